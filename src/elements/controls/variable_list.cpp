#include "elements/controls/variable_list.h"

#include <fmt/format.h>

#include <algorithm>

namespace dynalin {

// Each place is a channel of its own.
void VariableListSet::warn_of_repeated(const VariableList& list, ElementReader& reader) {
  const Span name = reader.at("VARIABLES");
  const auto written = std::ranges::find_if(reader.statement().arguments,
                                            [&](const WrittenArgument& w) { return w.name.offset == name.offset; });
  if (written == reader.statement().arguments.end()) return;
  Diagnostics said;  // where it was read
  const auto ids = read_integers(*written, *name.source, said);
  for (std::size_t k = 0; ids && k < std::min(ids->size(), list.variables.size()); ++k) {
    const auto first = list.variables.begin(), here = first + static_cast<std::ptrdiff_t>(k);
    if (std::count(first, here, *here) != 1) continue;
    reader.warning("variable-twice", (*ids)[k].at,
                   fmt::format("{} names VARIABLE/{} more than once, and each place counts", reader.label().text(),
                               (*ids)[k].value));
  }
}

}  // namespace dynalin
