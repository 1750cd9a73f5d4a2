// Integrals over parts of planes, and how they change where another surface cuts along a straight line.
#pragma once

#include <optional>

#include "geometry/facet_overlap.h"

namespace dynalin {

// Over a part of a plane.
struct PlaneMoments {
  double area = 0;
  Vector first{};    // ∫ x dS
  Matrix3 second{};  // ∫ x xᵀ dS
  void add(const Vector& a, const Vector& b, const Vector& c, const Vector& normal) {
    const double s = 0.5 * dot(normal, cross(b - a, c - a));
    const Vector sum = a + b + c;
    area += s;
    first += sum * (s / 3);
    second += (s / 12) * (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum));
  }
  // A strip of it that begins at a place of a line and reaches `height` along a unit vector across that.
  void add_strip(const Vector& at, const Vector& across, double height, double width) {
    const double h = height * width, hh = 0.5 * height * h, hhh = 2.0 / 3 * height * hh;
    area += h;
    first += at * h + across * hh;
    second += h * outer(at, at) + hh * (outer(at, across) + outer(across, at)) + hhh * outer(across, across);
  }
};

// How the part of a plane grows where another one cuts it: the cut moves over it with the velocity of that one, seen
// from it, along the normal of the other by the sine of the angle between both.
struct StraightCut {
  Vector middle, way;  // from the origin of the integrals
  Vector across;       // the normal by the sine
  double length;

  // `moves`: 1 where the other plane moves over this one, −1 where this one moves. Nothing of planes in one, of which
  // either all or nothing is inside.
  static std::optional<StraightCut> of(const Vector& from, const Vector& to, const Vector& normal,
                                       const Vector& other_normal, double moves) {
    constexpr double parallel = 1e-9;  // sine
    const double sine = norm(cross(normal, other_normal));
    if (sine <= parallel) return std::nullopt;
    return StraightCut{0.5 * (from + to), to - from, other_normal * (moves / sine), norm(to - from)};
  }
  void add_to(Overlap::Part& part) const {
    part.area_by_shift += across * length;
    part.area_by_turn += cross(middle, across) * length;
  }
  void add_to(Overlap::FixedPart& part) const {
    add_to(static_cast<Overlap::Part&>(part));
    part.first_by_shift += outer(middle * length, across);
    // Row k: ∫ x_k (x × n) dl.
    const Matrix3 second = length * (outer(middle, middle) + (1.0 / 12) * outer(way, way));
    part.first_by_turn += transpose(Matrix3{cross(second.x, across), cross(second.y, across), cross(second.z, across)});
  }
};

}  // namespace dynalin
