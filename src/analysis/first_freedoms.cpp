#include "analysis/first_freedoms.h"

#include <Eigen/Geometry>
#include <limits>

#include "analysis/displace.h"
#include "analysis/rest_judgement.h"

namespace dynalin {

namespace {

// The turn about one axis that leads from one set of axes to another [rad].
Eigen::Vector3d turn_between(const Matrix3& from, const Matrix3& to) {
  const Matrix3 R = to * transpose(from);
  Eigen::Matrix3d m;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = R(r, c);
  }
  const Eigen::AngleAxisd turn(m);
  return turn.angle() * turn.axis();
}

// Of coordinates and states.
Eigen::VectorXd move_between(const StaticEquations& equations, const OperatingPoint& from, const OperatingPoint& to) {
  const Layout& layout = equations.system().layout();
  Eigen::VectorXd move = Eigen::VectorXd::Zero(equations.augmented().size());
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const Vector way = to.poses[b].r - from.poses[b].r;
    move.segment<3>(block.offset) << way.x, way.y, way.z;
    if (block.turns()) move.segment<3>(block.offset + 3) = turn_between(from.poses[b].R, to.poses[b].R);
  }
  for (std::size_t k = 0; k < to.extra.size(); ++k)
    move(layout.body_coordinate_count + static_cast<Eigen::Index>(k)) = to.extra[k] - from.extra[k];
  for (std::size_t k = 0; k < to.state.size(); ++k)
    move(equations.augmented().state(static_cast<std::int32_t>(k))) = to.state[k] - from.state[k];
  return move;
}

}  // namespace

FirstFreedoms freedoms_at(StaticEquations& equations, const OperatingPoint& op) {
  return {op, free_unknowns(equations, op)};
}

std::optional<OperatingPoint> put_back(StaticEquations& equations, const OperatingPoint& op,
                                       const OperatingPoint& first) {
  constexpr StepLimits any{std::numeric_limits<double>::infinity()};
  const System& system = equations.system();
  const Eigen::VectorXd way = undetermined_part(equations, move_between(equations, op, first));
  OperatingPoint back = op;
  if (displace(system, back, way.head(static_cast<Eigen::Index>(system.coordinates())), any) < 1) return std::nullopt;
  for (std::size_t k = 0; k < back.state.size(); ++k)
    back.state[k] += way(equations.augmented().state(static_cast<std::int32_t>(k)));
  return back;
}

}  // namespace dynalin
