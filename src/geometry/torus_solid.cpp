#include "geometry/torus_solid.h"

#include <algorithm>

namespace dynalin {

Vector TorusSolid::farthest(const Vector& way) const {
  const double across = std::hypot(way.x, way.y), length = norm(way);
  const Vector on_tube = way * (minor_ / length);
  return across > 0 ? Vector{way.x, way.y, 0} * (major_ / across) + on_tube : Vector{major_, 0, 0} + on_tube;
}

namespace {

// Up to so many sorted numbers between two others.
template <std::size_t most>
struct Sorted {
  std::array<double, most> at{};
  std::size_t count = 0;
  void add(double x) { at[count++] = x; }
};

// Where a function changes its sign between neighbours of these places, of which it is monotonic between any two.
template <std::size_t most, std::size_t given, class F>
Sorted<most> changes_of_sign(const Sorted<given>& between, const F& f) {
  Sorted<most> found;
  for (std::size_t k = 0; k + 1 < between.count; ++k) {
    double low = between.at[k], high = between.at[k + 1];
    const bool rises = f(low) < 0;
    if (rises != (f(high) >= 0)) continue;
    for (int n = 0; n < 200; ++n) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      ((f(middle) < 0) == rises ? low : high) = middle;
    }
    found.add(0.5 * (low + high));
  }
  return found;
}

template <std::size_t most>
Sorted<most + 2> with_ends(double low, const Sorted<most>& inner, double high) {
  Sorted<most + 2> all;
  all.add(low);
  for (std::size_t k = 0; k < inner.count; ++k) {
    if (inner.at[k] > low && inner.at[k] < high) all.add(inner.at[k]);
  }
  all.add(high);
  return all;
}

}  // namespace

// Along a line whose length t is from where it is next to the middle, the quartic of the surface is one of t² + c and
// of the square of the distance from the axis; between zeros of its derivative, t³ + p t − q, there is one place at
// most.
LineThroughTorus line_through(const TorusSolid& s, const Vector& a, const Vector& b) {
  LineThroughTorus line;
  line.first_inside = s.holds(a), line.last_inside = s.holds(b);
  const Vector way = b - a;
  const double length = norm(way), R = s.major();
  if (!(length > 0)) return line;
  const Vector w = way / length;
  const double start = dot(a, w), end = start + length;
  const Vector foot = a - w * start;
  const double c = dot(foot, foot) + R * R - s.minor() * s.minor(), steep = w.x * w.x + w.y * w.y,
               p = c - 2 * R * R * steep, q = 2 * R * R * (foot.x * w.x + foot.y * w.y);
  const auto cubic = [&](double t) { return t * (t * t + p) - q; };
  Sorted<2> turns;
  if (p < 0) turns.add(-std::sqrt(-p / 3)), turns.add(std::sqrt(-p / 3));
  const auto critical = changes_of_sign<3>(with_ends(start, turns, end), cubic);
  const auto parts = with_ends(start, critical, end);
  const auto at = [&](double t) { return t <= start ? a : t >= end ? b : a + w * (t - start); };
  bool inside = line.first_inside;
  for (std::size_t k = 0; k + 1 < parts.count; ++k) {
    double low = parts.at[k], high = parts.at[k + 1];
    const bool next_inside = k + 2 == parts.count ? line.last_inside : s.holds(at(high));
    if (next_inside == inside) continue;
    // Newton's method between two places on either side.
    double t = 0.5 * (low + high);
    for (int n = 0; n < 100; ++n) {
      const Vector here = at(t);
      const double value = s.value(here), slope = dot(s.gradient(here), w);
      ((value < 0) == inside ? low : high) = t;
      double next = t - value / slope;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (std::abs(next - t) <= 1e-17 * s.size() || next <= low || next >= high) break;
      t = next;
    }
    line.at[line.count++] = at(t);
    inside = next_inside;
  }
  return line;
}

// --- what is apart

namespace {

// From a side of a triangle to the circle. The square of the distance is ρ² + z² + R² − 2 R ρ; its derivative turns
// where the second one of the distance ρ from the axis is 1/R.
double side_from_circle(const TorusSolid& s, const Vector& a, const Vector& b) {
  const auto away = [&](const Vector& p) { return apart(s, p); };
  const Vector way = b - a;
  const double length = norm(way), R = s.major();
  if (!(length > 0)) return away(a);
  const Vector w = way / length;
  const double steep = w.x * w.x + w.y * w.y, to_axis = -(a.x * w.x + a.y * w.y) / std::max(steep, 1e-300);
  const double m = std::hypot(a.x + to_axis * w.x, a.y + to_axis * w.y);
  const auto slope = [&](double t) {
    const Vector p = a + w * t;
    return dot(s.gradient(p), w);
  };
  Sorted<2> turns;
  if (steep > 0) {
    const double square = (std::cbrt(R * R * steep * steep * m * m * m * m) - m * m) / steep;
    if (square > 0) turns.add(to_axis - std::sqrt(square)), turns.add(to_axis + std::sqrt(square));
  }
  const auto least = changes_of_sign<3>(with_ends(0, turns, length), slope);
  double best = std::min(away(a), away(b));
  for (std::size_t k = 0; k < least.count; ++k) best = std::min(best, away(a + w * least.at[k]));
  return best;
}

}  // namespace

double least_apart(const TorusSolid& s, const Vector& a, const Vector& b, const Vector& c) {
  double best = std::min({side_from_circle(s, a, b), side_from_circle(s, b, c), side_from_circle(s, c, a)});
  // In between: below the place of the circle that is the nearest to the plane.
  const Vector across = cross(b - a, c - a);
  const double size = norm(across);
  if (!(size > 0)) return best;
  const Vector n = across / size;
  for (const double sign : {-1.0, 1.0}) {
    const double sine = std::hypot(n.x, n.y);
    const Vector place = sine > 0 ? Vector{n.x, n.y, 0} * (sign * s.major() / sine) : Vector{s.major(), 0, 0};
    const double height = dot(n, place - a);
    const Vector below = place - n * height;
    const auto left_of = [&](const Vector& from, const Vector& to) {
      return dot(n, cross(to - from, below - from)) >= 0;
    };
    if (left_of(a, b) && left_of(b, c) && left_of(c, a)) best = std::min(best, std::abs(height) - s.minor());
  }
  return best;
}

}  // namespace dynalin
