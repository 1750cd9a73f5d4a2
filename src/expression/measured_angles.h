// The angles among the measures: between axes, between segments, and body-fixed ones, with what holds of them where
// they have no gradient.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "expression/measured_zero.h"
#include "expression/measures.h"

namespace dynalin::measured {

// Entry (row, column) of the matrix whose columns are the axes of i in the axes of j, counted from 1.
template <class T>
T direction(const MeasureFrames<T>& f, std::size_t row, std::size_t column) {
  return dot(f.j.axes[row - 1], f.i.axes[column - 1]);
}

// The angle of the point (x, y), which are made of unit vectors. At the origin it has no value.
template <class T>
T angle_of_point(const T& y, const T& x) {
  using std::atan2;
  const bool none = std::max(std::fabs(value_of(x)), std::fabs(value_of(y))) <= rounding;
  return none ? unknown<T>() : atan2(y, x);
}

// What is known of an angle by its cosine and the square of its sine, both without a kink.
template <class T>
struct SmoothAngle {
  T cosine, squared_sine;
};

// 0 … π, with a kink at both ends.
template <class T>
T angle_of(const Vec3<T>& sine, const T& cosine, double size) {
  using std::atan2;
  return atan2(magnitude(sine, size), cosine);
}

// Near zero θ² = 4 asin²(√u) is a series in u = sin²(θ/2) = (1 − cos θ)/2, without a kink:
// ½ Σ (4u)^n / (n² binomial(2n, n)).
template <class T>
T squared_angle(const SmoothAngle<T>& a, const T& angle) {
  constexpr int terms = 20;
  constexpr double largest_for_series = 0.1;
  if (value_of(a.cosine) <= 1 - 2 * largest_for_series) return angle * angle;
  const T four_u = 2.0 * (a.squared_sine / (1.0 + a.cosine));
  T sum(0.0);
  double binomial = 2;  // of (2n, n)
  std::array<double, terms> factor{};
  for (int n = 1; n <= terms; ++n) {
    factor[static_cast<std::size_t>(n - 1)] = 2.0 / (n * n * binomial);
    binomial *= 2.0 * (2 * n + 1) / (n + 1);
  }
  for (std::size_t n = terms; n-- > 0;) sum = four_u * (T(factor[n]) + sum);
  return sum;
}

// Between the axes z of i and j.
template <class T>
Vec3<T> sine_of_theta(const MeasureFrames<T>& f) {
  return {direction(f, 1, 3), direction(f, 2, 3), T(0.0)};
}
template <class T>
T theta(const MeasureFrames<T>& f) {
  return angle_of(sine_of_theta(f), direction(f, 3, 3), 1.0);
}
template <class T>
T theta_squared(const MeasureFrames<T>& f) {
  const Vec3<T> s = sine_of_theta(f);
  return squared_angle({direction(f, 3, 3), dot(s, s)}, theta(f));
}

// The sum or difference of the first and the last of three angles: a principal value that has a gradient where each of
// them has none, brought to the turn they are in. It is the angle of a point at `distance` from the origin: where that
// is small the coordinates have cancelled, and there the angles themselves are known well.
template <class T>
T of_both(const T& principal, double distance, const T& first, const T& last) {
  if (distance < 1) return first + last;
  const double turn = 2 * std::numbers::pi, together = value_of(first) + value_of(last);
  return principal + turn * std::round((together - value_of(principal)) / turn);
}

// Body-fixed angles. Where the middle one leaves only the sum of the others determined, or their difference, the first
// holds all of it; both respond to what varies the middle one in no defined way.
template <class T>
struct FirstAndLast {
  T first, last;
};
template <class T>
T principal_psi_with_phi(const MeasureFrames<T>& f, double sign) {
  return angle_of_point(T(direction(f, 2, 1) - sign * direction(f, 1, 2)),
                        T(direction(f, 1, 1) + sign * direction(f, 2, 2)));
}
template <class T>
FirstAndLast<T> psi_and_phi(const MeasureFrames<T>& f) {
  using std::atan2;
  if (const Vec3<T> sine = sine_of_theta(f); largest(sine) <= rounding) {
    const T jump = size_of_zero(sine);
    return {principal_psi_with_phi(f, value_of(direction(f, 3, 3)) > 0 ? 1.0 : -1.0) + jump, jump};
  }
  return {atan2(direction(f, 1, 3), T(-direction(f, 2, 3))), atan2(direction(f, 3, 1), direction(f, 3, 2))};
}
// PSI + sign PHI.
template <class T>
T psi_with_phi(const MeasureFrames<T>& f, double sign) {
  const auto [psi, phi] = psi_and_phi(f);
  return of_both(principal_psi_with_phi(f, sign), 1 + sign * value_of(direction(f, 3, 3)), psi, T(sign * phi));
}
template <class T>
T principal_yaw_with_roll(const MeasureFrames<T>& f, double sign) {
  return angle_of_point(T(-direction(f, 1, 2) - sign * direction(f, 2, 3)),
                        T(direction(f, 2, 2) - sign * direction(f, 1, 3)));
}
template <class T>
Vec3<T> cosine_of_pitch(const MeasureFrames<T>& f) {
  return {direction(f, 1, 1), direction(f, 2, 1), T(0.0)};
}
template <class T>
FirstAndLast<T> yaw_and_roll(const MeasureFrames<T>& f) {
  using std::atan2;
  if (const Vec3<T> cosine = cosine_of_pitch(f); largest(cosine) <= rounding) {
    const T jump = size_of_zero(cosine);
    return {principal_yaw_with_roll(f, value_of(direction(f, 3, 1)) > 0 ? 1.0 : -1.0) + jump, jump};
  }
  return {atan2(direction(f, 2, 1), direction(f, 1, 1)), atan2(direction(f, 3, 2), direction(f, 3, 3))};
}
// YAW + sign ROLL.
template <class T>
T yaw_with_roll(const MeasureFrames<T>& f, double sign) {
  const auto [yaw, roll] = yaw_and_roll(f);
  return of_both(principal_yaw_with_roll(f, sign), 1 + sign * value_of(direction(f, 3, 1)), yaw, T(sign * roll));
}
template <class T>
T pitch(const MeasureFrames<T>& f) {
  using std::atan2;
  return atan2(direction(f, 3, 1), magnitude(cosine_of_pitch(f), 1.0));
}

// Between the segments from j to i and to k. The cross product of two sides of a triangle is that of any two: the
// longest side takes no part, so that i and k may be close to each other and far from j.
template <class T>
struct Segments {
  Vec3<T> a, b, third;
  explicit Segments(const MeasureFrames<T>& f)
      : a(f.i.origin - f.j.origin), b(f.k.origin - f.j.origin), third(f.k.origin - f.i.origin) {
    const double size = rounding * (largest(f.i.origin) + largest(f.j.origin) + largest(f.k.origin));
    if (largest(a) <= size || largest(b) <= size) a = {unknown<T>(), unknown<T>(), unknown<T>()};
  }
  Vec3<T> sine() const {
    if (largest(third) >= std::max(largest(a), largest(b))) return cross(a, b);
    return largest(a) < largest(b) ? cross(a, third) : cross(b, third);
  }
  T angle() const { return angle_of(sine(), dot(a, b), largest(a) * largest(b)); }
  T cosine() const { return dot(a, b) / (norm(a) * norm(b)); }
  T squared_angle() const {
    const Vec3<T> c = sine();
    return measured::squared_angle(SmoothAngle<T>{cosine(), dot(c, c) / (dot(a, a) * dot(b, b))}, angle());
  }
};

}  // namespace dynalin::measured
