// What the entries of the equations are made of: the sizes that their rounding is measured against.
//
// An entry that cancels to nothing keeps the roundings of what was added up to it. The three by three entries of a
// force or moment against the displacements or turns of a body come from one product of matrices and share the largest
// of their sizes. A body that turns with ω passes on, to what is a derivative along the motion, ω times the size of
// what is derived.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mechanics/equations.h"

namespace dynalin {

class RoundoffScales {
 public:
  RoundoffScales(const Layout&, const Motion&);

  // Of partials, with the pattern of eq.matrix(family); eq must keep sizes and hold accelerations.
  ColumnMatrix of(const Equations& eq, PartialBy family) const;
  // Of a row's coefficients, entry by entry.
  template <class Entries>
  std::vector<RowCoefficients> of_row(const Entries& row) const {
    std::vector<RowCoefficients> sizes;
    double turning = 0;
    for (const auto& e : row) turning = std::max(turning, turning_[static_cast<std::size_t>(e.column)]);
    for (const auto& e : row) {
      RowCoefficients s;
      for (const auto& other : row) {
        if (group(other.column) != group(e.column)) continue;
        s.g = std::max(s.g, std::abs(other.c.g));
        s.v = std::max(s.v, std::abs(other.c.v));
        s.a1 = std::max(s.a1, std::abs(other.c.a1));
        s.a0 = std::max(s.a0, std::abs(other.c.a0));
      }
      s.v = std::max(s.v, turning * s.g);
      s.a1 = std::max(s.a1, 2 * s.v);
      s.a0 = std::max(s.a0, turning * s.v);
      sizes.push_back(s);
    }
    return sizes;
  }

 private:
  // Rows and columns of one vector of a body have the same; all others stand alone.
  std::int32_t group(std::int32_t k) const {
    const auto at = static_cast<std::size_t>(k);
    return at < group_.size() ? group_[at] : k;
  }

  std::vector<std::int32_t> group_;  // of coordinates: the first of their vector
  std::vector<double> turning_;      // of their bodies: √(ω² + |α|) [rad/time]
};

}  // namespace dynalin
