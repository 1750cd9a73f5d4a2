#include "study/sums_over_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "modal/energy_per_mode.h"
#include "modal/modal_masses.h"

namespace dynalin {

namespace {

using Wanted = std::vector<std::size_t>;

Wanted wanted_of(const EigenSolution& of, const ModeRange& range) {
  Wanted wanted;
  for (std::size_t k = 0; k < of.modes.size(); ++k) {
    if (range.has(k + 1, of.modes[k])) wanted.push_back(k);
  }
  return wanted;
}

template <class Fill>
ModalTable table_over(const Wanted& wanted, std::string name, std::vector<std::string> columns, const Fill& fill) {
  ModalTable table{std::move(name), 0, std::move(columns), {}};
  for (const std::size_t k : wanted) {
    ModalTable::Row& row = table.rows.emplace_back();
    row.part = static_cast<std::int64_t>(k + 1);
    fill(k, row);
  }
  return table;
}

std::string number_of(std::size_t mode) { return std::to_string(mode + 1); }

template <class Values>
std::vector<double> listed(const Values& values) {
  return {values.begin(), values.end()};
}

double percent(double part, double whole) { return whole != 0 ? 100 * part / whole : 0; }

// "1, 2, 5-9"
std::string mode_list(const Wanted& modes) {
  std::string text;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const std::size_t first = k;
    while (k + 1 < modes.size() && modes[k + 1] == modes[k] + 1) ++k;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", number_of(modes[first]));
    if (k > first) text += fmt::format("-{}", number_of(modes[k]));
  }
  return text;
}

// Of the wanted modes that are so.
template <class Predicate>
void note(SumsOverModes& sums, const Wanted& wanted, std::string_view what, const Predicate& is_so) {
  Wanted modes;
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(modes), is_so);
  if (modes.empty()) return;
  sums.notes.push_back(fmt::format("Mode{} {}: {}.", modes.size() > 1 ? "s" : "", mode_list(modes), what));
}

SumsOverModes energy_sums(const EnergyPerMode& energies, const Wanted& wanted) {
  EnergyPerMode::Share sum;
  for (const std::size_t k : wanted) {
    const EnergyPerMode::Share& s = energies.modes[k];
    sum.kinetic += s.kinetic, sum.potential += s.potential, sum.power += s.power;
  }
  SumsOverModes sums{.title = "Energies per mode",
                     .columns = {"Kinetic", "percent", "Potential", "percent", "Diss. power", "percent"},
                     .lines = {},
                     .below = {},
                     .notes = {}};
  const auto add = [&](std::string label, const EnergyPerMode::Share& s) {
    sums.lines.push_back({std::move(label),
                          {s.kinetic, percent(s.kinetic, sum.kinetic), s.potential, percent(s.potential, sum.potential),
                           s.power, percent(s.power, sum.power)}});
  };
  for (const std::size_t k : wanted) add(number_of(k), energies.modes[k]);
  add("Sum", sum);
  add("Model", energies.total);
  if (energies.at_rest)
    sums.below =
        "The model is at rest: kinetic energy and dissipated power are zero, and in equilibrium the potential energy "
        "is "
        "zero as well, but for rounding.";
  note(sums, wanted, "no share, the shape adds nothing to those of other modes",
       [&](std::size_t k) { return !energies.counted[k]; });
  return sums;
}

SumsOverModes participation_sums(const ModalMasses& masses, const Wanted& wanted, const std::string& frame) {
  SumsOverModes sums{.title = "Modal participation factors " + frame,
                     .columns = {"Gen. mass", "X", "Y", "Z", "RX", "RY", "RZ"},
                     .lines = {},
                     .below = {},
                     .notes = {}};
  for (const std::size_t k : wanted) {
    const ModalMasses::Row& m = masses.modes[k];
    std::array<double, 7> real{m.generalized}, imaginary{};
    // Shapes of real modes are real but for rounding.
    double largest = 0;
    for (std::size_t d = 0; d < 6; ++d) {
      real[d + 1] = m.participation[d].real(), imaginary[d + 1] = m.participation[d].imag();
      largest = std::max(largest, std::abs(m.participation[d]));
    }
    sums.lines.push_back({number_of(k), listed(real)});
    if (std::any_of(imaginary.begin(), imaginary.end(), [&](double x) { return std::abs(x) > 1e-10 * largest; }))
      sums.lines.push_back({"  imag.", listed(imaginary)});
  }
  return sums;
}

