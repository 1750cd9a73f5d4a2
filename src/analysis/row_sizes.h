// In what sizes violations of constraint rows are told from rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "expression/parametric_curve.h"
#include "mechanics/row_terms.h"
#include "system/system.h"

namespace dynalin {

// What a row makes of a displacement by the model's length, or of a radian.
inline double row_scale(const System& system, std::span<const ConstraintRows::Entry> row) {
  double scale = 0;
  for (const auto& e : row) scale = std::max(scale, std::abs(e.c.g) * system.coordinate_scale(e.column));
  return scale > 0 ? scale : 1.0;
}

// Of each coordinate, what its last place is counted from: the farthest component of an origin, a radian, half the
// parameters of a curve. The amplitude of a shape has no other size than its own: its unit is that of the shape.
inline std::vector<double> coordinate_sizes(const Layout& layout, const OperatingPoint& op) {
  std::vector<double> size(static_cast<std::size_t>(layout.coordinate_count), 1.0);
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const Vector& r = op.poses[b].r;
    std::fill_n(size.begin() + block.offset, 3, std::max({std::abs(r.x), std::abs(r.y), std::abs(r.z)}));
  }
  for (const CurvePoint& c : layout.curve_points) size[static_cast<std::size_t>(c.coordinate)] = 0.5 * c.curve->range();
  for (const ExtraBlock& e : layout.extras) {
    if (e.is_shape()) std::fill_n(size.begin() + e.offset, e.count, 0.0);
  }
  for (std::size_t k = 0; k < op.extra.size(); ++k) {
    double& own = size[static_cast<std::size_t>(layout.body_coordinate_count) + k];
    own = std::max(own, std::abs(op.extra[k]));
  }
  return size;
}

// What the last places of the coordinates, and those of its other terms, make of a row: it sums up some of them, and
// frames round as well.
inline double row_rounding(const std::vector<double>& sizes, std::span<const ConstraintRows::Entry> row,
                           const RowTerms& terms) {
  constexpr double rounding_units = 8;
  double sum = terms.size;
  for (const auto& e : row) sum += std::abs(e.c.g) * sizes[static_cast<std::size_t>(e.column)];
  return rounding_units * std::numeric_limits<double>::epsilon() * sum;
}

}  // namespace dynalin
