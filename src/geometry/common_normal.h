// Two ellipsoids: the direction n in which the second separates from the first most, or overlaps it least. The gap
// between their supporting planes across n,
//
//     h(n) = n·p − |a Rᵀn| − |b n|,      ∇h = (nearest point of the first) − (nearest point of the second)
//
// is largest where both points lie along n; p and R are centre and axes of the first as seen from the second, a and b
// the semi-axes.
#pragma once

#include <cmath>
#include <optional>

#include "geometry/solid.h"
#include "mechanics/path.h"

namespace dynalin::solid {

template <class T>
struct CommonNormal {
  Vec3<T> normal, on_first, on_second;  // both points on the surfaces, in the axes of the second
};

// How an ellipsoid reaches in a direction n: the farthest point, and how that moves with n.
struct Reach {
  Vector farthest;
  Matrix3 slope;
};
inline bool is_point(const Vector& semi_axes) { return semi_axes.x == 0 && semi_axes.y == 0 && semi_axes.z == 0; }
inline Reach reach(const Vector& semi_axes, const Matrix3& axes, const Vector& n) {
  if (is_point(semi_axes)) return {};
  Matrix3 squared = axes;
  for (std::size_t k = 0; k < 3; ++k) squared[k] = axes[k] * (semi_axes[k] * semi_axes[k]);
  const Matrix3 S = squared * transpose(axes);
  const Vector Sn = S * n;
  const double size = std::sqrt(dot(n, Sn));
  const Vector x = Sn / size;
  return {x, (1 / size) * (S - outer(x, x))};
}

// Newton's method on the sphere of directions from one of them, in double. Nothing where it does not converge: the
// ellipsoids are as deep in each other as they are wide, and no direction is the one. A semi-axis may be zero, and of a
// point all are.
inline std::optional<Vector> common_normal(const Vector& a, const RelativeFrame<double>& first, const Vector& b,
                                           Vector n) {
  const Matrix3 R{first.x, first.y, first.z};
  const auto separation = [&](const Vector& m) {
    return dot(m, first.p) - dot(m, reach(a, R, m).farthest) - dot(m, reach(b, Matrix3::identity(), m).farthest);
  };
  double h = separation(n), last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 200; ++k) {
    const Reach A = reach(a, R, n), B = reach(b, Matrix3::identity(), n);
    const Vector gradient = first.p - A.farthest - B.farthest;
    const Vector u = std::abs(n.x) < 0.6 ? cross(n, unit_vectors[0]) : cross(n, unit_vectors[1]);
    const Vector t1 = u / norm(u), t2 = cross(n, t1);
    const Matrix3 curvature = A.slope + B.slope;  // −∇∇h
    const double c11 = dot(t1, curvature * t1) + h, c12 = dot(t1, curvature * t2), c22 = dot(t2, curvature * t2) + h;
    const double g1 = dot(t1, gradient), g2 = dot(t2, gradient), det = c11 * c22 - c12 * c12;
    double s1 = g1, s2 = g2;
    const bool concave = c11 > 0 && det > 0;
    if (concave) s1 = (c22 * g1 - c12 * g2) / det, s2 = (c11 * g2 - c12 * g1) / det;
    const double size = std::hypot(s1, s2);
    if (concave && (size == 0 || (size < 1e-9 && size >= 0.5 * last))) return n;
    last = size;
    double factor = std::min(1.0, 0.5 / std::max(size, 1e-300));
    bool moved = false;
    for (int halving = 0; halving < 50 && !moved; ++halving, factor *= 0.5) {
      const Vector to = n + factor * (s1 * t1 + s2 * t2);
      const Vector m = to / norm(to);
      const double there = separation(m);
      // Where the height says no more, Newton's steps end it.
      if (there > h || (concave && size < 1e-6)) n = m, h = there, moved = true;
    }
    if (!moved) return std::nullopt;
  }
  return std::nullopt;
}

// The same with what it changes by: one step of Newton's method from the converged direction n.
template <class T>
CommonNormal<T> common_normal_at(const Vector& n, const Vector& a, const RelativeFrame<T>& at, const Vector& b) {
  const RelativeFrame<double> frame{value_of(at.p), value_of(at.x), value_of(at.y), value_of(at.z)};
  const auto points = [&](const Vec3<T>& m) {
    const Vec3<T> in_first{dot(at.x, m) * a.x, dot(at.y, m) * a.y, dot(at.z, m) * a.z};
    const Vec3<T> in_second{m.x * b.x, m.y * b.y, m.z * b.z};
    const T reach_first = norm(in_first);
    const Vec3<T> from_centre = at.x * (in_first.x * a.x) + at.y * (in_first.y * a.y) + at.z * (in_first.z * a.z);
    CommonNormal<T> c;
    c.normal = m;
    c.on_first = at.p - from_centre / reach_first;
    if (!is_point(b)) c.on_second = Vec3<T>{in_second.x * b.x, in_second.y * b.y, in_second.z * b.z} / norm(in_second);
    return c;
  };
  const CommonNormal<T> here = points(Vec3<T>{T(n.x), T(n.y), T(n.z)});
  const Vec3<T> gradient = here.on_first - here.on_second;
  const Matrix3 R{frame.x, frame.y, frame.z};
  const Matrix3 curvature = reach(a, R, n).slope + reach(b, Matrix3::identity(), n).slope;
  const double h = dot(n, value_of(gradient));
  const Vector u = std::abs(n.x) < 0.6 ? cross(n, unit_vectors[0]) : cross(n, unit_vectors[1]);
  const Vector t1 = u / norm(u), t2 = cross(n, t1);
  const double c11 = dot(t1, curvature * t1) + h, c12 = dot(t1, curvature * t2), c22 = dot(t2, curvature * t2) + h;
  const double det = c11 * c22 - c12 * c12;
  const T g1 = dot(t1, gradient), g2 = dot(t2, gradient);
  const T s1 = (g1 * c22 - g2 * c12) * (1 / det), s2 = (g2 * c11 - g1 * c12) * (1 / det);
  const Vec3<T> to{n.x + s1 * t1.x + s2 * t2.x, n.y + s1 * t1.y + s2 * t2.y, n.z + s1 * t1.z + s2 * t2.z};
  return points(to / norm(to));
}

// Along the line of both centres it starts.
template <class T>
std::optional<CommonNormal<T>> common_normal(const Ellipsoid& first, const RelativeFrame<T>& at,
                                             const Ellipsoid& second) {
  const RelativeFrame<double> frame{value_of(at.p), value_of(at.x), value_of(at.y), value_of(at.z)};
  if (norm(frame.p) <= coincidence * norm(first.semi_axes)) return std::nullopt;
  const auto n = common_normal(first.semi_axes, frame, second.semi_axes, frame.p / norm(frame.p));
  if (!n) return std::nullopt;
  return common_normal_at(*n, first.semi_axes, at, second.semi_axes);
}

}  // namespace dynalin::solid
