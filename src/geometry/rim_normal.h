// Two rims: the direction n in which the second separates from the first most, or overlaps it least, among those
// nearby. Out of the second and with the centres c, radii r and unit axes a of both,
//
//     h(n) = n·(c₁ − c₂) − r₁ |a₁ × n| − r₂ |a₂ × n|,      ∇h: from the point of the second to that of the first
//
// is largest where both points lie along n. It has a kink where n is an axis; one that is as large as it gets is the
// normal of an end, and no pair of rims.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/least_on_circle.h"

namespace dynalin::solid {

class RimPair {
 public:
  RimPair(const Circle<double>& first, const Circle<double>& second) : first_(first), second_(second) {}

  // Uphill from a direction. Nothing where the way ends at an axis, or on no place at all.
  std::optional<Vector> uphill(Vector n) const {
    double h = separation(n), last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 100; ++k) {
      if (leads_to_axis(first_, second_, -n, h) || leads_to_axis(second_, first_, n, h)) return std::nullopt;
      const Vector u = std::abs(n.x) < 0.6 ? cross(n, unit_vectors[0]) : cross(n, unit_vectors[1]);
      const Vector t1 = u / norm(u), t2 = cross(n, t1);
      const Vector gradient = first_.farthest(-n) - second_.farthest(n);
      const std::array<double, 2> g{dot(t1, gradient), dot(t2, gradient)};
      const Step s = step(g, curvature(n, h, t1, t2));
      const double size = std::hypot(s.along[0], s.along[1]);
      if (s.concave && (size == 0 || (size < settled && size >= 0.5 * last))) return n;
      last = size;
      double factor = std::min(1.0, longest / std::max(size, 1e-300));
      bool moved = false;
      for (int halving = 0; halving < 50 && !moved; ++halving, factor *= 0.5) {
        const Vector to = n + factor * (s.along[0] * t1 + s.along[1] * t2), m = to / norm(to);
        const double there = separation(m);
        // Where the height says no more, Newton's steps end it.
        if (there > h || (s.concave && size < 1e-5)) n = m, h = there, moved = true;
      }
      if (!moved) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  static constexpr double longest = 0.5, settled = 1e-9;  // steps, in radians

  // A circle with what is used of it over and over.
  struct Rim {
    Vector centre, axis;
    double radius;

    explicit Rim(const Circle<double>& c) : centre(c.centre), axis(cross(c.first, c.second)), radius(c.radius) {}
    double reach(const Vector& n) const { return dot(n, centre) + radius * norm(cross(axis, n)); }
    Vector farthest(const Vector& n) const {
      const Vector outward = n - dot(axis, n) * axis;
      const double size = norm(outward);
      return size > 0 ? centre + (radius / size) * outward : centre;
    }
  };
  // −∇∇h across n.
  struct Curvature {
    double c11, c12, c22;
  };
  struct Step {
    std::array<double, 2> along;
    bool concave;
  };

  double separation(const Vector& n) const { return -first_.reach(-n) - second_.reach(n); }

  // Whether it is uphill all the way to the axis of `rim` that n is next to. There, with the farthest point of the
  // other one inside of the rim by i, each way away from the axis goes down by i or more, and h being concave as a
  // function of all of space so it stays; on the sphere h gains no more than |h| times the sine of the angle.
  static bool leads_to_axis(const Rim& rim, const Rim& other, const Vector& n, double h) {
    if (!(h < 0)) return false;
    const double along = dot(rim.axis, n);
    const Vector axis = along < 0 ? -rim.axis : rim.axis;
    const Vector from = other.farthest(-axis) - rim.centre;
    const double inside = rim.radius - norm(from - dot(axis, from) * axis);
    return inside > 0 && -h * norm(cross(axis, n)) < inside;
  }
  Curvature curvature(const Vector& n, double h, const Vector& t1, const Vector& t2) const {
    Curvature c{h, 0, h};
    for (const Rim* rim : {&first_, &second_}) {
      const Vector along = cross(rim->axis, n);  // the rim where it is farthest
      const double sine = norm(along), x = dot(t1, along), y = dot(t2, along);
      if (!(sine > 0)) continue;
      const double share = rim->radius / (sine * sine * sine);
      c.c11 += share * x * x, c.c12 += share * x * y, c.c22 += share * y * y;
    }
    return c;
  }
  // Newton's where h is concave; where it is not, it goes uphill along both principal directions.
  static Step step(const std::array<double, 2>& g, const Curvature& c) {
    const double det = c.c11 * c.c22 - c.c12 * c.c12;
    if (c.c11 > 0 && det > 0) return {{(c.c22 * g[0] - c.c12 * g[1]) / det, (c.c11 * g[1] - c.c12 * g[0]) / det}, true};
    const double mean = 0.5 * (c.c11 + c.c22), half = 0.5 * (c.c11 - c.c22), apart = std::hypot(half, c.c12);
    const double turn = 0.5 * std::atan2(c.c12, half), x = std::cos(turn), y = std::sin(turn);
    const double high = std::abs(mean + apart), low = std::abs(mean - apart), least = 1e-6 * std::max(high, low);
    const double a = (g[0] * x + g[1] * y) / std::max({high, least, 1e-300});
    const double b = (g[1] * x - g[0] * y) / std::max({low, least, 1e-300});
    return {{a * x - b * y, a * y + b * x}, false};
  }

  Rim first_, second_;
};

}  // namespace dynalin::solid
