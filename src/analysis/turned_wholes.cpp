#include "analysis/turned_wholes.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace dynalin {

namespace {

Vector part(const Eigen::VectorXd& step, Eigen::Index at) { return {step(at), step(at + 1), step(at + 2)}; }

// The way of a point of a body that turns by `rotation` while it begins to move by `way`, about an axis that stays:
// what a joint holds is held throughout.
Vector along_screw(const Vector& rotation, const Vector& way) {
  const double square = dot(rotation, rotation), angle = std::sqrt(square);
  const double share = angle > 0 ? std::sin(0.5 * angle) / (0.5 * angle) : 1;
  const double sixth = angle < 1e-2 ? 1.0 / 6 - square / 120 : (angle - std::sin(angle)) / (square * angle);
  const Vector across = cross(rotation, way);
  return way + 0.5 * share * share * across + sixth * cross(rotation, across);
}

void turn(const Layout& layout, const TurningWhole& whole, const OperatingPoint& from, const Eigen::VectorXd& step,
          OperatingPoint& to) {
  const auto pose = [&](BodyId b) -> const Pose& { return from.poses[static_cast<std::size_t>(b.index)]; };
  const auto moved = [&](BodyId b) { return part(step, layout.body(b).offset); };
  const auto turned = [&](BodyId b) { return part(step, layout.body(b).offset + 3); };
  const auto count = static_cast<double>(whole.bodies.size());
  Vector centre, way;
  for (const BodyId b : whole.bodies) centre += (1 / count) * pose(b).r, way += (1 / count) * moved(b);
  double square = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Vector moment;
  for (const BodyId b : whole.bodies) {
    const Vector x = pose(b).r - centre;
    const Eigen::Vector3d column(x.x, x.y, x.z);
    square += dot(x, x) / count;
    inertia += dot(x, x) * Eigen::Matrix3d::Identity() - column * column.transpose();
    moment += cross(x, moved(b) - way);
  }
  if (!(square > 0)) return;
  // Rotations of nodes count like places at the mean distance: of a straight bar they alone tell how it turns about
  // itself.
  inertia += count * square * Eigen::Matrix3d::Identity();
  for (const BodyId b : whole.bodies) moment += square * turned(b);
  const Eigen::Vector3d solved = inertia.ldlt().solve(Eigen::Vector3d(moment.x, moment.y, moment.z));
  const Vector rotation{solved(0), solved(1), solved(2)};
  const Matrix3 R = rotation_exponential(rotation);
  const Vector there = centre + along_screw(rotation, way);
  // v + δv without the rotation, turned.
  const auto with_whole = [&](const Vector& v, const Vector& change) { return R * (v + change - cross(rotation, v)); };
  for (const BodyId b : whole.bodies) {
    Pose& p = to.poses[static_cast<std::size_t>(b.index)];
    p.r = there + with_whole(pose(b).r - centre, moved(b) - way);
    p.R = orthonormalized(rotation_exponential(turned(b) - rotation) * (R * pose(b).R));
  }
  for (const std::size_t at : whole.vectors) {
    const Vector v = with_whole({from.extra[at], from.extra[at + 1], from.extra[at + 2]},
                                part(step, layout.body_coordinate_count + static_cast<Eigen::Index>(at)));
    for (std::size_t k = 0; k < 3; ++k) to.extra[at + k] = v[k];
  }
}

}  // namespace

void turn_wholes(const Layout& layout, const OperatingPoint& from, const Eigen::VectorXd& step, OperatingPoint& to) {
  for (const TurningWhole& whole : layout.turning_wholes) turn(layout, whole, from, step, to);
}

}  // namespace dynalin
