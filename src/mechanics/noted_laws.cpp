#include "mechanics/noted_laws.h"

#include <cmath>
#include <limits>

#include "mechanics/pair_blocks.h"

namespace dynalin {

namespace {

// `own` is along the columns of `axes`.
void note(const PairMotion& p, const Matrix3& axes, const PairForce& own, const Layout& layout, ElementTrace& trace) {
  const Matrix3 back = transpose(axes);
  ElementTrace::Law& noted = trace.laws.emplace_back();
  noted.element = trace.elements.size() - 1;
  noted.axes = axes;
  noted.origin = p.motion->body(p.body_I).r + value(p.arm_I);
  noted.force = axes * own.force, noted.torque = axes * own.torque;
  for_each_block(p, layout, [&](const PairBlock& b) {
    BlockPartials by = partials_by(b, own);
    // About the point where the origin of I was: δp_I × F.
    if (!b.of_J) by.torque -= skew(own.force) * (back * b.moves);
    const auto add = [&](PartialBy family, const Matrix3& F, const Matrix3& T) {
      for (std::size_t c = 0; c < b.count; ++c)
        noted.partials.push_back(
            {family, b.column + static_cast<std::int32_t>(c), {F[c].x, F[c].y, F[c].z, T[c].x, T[c].y, T[c].z}});
    };
    add(PartialBy::position, by.force, by.torque);
    if (own.depends_on_velocity) add(PartialBy::damping, by.force_by_rate, by.torque_by_rate);
  });
}

// The first column is `u`; the others lie in planes of the ground where it does.
Matrix3 axes_along(const Vector& u) {
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(u[k]) < std::abs(u[least])) least = k;
  }
  Vector across{};
  across[least] = 1;
  across = normalized(across - dot(across, u) * u);
  return {u, across, cross(u, across)};
}

}  // namespace

double lengths_of_places(const PairMotion& p) {
  return norm(p.motion->body(p.body_I).r) + norm(p.motion->body(p.body_J).r) + norm(value(p.arm_I)) +
         norm(value(p.arm_J));
}

double rounding_of_force(double stiffness_times_lengths, double stated) {
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * stiffness_times_lengths;
  return stated != 0 && std::abs(stated) <= rounding ? 0 : rounding;
}

void note_law(const PairMotion& p, const RelativeWrench& w, const std::array<double, 6>& rounding, const Layout& layout,
              ElementTrace& trace) {
  RelativeWrench law = w;
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(law.force[k]) <= rounding[k]) law.force[k] = 0;
    if (std::abs(law.torque[k]) <= rounding[3 + k]) law.torque[k] = 0;
  }
  note(p, value(p.axes_J), along_axes_of_J(p, law), layout, trace);
}

void note_line(const PairMotion& p, const LineMagnitude& F, double rounding, const Layout& layout,
               ElementTrace& trace) {
  const Taylor d = norm(p.delta);
  const Vec3<Taylor> line = p.delta / d;
  const Matrix3 axes = axes_along(value(line));
  const double magnitude = std::abs(F.value) <= rounding ? 0 : F.value;
  PairForce own;
  own.force.x = magnitude;
  own.depends_on_velocity = F.on_rate != 0.0;
  // Along the line F_d δd + F_v δd′ with δd = u·δΔ and δd′ = u·δΔ′ + u′·δΔ, across it F/d δΔ. The axes stay as they
  // were.
  const Vector turned = F.on_rate * rate(line);
  const Matrix3 on_delta =
      transpose(Matrix3{F.on_distance * axes.x + turned, magnitude / d.value * axes.y, magnitude / d.value * axes.z});
  const Matrix3 on_delta_rate = transpose(Matrix3{F.on_rate * axes.x, {}, {}});
  own.force_on_position.origin_I = on_delta, own.force_on_position.origin_J = -on_delta;
  own.force_on_velocity.origin_I = on_delta_rate, own.force_on_velocity.origin_J = -on_delta_rate;
  note(p, axes, own, layout, trace);
}

}  // namespace dynalin
