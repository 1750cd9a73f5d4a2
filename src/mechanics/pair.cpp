#include "mechanics/pair.h"

#include <limits>
#include <optional>

#include "expression/measured_zero.h"
#include "mechanics/pair_blocks.h"
#include "mechanics/pair_sizes.h"

namespace dynalin {

namespace {

Matrix3 block(const std::array<std::array<double, 6>, 6>& m, std::size_t row, std::size_t column) {
  Matrix3 b;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) b(r, c) = m[row + r][column + c];
  }
  return b;
}

// The partials of a law but for the turn of its axes, in such as `to` leads to from those of J.
void add_law(const PairMotion& p, const RelativeWrench& w, const Matrix3& to, PairForce& out) {
  const Matrix3 back = transpose(value(p.axes_J));
  // δξ = Rᵀ G δ(p_I, φ_I, p_J, φ_J) with G = (1, 0, −1, Δ×) for d and (0, 1, 0, −1) for φ, all in global components.
  const Matrix3 delta = skew(value(p.delta));
  const auto add = [&](const std::array<std::array<double, 6>, 6>& m, std::size_t row, MarkerPartials& by) {
    const Matrix3 on_d = to * block(m, row, 0) * back, on_phi = to * block(m, row, 3) * back;
    by.origin_I += on_d, by.axes_I += on_phi;
    by.origin_J -= on_d, by.axes_J += on_d * delta - on_phi;
  };
  add(w.on_pose, 0, out.force_on_position), add(w.on_pose, 3, out.torque_on_position);
  if (w.depends_on_rate) {
    add(w.on_rate, 0, out.force_on_velocity), add(w.on_rate, 3, out.torque_on_velocity);
    // δξ′ = Rᵀ (G δ(…)′ + (Ġ − ω× G) δ(…)), as (Rᵀ)′ = −Rᵀ ω×.
    const Matrix3 omega = skew(p.w_J), turning = skew(rate(p.delta)) - omega * delta;
    const auto add_rate = [&](std::size_t row, MarkerPartials& by) {
      const Matrix3 on_d = to * block(w.on_rate, row, 0) * back, on_phi = to * block(w.on_rate, row, 3) * back;
      const Matrix3 d = on_d * omega, phi = on_phi * omega;
      by.origin_I -= d, by.axes_I -= phi;
      by.origin_J += d, by.axes_J += on_d * turning + phi;
    };
    add_rate(0, out.force_on_position), add_rate(3, out.torque_on_position);
  }
}

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
  if (J.shapes) {  // its axes turn against the body
    p.w_J = {};
    for (std::size_t k = 0; k < 3; ++k) p.w_J += 0.5 * cross(value(p.axes_J[k]), rate(p.axes_J[k]));
  }
  p.shapes_I = I.shapes, p.shapes_J = J.shapes;
  p.motion = &motion;
  return p;
}

PairForce spread(const PairMotion& p, const RelativeWrench& w, Partials wanted) {
  PairForce out;
  const Matrix3 R = value(p.axes_J);
  out.force = R * w.force;
  out.torque = R * w.torque;
  out.depends_on_velocity = w.depends_on_rate;
  out.levers = w.levers;
  if (wanted == Partials::no) return out;

  add_law(p, w, R, out);
  // The axes in which the wrench is given turn with J.
  out.force_on_position.axes_J -= skew(out.force);
  out.torque_on_position.axes_J -= skew(out.torque);
  return out;
}

PairForce along_axes_of_J(const PairMotion& p, const RelativeWrench& w) {
  PairForce out;
  out.force = w.force, out.torque = w.torque;
  out.depends_on_velocity = w.depends_on_rate;
  add_law(p, w, Matrix3::identity(), out);
  // A turn of the axes of J, δφ_J, takes the wrench along.
  const Matrix3 back = transpose(value(p.axes_J));
  out.force_on_position.axes_J -= skew(w.force) * back;
  out.torque_on_position.axes_J -= skew(w.torque) * back;
  return out;
}

PairForce along_line(const PairMotion& p, const LineMagnitude& F, Partials wanted) {
  PairForce out;
  const Taylor d = norm(p.delta);
  const Vec3<Taylor> line = p.delta / d;
  const Vector u = value(line);
  out.force = F.value * u;
  out.reaction = Reaction::at_J;
  out.components = Components::force;
  out.depends_on_velocity = F.on_rate != 0.0;
  if (wanted == Partials::no) return out;

  // δf = u (F_d δd + F_v δd′) + (F/d) (1 − u uᵀ) δΔ with δd′ = u·δΔ′ + u′·δΔ.
  const Matrix3 uu = outer(u, u);
  const Matrix3 on_delta =
      F.on_distance * uu + F.on_rate * outer(u, rate(line)) + (F.value / d.value) * (Matrix3::identity() - uu);
  const Matrix3 on_delta_rate = F.on_rate * uu;
  out.force_on_position.origin_I = on_delta, out.force_on_position.origin_J = -on_delta;
  if (out.depends_on_velocity)
    out.force_on_velocity.origin_I = on_delta_rate, out.force_on_velocity.origin_J = -on_delta_rate;
  return out;
}

