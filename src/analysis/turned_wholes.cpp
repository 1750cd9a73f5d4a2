#include "analysis/turned_wholes.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace dynalin {

namespace {

Vector plus(const Vector& a, const Eigen::Vector3d& b) { return a + Vector{b(0), b(1), b(2)}; }
Eigen::Vector3d dense(const Vector& v) { return {v.x, v.y, v.z}; }

// The way of a point of a body that turns by `rotation` while it begins to move by `way`, about an axis that stays:
// what a joint holds is held throughout.
Eigen::Vector3d along_screw(const Eigen::Vector3d& rotation, const Eigen::Vector3d& way) {
  const double square = rotation.squaredNorm(), angle = std::sqrt(square);
  const double half = angle < 1e-4 ? 0.5 - square / 24 : (1 - std::cos(angle)) / square;
  const double sixth = angle < 1e-2 ? 1.0 / 6 - square / 120 : (angle - std::sin(angle)) / (square * angle);
  const Eigen::Vector3d across = rotation.cross(way);
  return way + half * across + sixth * rotation.cross(across);
}

void turn(const Layout& layout, const TurningWhole& whole, const OperatingPoint& from, const Eigen::VectorXd& step,
          OperatingPoint& to) {
  const auto pose = [&](BodyId b) -> const Pose& { return from.poses[static_cast<std::size_t>(b.index)]; };
  const auto offset = [&](BodyId b) { return layout.body(b).offset; };
  const auto count = static_cast<double>(whole.bodies.size());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), way = centre, turned = centre, moment = centre;
  for (const BodyId b : whole.bodies) {
    centre += dense(pose(b).r) / count;
    way += step.segment<3>(offset(b)) / count;
    turned += step.segment<3>(offset(b) + 3);
  }
  double square = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const BodyId b : whole.bodies) {
    const Eigen::Vector3d x = dense(pose(b).r) - centre;
    square += x.squaredNorm() / count;
    inertia += x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose();
    moment += x.cross(step.segment<3>(offset(b)) - way);
  }
  if (!(square > 0)) return;
  // Rotations of nodes count like places at the mean distance: of a straight bar they alone tell how it turns about
  // itself.
  inertia += count * square * Eigen::Matrix3d::Identity();
  moment += square * turned;
  const Eigen::Vector3d rotation = inertia.ldlt().solve(moment);
  const Matrix3 R = rotation_exponential(Vector{rotation(0), rotation(1), rotation(2)});
  const Eigen::Vector3d there = centre + along_screw(rotation, way);
  // v + δv without the rotation, turned.
  const auto turned_with = [&](const Eigen::Vector3d& v, const Eigen::Vector3d& change) {
    const Eigen::Vector3d rest = v + change - rotation.cross(v);
    return R * Vector{rest(0), rest(1), rest(2)};
  };
  for (const BodyId b : whole.bodies) {
    Pose& p = to.poses[static_cast<std::size_t>(b.index)];
    p.r = plus(turned_with(dense(pose(b).r) - centre, step.segment<3>(offset(b)) - way), there);
    const Eigen::Vector3d rest = step.segment<3>(offset(b) + 3) - rotation;
    p.R = orthonormalized(rotation_exponential(Vector{rest(0), rest(1), rest(2)}) * (R * pose(b).R));
  }
  for (const std::size_t at : whole.vectors) {
    const auto column = layout.body_coordinate_count + static_cast<Eigen::Index>(at);
    const Vector v = turned_with({from.extra[at], from.extra[at + 1], from.extra[at + 2]}, step.segment<3>(column));
    for (std::size_t k = 0; k < 3; ++k) to.extra[at + k] = v[k];
  }
}

}  // namespace

void turn_wholes(const Layout& layout, const OperatingPoint& from, const Eigen::VectorXd& step, OperatingPoint& to) {
  for (const TurningWhole& whole : layout.turning_wholes) turn(layout, whole, from, step, to);
}

}  // namespace dynalin
