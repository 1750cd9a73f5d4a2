#include "elements/families/inertia.h"

#include <algorithm>

#include "base/second_moments.h"

namespace dynalin {

InertiaKernel::InertiaKernel(const Model& model, const Layout& layout, BodyKind kind) : gravity_(model.gravity) {
  const auto count = static_cast<std::size_t>(std::ranges::count(model.bodies, kind, &Body::kind));
  masses_.reserve(count), bodies_.reserve(count);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    if (body.kind != kind || body.nature->listed.role != BodyRole::rigid) continue;
    const Vector& c = body.p_BC;
    const Matrix3& J = body.J_BC;
    // About the mass centre; moving the point adds m c cᵀ.
    const Matrix3 S = second_moments_of(J) + body.mass * outer(c, c);
    const BodyId id{static_cast<std::int32_t>(b)};
    masses_.push_back({id, body.mass, body.mass * c, S});
    bodies_.emplace_back(model, layout, id);
  }
}

std::vector<const BodySource*> InertiaKernel::bodies() const {
  std::vector<const BodySource*> list;
  list.reserve(bodies_.size());
  for (const RigidBody& b : bodies_) list.push_back(&b);
  return list;
}

void InertiaKernel::equations(const Motion& motion, Equations& eq) const {
  for (const Mass& m : eq.share(masses_)) {
    eq.begin_element(eq.layout().body(m.body).label);
    const BodyMotion& b = motion.body(m.body);
    const BodyBlock& block = eq.layout().body(m.body);
    const Vector c = b.R * m.moment, cdot = b.Rdot * m.moment, cddot = b.Rddot * m.moment;
    const Matrix3 SA = m.S * transpose(b.R);
    const Matrix3 G0 = b.R * SA, G2 = b.Rddot * SA;
    // Σ S_ab a_a × a_b″ is the axial vector of G₂: e_k·T = ε_kij G₂(j,i).
    const Vector moment = Vector{G2(2, 1) - G2(1, 2), G2(0, 2) - G2(2, 0), G2(1, 0) - G2(0, 1)};
    const Vector force = m.mass * (b.rddot - gravity_) + cddot;
    // R″ is of the size of ω² and α in all axes, also where it turns nothing: ω × J ω of a ball is nothing but
    // rounding, and that of a part of this size.
    const double turning = 0.25 * (norm(b.wdot) + dot(b.w, b.w));
    eq.apply_inertia(m.body, force, moment + cross(c, b.rddot - gravity_),
                     {.force = turning * norm(c), .moment = turning * trace(m.S)});
    if (!eq.wants_partials()) continue;

    const Matrix3 one = Matrix3::identity();
    const Matrix3 J = inertia_tensor(G0);
    const std::int32_t column = block.offset;
    eq.add_block(PartialBy::acceleration, m.body, {column}, {m.mass * one, skew(c)}, 1.0);
    if (!block.turns()) continue;
    const Matrix3 G1 = b.Rdot * SA;
    eq.add_block(PartialBy::acceleration, m.body, {column + 3}, {-skew(c), J}, 1.0);
    eq.add_block(PartialBy::velocity, m.body, {column + 3}, {-2.0 * skew(cdot), 2.0 * inertia_tensor(G1)}, 1.0);
    eq.add_block(PartialBy::position, m.body, {column + 3},
                 {-skew(cddot), transpose(G2) - G2 + skew(b.rddot - gravity_) * skew(c)}, 1.0);
  }
}

}  // namespace dynalin
