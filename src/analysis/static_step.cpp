#include "analysis/static_step.h"

#include <algorithm>

#include "analysis/turned_wholes.h"

namespace dynalin {

namespace {

// The part of a step after which what bodies touch is looked at again.
double part_within_shapes(const Layout& layout, const Eigen::VectorXd& step) {
  double part = 1;
  for (const BodyBlock& b : layout.bodies) {
    if (b.count == 0) continue;
    const double way = step.segment<3>(b.offset).norm();
    if (way > b.largest_step) part = std::min(part, b.largest_step / way);
  }
  return part;
}

}  // namespace

OperatingPoint moved(const System& system, const OperatingPoint& from, const AugmentedSystem& augmented,
                     const Eigen::VectorXd& step, double fraction, const StepLimits& limits, double* taken) {
  OperatingPoint to = from;
  fraction *= part_within_shapes(system.layout(), fraction * step);
  const Eigen::VectorXd way = step.head(static_cast<Eigen::Index>(system.coordinates()));
  const double f = fraction * displace(system, to, fraction * way, limits);
  if (taken) *taken = f;
  turn_wholes(system.layout(), from, f * way, to);
  const auto add = [&](std::vector<double>& x, std::int32_t offset) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += f * step(offset + static_cast<Eigen::Index>(k));
  };
  add(to.lambda, augmented.lambda(0));
  add(to.algebraic, augmented.algebraic(0));
  add(to.state, augmented.state(0));
  return to;
}

}  // namespace dynalin
