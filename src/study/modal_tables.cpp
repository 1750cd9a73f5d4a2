#include "study/modal_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/view_names.h"

namespace dynalin {

namespace {

using Row = ModalTable::Row;
using Markers = std::span<const MarkerId>;

template <class T>
Row row_of(const ModalRow<T>& from) {
  const ElementLabel& label = *from.element;
  Row row{label.element(), from.part, std::string(label.view_name), {}, {}};
  row.full_name = view_path({}, from.carrier ? from.carrier->view_name : std::string_view{}, row.name);
  return row;
}

std::vector<Row> plain(const std::vector<ModalRow<double>>& from) {
  std::vector<Row> rows;
  for (const auto& r : from) rows.emplace_back(row_of(r)).values = r.values;
  return rows;
}

std::vector<Row> plain(const std::vector<ModalRow<std::complex<double>>>& from) {
  std::vector<Row> rows;
  for (const auto& r : from) {
    Row& row = rows.emplace_back(row_of(r));
    for (const std::complex<double>& v : r.values) row.values.push_back(v.real()), row.imaginary.push_back(v.imag());
  }
  return rows;
}

// Names in full where that of the model is known, else the names alone.
void name_in_full(std::string_view of_model, std::vector<Row>& rows) {
  for (Row& row : rows) {
    const bool whole = of_model.empty() || row.name.empty() || is_whole_view_name(of_model, row.name);
    row.full_name = whole ? row.name : view_path(of_model, {}, row.full_name);
  }
}

using Name = std::string_view;
constexpr std::array<Name, 6> six = {"X", "Y", "Z", "RX", "RY", "RZ"};
constexpr std::array<Name, 10> shares = {"X", "Y", "Z", "RXX", "RYY", "RZZ", "RXY", "RXZ", "RYZ", "Sum"};
constexpr std::array<Name, 7> works = {"Total", "X", "Y", "Z", "RXX", "RYY", "RZZ"};

ModalTable summary_of(std::size_t mode, const ModeHeader& h) {
  Row row;
  row.part = static_cast<std::int64_t>(mode + 1);
  row.values = {h.damping_ratio, h.frequency, h.stiffness, h.mass, h.kinetic_energy};
  return {"MODE",
          mode + 1,
          {"Damping ratio", "Undamped natural freq.", "Generalized stiffness", "Generalized mass", "Kinetic energy"},
          {std::move(row)}};
}

void look_for_missing(const ModalTableRequest& request, const std::vector<EigenMode>& modes,
                      std::string_view frequency_unit, Diagnostics& remarks) {
  const std::size_t count = modes.size();
  for (const auto& [name, range] : request.modes) {
    const auto is_there = [&, r = range](const EigenMode& m) { return r.has(0, m); };
    if (range.highest_hz > 0 && std::ranges::none_of(modes, is_there)) {
      remarks.warning("missing-mode", {},
                      fmt::format("F{} asks for modes between {:g} and {:g} {}, none is there", name, range.lowest_hz,
                                  range.highest_hz, frequency_unit));
    }
    if (range.last <= static_cast<std::int64_t>(count) || range.last == ModeRange::all().last) continue;
    remarks.warning("missing-mode", {},
                    fmt::format("{} asks for {} {}, the eigensolution has {} {}", name,
                                range.first == range.last ? "mode" : "modes up to", range.last, count,
                                count == 1 ? "mode" : "modes"));
  }
}

StudyFailure no_such(std::string_view what) {
  return StudyFailure({"linear analysis", fmt::format("{} does not exist", what), {}});
}

constexpr std::array kinds = {
    ModalTableKind{.name = "COORDS",
                   .help = "table of mode shapes",
                   .columns = six,
                   .title = "Normalized coordinates in this mode",
                   .rows = [](const ModalDistribution& d, std::size_t k, Markers) { return plain(d.coordinates(k)); }},
    ModalTableKind{.name = "MRANGE",
                   .help = "modes of MLIST",
                   .asked = TableAsked::by_numbers,
                   .columns = six,
                   .title = "Marker mode table",
                   .rows = [](const ModalDistribution& d, std::size_t k, Markers m) { return plain(d.markers(k, m)); }},
    ModalTableKind{.name = "KINETIC",
                   .help = "table of kinetic energy",
                   .columns = shares,
                   .title = "Percentage distribution of Kinetic energy",
                   .nothing = "Nothing that has mass moves in this mode.",
                   .totals = true,
                   .rows = [](const ModalDistribution& d, std::size_t k, Markers) { return plain(d.kinetic(k)); }},
    ModalTableKind{.name = "STRAIN",
                   .help = "table of strain energy",
                   .columns = works,
                   .title = "Percentage distribution of strain energy",
                   .nothing = "No element of this table stores energy in this mode.",
                   .no_share = "The energies of these elements cancel in this mode: none has a share.",
                   .short_names = true,
                   .rows = [](const ModalDistribution& d, std::size_t k, Markers) { return plain(d.strain(k)); }},
    ModalTableKind{.name = "DISSIPAT",
                   .help = "table of dissipated power",
                   .columns = works,
                   .title = "Percentage distribution of dissipative energy",
                   .nothing = "No element of this table dissipates power in this mode.",
                   .no_share = "The powers of these elements cancel in this mode: none has a share.",
                   .short_names = true,
                   .rows = [](const ModalDistribution& d, std::size_t k, Markers) { return plain(d.dissipation(k)); }},
    ModalTableKind{.name = "ENERGY_PER_MODE",
                   .help = "table of the energies of each mode",
                   .asked = TableAsked::all_or_by_numbers,
                   .of_all = energies_of_all,
                   .needs_all_modes = true},
    ModalTableKind{.name = "MASS_PER_MODE",
                   .help = "table of effective masses",
                   .asked = TableAsked::all_or_by_numbers,
                   .of_all = masses_of_all,
                   .only_argument = "MODAL_RM"},
};

}  // namespace

std::span<const ModalTableKind> modal_table_kinds() { return kinds; }

const ModalTableKind* find_modal_table(std::string_view name) {
  const auto found = std::ranges::find(kinds, name, &ModalTableKind::name);
  return found == kinds.end() ? nullptr : &*found;
}

bool asks_for_all_modes(const ModalTableRequest& request) {
  return std::ranges::any_of(kinds, [&](const ModalTableKind& kind) {
    return kind.needs_all_modes && request.of(std::string(kind.name)).any();
  });
}

bool ModeRange::has(std::size_t number, const EigenMode& mode) const {
  if (highest_hz > 0) {
    const double f = std::abs(mode.eigenvalue_hz.imag());
    return !mode.is_real && f >= lowest_hz && f <= highest_hz;
  }
  const auto n = static_cast<std::int64_t>(number);
  return first > 0 && n >= first && n <= last;
}

StudyResult<TablesFound> modal_tables(const Linearization& of, const EigenSolution& modes,
                                      const ModalTableRequest& request) {
  TablesFound found;
  const Model& model = of.system->model();
  std::vector<MarkerId> markers;
  for (const std::int64_t id : request.markers) {
    const auto marker = model.find_marker(id);
    if (!marker) return tl::unexpected(no_such(fmt::format("MARKER/{}", id)));
    markers.push_back(*marker);
  }
  for (const auto& [name, range] : request.modes) {
    if (!find_modal_table(name)) return tl::unexpected(no_such("the modal table " + name));
  }
  const ModalDistribution distribution(*of.system, of.linear, modes);
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    bool any = false;
    for (const ModalTableKind& kind : kinds) {
      if (!kind.rows || !request.of(std::string(kind.name)).has(k + 1, modes.modes[k])) continue;
      if (!any) found.tables.push_back(summary_of(k, distribution.header(k)));
      any = true;
      found.tables.push_back({std::string(kind.name),
                              k + 1,
                              {kind.columns.begin(), kind.columns.end()},
                              kind.rows(distribution, k, markers)});
      name_in_full(view_model_name(model.title), found.tables.back().rows);
      // Models with flexible bodies have their modal part before the sum.
      ModalTable& table = found.tables.back();
      if (kind.totals && !table.rows.empty() && table.rows.front().values.size() > table.columns.size())
        table.columns.insert(table.columns.end() - 1, "Modal");
    }
  }
  for (const ModalTableKind& kind : kinds) {
    if (!kind.of_all || !request.of(std::string(kind.name)).any()) continue;
    auto made = kind.of_all(of, modes, request);
    if (!made) return tl::unexpected(made.error());
    found.tables.insert(found.tables.end(), made->values.begin(), made->values.end());
    found.sums.insert(found.sums.end(), made->texts.begin(), made->texts.end());
  }
  look_for_missing(request, modes.modes, model.units.frequency(), found.remarks);
  return found;
}

}  // namespace dynalin
