#include "simulation/motion_unknowns.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace dynalin {

Quaternion quaternion_of(const Matrix3& rotation) {
  Eigen::Matrix3d m;
  for (int c = 0; c < 3; ++c) {
    const Vector& axis = rotation[static_cast<std::size_t>(c)];
    m.col(c) << axis.x, axis.y, axis.z;
  }
  const Eigen::Quaterniond q = Eigen::Quaterniond(m).normalized();
  return {q.w(), q.x(), q.y(), q.z()};
}

Matrix3 rotation_of(const Quaternion& p) {
  const Eigen::Matrix3d m = Eigen::Quaterniond(p[0], p[1], p[2], p[3]).normalized().toRotationMatrix();
  const auto axis = [&](Eigen::Index c) { return Vector{m(0, c), m(1, c), m(2, c)}; };
  return {axis(0), axis(1), axis(2)};
}

namespace {

Vector vector_at(std::span<const double> x, std::int32_t k) {
  const auto i = static_cast<std::size_t>(k);
  return {x[i], x[i + 1], x[i + 2]};
}
void put(std::span<double> x, std::int32_t k, const Vector& v) {
  const auto i = static_cast<std::size_t>(k);
  x[i] = v.x, x[i + 1] = v.y, x[i + 2] = v.z;
}
Quaternion quaternion_at(std::span<const double> x, std::int32_t k) {
  const auto i = static_cast<std::size_t>(k);
  return {x[i], x[i + 1], x[i + 2], x[i + 3]};
}
std::span<const double> part(std::span<const double> x, std::int32_t first, std::size_t count) {
  return x.subspan(static_cast<std::size_t>(first), count);
}
void copy(std::span<const double> from, std::vector<double>& to) {
  to.resize(from.size());
  std::copy(from.begin(), from.end(), to.begin());
}

}  // namespace

MotionUnknowns::MotionUnknowns(const System& system) : system_(system), n_(system.layout().coordinate_count) {
  const Layout& layout = system.layout();
  std::int32_t next = 0;
  for (const BodyBlock& b : layout.bodies) {
    position_.push_back(next);
    next += b.turns() ? 7 : b.count;
  }
  extra_ = next;
  velocity_ = extra_ + n_ - layout.body_coordinate_count;
  lambda_ = velocity_ + n_;
  next = lambda_ + static_cast<std::int32_t>(layout.row_count());
  for (const ConstraintRow& row : layout.rows) mu_.push_back(row.level == RowLevel::position ? next++ : -1);
  algebraic_ = next;
  state_ = algebraic_ + static_cast<std::int32_t>(layout.algebraic.size());
  size_ = static_cast<std::size_t>(state_) + layout.states.size();
}

void MotionUnknowns::pack(const OperatingPoint& op, std::span<double> y, std::span<double> yp) const {
  const Layout& layout = system_.layout();
  std::fill(y.begin(), y.end(), 0.0);
  std::fill(yp.begin(), yp.end(), 0.0);
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    put(y, position(b), op.poses[b].r);
    put(yp, position(b), vector_at(op.velocity, block.offset));
    if (!block.turns()) continue;
    const Quaternion p = quaternion_of(op.poses[b].R);
    const Vector w = vector_at(op.velocity, block.offset + 3), v{p[1], p[2], p[3]};
    const Vector rate = 0.5 * (p[0] * w + cross(w, v));
    const auto at = static_cast<std::size_t>(quaternion(b));
    std::copy(p.begin(), p.end(), y.begin() + quaternion(b));
    yp[at] = -0.5 * dot(w, v);
    put(yp, quaternion(b) + 1, rate);
  }
  const auto first_extra = op.velocity.begin() + layout.body_coordinate_count;
  std::copy(op.extra.begin(), op.extra.end(), y.begin() + extra_);
  std::copy(first_extra, op.velocity.end(), yp.begin() + extra_);
  std::copy(op.velocity.begin(), op.velocity.end(), y.begin() + velocity_);
  std::copy(op.acceleration.begin(), op.acceleration.end(), yp.begin() + velocity_);
  std::copy(op.lambda.begin(), op.lambda.end(), y.begin() + lambda_);
  std::copy(op.algebraic.begin(), op.algebraic.end(), y.begin() + algebraic_);
  std::copy(op.state.begin(), op.state.end(), y.begin() + state_);
  std::copy(op.state_rate.begin(), op.state_rate.end(), yp.begin() + state_);
}

