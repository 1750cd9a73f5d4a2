#include "routine/measures.h"

#include <algorithm>
#include <array>
#include <string>

#include "dataset/characters.h"

namespace dynalin {

namespace {

// A list of measures of markers, and how many of the ids each of them takes.
struct MarkerList {
  std::string_view name;
  std::array<std::string_view, 9> functions;
  std::size_t first_count, first_ids, further_ids;  // of the first functions, of those that follow
};
constexpr std::array<MarkerList, 16> marker_lists = {{
    {"DISP", {"DX", "DY", "DZ", "PSI", "THETA", "PHI"}, 3, 3, 2},
    {"TDISP", {"DX", "DY", "DZ"}, 3, 3, 0},
    {"RDISP", {"PSI", "THETA", "PHI"}, 3, 2, 0},
    {"VEL", {"VX", "VY", "VZ", "WX", "WY", "WZ"}, 3, 4, 3},
    {"TVEL", {"VX", "VY", "VZ"}, 3, 4, 0},
    {"RVEL", {"WX", "WY", "WZ"}, 3, 3, 0},
    {"ACC", {"ACCX", "ACCY", "ACCZ", "WDTX", "WDTY", "WDTZ"}, 3, 4, 4},
    {"TACC", {"ACCX", "ACCY", "ACCZ"}, 3, 4, 0},
    {"RACC", {"WDTX", "WDTY", "WDTZ"}, 3, 4, 0},
    {"FORCE", {"FX", "FY", "FZ", "TX", "TY", "TZ"}, 6, 3, 0},
    {"TFORCE", {"FX", "FY", "FZ"}, 3, 3, 0},
    {"RFORCE", {"TX", "TY", "TZ"}, 3, 3, 0},
    {"UVX", {"UVX.X", "UVX.Y", "UVX.Z"}, 3, 2, 0},
    {"UVY", {"UVY.X", "UVY.Y", "UVY.Z"}, 3, 2, 0},
    {"UVZ", {"UVZ.X", "UVZ.Y", "UVZ.Z"}, 3, 2, 0},
    {"DC", {"UVX.X", "UVY.X", "UVZ.X", "UVX.Y", "UVY.Y", "UVZ.Y", "UVX.Z", "UVY.Z", "UVZ.Z"}, 9, 2, 0},
}};

// Entry by entry of what a function reads.
struct ElementList {
  std::string_view name, function;
};
constexpr std::array<ElementList, 3> element_lists = {
    {{"ARRAY", "ARYVAL"}, {"PINPUT", "PINVAL"}, {"POUTPUT", "POUVAL"}}};

// x′ of a GSE, which no expression of the language reads.
constexpr AtomFunction rate_of_state_equations = {.name = "GSE_XDOT",
                                                  .family = AtomFamily::data,
                                                  .order = -1,
                                                  .minimum_arguments = 2,
                                                  .maximum_arguments = 2,
                                                  .statement = "GSE",
                                                  .built = true,
                                                  .reads = DataSource::state_rate};

// The modal coordinates of a flexible body and their rates, unknowns of its own where a routine asks for them.
constexpr AtomFunction list_of_modes(std::string_view name) {
  return {.name = name,
          .family = AtomFamily::data,
          .order = -1,
          .minimum_arguments = 2,
          .maximum_arguments = 2,
          .statement = "FLEX_BODY",
          .built = true,
          .reads = DataSource::unknown};
}
constexpr std::array<AtomFunction, 2> modal_lists = {list_of_modes("Q"), list_of_modes("QDOT")};

Atom entry_of(const AtomFunction& list, std::int32_t id, std::size_t n) {
  Atom atom;
  atom.function = &list;
  atom.argument = {id, static_cast<std::int32_t>(n)};
  atom.argument_count = 2;
  return atom;
}

std::optional<Atom> atom_of(std::string_view function, std::span<const int> ids) {
  Atom atom;
  atom.function = find_atom_function(function);
  if (!atom.function || !atom.function->built || atom.function->family == AtomFamily::delay) return std::nullopt;
  if (ids.size() < atom.function->minimum_arguments || ids.size() > atom.function->maximum_arguments)
    return std::nullopt;
  std::copy(ids.begin(), ids.end(), atom.argument.begin());
  atom.argument_count = static_cast<std::uint8_t>(ids.size());
  return atom;
}

}  // namespace

std::optional<Atom> single_measure(std::string_view name, std::span<const int> ids) {
  if (name.find('.') != std::string_view::npos) return std::nullopt;  // not of the language
  return atom_of(upper_case(name), ids);
}

std::optional<std::vector<Atom>> measure_list(std::string_view name, std::span<const int> ids,
                                              const SizeOfList& size_of) {
  const std::string wanted = upper_case(name);
  std::vector<Atom> list;
  for (const MarkerList& m : marker_lists) {
    if (m.name != wanted) continue;
    if (ids.empty() || ids.size() > 4) return std::nullopt;
    for (std::size_t k = 0; k < m.functions.size() && !m.functions[k].empty(); ++k) {
      const std::size_t most = k < m.first_count ? m.first_ids : m.further_ids;
      const auto atom = atom_of(m.functions[k], ids.subspan(0, std::min(ids.size(), most)));
      if (!atom) return std::nullopt;
      list.push_back(*atom);
    }
    return list;
  }
  for (const ElementList& e : element_lists) {
    if (e.name != wanted) continue;
    const auto count = ids.size() == 1 ? size_of(find_atom_function(e.function)->statement, ids[0]) : std::nullopt;
    if (!count) return std::nullopt;
    for (std::size_t n = 1; n <= *count; ++n)
      list.push_back(*atom_of(e.function, std::array{ids[0], static_cast<int>(n)}));
    return list;
  }
  for (const AtomFunction* f : {&rate_of_state_equations, &modal_lists[0], &modal_lists[1]}) {
    if (wanted != f->name || ids.size() != 1) continue;
    const auto count = size_of(f->statement, ids[0]);
    if (!count) return std::nullopt;
    for (std::size_t n = 1; n <= *count; ++n) list.push_back(entry_of(*f, ids[0], n));
    return list;
  }
  return std::nullopt;
}

bool reads_modes(const Atom& atom) {
  return atom.function->reads == DataSource::unknown && atom.function->statement == modal_lists[0].statement;
}
bool reads_modal_rate(const Atom& atom) { return atom.function == &modal_lists[1]; }

}  // namespace dynalin
