#include "simulation/pose_interpolation.h"

#include "analysis/displace.h"
#include "simulation/motion_courses.h"

namespace dynalin {

OperatingPoint interpolated(const System& system, const OperatingPoint& before, const OperatingPoint& after,
                            double time) {
  const auto vector = [](const std::vector<double>& x) {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  };
  const double h = after.time - before.time, s = (time - before.time) / h;
  const Eigen::VectorXd change = change_between(system, before, after);
  const Eigen::VectorXd v0 = h * vector(before.velocity), v1 = h * vector(after.velocity);
  const Eigen::VectorXd a0 = h * h * vector(before.acceleration), a1 = h * h * vector(after.acceleration);
  // q = v₀ s + a₀ s²/2 + c₃ s³ + c₄ s⁴ + c₅ s⁵
  const Eigen::VectorXd q = change - v0 - 0.5 * a0, v = v1 - v0 - a0, a = a1 - a0;
  const Eigen::VectorXd c3 = 10 * q - 4 * v + 0.5 * a, c4 = -15 * q + 7 * v - a, c5 = 6 * q - 3 * v + 0.5 * a;
  OperatingPoint op = before;
  op.time = time;
  displace(system, op, s * (v0 + s * (0.5 * a0 + s * (c3 + s * (c4 + s * c5)))),
           {std::numeric_limits<double>::infinity()});
  const Eigen::VectorXd rate = (v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h;
  op.velocity.assign(rate.begin(), rate.end());
  const auto between = [&](std::vector<double>& x, const std::vector<double>& other) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += s * (other[k] - x[k]);
  };
  // The rounding of accelerations near such a place is far above that of velocities.
  const Eigen::VectorXd acceleration = ((v1 - v0) + (s - 0.5) * a) / (h * h);
  op.acceleration.assign(acceleration.begin(), acceleration.end());
  between(op.lambda, after.lambda);
  between(op.algebraic, after.algebraic);
  between(op.state_rate, after.state_rate);
  advance_courses(system, before, op);
  system.remember(op);
  return op;
}

}  // namespace dynalin
