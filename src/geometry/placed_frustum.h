// A frustum where it stands, and how far it and a box reach in a direction.
#pragma once

#include "geometry/ruled_touch.h"

namespace dynalin::solid {

template <class T>
struct PlacedFrustum {
  FrustumFaces faces;
  RelativeFrame<T> at;

  double radius(bool upper) const { return upper ? faces.f.high_radius : faces.f.low_radius; }
  Vec3<T> centre(bool upper) const { return at.p + at.z * (upper ? faces.f.high : faces.f.low); }
  Vec3<T> end_normal(bool upper) const { return upper ? at.z : -at.z; }
  Circle<T> rim(bool upper) const { return {centre(upper), at.x, at.y, radius(upper)}; }
  Ruled<T> mantle() const {
    return {centre(false), at.z, at.x, at.y, -faces.along_radius, faces.along_z, faces.f.low_radius, faces.length};
  }
  double size() const { return faces.length + 2 * std::max(faces.f.low_radius, faces.f.high_radius); }
};

template <class T>
PlacedFrustum<double> plain(const PlacedFrustum<T>& f) {
  return {f.faces, {as<double>(f.at.p), as<double>(f.at.x), as<double>(f.at.y), as<double>(f.at.z)}};
}
template <class T>
PlacedBox<double> plain(const PlacedBox<T>& b) {
  return {b.box, as<double>(b.origin), {as<double>(b.axes[0]), as<double>(b.axes[1]), as<double>(b.axes[2])}};
}

// The point of a circle that is farthest in a direction; its centre where all are as far.
inline Vector farthest(const Circle<double>& c, const Vector& n) {
  const double x = dot(c.first, n), y = dot(c.second, n), size = std::sqrt(x * x + y * y);
  return size > 0 ? c.centre + (c.radius / size) * (x * c.first + y * c.second) : c.centre;
}
inline bool upper_reaches(const PlacedFrustum<double>& f, const Vector& n) {
  const double rise = dot(f.at.z, n) * (f.faces.f.high - f.faces.f.low), wider = f.radius(true) - f.radius(false);
  if (wider == 0) return rise > 0;
  const double x = dot(f.at.x, n), y = dot(f.at.y, n);
  return rise + wider * std::sqrt(x * x + y * y) > 0;
}
inline Vector farthest(const PlacedFrustum<double>& f, const Vector& n) {
  return farthest(f.rim(upper_reaches(f, n)), n);
}
template <class T>
Vec3<T> farthest(const PlacedBox<T>& b, const Vector& n) {
  Vector p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = dot(value_of(b.axes[k]), n) > 0 ? b.box.high[k] : b.box.low[k];
  return b.at(p);
}

}  // namespace dynalin::solid
