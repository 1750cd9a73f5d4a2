// Curves of a draw and what touches them.
#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "generator.h"

namespace dynalin::oracle {

namespace {

const CurveShape shape_of(const Mechanism& m, int id) {
  const auto curve = std::find_if(m.curves.begin(), m.curves.end(), [&](const Curve& c) { return c.id == id; });
  return {*curve, *std::find_if(m.matrices.begin(), m.matrices.end(),
                                [&](const NumberMatrix& a) { return a.id == curve->matrix; })};
}

}  // namespace

// Gently bent: along x, or around z.
int Draw::draw_curve(bool plane) {
  Curve c;
  c.id = static_cast<int>(m_.curves.size()) + 1;
  c.matrix = next_matrix_++;
  c.closed = chance(0.5);
  c.controls = chance(0.3);
  c.order = chance(0.6) ? 4 : 5 + pick(2);
  const int n = (c.closed ? 5 : 4) + (c.order - 4) + pick(4);
  NumberMatrix points{c.matrix, c.closed ? n + 1 : n, 3, {}};
  for (int k = 0; k < n; ++k) {
    const double at = -1 + 2.0 * k / (c.closed ? n : n - 1);
    const double angle = std::numbers::pi * at, radius = uniform(0.5, 0.7);
    const double rise = plane ? 0 : uniform(-0.15, 0.15), aside = uniform(-0.2, 0.2) + 0.4 * at * at;
    for (const double v :
         {c.closed ? radius * std::cos(angle) : at, c.closed ? radius * std::sin(angle) : aside, rise}) {
      points.values.push_back(L_ * v);
    }
  }
  if (c.closed) points.values.insert(points.values.end(), points.values.begin(), points.values.begin() + 3);
  m_.matrices.push_back(points);
  m_.curves.push_back(c);
  return c.id;
}

// In contact anywhere along the curves, in planes that need not agree. Not near a knot, where a third derivative jumps,
// nor where two curves osculate.
void Draw::place_contact(const BodyRef& i_body, const BodyRef& j_body, bool two_curves) {
  Contact c;
  c.id = static_cast<int>(m_.contacts.size()) + 1;
  c.two_curves = two_curves;
  c.u = uniform(-0.9, 0.9), c.v = uniform(-0.9, 0.9);
  const Vec at = 0.5L * (to_vec(body(i_body).qg) + to_vec(body(j_body).qg)) + box(0.4 * L_);
  Frame I{at, orientation()}, J{at, orientation()};
  c.jcurve = draw_curve(two_curves);
  const CurveShape b = shape_of(m_, c.jcurve);
  J.p = at - J.R * b.at(c.v);
  const Vec s = b.at(c.v, 1), s2 = b.at(c.v, 2);
  bool good = b.clearance(c.v) > 0.05L && norm(s) > 0.4L * L_ && norm(s2) < 6 * L_;
  if (two_curves) {
    c.icurve = draw_curve(true);
    const CurveShape a = shape_of(m_, c.icurve);
    const Vec t = a.at(c.u, 1), t2 = a.at(c.u, 2);
    good = good && a.clearance(c.u) > 0.05L && norm(t) > 0.4L * L_ && norm(t2) < 6 * L_;
    // Seen along z_J the tangents agree: e1 is that of I, in axes of J, and I is turned about it.
    const Real rise = uniform(-0.4, 0.4), turn = uniform(-0.5, 0.5) + (chance(0.3) ? std::numbers::pi : 0);
    const Vec e = (1 / norm(s)) * s;
    const Vec e1 = (chance(0.5) ? 1.0L : -1.0L) * (std::cos(rise) * e + std::sin(rise) * Vec{0, 0, 1});
    const Vec aside{-e.y, e.x, 0};
    const Vec e2 = std::cos(turn) * aside + std::sin(turn) * cross(e1, aside);
    const Vec along = (1 / norm(t)) * t;
    const Mat from{{along, Vec{-along.y, along.x, 0}, Vec{0, 0, 1}}}, to{{e1, e2, cross(e1, e2)}};
    const Mat R = to * transpose(from);
    I.R = J.R * R;
    I.p = at - I.R * a.at(c.u);
    const auto curvature = [](const Vec& d, const Vec& dd) {
      return (d.x * dd.y - d.y * dd.x) / std::pow(std::hypot(d.x, d.y), 3.0L);
    };
    const Real sense = dot(e1, e) > 0 ? 1 : -1;
    good = good && std::fabs(sense * curvature(R * t, R * t2) - curvature(s, s2)) > 0.5L / L_;
  }
  if (!good) throw std::runtime_error("the contact is near a knot or hardly determined");
  c.i = add_marker(i_body, I), c.j = add_marker(j_body, J);
  c.jfloat = add_floating(j_body);
  if (two_curves) c.ifloat = add_floating(i_body);
  m_.contacts.push_back(c);
  const auto note = [&](int marker, const CurveShape& shape, Real u) {
    const Vec d = shape.at(u, 1);
    if (norm(cross(d, shape.at(u, 2))) > 0.4L * std::pow(norm(d), 3.0L) / L_) floating_.push_back(marker);
  };
  note(c.jfloat, b, c.v);
  if (two_curves) note(c.ifloat, shape_of(m_, c.icurve), c.u);
}

// Measures of floating markers, and in their axes.
Expr Draw::at_contact(int order) {
  const int f = one_of(floating_);
  for (int attempt = 0; attempt < 50; ++attempt) {
    const auto [i, j] = distant_pair(true);
    const Vec d = here_->markers()[static_cast<std::size_t>(here_->marker_index(f))].p -
                  here_->markers()[static_cast<std::size_t>(here_->marker_index(j))].p;
    if (norm(d) < 0.3L * L_) continue;
    const auto along = [&](Measure x) { return static_cast<Measure>(static_cast<int>(x) + pick(3)); };
    const bool turning = body_of(i).kind != BodyKind::point_mass && chance(0.4);
    if (order == 0) {
      if (turning) return 0.5 * measure(along(chance(0.5) ? Measure::AX : Measure::YAW), {i, f});
      return (1 / L_) * (chance(0.5) ? measure(along(Measure::DX), {f, j, one_of(oriented_)})
                                     : measure(along(Measure::DX), {i, j, f}));
    }
    const Measure linear = along(order == 1 ? Measure::VX : Measure::ACCX);
    const Measure angular = along(order == 1 ? Measure::WX : Measure::WDTX);
    const double scale = order == 1 ? 0.3 : 0.02;
    if (turning) return scale * (order == 1 ? measure(angular, {f, j, i}) : measure(angular, {f, j, i, j}));
    if (chance(0.5)) return (scale / L_) * measure(linear, {f, j, one_of(oriented_), one_of(oriented_)});
    return (scale / L_) * measure(linear, {i, j, f, chance(0.5) ? f : j});
  }
  return displacement();
}

void Draw::draw_contacts() {
  if (!chance(0.5)) return;
  for (int attempt = 0, wanted = 1 + pick(2); attempt < 20 && wanted > 0 && mobility() > 2; ++attempt) {
    const BodyRef a = one_of(bodies_), b = one_of(bodies_);
    const bool two_curves = chance(0.5);
    if (a == b || b.kind == BodyKind::point_mass || (two_curves && a.kind == BodyKind::point_mass)) continue;
    const Mechanism before = m_;
    const int marker = next_marker_, matrix = next_matrix_;
    try {
      place_contact(a, b, two_curves);
      --wanted;
    } catch (const std::runtime_error&) {
      m_ = before;
      next_marker_ = marker, next_matrix_ = matrix;
    }
  }
}

void Draw::draw_planes() {
  for (int attempt = 0; attempt < 20 && mobility() > 2; ++attempt) {
    const BodyRef a = one_of(bodies_), b = one_of(bodies_);
    if (a == b || a.kind == BodyKind::point_mass || b.kind == BodyKind::point_mass) continue;
    const Mechanism before = m_;
    const int marker = next_marker_, matrix = next_matrix_;
    try {
      return place_plane(a, b);
    } catch (const std::runtime_error&) {
      m_ = before;
      next_marker_ = marker, next_matrix_ = matrix;
    }
  }
}

// A curve on the second body, and a place anywhere on it.
Draw::OnCurve Draw::draw_on_curve(const BodyRef& i_body, const BodyRef& j_body) {
  OnCurve on;
  on.contact.id = static_cast<int>(m_.contacts.size()) + 1;
  on.contact.v = uniform(-0.9, 0.9);
  on.at = 0.5L * (to_vec(body(i_body).qg) + to_vec(body(j_body).qg)) + box(0.4 * L_);
  on.contact.jcurve = draw_curve(false);
  const CurveShape b = shape_of(m_, on.contact.jcurve);
  on.J = {on.at, orientation()};
  on.J.p = on.at - on.J.R * b.at(on.contact.v);
  on.slope = b.at(on.contact.v, 1), on.bend = b.at(on.contact.v, 2);
  on.is_smooth = b.clearance(on.contact.v) > 0.05L && norm(on.slope) > 0.4L * L_ && norm(on.bend) < 6 * L_;
  return on;
}

int Draw::add_floating(const BodyRef& on) {
  Marker floating;
  floating.id = next_marker_++;
  floating.body = on;
  floating.floating = true;
  m_.markers.push_back(floating);
  return floating.id;
}

void Draw::add_contact(const OnCurve& on) {
  m_.contacts.push_back(on.contact);
  if (norm(cross(on.slope, on.bend)) > 0.4L * std::pow(norm(on.slope), 3.0L) / L_)
    floating_.push_back(on.contact.jfloat);
}

// A plane along the tangent anywhere on the curve, which bends away from it.
void Draw::place_plane(const BodyRef& i_body, const BodyRef& j_body) {
  OnCurve on = draw_on_curve(i_body, j_body);
  Contact& c = on.contact;
  c.plane = true;
  const Vec x = (1 / norm(on.slope)) * on.slope;
  const Vec drawn = box(1), aside = drawn - dot(drawn, x) * x;
  const Vec z = (1 / norm(aside)) * aside;
  if (!on.is_smooth || std::fabs(dot(z, on.bend)) < 0.4L * L_)
    throw std::runtime_error("the contact is near a knot or hardly determined");
  const Mat R = on.J.R * Mat{{x, cross(z, x), z}};
  const Frame I{on.at + uniform(-0.5, 0.5) * L_ * R.column[0] + uniform(-0.5, 0.5) * L_ * R.column[1],
                R * rotation_313(uniform(-3, 3), 0, 0)};
  c.i = add_marker(i_body, I), c.j = add_marker(j_body, on.J);
  c.ifloat = add_floating(i_body), c.jfloat = add_floating(j_body);
  add_contact(on);
}

// Between bodies that would be free of each other otherwise, or nearly.
void Draw::draw_axis() {
  for (int attempt = 0; attempt < 40 && mobility() > 4; ++attempt) {
    const BodyRef a = one_of(bodies_), b = one_of(bodies_);
    if (a == b || a == ground || a.kind == BodyKind::point_mass || b.kind == BodyKind::point_mass) continue;
    const Mechanism before = m_;
    const int marker = next_marker_, matrix = next_matrix_;
    try {
      return place_axis(a, b);
    } catch (const std::runtime_error&) {
      m_ = before;
      next_marker_ = marker, next_matrix_ = matrix;
    }
  }
  throw std::runtime_error("the seed wants an axis along a curve");
}

// z of I along the tangent, either way, and turned about it at will.
void Draw::place_axis(const BodyRef& i_body, const BodyRef& j_body) {
  OnCurve on = draw_on_curve(i_body, j_body);
  Contact& c = on.contact;
  c.axis = true;
  if (!on.is_smooth) throw std::runtime_error("the contact is near a knot");
  const Vec z = ((chance(0.5) ? 1 : -1) / norm(on.slope)) * on.slope;
  const Vec drawn = box(1), aside = drawn - dot(drawn, z) * z;
  const Vec x = (1 / norm(aside)) * aside;
  c.i = add_marker(i_body, {on.at, on.J.R * Mat{{x, cross(z, x), z}}}), c.j = add_marker(j_body, on.J);
  c.jfloat = add_floating(j_body);
  add_contact(on);
}

// Some contacts are stated where they are, in the axes of the curve or of another marker, and as fast as they are.
void Draw::draw_contact_starts() {
  const Mechanism drawn = m_;
  for (std::size_t k = 0; k < drawn.contacts.size(); ++k) {
    Contact& c = m_.contacts[k];
    const auto start = [&](int on, int curve, double u, std::optional<Triple>& at, int& axes) {
      if (!chance(0.4)) return;
      at = to_triple(shape_of(m_, curve).at(u));
      if (!chance(0.5)) return;
      // The same point from a marker of the same body.
      const auto other = std::find_if(m_.markers.begin(), m_.markers.end(), [&](const Marker& a) {
        return a.body == body_of(on) && !a.floating && a.id != on;
      });
      if (other == m_.markers.end()) return;
      const MarkerMotion& from = here_->markers()[static_cast<std::size_t>(here_->marker_index(on))];
      const MarkerMotion& to = here_->markers()[static_cast<std::size_t>(here_->marker_index(other->id))];
      axes = other->id;
      at = to_triple(transpose(Mat{to.axis}) * (from.p + Mat{from.axis} * to_vec(*at) - to.p));
    };
    if (c.two_curves) start(c.i, c.icurve, c.u, c.at_i, c.axes_i);
    start(c.j, c.jcurve, c.v, c.at_j, c.axes_j);
    const auto [slide_i, slide_j] = here_->contact_speeds(k);
    if (c.two_curves && chance(0.3)) c.speed_i = static_cast<double>(slide_i);
    if (chance(0.3)) c.speed_j = static_cast<double>(slide_j);
  }
}

}  // namespace dynalin::oracle
