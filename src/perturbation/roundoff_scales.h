// What the entries of the equations are made of: the sizes that their rounding is measured against.
//
// An entry that cancels to nothing keeps the roundings of what was added up to it (pair_sizes.h). The three by three
// entries of a force or moment against the displacements or turns of a body come from one product of matrices and share
// the largest of their sizes. A body that turns with ω passes on, to what is a derivative along the motion, ω times the
// size of what is derived.
//
// How many roundings an entry has gone through is counted along the longest way from the data to it, to first order: a
// sum of three products rounds three times. Axes of the markers are products of two rotations, the frame of I seen from
// J is one of theirs, and what stands in axes of J is turned by them once more: 15. Each derivative along the motion
// makes every product a sum, and those of the axes of a body are cross products with ω: four more each. A force goes
// from axes of J to global ones on both sides of its stiffness and takes a lever arm: 23. An entry that is not measured
// along axes is a number of the dataset, rounded when it was read.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mechanics/equations.h"

namespace dynalin {

class RoundoffScales {
 public:
  // Roundings on the longest way of what is measured along axes, and of a number of the dataset.
  static constexpr double along_axes = 23, as_read = 1;

  RoundoffScales(const Layout&, const Motion&);

  // Of partials, entry by entry of eq.matrix(family); eq must keep sizes and hold accelerations.
  std::vector<double> of(const Equations& eq, PartialBy family) const;
  // What roundings have left of the entries of a family, in half units of the last place, from their sizes. Blocks of
  // numbers that are so short that they were never rounded count nothing.
  std::vector<double> roundings(const Equations& eq, PartialBy family, std::vector<double> sizes) const;
  template <class Entries>
  std::vector<RowCoefficients> roundings_of_row(const Entries& row, const std::vector<RowCoefficients>& sizes) const {
    constexpr double of_value = 15, of_rate = 19, of_acceleration = 23;
    std::vector<RowCoefficients> roundings;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      const RowCoefficients& s = sizes[k];
      bool exact = true;
      for (const auto& other : row) {
        if (group(other.column) == group(row[k].column)) exact = exact && is_short(other.c.g, s.g);
      }
      roundings.push_back({exact ? 0 : of_value * s.g, of_rate * s.v, of_rate * s.a1, of_acceleration * s.a0});
    }
    return roundings;
  }
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
        s.g = std::max({s.g, std::abs(other.c.g), static_cast<double>(other.size_of_g)});
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
  // Whether a number has so few digits, counted from the first one of what it is compared with, that none was rounded.
  static bool is_short(double v, double size) {
    int exponent = 0;
    std::frexp(size, &exponent);
    const double digits = std::ldexp(v, 26 - exponent);
    return digits == std::trunc(digits);
  }
  template <class Work>
  void for_blocks(const ColumnMatrix&, bool by_coordinates, Work&&) const;
  // Rows and columns of one vector of a body have the same; all others stand alone.
  std::int32_t group(std::int32_t k) const {
    const auto at = static_cast<std::size_t>(k);
    return at < group_.size() ? group_[at] : k;
  }

  std::vector<std::int32_t> group_;  // of coordinates: the first of their vector
  std::vector<double> turning_;      // of their bodies: √(ω² + |α|) [rad/time]
};

}  // namespace dynalin