bool markers_meet(const PairMotion& p) {
  const auto place = [&](BodyId body, const Vec3<Taylor>& arm) { return p.motion->body(body).r + value(arm); };
  const double size = measured::largest(place(p.body_I, p.arm_I)) + measured::largest(place(p.body_J, p.arm_J));
  return measured::largest(value(p.delta)) <= measured::rounding * size;
}

PairForce around_origin(const LineMagnitude& F, Partials wanted) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  PairForce out;
  out.reaction = Reaction::at_J;
  out.components = Components::force;
  out.depends_on_velocity = F.on_rate != 0.0;
  if (wanted == Partials::no) return out;
  const Matrix3 on_delta = (out.depends_on_velocity ? unknown : F.on_distance) * Matrix3::identity();
  out.force_on_position.origin_I = on_delta, out.force_on_position.origin_J = -on_delta;
  if (out.depends_on_velocity) out.force_on_velocity = out.force_on_position;
  return out;
}

PairForce without_direction(Partials wanted) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  PairForce out = around_origin({0.0, unknown, 0.0}, wanted);
  out.force = {unknown, unknown, unknown};
  return out;
}

BlockPartials partials_by(const PairBlock& b, const PairForce& f) {
  const auto on_position = [&](const MarkerPartials& at, const MarkerPartials& by_rate) {
    const Matrix3 &origin = b.of_J ? at.origin_J : at.origin_I, &axes = b.of_J ? at.axes_J : at.axes_I;
    if (b.kind == PairBlock::Kind::translation) return origin;
    const bool modal = b.kind == PairBlock::Kind::modal;
    Matrix3 on = origin * b.moves + (modal ? axes * b.turns : axes);
    if (f.depends_on_velocity) on += (b.of_J ? by_rate.origin_J : by_rate.origin_I) * b.moves_rate;
    if (f.depends_on_velocity && modal) on += (b.of_J ? by_rate.axes_J : by_rate.axes_I) * b.turns_rate;
    return on;
  };
  const auto on_velocity = [&](const MarkerPartials& at) {
    const Matrix3 &origin = b.of_J ? at.origin_J : at.origin_I, &axes = b.of_J ? at.axes_J : at.axes_I;
    if (b.kind == PairBlock::Kind::translation) return origin;
    return origin * b.moves + (b.kind == PairBlock::Kind::modal ? axes * b.turns : axes);
  };
  BlockPartials on;
  on.force = on_position(f.force_on_position, f.force_on_velocity);
  on.torque = on_position(f.torque_on_position, f.torque_on_velocity);
  if (!f.depends_on_velocity) return on;
  on.force_by_rate = on_velocity(f.force_on_velocity);
  on.torque_by_rate = on_velocity(f.torque_on_velocity);
  return on;
}

