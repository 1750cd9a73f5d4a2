// Where along a circle a function is least, and how that place follows what the function depends on.
//
// A function of an angle s is given by its slope g(s; q). The least one is searched for on plain numbers; there one
// step of Newton's method on duals, s − g(s; q)/g′(s), has the derivatives of the implicit function theorem.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "geometry/distance.h"

namespace dynalin::solid {

struct LeastAngle {
  double at = 0;
  double curvature = 0;  // g′ there
  bool definite = true;  // false where the function is level or has a kink, or is as low elsewhere
};

// `value` of a double; `slope` of a double and of a Dual<1>. `size`: what values compare with.
template <class Value, class Slope>
LeastAngle least_on_turn(const Value& value, const Slope& slope, double size) {
  // Between neighbours of one of so many that is less than both the slope changes its sign.
  constexpr int samples = 48;
  constexpr double step = 2 * std::numbers::pi / samples, level = 1e-9;
  std::array<double, samples> at;
  for (int k = 0; k < samples; ++k) at[static_cast<std::size_t>(k)] = value(k * step);
  const auto sample = [&](int k) { return at[static_cast<std::size_t>((k + samples) % samples)]; };
  const double lowest = *std::min_element(at.begin(), at.end());
  double best = 0, least = std::numeric_limits<double>::infinity(), next = least;
  for (int k = 0; k < samples; ++k) {
    const double here = sample(k), before = sample(k - 1), behind = sample(k + 1);
    if (here > before || here > behind) continue;
    // A parabola through the three goes down by no more than an eighth of this; the least sample is always looked at.
    if (here != lowest && here - (before - 2 * here + behind) > lowest) continue;
    double low = (k - 1) * step, high = (k + 1) * step;
    for (int i = 0; i < 200 && high - low > 1e-16 * (1 + std::abs(high)); ++i) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (slope(middle) > 0 ? high : low) = middle;
    }
    const double angle = 0.5 * (low + high);
    const double v = value(angle);
    // Neighbouring samples as low as each other lead to one place.
    const bool elsewhere = std::abs(std::remainder(angle - best, 2 * std::numbers::pi)) > 1e-6;
    if (v < least) {
      if (elsewhere) next = least;
      least = v, best = angle;
    } else if (elsewhere) {
      next = std::min(next, v);
    }
  }
  LeastAngle found{best};
  const Dual<1> there = slope(Dual<1>(found.at, std::size_t{0}));
  found.curvature = there.partial[0];
  found.definite =
      found.curvature > level * size && std::abs(there.value) < level * size && next - least > coincidence * size;
  return found;
}

struct LargestAngle {
  double at = 0;
  bool definite = true;  // false where the function is as large elsewhere
};

// The largest value inside of an arc, nothing where the function has its largest at an end. `slope` of a double.
template <class Value, class Slope>
std::optional<LargestAngle> largest_between(double first, double last, const Value& value, const Slope& slope,
                                            double size) {
  constexpr int samples = 16;
  const auto at = [&](int k) { return first + (last - first) * k / samples; };
  std::optional<LargestAngle> found;
  double most = -std::numeric_limits<double>::infinity();
  double before = slope(first);
  for (int k = 1; k <= samples; ++k) {
    const double here = slope(at(k));
    if (before > 0 && here <= 0) {
      double low = at(k - 1), high = at(k);
      for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (slope(middle) > 0 ? low : high) = middle;
      }
      const double angle = 0.5 * (low + high), v = value(angle);
      const bool apart = std::abs(v - most) > coincidence * size;
      if (v > most)
        found = LargestAngle{angle, apart}, most = v;
      else if (!apart)
        found->definite = false;
    }
    before = here;
  }
  return found;
}

// The same vector over the scalar S, without what it depends on where that is another one.
template <class S, class T>
Vec3<S> as(const Vec3<T>& v) {
  if constexpr (std::is_same_v<S, T>) {
    return v;
  } else {
    return {S(value_of(v.x)), S(value_of(v.y)), S(value_of(v.z))};
  }
}

// About `centre`, from the unit vector `first` towards `second`.
template <class T>
struct Circle {
  Vec3<T> centre, first, second;
  double radius = 0;

  template <class S>
  Vec3<S> at(const S& s) const {
    using std::cos, std::sin;
    return as<S>(centre) + as<S>(first) * S(cos(s) * radius) + as<S>(second) * S(sin(s) * radius);
  }
  template <class S>
  Vec3<S> tangent(const S& s) const {
    using std::cos, std::sin;
    return as<S>(second) * S(cos(s) * radius) - as<S>(first) * S(sin(s) * radius);
  }
  // The same without what it depends on.
  Circle<double> plain() const { return {as<double>(centre), as<double>(first), as<double>(second), radius}; }
};

template <class T>
struct OnCircle {
  Vec3<T> point;
  Distance<T> distance;
};

// The point of a circle with the least distance, `distance_of(point)` of any scalar, whose direction is its gradient.
template <class T, class DistanceOf>
OnCircle<T> nearest_on_circle(const Circle<T>& circle, const DistanceOf& distance_of) {
  const Circle<double> plain = circle.plain();
  const auto slope = [&](const auto& s) { return dot(distance_of(plain.at(s)).direction, plain.tangent(s)); };
  const LeastAngle least =
      circle.radius > 0 ? least_on_turn([&](double s) { return distance_of(plain.at(s)).value; }, slope, circle.radius)
                        : LeastAngle{};
  T s(least.at);
  if (circle.radius > 0 && least.definite)
    s = s - dot(distance_of(circle.at(s)).direction, circle.tangent(s)) * (1 / least.curvature);
  OnCircle<T> found{circle.at(s), {}};
  found.distance = distance_of(found.point);
  found.distance.defined = found.distance.defined && least.definite;
  return found;
}

}  // namespace dynalin::solid
