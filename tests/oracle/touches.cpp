// Contact of shapes: a ball or disc about marker i with what marker j carries, or solids (solids.h), from positions and
// velocities in global axes. A disc turns no curve: what of it is nearest lies against the normal, in its own plane.
// Every place has a force of its own, by its own depth, approach and slip.
#include <algorithm>

#include "model.h"

namespace dynalin::oracle {

namespace {

Real step(Real x) {
  const Real s = std::clamp(x, Real(0), Real(1));
  return s * s * (3 - 2 * s);
}

// 2 zeta: what part r of the speed two masses keep on a spring and a damper of that ratio, as long as they press.
Real twice_damping_ratio(Real r) {
  Real low = 0, high = 1;
  for (int k = 0; k < 200; ++k) {
    const Real zeta = (low + high) / 2;
    (std::exp(-2 * zeta * std::acos(zeta) / std::sqrt(1 - zeta * zeta)) > r ? low : high) = zeta;
  }
  return low + high;
}

}  // namespace

TouchPlace Model::place_of_ball(const Touch& t, const MarkerMotion& i, const MarkerMotion& j) const {
  const Real r = t.radius_i;
  TouchPlace s;
  const Vec d = i.p - j.p;
  if (t.kind == TouchKind::ball_on_plane) {
    const Real height = dot(d, j.axis[2]);
    s.normal = j.axis[2];
    s.gap = height - r;
    s.point = i.p - ((height + r) / 2) * s.normal;
  } else if (t.kind == TouchKind::balls) {
    s.normal = (1 / norm(d)) * d;
    s.gap = norm(d) - r - t.radius_j;
    s.point = j.p + ((norm(d) - r + t.radius_j) / 2) * s.normal;
  } else {
    const CurveShape& curve = curves_.at(t.curve);
    const Real x = dot(d, j.axis[0]), y = dot(d, j.axis[1]);
    Real v = t.v;
    for (int n = 0; n < 60; ++n) {
      const Vec b = curve.at(v), b1 = curve.at(v, 1), b2 = curve.at(v, 2);
      const Real dx = b.x - x, dy = b.y - y;
      const Real change = (dx * b1.x + dy * b1.y) / (b1.x * b1.x + b1.y * b1.y + dx * b2.x + dy * b2.y);
      v -= change;
      if (std::fabs(change) < 1e-19L) break;
    }
    const Vec b = curve.at(v), b1 = curve.at(v, 1);
    // Matter is to the left.
    const Real size = std::hypot(b1.x, b1.y);
    s.normal = (b1.y / size) * j.axis[0] - (b1.x / size) * j.axis[1];
    const Vec outwards = s.normal - dot(s.normal, i.axis[2]) * i.axis[2];
    const Vec disc = i.p - (r / norm(outwards)) * outwards,
              from_curve = disc - (j.p + b.x * j.axis[0] + b.y * j.axis[1]);
    s.gap = dot(from_curve, s.normal);
    // The curve as a cylinder: the same height over its plane.
    const Vec across = dot(from_curve, j.axis[0]) * j.axis[0] + dot(from_curve, j.axis[1]) * j.axis[1];
    s.point = disc - 0.5L * across;
  }
  return s;
}

const std::vector<TouchPlace>& Model::touch_places(std::size_t k) const {
  std::vector<TouchPlace>& places = touch_places_[k];
  if (!places.empty()) return places;
  const Touch& t = mechanism_.touches[k];
  const MarkerMotion& i = markers_[static_cast<std::size_t>(marker_index(t.i))];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(marker_index(t.j))];
  if (t.kind == TouchKind::solids) {
    places = places_of_solids(t, {i.p, {i.axis}}, {j.p, {j.axis}});
  } else {
    places = {place_of_ball(t, i, j)};
  }
  return places;
}

Model::TouchState Model::touch_state(const Touch& t, const TouchPlace& place) const {
  const auto on_i = static_cast<std::size_t>(marker_index(t.i)), on_j = static_cast<std::size_t>(marker_index(t.j));
  const MarkerMotion &i = markers_[on_i], &j = markers_[on_j];
  TouchState s{place.normal, place.point, {}, place.gap, 0};
  s.velocity = i.v + cross(i.w, s.point - i.p) - j.v - cross(j.w, s.point - j.p);
  const Real g = -s.gap, rate = -dot(s.velocity, s.normal);
  if (g <= 0) return s;
  Real damping = t.damping * step(g / t.full_damping), exponent = t.exponent;
  if (t.restitution) {
    Real inverse = 0;
    for (const std::size_t m : {on_i, on_j}) {
      const auto body = static_cast<std::size_t>(marker_data_[m].body);
      if (body != 0) inverse += mechanism_.ucf / bodies[body].mass;
    }
    exponent = 1;
    damping = twice_damping_ratio(*t.restitution) * std::sqrt(t.stiffness / inverse);
  }
  s.pressure = std::max(Real(0), t.stiffness * std::pow(g, exponent) + damping * rate);
  return s;
}

std::vector<Model::TouchState> Model::touch_states(std::size_t k) const {
  std::vector<TouchState> states;
  for (const TouchPlace& place : touch_places(k)) states.push_back(touch_state(mechanism_.touches[k], place));
  return states;
}

Wrench Model::touch_wrench(std::size_t k) const {
  const Touch& t = mechanism_.touches[k];
  const Vec about = markers_[static_cast<std::size_t>(marker_index(t.i))].p;
  Wrench sum;
  for (const TouchState& s : touch_states(k)) {
    Vec force = s.pressure * s.normal;
    const Vec slip = s.slip();
    const Real speed = norm(slip);
    if (t.rubs && speed > 0) {
      const Real vs = t.stiction_speed, vd = t.sliding_speed;
      const Real mu = speed < vs ? t.mu_static * (2 * step((speed + vs) / (2 * vs)) - 1)
                                 : t.mu_static + (t.mu_dynamic - t.mu_static) * step((speed - vs) / (vd - vs));
      force = force - (mu * s.pressure / speed) * slip;
    }
    sum.f += force;
    sum.t += cross(s.point - about, force);
  }
  return sum;
}

void Model::apply_touches(std::vector<Wrench>& loads) const {
  for (std::size_t k = 0; k < mechanism_.touches.size(); ++k) {
    const int i = marker_index(mechanism_.touches[k].i), j = marker_index(mechanism_.touches[k].j);
    const Wrench w = touch_wrench(k);
    const Vec at = markers_[static_cast<std::size_t>(i)].p;
    apply(loads, i, at, w, 1);
    apply(loads, j, at, w, -1);
  }
}

}  // namespace dynalin::oracle