namespace {

// Force and torque on a marker of a pair at its origin.
struct Load {
  Vector force, torque;
};
Load on_J(const PairMotion& p, const Vector& force, const Vector& torque) {
  return {-force, -(torque + cross(value(p.arm) - value(p.arm_J), force))};
}

// One marker of a pair on a body that changes its shape, and how it follows the modal coordinates of that.
struct Deformed {
  const NodeShapes& shapes;
  BodyId body;
  NodeVariations variations;
};
std::optional<Deformed> deformed(const PairMotion& p, bool of_J) {
  const NodeShapes* shapes = of_J ? p.shapes_J : p.shapes_I;
  if (!shapes) return std::nullopt;
  const BodyId body = of_J ? p.body_J : p.body_I;
  return Deformed{*shapes, body, NodeVariations(*p.motion, body, *shapes)};
}

void add_to_modal_residuals(const Deformed& of, const Load& load, Equations& eq) {
  const ModalWork work = of.variations.work(load.force, load.torque);
  const std::int32_t first = eq.layout().body_coordinate_count + static_cast<std::int32_t>(of.shapes.first);
  for (std::size_t k = 0; k < of.shapes.translation.size(); ++k)
    eq.add_residual(first + static_cast<std::int32_t>(k), -work.of(of.shapes, k));
}

// Partials of these rows by the coordinates of a block that changes the load; column by column.
void add_to_modal_rows(const Deformed& of, PartialBy family, const PairBlock& by, const Matrix3& force,
                       const Matrix3& torque, Equations& eq) {
  for (std::size_t c = 0; c < by.count; ++c)
    add_modal_rows(family, by.column + static_cast<std::int32_t>(c), of.shapes, of.variations.work(force[c], torque[c]),
                   -1, eq);
}

// The same under the load of a force on I, and how the work of that changes with the modal coordinates.
struct Loaded {
  Deformed marker;
  Load load;
  Matrix3 change;
};
std::optional<Loaded> loaded(const PairMotion& p, bool of_J, const PairForce& f) {
  const auto marker = deformed(p, of_J);
  if (!marker) return std::nullopt;
  const Load load = of_J ? on_J(p, f.force, f.torque) : Load{f.force, f.torque};
  return Loaded{*marker, load, change_of_work(*p.motion, marker->body, marker->shapes, load.force, load.torque)};
}

// How the rows themselves change under the load with the coordinates that move their marker.
void add_change_of_modal_rows(const Loaded& on, const PairBlock& by, Equations& eq) {
  if (by.kind == PairBlock::Kind::translation) return;
  const auto& [of, load, change] = on;
  for (std::size_t c = 0; c < by.count; ++c) {
    // Variations turn with the body: (e × δp)·F = δp·(F × e).
    const ModalWork work =
        by.kind == PairBlock::Kind::modal
            ? ModalWork{{}, change * of.shapes.rotation[by.first_shape + c]}
            : of.variations.work(cross(load.force, unit_vectors[c]), cross(load.torque, unit_vectors[c]));
    add_modal_rows(PartialBy::position, by.column + static_cast<std::int32_t>(c), of.shapes, work, -1, eq);
  }
}

}  // namespace

void apply(const PairMotion& p, const PairForce& f, Equations& eq, PartialBy velocity_family) {
  const double cancelled = f.levers.force * f.levers.arm;
  eq.apply_at(p.body_I, value(p.arm_I), f.force, f.torque, cancelled);
  if (f.acts_on_J()) eq.apply_at(p.body_J, value(p.arm), -f.force, -f.torque, cancelled);
  if (const auto I = deformed(p, false)) add_to_modal_residuals(*I, {f.force, f.torque}, eq);
  if (f.acts_on_J()) {
    if (const auto J = deformed(p, true)) add_to_modal_residuals(*J, on_J(p, f.force, f.torque), eq);
  }
  if (eq.wants_partials()) apply_partials(p, f, eq, velocity_family);
}

void apply_partials(const PairMotion& p, const PairForce& f, Equations& eq, PartialBy velocity_family) {
  const Matrix3 to_I = skew(value(p.arm_I)), to_J = skew(value(p.arm)), of_force = skew(f.force);
  const Matrix3 from_J = skew(value(p.arm) - value(p.arm_J));
  const bool by_rate = eq.wants(velocity_family);
  const std::optional<Loaded> I = loaded(p, false, f), J = f.acts_on_J() ? loaded(p, true, f) : std::nullopt;
  for_each_block(p, eq.layout(), [&](const PairBlock& b) {
    const BlockPartials on = partials_by(b, f);
    const bool translation = b.kind == PairBlock::Kind::translation;
    // Change of the lever arms under the force: δ(ρ × f), δ(arm × f), and of that from the origin of J.
    const Matrix3 none{}, moved = -(of_force * b.moves);
    const Matrix3& arm_I = b.of_J || translation ? none : moved;
    const Matrix3 arm_J = !b.of_J ? moved : translation ? of_force : none;
    // On the bodies of I and J.
    const auto add = [&](PartialBy family, const Matrix3& F, const Matrix3& T, const Matrix3& I_moved,
                         const Matrix3& J_moved, const Matrix3& size_of_F, const Matrix3& size_of_T) {
      const auto add_to = [&](BodyId body, double sign, const Matrix3& to, const Matrix3& arm) {
        const Equations::Columns columns{b.column, b.count};
        const Equations::Block partials{F, to * F + T + arm};
        if (!eq.keeps_sizes()) return eq.add_block(family, body, columns, partials, sign);
        eq.add_block(family, body, columns, partials, {size_of_F, sizes(to) * size_of_F + size_of_T + sizes(arm)},
                     sign);
      };
      add_to(p.body_I, -1.0, to_I, I_moved);
      if (f.acts_on_J()) add_to(p.body_J, 1.0, to_J, J_moved);
    };
    const BlockPartials of = eq.keeps_sizes() ? sizes_by(p, b, f) : BlockPartials{};
    add(PartialBy::position, on.force, on.torque, arm_I, arm_J, of.force, of.torque);
    if (I) {
      add_to_modal_rows(I->marker, PartialBy::position, b, on.force, on.torque, eq);
      if (!b.of_J) add_change_of_modal_rows(*I, b, eq);
    }
    if (J) {
      add_to_modal_rows(J->marker, PartialBy::position, b, -on.force,
                        -(from_J * on.force + on.torque + (b.of_J ? -moved : moved)), eq);
      if (b.of_J) add_change_of_modal_rows(*J, b, eq);
    }
    if (!by_rate) return;
    const Matrix3 &Fv = on.force_by_rate, &Tv = on.torque_by_rate;
    add(velocity_family, Fv, Tv, none, none, of.force_by_rate, of.torque_by_rate);
    if (I) add_to_modal_rows(I->marker, velocity_family, b, Fv, Tv, eq);
    if (J) add_to_modal_rows(J->marker, velocity_family, b, -Fv, -(from_J * Fv + Tv), eq);
  });
}

