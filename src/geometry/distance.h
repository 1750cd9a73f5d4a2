// The distance of a point from a solid, negative inside, with the direction in which it grows. Cavities are taken face
// by face, for a ball in one may touch several of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "base/dual.h"
#include "geometry/solid.h"

namespace dynalin {

template <class T>
struct Distance {
  T value{};
  Vec3<T> direction{T(0.0), T(0.0), T(1.0)};
  bool defined = true;
  // How far the nearest place is from where a face ends in an edge, and its curvature jumps [length].
  double seam = std::numeric_limits<double>::infinity();
};

namespace solid {

// Of distances from faces, negative inside: whether two of them are the largest, where that is the distance.
template <std::size_t n>
bool is_tied(std::array<double, n> of_faces, double size) {
  std::partial_sort(of_faces.begin(), of_faces.begin() + 2, of_faces.end(), std::greater<>());
  return of_faces[0] <= coincidence * size && of_faces[0] - of_faces[1] <= coincidence * size;
}

template <class T>
Vec3<T> constant(const Vector& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

// From a point, with the direction away from it; without one at the point itself. `size`: of what it is part of.
template <class T>
Distance<T> from_point(const Vec3<T>& p, double size) {
  Distance<T> d;
  if (norm(value_of(p)) <= coincidence * size) {
    d.defined = false;
    return d;
  }
  d.value = norm(p);
  d.direction = p / d.value;
  return d;
}

template <class T>
Distance<T> distance(const Ball& b, const Vec3<T>& p) {
  Distance<T> d = from_point(p, b.radius);
  d.value -= T(b.radius);
  return d;
}

// In the half plane through z and a point: its distance from z, and the direction away from z.
template <class T>
struct Meridional {
  T radius{};
  Vec3<T> outward{T(0.0), T(0.0), T(0.0)};
  bool on_axis = false;

  Meridional(const Vec3<T>& p, double size) {
    using std::sqrt;
    on_axis = std::hypot(value_of(p.x), value_of(p.y)) <= coincidence * size;
    if (on_axis) return;
    radius = sqrt(p.x * p.x + p.y * p.y);
    outward = {p.x / radius, p.y / radius, T(0.0)};
  }
  Vec3<T> direction(const T& along_radius, const T& along_z) const {
    return {outward.x * along_radius, outward.y * along_radius, along_z};
  }
};

// The faces of a frustum: a circle below, one above, and the mantle between them.
struct FrustumFaces {
  double length, along_radius, along_z;  // of the mantle: from the lower rim to the upper one, and as a unit vector
  double size;                           // of the larger end
  Frustum f;

  explicit FrustumFaces(const Frustum& frustum) : f(frustum) {
    const double dr = f.high_radius - f.low_radius, dz = f.high - f.low;
    length = std::hypot(dr, dz), along_radius = dr / length, along_z = dz / length;
    size = std::max(f.low_radius, f.high_radius);
  }
  template <class T>
  Distance<T> below(const Vec3<T>& p) const {
    return {f.low - p.z, {T(0.0), T(0.0), T(-1.0)}};
  }
  template <class T>
  Distance<T> above(const Vec3<T>& p) const {
    return {p.z - f.high, {T(0.0), T(0.0), T(1.0)}};
  }
  template <class T>
  Distance<T> mantle(const Meridional<T>& m, const Vec3<T>& p) const {
    return {(m.radius - f.low_radius) * along_z - (p.z - f.low) * along_radius,
            m.direction(T(along_z), T(-along_radius)), !m.on_axis};
  }
  // From the lower rim along the mantle.
  double along_mantle(double radius, double z) const {
    return (radius - f.low_radius) * along_radius + (z - f.low) * along_z;
  }
  template <class T>
  Distance<T> rim(double rim_radius, double height, const Meridional<T>& m, const Vec3<T>& p) const {
    using std::sqrt;
    if (rim_radius == 0) return from_point(Vec3<T>{p.x, p.y, p.z - height}, size);
    const T dr = m.radius - rim_radius, dz = p.z - height;
    const T away = sqrt(dr * dr + dz * dz);
    return {away, m.direction(dr / away, dz / away), !m.on_axis};
  }
};

template <class T>
Distance<T> distance(const Frustum& f, const Vec3<T>& p) {
  const FrustumFaces faces(f);
  const Meridional<T> m(p, faces.size);
  const double r = value_of(m.radius), z = value_of(p.z);
  const Distance<T> below = faces.below(p), above = faces.above(p), mantle = faces.mantle(m, p);
  const double b = value_of(below.value), a = value_of(above.value), s = value_of(mantle.value);
  if (is_tied(std::array{b, a, s}, faces.size)) return {T(std::max({b, a, s})), {T(0.0), T(0.0), T(1.0)}, false};
  if (b <= 0 && a <= 0 && s <= 0) return s >= a && s >= b ? mantle : a >= b ? above : below;
  const double along = faces.along_mantle(r, z);
  double seam = std::min(std::abs(along), std::abs(along - faces.length));
  if (a > 0) seam = std::min(seam, std::abs(r - f.high_radius));
  if (b > 0) seam = std::min(seam, std::abs(r - f.low_radius));
  const auto with_seam = [&](Distance<T> d) {
    d.seam = seam;
    return d;
  };
  if (a > 0 && r <= f.high_radius) return with_seam(above);
  if (b > 0 && r <= f.low_radius) return with_seam(below);
  if (along <= 0) return with_seam(faces.rim(f.low_radius, f.low, m, p));
  if (along >= faces.length) return with_seam(faces.rim(f.high_radius, f.high, m, p));
  return with_seam(mantle);
}

template <class T>
Distance<T> distance(const Torus& t, const Vec3<T>& p) {
  using std::sqrt;
  const Meridional<T> m(p, t.major);
  const T dr = m.radius - t.major;
  if (std::hypot(value_of(dr), value_of(p.z)) <= coincidence * t.minor)
    return {T(-t.minor), {T(0.0), T(0.0), T(1.0)}, false};
  const T away = sqrt(dr * dr + p.z * p.z);
  return {away - t.minor, m.direction(dr / away, p.z / away), !m.on_axis};
}

// The face of a box across axis `k`, the upper one or the lower one.
template <class T>
Distance<T> face(const Box& b, std::size_t k, bool upper, const Vec3<T>& p) {
  Distance<T> d{upper ? p[k] - b.high[k] : b.low[k] - p[k], {T(0.0), T(0.0), T(0.0)}};
  d.direction[k] = T(upper ? 1.0 : -1.0);
  return d;
}

template <class T>
Distance<T> distance(const Box& b, const Vec3<T>& p) {
  Vec3<T> beyond{T(0.0), T(0.0), T(0.0)};
  std::size_t count = 0, last = 0;
  std::optional<Distance<T>> nearest;
  std::array<double, 6> of_faces;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const bool upper : {false, true}) {
      const Distance<T> d = face(b, k, upper, p);
      of_faces[2 * k + (upper ? 1 : 0)] = value_of(d.value);
      if (value_of(d.value) > 0) beyond[k] = d.value * (upper ? 1.0 : -1.0), last = 2 * k + (upper ? 1 : 0), ++count;
      if (!nearest || d.value > nearest->value) nearest = d;
    }
  }
  const double size = norm(b.high - b.low);
  nearest->defined = !is_tied(of_faces, size);
  if (count == 0 || !nearest->defined) return *nearest;
  Distance<T> d = count == 1 ? face(b, last / 2, last % 2 == 1, p) : from_point(beyond, size);
  const auto outermost = std::max_element(of_faces.begin(), of_faces.end());
  for (auto other = of_faces.begin(); other != of_faces.end(); ++other)
    if (other != outermost) d.seam = std::min(d.seam, std::abs(*other));
  return d;
}

// The nearest point x of the surface: xₖ = aₖ² pₖ / (aₖ² + λ) with Σ (xₖ/aₖ)² = 1, the largest root λ.
template <class T>
Distance<T> distance(const Ellipsoid& e, const Vec3<T>& p) {
  const Vector& a = e.semi_axes;
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (a[k] < a[least]) least = k;
  }
  const double middle = a[least] * a[least];
  const Vector plain = value_of(p);
  // There one of the terms is 1, so that the sum is not less, and Newton's method comes from above: the function is
  // convex and falls.
  double lambda = -middle;
  for (std::size_t k = 0; k < 3; ++k) lambda = std::max(lambda, a[k] * (std::abs(plain[k]) - a[k]));
  const auto terms = [&](double at) {
    std::array<double, 2> f{-1, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const double q = a[k] * plain[k] / (a[k] * a[k] + at);
      if (plain[k] == 0) continue;
      f[0] += q * q, f[1] -= 2 * q * q / (a[k] * a[k] + at);
    }
    return f;
  };
  for (int n = 0; n < 200; ++n) {
    const auto [f, slope] = terms(lambda);
    if (!(slope < 0)) break;
    const double step = -f / slope;
    lambda += step;
    if (!(std::abs(step) > 1e-16 * (middle + std::abs(lambda)))) break;
  }
  if (!(lambda + middle > coincidence * middle)) return {T(-a[least]), {T(0.0), T(0.0), T(1.0)}, false};
  T f(-1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const T q = p[k] * (a[k] / (a[k] * a[k] + lambda));
    f += q * q;
  }
  const T root = lambda - f / terms(lambda)[1];
  Vec3<T> x, n;
  for (std::size_t k = 0; k < 3; ++k) {
    n[k] = p[k] / (a[k] * a[k] + root);
    x[k] = n[k] * (a[k] * a[k]);
  }
  n = n / norm(n);
  return {dot(p - x, n), n};
}

}  // namespace solid
}  // namespace dynalin
