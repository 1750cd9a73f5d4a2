#include "geometry/quadric_solid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dynalin {

QuadricSolid::QuadricSolid(const solid::Ellipsoid& e)
    : semi_axes_(e.semi_axes), size_(2 * std::max({e.semi_axes.x, e.semi_axes.y, e.semi_axes.z})) {
  for (std::size_t k = 0; k < 3; ++k) square_[k] = 1 / (semi_axes_[k] * semi_axes_[k]);
}

QuadricSolid::QuadricSolid(const solid::Frustum& f)
    : has_ends_(true),
      frustum_(f),
      slope_((f.high_radius - f.low_radius) / (f.high - f.low)),
      radius_at_origin_(f.low_radius - slope_ * f.low),
      size_(std::max(f.high - f.low, 2 * std::max(f.low_radius, f.high_radius))),
      square_{1, 1, -slope_ * slope_} {}

Vector QuadricSolid::farthest(const Vector& way) const {
  if (!has_ends_) {
    const Vector m{semi_axes_.x * way.x, semi_axes_.y * way.y, semi_axes_.z * way.z};
    const double size = norm(m);
    return {semi_axes_.x * m.x / size, semi_axes_.y * m.y / size, semi_axes_.z * m.z / size};
  }
  const double across = std::hypot(way.x, way.y);
  const bool upper = way.z * (frustum_.high - frustum_.low) + across * (frustum_.high_radius - frustum_.low_radius) > 0;
  const double by = across > 0 ? radius(upper) / across : 0;
  return {by * way.x, by * way.y, height(upper)};
}

namespace {

// Of A u² + 2 B u + C with C < 0 at u = 0 and not below 0 at u = 1: where it rises through 0.
double rises_at(double A, double B, double C) {
  const double root = std::sqrt(std::max(B * B - A * C, 0.0));
  const double u = B > 0 ? -C / (B + root) : (root - B) / A;
  return u >= 0 && u <= 1 ? u : 1.0;
}

}  // namespace

void find_inside(const QuadricSolid& s, LineInSolid& line) {
  const Vector way = line.last - line.first;
  line.from = line.first, line.to = line.last, line.from_at = line.first_at, line.to_at = line.last_at;
  line.enters = line.first_inside || line.last_inside;
  if (line.first_inside && line.last_inside) return;
  const double A = s.form(way, way), B = 0.5 * dot(s.gradient(line.first), way);
  const auto at = [&](double u) { return line.first + way * u; };
  if (line.first_inside) {
    line.to = at(rises_at(A, B, s.value(line.first))), line.to_at = SolidFace::curved;
  } else if (line.last_inside) {
    const double back = -0.5 * dot(s.gradient(line.last), way);
    line.from = line.last - way * rises_at(A, back, s.value(line.last)), line.from_at = SolidFace::curved;
  } else {
    const double C = s.value(line.first), square = B * B - A * C;
    if (!(A > 0) || B >= 0 || -B >= A || square <= 0) return;
    const double sum = -B + std::sqrt(square), enter = C / sum, leave = sum / A;
    if (!(enter < leave && leave <= 1)) return;
    line.enters = true;
    line.from = at(enter), line.to = at(leave), line.from_at = line.to_at = SolidFace::curved;
  }
}

LineInSolid line_in_solid(const QuadricSolid& s, const Vector& a, const Vector& b) {
  LineInSolid line;
  line.first = a, line.last = b;
  if (s.has_ends()) {
    for (const bool high : {false, true}) {
      const double end = s.height(high), up = high ? 1 : -1;
      const bool a_beyond = up * (a.z - end) >= 0, b_beyond = up * (b.z - end) >= 0;
      if (a_beyond && b_beyond) return line;
      if (!a_beyond && !b_beyond) continue;
      Vector cut = a + (b - a) * ((end - a.z) / (b.z - a.z));
      cut.z = end;
      const SolidFace face = high ? SolidFace::high : SolidFace::low;
      if (a_beyond) {
        line.first = cut, line.first_at = face;
      } else {
        line.last = cut, line.last_at = face;
      }
    }
  }
  line.between_ends = true;
  line.first_inside = s.value(line.first) < 0, line.last_inside = s.value(line.last) < 0;
  find_inside(s, line);
  return line;
}

// --- what is apart

double apart(const QuadricSolid& s, const Vector& p) {
  if (!s.has_ends()) {
    const Vector& a = s.semi_axes();
    return (norm(Vector{p.x / a.x, p.y / a.y, p.z / a.z}) - 1) * std::min({a.x, a.y, a.z});
  }
  const double of_mantle = (std::hypot(p.x, p.y) - s.radius_at(p.z)) / std::hypot(1, s.slope());
  return std::max({of_mantle, s.frustum().low - p.z, p.z - s.frustum().high});
}

namespace {

// Of a convex function between 0 and 1.
template <class F>
double least_between(const F& f) {
  constexpr double golden = 0.6180339887498949;
  double low = 0, high = 1, a = 1 - golden, b = golden, fa = f(a), fb = f(b);
  for (int k = 0; k < 60; ++k) {
    if (fa < fb) {
      high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
    }
  }
  return std::min({fa, fb, f(0.0), f(1.0)});
}

}  // namespace

double least_apart(const QuadricSolid& s, const Vector& a, const Vector& b, const Vector& c) {
  return least_between([&](double u) {
    const Vector from = a + (b - a) * u, way = (c - b) * u;
    return least_between([&](double v) { return apart(s, from + way * v); });
  });
}

}  // namespace dynalin
