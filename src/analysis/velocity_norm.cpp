#include "analysis/velocity_norm.h"

#include <algorithm>
#include <cmath>

#include "analysis/outside_weight.h"

namespace dynalin {

void add_velocity_norm(const System& system, const Motion& motion, double weight, std::vector<Triplet>& entries) {
  const double L2 = system.length() * system.length();
  for (std::size_t b = 1; b < system.layout().bodies.size(); ++b) {
    const BodyBlock& block = system.layout().bodies[b];
    const Vector c = motion.bodies[b].R * system.model().bodies[b].p_BC;
    const Matrix3 C = -skew(c);  // v_C = v + C ω
    const Matrix3 CC = transpose(C) * C;
    for (std::size_t r = 0; r < 3; ++r) {
      const auto i = block.offset + static_cast<std::int32_t>(r);
      entries.push_back({i, i, weight});
      for (std::size_t k = 0; k < 3 && block.turns(); ++k) {
        const auto j = block.offset + 3 + static_cast<std::int32_t>(k);
        entries.push_back({i, j, weight * C(r, k)});
        entries.push_back({j, i, weight * C(r, k)});
        entries.push_back(
            {block.offset + 3 + static_cast<std::int32_t>(r), j, weight * (CC(r, k) + (r == k ? L2 : 0.0))});
      }
    }
  }
  // Points of contact follow them: a weight that only keeps the matrix regular where nothing moves them.
  for (const ExtraBlock& e : system.layout().extras) {
    for (std::int32_t k = 0; k < e.count; ++k) {
      const double s = system.length() / system.coordinate_scale(e.offset + k);
      entries.push_back({e.offset + k, e.offset + k, outside_weight(e) * weight * s * s});
    }
  }
}

double fastest_of(const System& system, const Eigen::VectorXd& velocity) {
  double fastest = 0;
  for (std::int32_t k = 0; k < velocity.size(); ++k) {
    fastest = std::max(fastest, std::abs(velocity(k)) / system.coordinate_scale(k));
  }
  return fastest;
}

double unit_of(const System& system, const VelocityCondition& c) {
  double size = 0;
  for (std::size_t i = 0; i < c.column.size(); ++i)
    size = std::max(size, std::abs(c.coefficient[i]) * system.coordinate_scale(c.column[i]));
  return size > 0 ? system.length() / size : 0.0;
}

}  // namespace dynalin