void MotionUnknowns::unpack(double t, std::span<const double> y, std::span<const double> yp, OperatingPoint& op) const {
  const Layout& layout = system_.layout();
  op.time = t;
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    if (layout.bodies[b].count == 0) continue;
    op.poses[b].r = vector_at(y, position(b));
    if (layout.bodies[b].turns()) op.poses[b].R = rotation_of(quaternion_at(y, quaternion(b)));
  }
  const auto n = static_cast<std::size_t>(n_);
  copy(part(y, extra_, op.extra.size()), op.extra);
  copy(part(y, velocity_, n), op.velocity);
  copy(part(yp, velocity_, n), op.acceleration);
  copy(part(y, lambda_, layout.row_count()), op.lambda);
  copy(part(y, algebraic_, layout.algebraic.size()), op.algebraic);
  copy(part(y, state_, layout.states.size()), op.state);
  copy(part(yp, state_, layout.states.size()), op.state_rate);
}

void MotionUnknowns::unpack(double t, std::span<const double> y, std::span<const double> yp, Motion& motion) const {
  const Layout& layout = system_.layout();
  motion.time = t;
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    Pose pose{vector_at(y, position(b)), motion.bodies[b].R};  // what does not turn keeps its axes
    const std::int32_t v = velocity(block.offset), w = v + 3;
    if (block.turns()) pose.R = rotation_of(quaternion_at(y, quaternion(b)));
    motion.bodies[b].set(pose, vector_at(y, v), block.turns() ? vector_at(y, w) : Vector{}, vector_at(yp, v),
                         block.turns() ? vector_at(yp, w) : Vector{});
  }
  const std::size_t extras = motion.extra.size();
  const std::int32_t rates = velocity(layout.body_coordinate_count);
  copy(part(y, extra_, extras), motion.extra);
  copy(part(y, rates, extras), motion.extra_rate);
  copy(part(yp, rates, extras), motion.extra_acceleration);
  copy(part(y, lambda_, layout.row_count()), motion.lambda);
  copy(part(y, algebraic_, layout.algebraic.size()), motion.algebraic);
  copy(part(y, state_, layout.states.size()), motion.state);
  copy(part(yp, state_, layout.states.size()), motion.state_rate);
}

std::string MotionUnknowns::text(std::int64_t unknown) const {
  const Layout& layout = system_.layout();
  const auto k = static_cast<std::int32_t>(unknown);
  if (k < 0 || static_cast<std::size_t>(k) >= size_) return {};
  if (k < extra_) {
    std::size_t b = 0;
    for (std::size_t body = 0; body < position_.size(); ++body) {
      if (layout.bodies[body].count > 0 && position_[body] <= k) b = body;
    }
    const std::int32_t of_body = k - position_[b];
    // Three of the four numbers of a quaternion are as good as any name for a rotation.
    return layout.coordinate_text(layout.bodies[b].offset + std::min(of_body, layout.bodies[b].count - 1));
  }
  if (k < velocity_) return layout.coordinate_text(layout.body_coordinate_count + k - extra_);
  if (k < lambda_) return "the velocity of " + layout.coordinate_text(k - velocity_);
  if (k < algebraic_) {
    for (std::size_t row = 0; row < mu_.size(); ++row) {
      const auto r = static_cast<std::int32_t>(row);
      if (lambda(r) == k || mu_[row] == k) return system_.row_text(r);
    }
  }
  if (k < state_) return layout.algebraic[static_cast<std::size_t>(k - algebraic_)].owner->full_text();
  return "the state of " + layout.states[static_cast<std::size_t>(k - state_)].owner->full_text();
}

}  // namespace dynalin
