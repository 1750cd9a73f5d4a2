// Shapes of a draw that press on each other, deep enough for the steps of differences, in every regime of their laws
// and away from where regimes meet.
#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "generator.h"

namespace dynalin::oracle {

namespace {

// Whether a disc is near the curve about its parameter v alone.
bool touches_once(const CurveShape& curve, double v, const Vec& centre, Real radius, Real room) {
  constexpr int samples = 800;
  const auto away = [&](int k) {
    const Vec d = curve.at(-1 + 2.0L * k / samples) - centre;
    return std::hypot(d.x, d.y);
  };
  int near = 0;
  for (int k = 0; k <= samples; ++k) {
    const bool least = (k == 0 || away(k) <= away(k - 1)) && (k == samples || away(k) < away(k + 1));
    if (!least || away(k) > radius + room) continue;
    if (std::fabs(-1 + 2.0 * k / samples - v) > 0.02) return false;
    ++near;
  }
  return near == 1;
}

Model::TouchState deepest(const std::vector<Model::TouchState>& places) {
  return *std::min_element(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
}

}  // namespace

void Draw::draw_touches() {
  if (!must_touch_ && meeting_ < 0) return;
  std::swap(random_, touch_random_);
  if (meeting_ >= 0) {
    draw_meetings();
  } else {
    for (int k = 1 + pick(2); k > 0; --k) draw_touch();
  }
  const Touch& t = m_.touches.back();
  const int component = 1 + pick(8);
  const Expr read = (1 / (component > 4 ? F_ * L_ : F_)) *
                    touch_load(t.id, pick(2), component == 5 ? 6 : component, chance(0.4) ? 0 : one_of(oriented_));
  m_.poutput.variables.push_back(variable(read));
  if (chance(0.3)) m_.sforces[0].function = m_.sforces[0].function + (0.1 * F_) * read;
  std::swap(random_, touch_random_);
  check();
}

void Draw::draw_touch() {
  std::vector<BodyRef> solid;
  std::copy_if(bodies_.begin(), bodies_.end(), std::back_inserter(solid),
               [](const BodyRef& b) { return b.kind != BodyKind::point_mass; });
  const BodyRef a = one_of(solid), b = one_of(solid);
  if (a == b) throw std::runtime_error("a body does not touch itself");
  Touch t;
  t.id = static_cast<int>(m_.touches.size()) + 1;
  t.kind = static_cast<TouchKind>(pick(3));
  t.radius_i = L_ * uniform(0.3, 0.6), t.radius_j = L_ * uniform(0.3, 0.6);
  const Real depth = L_ * uniform(0.1, 0.2);
  const Vec at = 0.5L * (to_vec(body(a).qg) + to_vec(body(b).qg)) + box(0.4 * L_);
  const Frame J{at, orientation()};
  Frame I{at, orientation()};
  if (t.kind == TouchKind::ball_on_plane) {
    const Vec aside = box(L_);
    I.p += J.R * Vec{aside.x, aside.y, t.radius_i - depth};
  } else if (t.kind == TouchKind::balls) {
    I.p += (t.radius_i + t.radius_j - depth) * orientation().column[0];
  } else {
    t.curve = draw_curve(true);
    t.v = uniform(-0.7, 0.7);
    const CurveShape curve(m_.curves.back(), m_.matrices.back());
    const Vec p = curve.at(t.v), s = curve.at(t.v, 1);
    const Vec centre = p + ((t.radius_i - depth) / std::hypot(s.x, s.y)) * Vec{s.y, -s.x, 0};
    const Vec bend = curve.at(t.v, 2);
    const Real curvature = (s.x * bend.y - s.y * bend.x) / std::pow(std::hypot(s.x, s.y), 3.0L);
    const Real together = 1 / Real(t.radius_i) + curvature * (1 - depth / t.radius_i);
    if (curve.clearance(t.v) < 0.08L || std::hypot(s.x, s.y) < 0.4L * L_ || together < 0.7L / L_ ||
        curvature * depth > 0.6L || !touches_once(curve, t.v, centre, t.radius_i, 0.1L * L_)) {
      throw std::runtime_error("a disc touches a curve at no definite place");
    }
    I.p = J.p + J.R * centre;
    I.R = J.R * rotation_z(uniform(-3, 3));
    if (chance(0.3)) I.R = I.R * rotation_x(std::numbers::pi_v<Real>);
  }
  t.i = add_marker(a, I), t.j = add_marker(b, J);
  draw_touch_law(t);
}

// By how deep it is at its deepest place, how fast it goes deeper and how fast it slips there.
void Draw::draw_touch_law(Touch& t) {
  m_.touches.push_back(t);
  Model here(m_);
  place(here, drawn_point(m_));
  const Model::TouchState s = deepest(here.touch_states(m_.touches.size() - 1));
  m_.touches.pop_back();
  const double depth = static_cast<double>(-s.gap), rate = static_cast<double>(std::fabs(dot(s.velocity, s.normal)));
  const double pressed = F_ * uniform(0.5, 2);
  const auto has_mass = [&](int marker) { return body_of(marker) == ground || body(body_of(marker)).mass > 0; };
  if (has_mass(t.i) && has_mass(t.j) && chance(0.35)) {
    t.stiffness = pressed / depth;
    t.restitution = uniform(0.75, 0.98);
  } else {
    t.exponent = chance(0.2) ? 1 : uniform(1.2, 2.5);
    t.stiffness = pressed / std::pow(depth, t.exponent);
    t.damping = pressed / std::max(rate, 0.3 * L_) * uniform(0.05, 0.4);
    t.full_damping = depth * (chance(0.5) ? uniform(0.2, 0.5) : uniform(1.7, 4));
  }
  const double speed = static_cast<double>(norm(s.slip()));
  t.rubs = chance(0.7);
  if (t.rubs) {
    t.mu_static = uniform(0.1, 0.5), t.mu_dynamic = t.mu_static * uniform(0.4, 1);
    const double ratio = uniform(1.5, 2.5), r = speed < 0.5 * L_ ? 0 : uniform(0, 1);
    t.stiction_speed = speed < 0.1 * L_ ? L_ * uniform(0.5, 2)
                       : r < 0.4        ? std::max(speed * uniform(1.3, 4), 0.4 * L_)
                       : r < 0.7        ? speed / (1 + (ratio - 1) * uniform(0.3, 0.7))
                                        : speed / (ratio * uniform(1.3, 3));
    t.sliding_speed = ratio * t.stiction_speed;
  }
  m_.touches.push_back(t);
  Model with_law(m_);
  place(with_law, drawn_point(m_));
  if (deepest(with_law.touch_states(m_.touches.size() - 1)).pressure < 0.3 * pressed)
    throw std::runtime_error("a contact is nearly open");
}

}  // namespace dynalin::oracle
