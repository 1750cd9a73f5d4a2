// What lines make when they turn: the mantle of a frustum, and the edge of a box as one of no radius. At every point of
// one of its lines it has the same normal. Two of them touch where two of their lines cross; a circle touches one at
//
//     n(u) · p′(s) = 0,      n′(u) · (p(s) − o) = 0
//
// with the normal n by its angle u about the axis, the points p of the circle by their angle s, and the origin o on the
// axis: there both have the normal n. The first holds at a circle of no radius whatever the angle.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "geometry/least_on_circle.h"
#include "geometry/placed_box.h"

namespace dynalin::solid {

// By its axis, and by the angle of its normals to that.
template <class T>
struct Ruled {
  Vec3<T> origin, axis, first, second;      // unit vectors, right-handed
  double along_axis = 0, along_radius = 1;  // of the normal
  double low_radius = 0;                    // where the axis begins
  double length = 0;                        // of its lines

  double offset() const { return low_radius * along_radius; }  // of n · (x − o)
  template <class S>
  Vec3<S> outward(const S& u) const {
    using std::cos, std::sin;
    return as<S>(first) * S(cos(u)) + as<S>(second) * S(sin(u));
  }
  template <class S>
  Vec3<S> normal(const S& u) const {
    return as<S>(axis) * S(along_axis) + outward(u) * along_radius;
  }
  template <class S>
  Vec3<S> turned(const S& u) const {  // its derivative
    using std::cos, std::sin;
    return as<S>(second) * S(cos(u) * along_radius) - as<S>(first) * S(sin(u) * along_radius);
  }
  // Of the normal nearest to a direction.
  double angle_of(const Vector& n) const { return std::atan2(dot(value_of(second), n), dot(value_of(first), n)); }
  // All points that have a normal.
  Edge<T> line(const Vec3<T>& n) const {
    const Vec3<T> out = (n - axis * along_axis) / along_radius;
    return {origin + out * low_radius, axis * along_radius - out * along_axis, length};
  }
  double slope() const { return std::atan2(-along_axis, along_radius); }  // of its lines, to the axis
  Ruled<double> plain() const {
    return {as<double>(origin), as<double>(axis), as<double>(first), as<double>(second),
            along_axis,         along_radius,     low_radius,        length};
  }
};

template <class T>
Ruled<T> ruled_of(const Edge<T>& e, const Vec3<T>& first) {
  return {e.from, e.along, first, cross(e.along, first), 0, 1, 0, e.length};
}

template <class T>
void keep_along(const T& along, double length, double tolerance, Touch<T>& t) {
  for (const double depth : {value_of(along), length - value_of(along)})
    t.inside = std::min(t.inside, depth), t.weight *= T(share_inside(depth, tolerance));
}

// Newton's method from two angles. Nothing where it does not settle.
struct RuledAngles {
  double u = 0, s = 0;
  double uu = 1, us = 0, ss = 1, determinant = 1;  // second derivatives of n(u) · (p(s) − o)
};
inline std::optional<RuledAngles> settle(const Ruled<double>& r, const Circle<double>& c, double u, double s) {
  RuledAngles a{u, s};
  const bool point = c.radius == 0;
  double last = unbounded;
  for (int k = 0; k < 50; ++k) {
    const Vector from = c.at(a.s) - r.origin, along = c.tangent(a.s), turned = r.turned(a.u), n = r.normal(a.u);
    a.uu = -dot(r.outward(a.u), from) * r.along_radius, a.us = point ? 0 : dot(turned, along);
    a.ss = point ? 1 : -dot(n, c.at(a.s) - c.centre);
    a.determinant = a.uu * a.ss - a.us * a.us;
    const double f = dot(turned, from), g = point ? 0 : dot(n, along);
    const double size = norm(from) + c.radius;
    if (!(std::abs(a.determinant) > 1e-9 * size * (point ? 1 : size))) return std::nullopt;
    double du = -(f * a.ss - g * a.us) / a.determinant, ds = -(g * a.uu - f * a.us) / a.determinant;
    const double step = std::max(std::abs(du), std::abs(ds));
    if (!std::isfinite(step)) return std::nullopt;
    if (step < 1e-9 && step >= 0.5 * last) return a;
    if (step == 0) return a;
    last = step;
    if (step > 0.3) du *= 0.3 / step, ds *= 0.3 / step;
    a.u += du, a.s += ds;
  }
  return std::nullopt;
}

// A circle, or a point, across it, from angles nearby.
template <class T>
std::optional<Touch<T>> touch_ruled(const Ruled<T>& r, const Circle<T>& c, double u, double s, bool out_of_J,
                                    double tolerance) {
  const auto settled = settle(r.plain(), c.plain(), u, s);
  if (!settled) return std::nullopt;
  const RuledAngles& a = *settled;
  T at_u(a.u), at_s(a.s);
  const Vec3<T> from = c.at(at_s) - r.origin;
  const T f = dot(r.turned(at_u), from), g = c.radius == 0 ? T(0.0) : dot(r.normal(at_u), c.tangent(at_s));
  at_u = at_u - (f * a.ss - g * a.us) * (1 / a.determinant);
  at_s = at_s - (g * a.uu - f * a.us) * (1 / a.determinant);
  const Vec3<T> n = r.normal(at_u), p = c.at(at_s);
  const T gap = dot(n, p - r.origin) - r.offset();
  const Vec3<T> on = p - n * gap;
  const Edge<T> line = r.line(n);
  Touch<T> t = between(on, gap, n);
  keep_along(T(dot(on - line.from, line.along)), r.length, tolerance, t);
  if (!out_of_J) t.normal = -n;
  return t;
}

// Two lines with their common normal, out of J.
template <class T>
Touch<T> crossing_of_lines(const Edge<T>& I, const Edge<T>& J, const Vec3<T>& n, double tolerance) {
  const Vec3<T> d = I.from - J.from;
  const T area = dot(cross(I.along, J.along), n);
  const T s = -dot(d, cross(J.along, n)) / area, r = -dot(d, cross(I.along, n)) / area;
  Touch<T> t = between(Vec3<T>(J.from + J.along * r), T(dot(d, n)), n);
  keep_along(s, I.length, tolerance, t), keep_along(r, J.length, tolerance, t);
  return t;
}

// The two directions out of J that are normal to a line of each, or none.
template <class T>
std::optional<std::array<Vec3<T>, 2>> common_normals(const Ruled<T>& I, const Ruled<T>& J) {
  using std::sqrt;
  const Vec3<T>&a = I.axis, &b = J.axis;
  const double A = -I.along_axis, B = J.along_axis;
  const T c = dot(a, b);
  const Vec3<T> across = cross(a, b);
  const T sine_squared = dot(across, across);
  if (!(value_of(sine_squared) > 1e-12)) return std::nullopt;
  const T alpha = (A - c * B) / sine_squared, beta = (B - c * A) / sine_squared;
  const T rest = (1.0 - alpha * A - beta * B) / sine_squared;
  if (!(value_of(rest) * value_of(sine_squared) > 1e-12)) return std::nullopt;
  const Vec3<T> in_plane = a * alpha + b * beta, out = across * sqrt(rest);
  return std::array<Vec3<T>, 2>{in_plane + out, in_plane - out};
}

// Lines that are nearly parallel hold each other at both ends of what they have in common; others where they cross. The
// share of the ends goes over from 1 to 0 between two small angles.
template <class T>
T share_of_ends(const Ruled<T>& I, const Ruled<T>& J, const Vector& normal) {
  constexpr double parallel = 1e-3, crossed = 1e-2;
  const Vector g = I.plain().line(I.plain().normal(I.angle_of(-normal))).along;
  const Vector h = J.plain().line(J.plain().normal(J.angle_of(normal))).along;
  if (norm(cross(g, h)) > 2 * crossed) return T(0.0);
  // sin² of the angle between the axes less that of both slopes.
  const double sense = value_of(dot(I.axis, J.axis)) < 0 ? -1 : 1;
  const double slopes = std::abs(sense * I.slope() + J.slope());
  const Vec3<T> across = cross(I.axis, J.axis);
  T sine_squared = dot(across, across);
  if (slopes > 1e-12) {
    using std::sqrt;
    if (!(value_of(sine_squared) > 0)) return T(0.0);
    const T sine = sqrt(sine_squared) * std::cos(slopes) - dot(I.axis, J.axis) * (sense * std::sin(slopes));
    sine_squared = sine * sine;
  }
  const double low = parallel * parallel, high = crossed * crossed;
  if (value_of(sine_squared) <= low) return T(1.0);
  if (value_of(sine_squared) >= high) return T(0.0);
  const T z = (sine_squared - low) / (high - low);
  return 1.0 - z * z * (3.0 - 2.0 * z);
}

// Where a line passes over a circle, seen along the axis first × second: angles of the circle.
inline std::array<std::optional<double>, 2> passes(const Edge<double>& line, const Circle<double>& c) {
  const Vector from = line.from - c.centre;
  const double x = dot(from, c.first), y = dot(from, c.second);
  const double dx = dot(line.along, c.first), dy = dot(line.along, c.second);
  const double a = dx * dx + dy * dy, b = x * dx + y * dy, e = x * x + y * y - c.radius * c.radius;
  const double root = b * b - a * e;
  if (!(a > 1e-12) || !(root > 0)) return {};
  const auto angle = [&](double t) { return std::atan2(y + t * dy, x + t * dx); };
  return {angle((-b - std::sqrt(root)) / a), angle((-b + std::sqrt(root)) / a)};
}

}  // namespace dynalin::solid
