// An ellipsoid, or a cylinder or frustum, as contacts by volume see it: inside of one quadric and, of the latter, of
// two planes across its axis. It is convex, and so are its sections.
#pragma once

#include <cstdint>
#include <limits>

#include "geometry/solid.h"

namespace dynalin {

// What of a solid bounds a line or a section.
enum class SolidFace : std::uint8_t { none, low, high, curved };

class QuadricSolid {
 public:
  explicit QuadricSolid(const solid::Ellipsoid&);
  explicit QuadricSolid(const solid::Frustum&);

  bool has_ends() const { return has_ends_; }
  const Vector& semi_axes() const { return semi_axes_; }  // of an ellipsoid
  const solid::Frustum& frustum() const { return frustum_; }
  double slope() const { return slope_; }                                      // of the mantle: dr/dz
  double radius_at(double z) const { return radius_at_origin_ + slope_ * z; }  // of the mantle
  double height(bool high) const { return high ? frustum_.high : frustum_.low; }
  double radius(bool high) const { return high ? frustum_.high_radius : frustum_.low_radius; }
  double size() const { return size_; }
  Vector centre() const { return {0, 0, has_ends_ ? 0.5 * (frustum_.low + frustum_.high) : 0.0}; }

  // Of the curved surface: negative inside.
  template <class T>
  T value(const Vec3<T>& p) const {
    if (!has_ends_) return p.x * p.x * square_.x + p.y * p.y * square_.y + p.z * p.z * square_.z - 1.0;
    const T r = p.z * slope_ + radius_at_origin_;
    return p.x * p.x + p.y * p.y - r * r;
  }
  Vector gradient(const Vector& p) const {
    return {2 * square_.x * p.x, 2 * square_.y * p.y, 2 * square_.z * p.z - 2 * slope_ * radius_at_origin_};
  }
  // Its part of second order.
  double form(const Vector& a, const Vector& b) const {
    return square_.x * a.x * b.x + square_.y * a.y * b.y + square_.z * a.z * b.z;
  }
  bool between_ends(const Vector& p) const { return !has_ends_ || (p.z > frustum_.low && p.z < frustum_.high); }
  bool holds(const Vector& p) const { return between_ends(p) && value(p) < 0; }
  // Out of it, of any length.
  Vector outwards(SolidFace face, const Vector& p) const {
    return face == SolidFace::curved ? gradient(p) : Vector{0, 0, face == SolidFace::high ? 1.0 : -1.0};
  }
  // Of its surface, the farthest in a direction.
  Vector farthest(const Vector& way) const;

 private:
  bool has_ends_ = false;
  Vector semi_axes_{};
  solid::Frustum frustum_;
  double slope_ = 0, radius_at_origin_ = 0, size_ = 0;
  Vector square_{};
};

// The part of a straight line from a to b between both ends of a solid, and what of that is in it.
struct LineInSolid {
  bool between_ends = false;
  Vector first, last;                                               // of what is between the ends
  SolidFace first_at = SolidFace::none, last_at = SolidFace::none;  // none: there the line itself ends
  bool first_inside = false, last_inside = false;                   // of the curved surface

  bool enters = false;  // the solid: a part of it is inside
  Vector from, to;
  SolidFace from_at = SolidFace::none, to_at = SolidFace::none;

  LineInSolid turned_round() const {
    return {between_ends, last, first, last_at, first_at, last_inside, first_inside, enters, to, from, to_at, from_at};
  }
};
LineInSolid line_in_solid(const QuadricSolid&, const Vector& a, const Vector& b);
// The same of a line between both ends, of which it is known whether its own ends are inside.
void find_inside(const QuadricSolid&, LineInSolid&);

// How far a triangle outside of a solid is from it, at least, and 0 where it touches. [length]
double least_apart(const QuadricSolid&, const Vector& a, const Vector& b, const Vector& c);
// The same of a point; convex, and no steeper than 1.
double apart(const QuadricSolid&, const Vector&);

}  // namespace dynalin
