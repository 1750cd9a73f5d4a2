// Moving a point along a displacement δq: translations add, rotations turn about global axes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "system/system.h"

namespace dynalin {

// How far a step may move any body.
struct StepLimits {
  double rotation;  // [rad]
  double translation = std::numeric_limits<double>::infinity();
};

// What goes beyond the limits shortens the whole step, and so do the limits of other coordinates. Returns the factor
// that was used.
inline double displace(const System& system, OperatingPoint& op, const Eigen::Ref<const Eigen::VectorXd>& step,
                       const StepLimits& limits) {
  const Layout& layout = system.layout();
  double turn = 0, way = 0;
  for (const BodyBlock& b : layout.bodies) {
    if (b.turns()) turn = std::max(turn, step.segment<3>(b.offset + 3).norm());
    if (b.count > 0) way = std::max(way, step.segment<3>(b.offset).norm());
  }
  double factor = turn > limits.rotation ? limits.rotation / turn : 1.0;
  if (factor * way > limits.translation) factor = limits.translation / way;
  for (const ExtraBlock& e : layout.extras) {
    for (std::int32_t k = 0; k < e.count; ++k) {
      const double limit = e.coordinates[static_cast<std::size_t>(k)].largest_step;
      factor = std::min(factor, limit / std::max(std::abs(step(e.offset + k)), std::numeric_limits<double>::min()));
    }
  }
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const auto part = [&](Eigen::Index k) {
      return factor * Vector{step(block.offset + k), step(block.offset + k + 1), step(block.offset + k + 2)};
    };
    op.poses[b].r += part(0);
    if (block.turns()) op.poses[b].R = orthonormalized(rotation_exponential(part(3)) * op.poses[b].R);
  }
  for (std::size_t k = 0; k < op.extra.size(); ++k) {
    op.extra[k] += factor * step(layout.body_coordinate_count + static_cast<Eigen::Index>(k));
  }
  return factor;
}

}  // namespace dynalin
