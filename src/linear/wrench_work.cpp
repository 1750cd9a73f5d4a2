#include "linear/wrench_work.h"

#include <cmath>

namespace dynalin {

namespace {

using Complex = std::complex<double>;

double size_of(const Matrix3& m) { return std::sqrt(trace(m * transpose(m))); }
double size_of(const ComplexVector& v) { return std::sqrt(std::norm(v[0]) + std::norm(v[1]) + std::norm(v[2])); }

}  // namespace

ComplexVector times(const Matrix3& m, const ComplexVector& v) {
  ComplexVector r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = m(i, 0) * v[0] + m(i, 1) * v[1] + m(i, 2) * v[2];
  return r;
}

void add(ComplexVector& a, const ComplexVector& b, Complex factor) {
  for (std::size_t k = 0; k < 3; ++k) a[k] += factor * b[k];
}

WrenchWork::WrenchWork(const Layout& layout, PartialBy family, const Eigen::VectorXcd& u, Eigen::VectorXcd dw,
                       Eigen::VectorXd dw_size)
    : layout_(layout), family_(family), u_(u), dw_(std::move(dw)), dw_size_(std::move(dw_size)) {}

ComplexVector WrenchWork::motion_of(BodyId body, std::int32_t first) const {
  const BodyBlock& block = layout_.body(body);
  return block.count >= first + 3 ? three(u_, block.offset + first) : ComplexVector{};
}

WrenchWork::Done WrenchWork::of(const MarkerWrench& w) const {
  const bool strain = family_ == PartialBy::position;
  const PairMotion& p = w.pair;
  const std::array<ComplexVector, 4> du = {motion_of(p.body_I, 0), motion_of(p.body_I, 3), motion_of(p.body_J, 0),
                                           motion_of(p.body_J, 3)};
  const GroupPartials& on_force = strain ? w.force.force_on_position : w.force.force_on_velocity;
  const GroupPartials& on_torque = strain ? w.force.torque_on_position : w.force.torque_on_velocity;

  // What the motion makes of force and torque, and how much if nothing cancelled.
  ComplexVector dF{}, dT{};
  std::array<double, 4> du_size{};
  double dF_size = 0, dT_size = 0;
  for (std::size_t g = 0; g < 4; ++g) {
    du_size[g] = size_of(du[g]);
    dF_size += du_size[g] * size_of(on_force.group[g]);
    dT_size += du_size[g] * size_of(on_torque.group[g]);
    add(dF, times(on_force.group[g], du[g]));
    add(dT, times(on_torque.group[g], du[g]));
  }
  for (const MarkerWrench::Scalar& s : w.scalars) {
    if (s.family != PartialBy::algebraic && s.family != family_) continue;
    const Complex change = s.family == family_ ? u_(s.column) : dw_(s.column);
    const double change_size = s.family == family_ ? std::abs(change) : dw_size_(s.column);
    dF_size += change_size * norm(s.force), dT_size += change_size * norm(s.torque);
    for (std::size_t k = 0; k < 3; ++k) {
      dF[k] += change * s.force[k];
      dT[k] += change * s.torque[k];
    }
  }
  for (const MarkerWrench::Turn& turn : w.turns) {
    if (!strain) continue;
    const ComplexVector theta = motion_of(turn.body, 3);
    add(dF, times(turn.force, theta));
    add(dT, times(turn.torque, theta));
  }

  // What they work on.
  const Vector arm_I = value(p.arm_I), arm_J = value(w.force.reaction == Reaction::at_J ? p.arm_J : p.arm);
  ComplexVector moved = du[0], turned = du[1];
  add(moved, times(-skew(arm_I), du[1]));
  double moved_size = du_size[0] + norm(arm_I) * du_size[1], turned_size = du_size[1];
  if (w.force.acts_on_J()) {
    add(moved, du[2], -1.0);
    add(moved, times(-skew(arm_J), du[3]), -1.0);
    add(turned, du[3], -1.0);
    moved_size += du_size[2] + norm(arm_J) * du_size[3];
    turned_size += du_size[3];
  }
  Done done;
  done.without_cancellation = moved_size * dF_size + turned_size * dT_size;
  for (std::size_t k = 0; k < 3; ++k) {
    done.along[k] = -0.5 * std::real(std::conj(moved[k]) * dF[k]);
    done.along[3 + k] = -0.5 * std::real(std::conj(turned[k]) * dT[k]);
  }
  return done;
}

}  // namespace dynalin
