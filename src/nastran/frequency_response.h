// SOL 108: loads of the input channels, the frequencies, and the subcases that combine them.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "nastran/card_file.h"
#include "nastran/export_options.h"
#include "nastran/ids.h"

namespace dynalin::nastran {

// What case control says of a subcase.
struct ResponseCase {
  std::int64_t number = 0, dload = 0, set = 0;
  std::string label;
  std::vector<std::int64_t> grids;  // of the set
};

// Ascending numbers, as Nastran wants them. Writes the cards; a subcase without any channel left is left out with a
// remark.
std::vector<ResponseCase> write_response(const Deck&, const ExportOptions&, Ids&, CardFile&, Diagnostics& remarks);

}  // namespace dynalin::nastran
