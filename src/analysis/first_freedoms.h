// What nothing holds at rest though something did where the search began. Where a force has faded with distance it is
// an illusion: put back, it is pushed again. Where the point is at rest all the same with it where it was, as a box in
// a tower is turned about the vertical, it is free.
#pragma once

#include <optional>
#include <vector>

#include "analysis/static_equations.h"

namespace dynalin {

// The point where a search began, and the unknowns that nothing held there.
struct FirstFreedoms {
  OperatingPoint at;
  std::vector<bool> free;
};

FirstFreedoms freedoms_at(StaticEquations&, const OperatingPoint&);

// `op`, the point of the last evaluation, with what its tangent leaves open as it was at `first`. Nothing where that is
// no single step.
std::optional<OperatingPoint> put_back(StaticEquations&, const OperatingPoint& op, const OperatingPoint& first);

}  // namespace dynalin
