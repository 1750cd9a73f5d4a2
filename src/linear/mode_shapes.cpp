#include "linear/mode_shapes.h"

#include <cmath>

namespace dynalin {

void name_movers(const System& system, const OperatingPoint& op, const LinearSystem& linear, EigenSolution& solution) {
  const Layout& layout = system.layout();
  const auto states = static_cast<Eigen::Index>(linear.model.states.size());
  const double L2 = system.length() * system.length();
  for (std::size_t m = 0; m < solution.modes.size(); ++m) {
    const Eigen::VectorXcd v = solution.vectors.col(static_cast<Eigen::Index>(m));
    const Eigen::VectorXcd dq = linear.dq.leftCols(states) * v;
    double most = 0;
    const ElementLabel* mover = nullptr;
    for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
      const BodyBlock& block = layout.bodies[b];
      if (block.count == 0) continue;
      const Vector c = op.poses[b].R * system.model().bodies[b].p_BC;
      double size = 0;
      for (const bool imaginary : {false, true}) {
        const auto part = [&](std::int32_t k) {
          const std::complex<double> x = dq(block.offset + k);
          return imaginary ? x.imag() : x.real();
        };
        const Vector r{part(0), part(1), part(2)};
        const Vector turn = block.count == 6 ? Vector{part(3), part(4), part(5)} : Vector{};
        const Vector of_cm = r + cross(turn, c);
        size += dot(of_cm, of_cm) + L2 * dot(turn, turn);
      }
      // Equal motions within rounding belong to the part that comes first.
      if (size > most * (1 + 1e-6)) most = size, mover = &block.label;
    }
    std::string& name = solution.modes[m].moves_most;
    if (mover && std::sqrt(most) > 1e-9 * system.length() *
                                       v.tail(states - static_cast<Eigen::Index>(linear.kinematic_states)).norm()) {
      name = mover->full_text();
      continue;
    }
    Eigen::Index k = 0;
    v.cwiseAbs().maxCoeff(&k);
    name = solution.states[static_cast<std::size_t>(k)].owner;
  }
}

}  // namespace dynalin
