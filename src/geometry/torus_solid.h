// A torus as contacts by volume see it: what is nearer than the radius of its tube to the circle that the tube follows.
// It is not convex: a straight line may be in it twice.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/solid.h"

namespace dynalin {

class TorusSolid {
 public:
  explicit TorusSolid(const solid::Torus& t) : major_(t.major), minor_(t.minor) {}

  double major() const { return major_; }
  double minor() const { return minor_; }
  double size() const { return 2 * (major_ + minor_); }
  Vector centre() const { return {major_, 0, 0}; }  // a place in it

  // Of the surface: negative inside. Its slope there is as large everywhere.
  template <class T>
  T value(const Vec3<T>& p) const {
    using std::sqrt;
    const T beyond = sqrt(p.x * p.x + p.y * p.y) - major_;
    return beyond * beyond + p.z * p.z - minor_ * minor_;
  }
  Vector gradient(const Vector& p) const {
    const double radius = std::max(std::hypot(p.x, p.y), std::numeric_limits<double>::min());
    const double by = 2 * (radius - major_) / radius;
    return {by * p.x, by * p.y, 2 * p.z};
  }
  bool holds(const Vector& p) const { return value(p) < 0; }
  // Of its surface, the farthest in a direction.
  Vector farthest(const Vector& way) const;

 private:
  double major_, minor_;
};

// Where a straight line from a to b goes through the surface, one place after the other.
struct LineThroughTorus {
  bool first_inside = false, last_inside = false;
  std::size_t count = 0;
  std::array<Vector, 4> at;
};
LineThroughTorus line_through(const TorusSolid&, const Vector& a, const Vector& b);

// How far a triangle outside of the torus is from it. [length]
double least_apart(const TorusSolid&, const Vector& a, const Vector& b, const Vector& c);
// The same of a point.
inline double apart(const TorusSolid& s, const Vector& p) {
  return std::hypot(std::hypot(p.x, p.y) - s.major(), p.z) - s.minor();
}

}  // namespace dynalin
