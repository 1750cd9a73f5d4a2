// The file of a SPLINE: lines of numbers, x first, in blocks that have names.
//
// Text in brackets alone on a line begins a block, text in parentheses alone on a line a list within it; lines that
// begin with ! $ # { or hold an equals sign are passed over.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "model/reader.h"

namespace dynalin {

// The points of one list, line by line, and the z of its curves where a line `Z z1 z2 …` states them.
struct SplineTable {
  std::vector<std::vector<double>> rows;  // x first, all of them as long
  std::vector<double> z;
};

// The only list of points in the named block, of the whole file where no block is named. Anything else is an error.
std::optional<SplineTable> read_spline_table(const SourceText& file, std::string_view block, ElementReader& reader);

}  // namespace dynalin
