#include "mechanics/pair.h"

namespace dynalin {

namespace {

// Columns of the relative displacement (or of Δ) with respect to the groups, in global components,
// and of their rates with respect to δq.
struct Groups {
  std::array<Matrix3, 4> displacement, rotation;
};

Matrix3 block(const std::array<std::array<double, 6>, 6>& m, std::size_t row, std::size_t column) {
  Matrix3 b;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) b(r, c) = m[row + r][column + c];
  }
  return b;
}

Matrix3 congruent(const Matrix3& R, const Matrix3& m) { return R * m * transpose(R); }

}  // namespace

PairMotion pair_motion(const Motion& motion, const MarkerPlace& I, const MarkerPlace& J) {
  PairMotion p;
  p.body_I = I.body, p.body_J = J.body;
  const Mat3<Taylor> axes_I = motion.axes_along(I);
  p.axes_J = motion.axes_along(J);
  p.arm_I = motion.arm(I), p.arm_J = motion.arm(J);
  // Differences of origins first: what is near stays exact far from the global origin.
  const BodyMotion &b = motion.body(I.body), &c = motion.body(J.body);
  p.arm = along_motion(b.r - c.r, b.rdot - c.rdot, b.rddot - c.rddot) + p.arm_I;
  p.delta = p.arm - p.arm_J;
  p.relative = {transpose_times(p.axes_J, p.delta), transpose_times(p.axes_J, axes_I.x),
                transpose_times(p.axes_J, axes_I.y), transpose_times(p.axes_J, axes_I.z)};
  p.w_J = c.w;
  return p;
}

PairForce spread(const PairMotion& p, const RelativeWrench& w, bool with_partials) {
  PairForce out;
  const Matrix3 R = value(p.axes_J);
  out.force = R * w.force;
  out.torque = R * w.torque;
  out.depends_on_velocity = w.depends_on_rate;
  if (!with_partials) return out;

  const Matrix3 one = Matrix3::identity();
  const Matrix3 rho = skew(value(p.arm_I)), arm = skew(value(p.arm));
  // δξ = Rᵀ G δq, all in global components.
  const Groups G{{one, -rho, -one, arm}, {Matrix3{}, one, Matrix3{}, -one}};
  const auto add = [&](const std::array<std::array<double, 6>, 6>& m, const Groups& g, GroupPartials& force,
                       GroupPartials& torque) {
    const Matrix3 fd = congruent(R, block(m, 0, 0)), fr = congruent(R, block(m, 0, 3));
    const Matrix3 td = congruent(R, block(m, 3, 0)), tr = congruent(R, block(m, 3, 3));
    for (std::size_t k = 0; k < 4; ++k) {
      force.group[k] += fd * g.displacement[k] + fr * g.rotation[k];
      torque.group[k] += td * g.displacement[k] + tr * g.rotation[k];
    }
  };
  add(w.on_pose, G, out.force_on_position, out.torque_on_position);
  if (w.depends_on_rate) {
    add(w.on_rate, G, out.force_on_velocity, out.torque_on_velocity);
    // δξ′ = Rᵀ (G δq′ + Ġ δq) with (Rᵀ)′ = −Rᵀ ω×.
    const Matrix3 omega = skew(p.w_J);
    const Matrix3 rho_rate = skew(rate(p.arm_I)), arm_rate = skew(rate(p.arm));
    const Groups G_rate{{-omega, omega * rho - rho_rate, omega, arm_rate - omega * arm},
                        {Matrix3{}, -omega, Matrix3{}, omega}};
    add(w.on_rate, G_rate, out.force_on_position, out.torque_on_position);
  }
  // The axes in which the wrench is given turn with J's body.
  out.force_on_position.group[3] -= skew(out.force);
  out.torque_on_position.group[3] -= skew(out.torque);
  return out;
}

PairForce along_line(const PairMotion& p, const LineMagnitude& F, bool with_partials) {
  PairForce out;
  const Taylor d = norm(p.delta);
  const Vec3<Taylor> line = p.delta / d;
  const Vector u = value(line);
  out.force = F.value * u;
  out.reaction = Reaction::at_J;
  out.components = Components::force;
  out.depends_on_velocity = F.on_rate != 0.0;
  if (!with_partials) return out;

  // δf = u (F_d δd + F_v δd′) + (F/d) (1 − u uᵀ) δΔ with δd′ = u·δΔ′ + u′·δΔ.
  const Matrix3 uu = outer(u, u);
  const Matrix3 on_delta =
      F.on_distance * uu + F.on_rate * outer(u, rate(line)) + (F.value / d.value) * (Matrix3::identity() - uu);
  const Matrix3 on_delta_rate = F.on_rate * uu;
  const Matrix3 one = Matrix3::identity();
  const std::array<Matrix3, 4> G = {one, -skew(value(p.arm_I)), -one, skew(value(p.arm_J))};
  for (std::size_t k = 0; k < 4; ++k) out.force_on_position.group[k] = on_delta * G[k];
  if (out.depends_on_velocity) {
    for (std::size_t k = 0; k < 4; ++k) out.force_on_velocity.group[k] = on_delta_rate * G[k];
    out.force_on_position.group[1] -= on_delta_rate * skew(rate(p.arm_I));
    out.force_on_position.group[3] += on_delta_rate * skew(rate(p.arm_J));
  }
  return out;
}

