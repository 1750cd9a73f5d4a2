#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "output/modal_tables.h"

namespace dynalin {

namespace {

// Numbers always carry their exponent: what is small here is not nothing.
class SumTable {
 public:
  SumTable(std::ostream& out, const ModalTableFormat& format) : out_(out), digits_(std::max(format.precision, 5)) {}

  void title(const std::string& text) {
    const std::string rule(79, '-');
    fmt::print(out_, "  {0}\n  {1}\n  {0}\n", rule, text);
  }
  void head(std::initializer_list<std::string_view> names) {
    fmt::print(out_, "  {:<8}", "Mode");
    for (const std::string_view name : names) fmt::print(out_, "{:>{}}", name, width());
    fmt::print(out_, "\n");
  }
  template <class Values>
  void row(const std::string& label, const Values& values) {
    fmt::print(out_, "  {:<8}", label);
    for (const double v : values) fmt::print(out_, "{:{}.{}E}", v + 0.0, width(), digits_);
    fmt::print(out_, "\n");
  }
  void end() { fmt::print(out_, "\n"); }

 private:
  int width() const { return digits_ + 10; }
  std::ostream& out_;
  int digits_;
};

// "1, 2, 5-9"
std::string mode_list(const std::vector<std::size_t>& modes) {
  std::string text;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const std::size_t first = k;
    while (k + 1 < modes.size() && modes[k + 1] == modes[k] + 1) ++k;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", modes[first] + 1);
    if (k > first) text += fmt::format("-{}", modes[k] + 1);
  }
  return text;
}

void write_note(std::ostream& out, const std::vector<std::size_t>& modes, std::string_view what) {
  if (modes.empty()) return;
  fmt::print(out, "  Mode{} {}: {}.\n\n", modes.size() > 1 ? "s" : "", mode_list(modes), what);
}

double percent(double part, double whole) { return whole != 0 ? 100 * part / whole : 0; }

}  // namespace

void write_energies(std::ostream& out, const ModalTableFormat& format, const EnergyPerMode& energies,
                    const WantedMode& wanted) {
  EnergyPerMode::Share sum;
  for (std::size_t k = 0; k < energies.modes.size(); ++k) {
    if (!wanted(k)) continue;
    const auto& s = energies.modes[k];
    sum.kinetic += s.kinetic, sum.potential += s.potential, sum.power += s.power;
  }
  SumTable t(out, format);
  t.title("Energies per mode");
  t.head({"Kinetic", "percent", "Potential", "percent", "Diss. power", "percent"});
  const auto row = [&](const std::string& label, const EnergyPerMode::Share& s) {
    t.row(label, std::array{s.kinetic, percent(s.kinetic, sum.kinetic), s.potential,
                            percent(s.potential, sum.potential), s.power, percent(s.power, sum.power)});
  };
  for (std::size_t k = 0; k < energies.modes.size(); ++k) {
    if (wanted(k)) row(std::to_string(k + 1), energies.modes[k]);
  }
  row("Sum", sum);
  row("Model", energies.total);
  if (energies.total.kinetic == 0 && energies.total.power == 0) {
    fmt::print(out,
               "  The model is at rest: kinetic energy and dissipated power are zero, and in equilibrium the potential "
               "energy is zero as well, but for rounding.\n");
  }
  t.end();
  std::vector<std::size_t> without;
  for (std::size_t k = 0; k < energies.modes.size(); ++k) {
    if (wanted(k) && !energies.counted[k]) without.push_back(k);
  }
  write_note(out, without, "no share, the shape adds nothing to those of other modes");
}

void write_masses(std::ostream& out, const ModalTableFormat& format, const ModalMasses& masses, std::int64_t rm,
                  const WantedMode& wanted) {
  const std::string frame = rm > 0 ? fmt::format("in MARKER/{}", rm) : std::string("in global axes");
  SumTable t(out, format);
  t.title("Modal participation factors " + frame);
  t.head({"Gen. mass", "X", "Y", "Z", "RX", "RY", "RZ"});
  std::array<double, 6> sum{};
  for (std::size_t k = 0; k < masses.modes.size(); ++k) {
    if (!wanted(k)) continue;
    const auto& m = masses.modes[k];
    std::array<double, 7> real{m.generalized}, imaginary{};
    for (std::size_t d = 0; d < 6; ++d) {
      real[d + 1] = m.participation[d].real(), imaginary[d + 1] = m.participation[d].imag();
      sum[d] += m.effective[d];
    }
    t.row(std::to_string(k + 1), real);
    // Shapes of real modes are real but for rounding.
    double largest = 0;
    for (const auto& factor : m.participation) largest = std::max(largest, std::abs(factor));
    if (std::any_of(imaginary.begin(), imaginary.end(), [&](double x) { return std::abs(x) > 1e-10 * largest; }))
      t.row("  imag.", imaginary);
  }
  t.end();

  t.title("Modal effective mass " + frame);
  t.head({"X", "Y", "Z", "RX", "RY", "RZ"});
  const auto share = [&](const std::array<double, 6>& of) {
    std::array<double, 6> p{};
    for (std::size_t d = 0; d < 6; ++d) p[d] = percent(of[d], sum[d]);
    return p;
  };
  for (std::size_t k = 0; k < masses.modes.size(); ++k) {
    if (!wanted(k)) continue;
    t.row(std::to_string(k + 1), masses.modes[k].effective);
    t.row("  perc.", share(masses.modes[k].effective));
  }
  t.row("Sum", sum);
  t.row("Model", masses.total);
  t.end();
  const auto of_kind = [&](ModalMasses::Row::Kind kind) {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < masses.modes.size(); ++k) {
      if (wanted(k) && masses.modes[k].kind == kind) list.push_back(k);
    }
    return list;
  };
  write_note(out, of_kind(ModalMasses::Row::Kind::still), "nothing that has mass moves");
  write_note(out, of_kind(ModalMasses::Row::Kind::repeated), "the shape repeats those of modes before it");
}

}  // namespace dynalin
