// How a point has moved from another: the displacement that leads from one to the other.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "system/system.h"

namespace dynalin {

// The rotation that turns `from` into `to`, as a vector in global axes; less than half a turn.
inline Vector turn_between(const Matrix3& from, const Matrix3& to) {
  const Matrix3 R = to * transpose(from);
  const Vector twice_sine = {R.y.z - R.z.y, R.z.x - R.x.z, R.x.y - R.y.x};
  const double s = norm(twice_sine), c = R.x.x + R.y.y + R.z.z - 1;
  return s > 0 ? std::atan2(s, c) / s * twice_sine : Vector{};
}

// By the coordinates of the layout.
inline Eigen::VectorXd change_between(const System& system, const OperatingPoint& from, const OperatingPoint& to) {
  const Layout& layout = system.layout();
  Eigen::VectorXd change(static_cast<Eigen::Index>(system.coordinates()));
  const auto put = [&](std::int32_t first, const Vector& v) {
    for (std::size_t k = 0; k < 3; ++k) change(first + static_cast<Eigen::Index>(k)) = v[k];
  };
  for (std::size_t b = 0; b < to.poses.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count > 0) put(block.offset, to.poses[b].r - from.poses[b].r);
    if (block.turns()) put(block.offset + 3, turn_between(from.poses[b].R, to.poses[b].R));
  }
  for (std::size_t k = 0; k < to.extra.size(); ++k)
    change(layout.body_coordinate_count + static_cast<Eigen::Index>(k)) = to.extra[k] - from.extra[k];
  return change;
}

// f(first, count) for the parts of a displacement that belong together: an origin, a rotation, a coordinate outside
// bodies.
template <class Function>
void for_each_part(const Layout& layout, Function&& f) {
  for (const BodyBlock& b : layout.bodies) {
    for (std::int32_t k = 0; k < b.count; k += 3) f(b.offset + k, 3);
  }
  for (std::int32_t k = layout.body_coordinate_count; k < layout.coordinate_count; ++k) f(k, 1);
}

// In lengths of the model and radians.
inline double length_of(const System& system, const Eigen::VectorXd& change) {
  double length = 0;
  for_each_part(system.layout(), [&](std::int32_t first, std::int32_t count) {
    length = std::max(length, change.segment(first, count).norm() / system.coordinate_scale(first));
  });
  return length;
}

}  // namespace dynalin
