// How large the terms of the equations of motion are: what rounding leaves of an equation is a part of them.
#include <algorithm>
#include <cmath>

#include "simulation/motion_equations.h"
#include "system/row_terms.h"

namespace dynalin {

void MotionEquations::terms(std::span<const double> y, std::span<const double> yp, std::span<double> size) const {
  const Layout& layout = system_.layout();
  const auto value = [&](std::int32_t k) { return std::abs(y[static_cast<std::size_t>(k)]); };
  const auto at = [&](std::int32_t k) -> double& { return size[static_cast<std::size_t>(k)]; };
  std::fill(size.begin(), size.end(), 0.0);
  // Kinematics: rates of positions against velocities, and the places that rates are differences of.
  std::vector<double> place(static_cast<std::size_t>(layout.coordinate_count), 1.0);
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const std::int32_t first = unknowns_.position(b), count = block.turns() ? 7 : 3;
    double far = system_.length();
    for (std::int32_t k = 0; k < 3; ++k) far = std::max(far, value(first + k));
    for (std::int32_t k = 0; k < count; ++k) at(first + k) = std::abs(yp[static_cast<std::size_t>(first + k)]);
    for (std::int32_t k = 0; block.turns() && k < 3; ++k) {
      for (std::int32_t j = 3; j < 7; ++j) at(first + j) += 0.5 * value(unknowns_.velocity(block.offset + 3 + k));
    }
    for (std::int32_t k = 0; k < std::min(block.count, 3); ++k) place[static_cast<std::size_t>(block.offset + k)] = far;
  }
  for (std::int32_t k = layout.body_coordinate_count; k < layout.coordinate_count; ++k) {
    const std::int32_t extra = unknowns_.extra(layout.extra_index(k));
    at(extra) = std::abs(yp[static_cast<std::size_t>(extra)]);
    place[static_cast<std::size_t>(k)] = std::max(system_.coordinate_scale(k), value(extra));
  }
  const std::vector<RowTerms> beside_poses = row_terms(system_, motion_);
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    const std::int32_t mu = unknowns_.mu(k), lambda = unknowns_.lambda(k);
    if (!active_[static_cast<std::size_t>(k)]) continue;
    if (mu >= 0) at(mu) = beside_poses[static_cast<std::size_t>(k)].size;
    double rate = 0, acceleration = 0;  // by motion alone
    for (const auto& e : rows_.row(k)) {
      const double g = static_cast<double>(e.size_of_g);
      const auto velocity = static_cast<std::size_t>(unknowns_.velocity(e.column));
      at(lambda) += g * std::abs(y[velocity]);
      if (mu >= 0) at(mu) += g * place[static_cast<std::size_t>(e.column)];
      rate += e.c.g * y[velocity], acceleration += e.c.g * yp[velocity] + e.c.v * y[velocity];
    }
    // Time itself is rounded from step to step. A second derivative that has no value is asked for nowhere else.
    const auto in_last_place_of_time = [&](double by_time) {
      return std::isfinite(by_time) ? std::abs(motion_.time * by_time) : 0.0;
    };
    const Taylor& along = rows_.along_motion(k);
    if (mu >= 0) at(mu) += in_last_place_of_time(along.rate - rate);
    at(lambda) += in_last_place_of_time((mu >= 0 ? along.acceleration : along.rate) - acceleration);
  }
  for (std::int32_t k = 0; k < eq_.size(); ++k)
    at(unknowns_.equation(k)) = eq_.magnitude()[static_cast<std::size_t>(k)];
}

}  // namespace dynalin