void apply_column(const PairMotion& p, const Vector& force, const Vector& torque, Reaction reaction, PartialBy family,
                  std::int32_t column, Equations& eq) {
  const bool acts_on_J = reaction != Reaction::none;
  eq.add_column(family, p.body_I, column, force, cross(value(p.arm_I), force) + torque);
  if (acts_on_J) {
    eq.add_column(family, p.body_J, column, -force, -(cross(value(p.arm), force) + torque));
  }
  for (const bool of_J : {false, true}) {
    if (of_J && !acts_on_J) continue;
    const auto side = deformed(p, of_J);
    if (!side) continue;
    const Load load = of_J ? on_J(p, force, torque) : Load{force, torque};
    add_modal_rows(family, column, side->shapes, side->variations.work(load.force, load.torque), -1, eq);
  }
}

void apply_turn(const PairMotion& p, const MarkerPlace& axes, const Matrix3& force, const Matrix3& torque,
                Equations& eq) {
  for_each_turning_block(
      *p.motion, axes, eq.layout(), [&](std::int32_t column, std::size_t count, const Matrix3& turns) {
        const Matrix3 F = force * turns, T = torque * turns;
        for (std::size_t c = 0; c < count; ++c)
          apply_column(p, F[c], T[c], Reaction::at_I, PartialBy::position, column + static_cast<std::int32_t>(c), eq);
      });
}

void apply_cross_partials(const PairMotion& acting, const PairMotion& varied, const PairForce& f, Equations& eq,
                          PartialBy velocity_family) {
  for_each_block(varied, eq.layout(), [&](const PairBlock& b) {
    const BlockPartials on = partials_by(b, f);
    for (std::size_t c = 0; c < b.count; ++c) {
      const std::int32_t column = b.column + static_cast<std::int32_t>(c);
      apply_column(acting, on.force[c], on.torque[c], Reaction::at_I, PartialBy::position, column, eq);
      apply_column(acting, on.force_by_rate[c], on.torque_by_rate[c], Reaction::at_I, velocity_family, column, eq);
    }
  });
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
  for (const bool of_J : {false, true}) {
    const auto side = deformed(p, of_J);
    if (!side) continue;
    const Load gradient = of_J ? on_J(p, f, t) : Load{f, t};
    const ModalWork work = side->variations.work(gradient.force, gradient.torque);
    const std::int32_t first = eq.layout().body_coordinate_count + static_cast<std::int32_t>(side->shapes.first);
    for (std::size_t k = 0; k < side->shapes.translation.size(); ++k)
      eq.add(family, row, first + static_cast<std::int32_t>(k), work.of(side->shapes, k));
  }
}

void add_gradient(std::int32_t row, const PairMotion& p, const Vec3<Taylor>& on_d, const Vec3<Taylor>& on_phi,
                  ConstraintRows& rows) {
  const Vec3<Taylor> f = p.axes_J * on_d, t = p.axes_J * on_phi;
  rows.add_pose(row, p.body_I, f, t + cross(p.arm_I, f));
  rows.add_pose(row, p.body_J, -f, -(t + cross(p.arm, f)));
  for (const bool of_J : {false, true}) {
    const auto side = deformed(p, of_J);
    if (!side) continue;
    const Vec3<Taylor> turning = of_J ? -(t + cross(p.arm - p.arm_J, f)) : t;
    for (std::size_t k = 0; k < side->shapes.translation.size(); ++k) {
      const NodeVariations::One v = side->variations.by(k);
      const Taylor moving = dot(v.moves, f);
      rows.add_coordinate(row, rows.layout().body_coordinate_count + static_cast<std::int32_t>(side->shapes.first + k),
                          (of_J ? -moving : moving) + dot(v.turns, turning));
    }
  }
}

}  // namespace dynalin