namespace {

std::array<std::int32_t, 4> group_columns(const PairMotion& p, const Layout& layout) {
  const auto columns = [&](BodyId b) {
    const BodyBlock& block = layout.body(b);
    return std::array<std::int32_t, 2>{block.count >= 3 ? block.offset : -1, block.count == 6 ? block.offset + 3 : -1};
  };
  const auto B = columns(p.body_I), C = columns(p.body_J);
  return {B[0], B[1], C[0], C[1]};
}

}  // namespace

void apply(const PairMotion& p, const PairForce& f, Equations& eq, PartialBy velocity_family) {
  eq.apply(p.body_I, f.force, cross(value(p.arm_I), f.force) + f.torque);
  if (f.acts_on_J()) eq.apply(p.body_J, -f.force, -(cross(value(p.arm), f.force) + f.torque));
  if (eq.wants_partials()) apply_partials(p, f, eq, velocity_family);
}

void apply_partials(const PairMotion& p, const PairForce& f, Equations& eq, PartialBy velocity_family) {
  const Vector rho = value(p.arm_I), arm = value(p.arm);
  const auto columns = group_columns(p, eq.layout());
  const Matrix3 to_I = skew(rho), to_J = skew(arm), of_force = skew(f.force);
  // Change of the lever arms under the force: δ(ρ × f) and δ(arm × f).
  const Matrix3 turn_I = of_force * to_I;
  const std::array<Matrix3, 4> arm_I = {Matrix3{}, turn_I, Matrix3{}, Matrix3{}};
  const std::array<Matrix3, 4> arm_J = {-of_force, turn_I, of_force, Matrix3{}};
  for (std::size_t k = 0; k < 4; ++k) {
    if (columns[k] < 0) continue;
    const Matrix3& F = f.force_on_position.group[k];
    const Matrix3& T = f.torque_on_position.group[k];
    eq.add_block(PartialBy::position, p.body_I, columns[k], F, to_I * F + T + arm_I[k]);
    if (f.acts_on_J()) {
      eq.add_block(PartialBy::position, p.body_J, columns[k], -F, -(to_J * F + T + arm_J[k]));
    }
    if (!eq.wants(velocity_family)) continue;
    const Matrix3& Fv = f.force_on_velocity.group[k];
    const Matrix3& Tv = f.torque_on_velocity.group[k];
    eq.add_block(velocity_family, p.body_I, columns[k], Fv, to_I * Fv + Tv);
    if (f.acts_on_J()) eq.add_block(velocity_family, p.body_J, columns[k], -Fv, -(to_J * Fv + Tv));
  }
}

void apply_column(const PairMotion& p, const Vector& force, const Vector& torque, bool acts_on_J, PartialBy family,
                  std::int32_t column, Equations& eq) {
  eq.add_column(family, p.body_I, column, force, cross(value(p.arm_I), force) + torque);
  if (acts_on_J) {
    eq.add_column(family, p.body_J, column, -force, -(cross(value(p.arm), force) + torque));
  }
}

void apply_turn(const PairMotion& p, BodyId body, const Matrix3& force, const Matrix3& torque, Equations& eq) {
  const BodyBlock& block = eq.layout().body(body);
  if (block.count != 6) return;
  eq.add_block(PartialBy::position, p.body_I, block.offset + 3, force, skew(value(p.arm_I)) * force + torque);
  eq.add_block(PartialBy::position, p.body_J, block.offset + 3, -force, -(skew(value(p.arm)) * force + torque));
}

void apply_cross_partials(const PairMotion& acting, const PairMotion& varied, const PairForce& f, Equations& eq,
                          PartialBy velocity_family) {
  const auto columns = group_columns(varied, eq.layout());
  const Matrix3 to_I = skew(value(acting.arm_I)), to_J = skew(value(acting.arm));
  const auto add = [&](PartialBy family, std::int32_t column, const Matrix3& F, const Matrix3& T) {
    if (!eq.wants(family)) return;
    eq.add_block(family, acting.body_I, column, F, to_I * F + T);
    eq.add_block(family, acting.body_J, column, -F, -(to_J * F + T));
  };
  for (std::size_t k = 0; k < 4; ++k) {
    if (columns[k] < 0) continue;
    add(PartialBy::position, columns[k], f.force_on_position.group[k], f.torque_on_position.group[k]);
    add(velocity_family, columns[k], f.force_on_velocity.group[k], f.torque_on_velocity.group[k]);
  }
}

void add_partials(std::int32_t row, const PairMotion& p, const Vector& on_d, const Vector& on_phi, PartialBy family,
                  Equations& eq) {
  const Matrix3 R = value(p.axes_J);
  const Vector f = R * on_d, t = R * on_phi;
  const auto add = [&](BodyId body, const Vector& on_r, const Vector& on_theta) {
    const BodyBlock& block = eq.layout().body(body);
    for (std::int32_t k = 0; k < block.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      eq.add(family, row, block.offset + k, k < 3 ? on_r[at] : on_theta[at - 3]);
    }
  };
  add(p.body_I, f, t + cross(value(p.arm_I), f));
  add(p.body_J, -f, -(t + cross(value(p.arm), f)));
}

void add_gradient(std::int32_t row, const PairMotion& p, const Vec3<Taylor>& on_d, const Vec3<Taylor>& on_phi,
                  ConstraintRows& rows) {
  const Vec3<Taylor> f = p.axes_J * on_d, t = p.axes_J * on_phi;
  rows.add_pose(row, p.body_I, f, t + cross(p.arm_I, f));
  rows.add_pose(row, p.body_J, -f, -(t + cross(p.arm, f)));
}

}  // namespace dynalin
