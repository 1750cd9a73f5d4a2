// How much an error of each unknown of the equations of motion counts.
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/motion_equations.h"

namespace dynalin {

namespace {

// The smallest size of a state that errors are a part of; there is no other unit for what is zero.
constexpr double least_state = 1e-6;
// Of what no error is asked.
constexpr double no_weight = 1e-30;
constexpr double some_steps = 10;
// Of a value, what rounding makes of its differences from step to step.
constexpr double motion_rounding = 100 * std::numeric_limits<double>::epsilon();

}  // namespace

void MotionEquations::weights(double step, std::span<const double> y, std::span<double> weight) const {
  const Layout& layout = system_.layout();
  std::fill(weight.begin(), weight.end(), no_weight);
  const double part = dilution_ / tolerance_.relative;
  // A velocity counts by the way it makes until the end, or as a part of the fastest. In short steps it counts by the
  // way that it makes in some of them: errors of velocities that stiff springs hold do not shrink with the step.
  double fastest = std::max(fastest_, 1 / tolerance_.duration);
  if (step > 0) fastest = std::max(fastest, 1 / (some_steps * step));
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const auto at = static_cast<std::size_t>(unknowns_.position(b));
    for (std::size_t k = 0; k < 3; ++k) weight[at + k] = part / system_.length();
    for (std::size_t k = 3; block.turns() && k < 7; ++k) weight[at + k] = 2 * part;
  }
  for (std::int32_t k = 0; k < layout.coordinate_count; ++k) {
    const double scale = system_.coordinate_scale(k);
    if (k >= layout.body_coordinate_count)
      weight[static_cast<std::size_t>(unknowns_.extra(layout.extra_index(k)))] = part / scale;
    const auto at = static_cast<std::size_t>(unknowns_.velocity(k));
    if (differential_[at] != 0.0) weight[at] = part / (scale * fastest);
  }
  for (std::size_t k = 0; k < layout.states.size(); ++k) {
    const auto at = static_cast<std::size_t>(unknowns_.state(static_cast<std::int32_t>(k)));
    if (differential_[at] != 0.0) weight[at] = part / std::max(largest_state_[k], least_state);
  }
  for (std::size_t k = 0; k < y.size(); ++k)
    weight[k] = std::min(weight[k], dilution_ / (motion_rounding * std::abs(y[k])));
}

}  // namespace dynalin
