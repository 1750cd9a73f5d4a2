#include "elements/families/flexible_motion.h"

namespace dynalin::flexible_motion {

namespace {

using Index = Eigen::Index;
using Eigen::VectorXd;

void put(Matrix3& m, std::size_t component, double x) {
  const auto [i, k] = tensor_components[component];
  m(i, k) += x;
  if (i != k) m(k, i) += x;
}

}  // namespace

Contracted contract(const ModalInertia& I, const Motion& motion, std::size_t first_extra) {
  const std::size_t n = I.modes();
  const auto of = [&](const std::vector<double>& all) {
    return VectorXd(Eigen::Map<const VectorXd>(all.data() + first_extra, static_cast<Index>(n)));
  };
  Contracted c{of(motion.extra),
               of(motion.extra_rate),
               of(motion.extra_acceleration),
               I.turning,
               {},
               {},
               I.tensor_by_mode,
               {},
               {}};
  c.G1.resize(n), c.G2.resize(n), c.J1.resize(n);
  for (std::size_t a = 0; a < 3; ++a) {
    const VectorXd x = I.turning_by_mode[a].transpose() * c.q, x1 = I.turning_by_mode[a].transpose() * c.q1,
                   x2 = I.turning_by_mode[a].transpose() * c.q2;
    for (std::size_t k = 0; k < n; ++k) {
      const auto at = static_cast<Index>(k);
      c.G[k][a] += x(at), c.G1[k][a] = x1(at), c.G2[k][a] = x2(at);
    }
  }
  for (std::size_t at = 0; at < tensor_components.size(); ++at) {
    const VectorXd x = I.tensor_by_modes[at] * c.q, x1 = I.tensor_by_modes[at] * c.q1;
    for (std::size_t k = 0; k < n; ++k) {
      put(c.J[k], at, x(static_cast<Index>(k)));
      put(c.J1[k], at, x1(static_cast<Index>(k)));
    }
  }
  Matrix3 J = I.tensor, J1;
  Vector arm = I.first, arm1, arm2, swing, swing1;
  for (std::size_t k = 0; k < n; ++k) {
    const auto at = static_cast<Index>(k);
    const double q = c.q(at), q1 = c.q1(at), q2 = c.q2(at);
    arm += q * I.of_modes[k], arm1 += q1 * I.of_modes[k], arm2 += q2 * I.of_modes[k];
    J += (0.5 * q) * (I.tensor_by_mode[k] + c.J[k]), J1 += q1 * c.J[k];
    swing += q1 * c.G[k], swing1 += q2 * c.G[k] + q1 * c.G1[k];
  }
  c.shape.c = along_motion(arm, arm1, arm2);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) c.shape.J(i, k) = momentary(J(i, k), J1(i, k));
    c.shape.swing[i] = momentary(swing[i], swing1[i]);
  }
  return c;
}

}  // namespace dynalin::flexible_motion