SumsOverModes effective_mass_sums(const ModalMasses& masses, const EigenSolution& modes, const Wanted& wanted,
                                  const std::string& frame) {
  std::array<double, 6> sum{};
  for (const std::size_t k : wanted) {
    for (std::size_t d = 0; d < 6; ++d) sum[d] += masses.modes[k].effective[d];
  }
  SumsOverModes sums{.title = "Modal effective mass " + frame,
                     .columns = {"X", "Y", "Z", "RX", "RY", "RZ"},
                     .lines = {},
                     .below = {},
                     .notes = {}};
  for (const std::size_t k : wanted) {
    const std::array<double, 6>& mass = masses.modes[k].effective;
    std::array<double, 6> share{};
    for (std::size_t d = 0; d < 6; ++d) share[d] = percent(mass[d], sum[d]);
    sums.lines.push_back({number_of(k), listed(mass)});
    sums.lines.push_back({"  perc.", listed(share)});
  }
  sums.lines.push_back({"Sum", listed(sum)});
  sums.lines.push_back({"Model", listed(masses.total)});
  const auto is_of = [&](ModalMasses::Row::Kind kind) {
    return [&masses, kind](std::size_t k) { return masses.modes[k].kind == kind; };
  };
  note(sums, wanted, "nothing that has mass moves", is_of(ModalMasses::Row::Kind::still));
  note(sums, wanted, "the shape repeats those of modes before it", is_of(ModalMasses::Row::Kind::repeated));
  if (modes.selected)
    sums.notes.emplace_back(
        "Sums and percentages are those of selected modes: what Sum lacks of Model is in modes that were not asked "
        "for.");
  return sums;
}

}  // namespace

StudyResult<TablesOfAllModes> energies_of_all(const Linearization& of, const EigenSolution& modes,
                                              const ModalTableRequest& request) {
  if (modes.selected) {
    return tl::unexpected(StudyFailure({"energies per mode",
                                        "they share out the energy of the model among all of its modes, and these are "
                                        "selected ones",
                                        {}}));
  }
  const auto energies = energy_per_mode(*of.system, of.point, of.linear, modes);
  if (!energies) return tl::unexpected(StudyFailure(energies.error()));
  const Wanted wanted = wanted_of(modes, request.of("ENERGY_PER_MODE"));
  const auto fill = [&](std::size_t k, ModalTable::Row& row) {
    const EnergyPerMode::Share& share = energies->modes[k];
    row.values = {share.kinetic, share.potential, share.power};
  };
  return TablesOfAllModes{{table_over(wanted, "ENERGY_PER_MODE", {"Kinetic", "Potential", "Diss. power"}, fill)},
                          {energy_sums(*energies, wanted)}};
}

StudyResult<TablesOfAllModes> masses_of_all(const Linearization& of, const EigenSolution& modes,
                                            const ModalTableRequest& request) {
  const auto frame = request.modal_rm ? of.system->model().find_marker(*request.modal_rm) : MarkerId{};
  if (!frame) {
    return tl::unexpected(
        StudyFailure({"linear analysis", fmt::format("MARKER/{} does not exist", *request.modal_rm), {}}));
  }
  const ModalMasses masses = modal_masses(*of.system, of.point, of.linear, modes, *frame);
  const Wanted wanted = wanted_of(modes, request.of("MASS_PER_MODE"));
  const std::string in_frame =
      request.modal_rm.value_or(0) > 0 ? fmt::format("in MARKER/{}", *request.modal_rm) : std::string("in global axes");
  TablesOfAllModes made;
  made.texts = {participation_sums(masses, wanted, in_frame), effective_mass_sums(masses, modes, wanted, in_frame)};
  made.values.push_back(table_over(wanted, "PARTICIPATION", made.texts[0].columns, [&](std::size_t k, auto& row) {
    const ModalMasses::Row& m = masses.modes[k];
    row.values = {m.generalized}, row.imaginary = {0};
    for (const auto& f : m.participation) row.values.push_back(f.real()), row.imaginary.push_back(f.imag());
  }));
  made.values.push_back(table_over(wanted, "EFFECTIVE_MASS", made.texts[1].columns,
                                   [&](std::size_t k, auto& row) { row.values = listed(masses.modes[k].effective); }));
  return made;
}

}  // namespace dynalin
