// Rotations along a beam element between those of its ends and its middle.
//
// With the rotation vectors ψ = log(R₁ᵀR₂) of the ends against each other and φ of the middle,
//
//     R_m = R₁ exp(½ψ) exp(φ),     R(x) = R_m exp(Ψ),     Ψ = N₁(x) log(R_mᵀR₁) + N₂(x) log(R_mᵀR₂)
//
// N₁ and N₂ the parabolas through the ends −1 and 1 that vanish in the middle: an interpolation of relative rotations
// does not know where the element stands (Crisfield, Jelenić 1999), so that turning the whole makes no strain. A
// variation turns the section by the spin w = Σ w_i ξ_i, global axes, with ξ the spins of both ends, global axes, and
// δφ; the left Jacobian J of exp, exp(a + δ) = exp(J(a) δ) exp(a), gives w and its slope.
//
// Everything is written for the value; on duals the spins come with their own variations, on TimeTaylor with rates.
#pragma once

#include <array>
#include <cmath>

#include "base/dual.h"
#include "base/time_taylor.h"
#include "base/vec3.h"

namespace dynalin {

// Functions of x = |a|² that are smooth at a = 0, from their power series: these end by factorials, so that fifteen
// terms are exact to rounding for angles up to π and six below a fifth.
namespace rotation {

template <class T>
T power_series(const T& x, double (*coefficient)(int)) {
  T sum(0.0);
  for (int k = value_of(x) < 0.04 ? 6 : 15; k >= 0; --k) sum = sum * x + coefficient(k);
  return sum;
}
inline double inverse_factorial(int n) {
  double f = 1;
  for (int k = 2; k <= n; ++k) f *= k;
  return 1 / f;
}
inline double sign(int k) { return k % 2 == 0 ? 1 : -1; }
// sin θ/θ, (1 − cos θ)/θ², (θ − sin θ)/θ³ and what the inverse of J needs, θ² = x.
template <class T>
T first(const T& x) {
  return power_series(x, [](int k) { return sign(k) * inverse_factorial(2 * k + 1); });
}
template <class T>
T second(const T& x) {
  return power_series(x, [](int k) { return sign(k) * inverse_factorial(2 * k + 2); });
}
template <class T>
T third(const T& x) {
  return power_series(x, [](int k) { return sign(k) * inverse_factorial(2 * k + 3); });
}
template <class T>
T fourth(const T& x) {
  return power_series(
      x, [](int k) { return sign(k) * (inverse_factorial(2 * k + 3) - 2 * inverse_factorial(2 * k + 4)); });
}

// 1 + f skew(a) + g skew(a)²
template <class T>
Mat3<T> polynomial(const Vec3<T>& a, const T& f, const T& g) {
  const T x = dot(a, a);
  Mat3<T> m = outer(Vec3<T>{a.x * g, a.y * g, a.z * g}, a) + Mat3<T>::diagonal(T(1.0) - g * x);
  return m += skew(Vec3<T>{a.x * f, a.y * f, a.z * f});
}
template <class T>
Mat3<T> exponential(const Vec3<T>& a) {
  const T x = dot(a, a);
  return polynomial(a, first(x), second(x));
}
// J and its inverse.
template <class T>
Mat3<T> jacobian(const Vec3<T>& a) {
  const T x = dot(a, a);
  return polynomial(a, second(x), third(x));
}
template <class T>
Mat3<T> inverse_jacobian(const Vec3<T>& a) {
  const T x = dot(a, a);
  return polynomial(a, T(-0.5), T(0.5 * fourth(x) / second(x)));
}

// The rotation vector, shorter than π.
template <class T>
Vec3<T> logarithm(const Mat3<T>& R) {
  using std::atan2, std::sqrt;
  // Of the unit quaternion (cos ½θ, sin ½θ n), whose scalar does not vanish below π.
  const T scalar = 0.5 * sqrt(1.0 + trace(R));
  const T factor = 0.25 / scalar;
  const Vec3<T> v{(R.y.z - R.z.y) * factor, (R.z.x - R.x.z) * factor, (R.x.y - R.y.x) * factor};
  const T x = dot(v, v);
  T ratio(0.0);  // ½θ/sin ½θ
  if (value_of(x) < 0.06) {
    static constexpr auto coefficients = [] {
      std::array<double, 13> c{1};
      for (std::size_t k = 1; k < c.size(); ++k) {
        const double odd = 2 * static_cast<double>(k) - 1, even = odd + 1;
        c[k] = c[k - 1] * odd * odd / (even * (even + 1));
      }
      return c;
    }();
    for (std::size_t k = coefficients.size(); k-- > 0;) ratio = ratio * x + coefficients[k];
  } else {
    const T sine = sqrt(x);
    ratio = atan2(sine, scalar) / sine;
  }
  ratio = 2.0 * ratio;
  return {v.x * ratio, v.y * ratio, v.z * ratio};
}

}  // namespace rotation

// Variations: the spins of the first and of the second end, three each, global axes, then δφ.
inline constexpr std::size_t rotation_seeds = 9;

// The rotations of one element.
template <class T>
struct RotationField {
  Mat3<T> middle;                                           // R_m
  std::array<Vec3<T>, 2> to_end;                            // log(R_mᵀR_i)
  std::array<Vec3<T>, rotation_seeds> spin;                 // of the middle by each variation
  std::array<std::array<Vec3<T>, rotation_seeds>, 2> turn;  // of to_end

  RotationField(const Mat3<T>& R1, const Mat3<T>& R2, const Vec3<T>& phi) {
    const Vec3<T> apart = rotation::logarithm(transpose_times(R1, R2));
    const Vec3<T> half{0.5 * apart.x, 0.5 * apart.y, 0.5 * apart.z};
    const Mat3<T> before = R1 * rotation::exponential(half);
    middle = before * rotation::exponential(phi);
    // exp(½ψ) turns with the second end by ½ J(½ψ) J(ψ)⁻¹ of its spin seen from the first, and with that by the rest.
    const Mat3<T> share = R1 * (0.5 * (rotation::jacobian(half) * rotation::inverse_jacobian(apart)) * transpose(R1));
    const Mat3<T> by_phi = before * rotation::jacobian(phi);
    for (std::size_t k = 0; k < 3; ++k) {
      spin[3 + k] = share[k];
      spin[k] = -share[k];
      spin[k][k] += T(1.0);
      spin[6 + k] = by_phi[k];
    }
    for (std::size_t end = 0; end < 2; ++end) {
      to_end[end] = rotation::logarithm(transpose_times(middle, end == 0 ? R1 : R2));
      const Mat3<T> inverse = rotation::inverse_jacobian(to_end[end]);
      for (std::size_t i = 0; i < rotation_seeds; ++i) {
        Vec3<T> against = -spin[i];
        if (i / 3 == end) against[i % 3] += T(1.0);
        turn[end][i] = inverse * transpose_times(middle, against);
      }
    }
  }
};

// One section of it, with derivatives along the undeformed length.
template <class T>
struct SectionRotation {
  Mat3<T> R;
  Vec3<T> curvature;  // κ = axial(Rᵀ R′), section axes
  std::array<Vec3<T>, rotation_seeds> spin, spin_slope;

  SectionRotation() = default;
  // x from −1 to 1 along an element of length l.
  SectionRotation(const RotationField<T>& field, double x, double length) {
    const double N1 = 0.5 * x * (x - 1), N2 = 0.5 * x * (x + 1);
    const double slope1 = 2 * (x - 0.5) / length, slope2 = 2 * (x + 0.5) / length;
    const Vec3<T> turned = field.to_end[0] * N1 + field.to_end[1] * N2;
    const Vec3<T> turned_slope = field.to_end[0] * slope1 + field.to_end[1] * slope2;
    R = field.middle * rotation::exponential(turned);
    curvature = rotation::jacobian(-turned) * turned_slope;
    Vec3<Dual<1, T>> along;
    for (std::size_t k = 0; k < 3; ++k) {
      along[k].value = turned[k];
      along[k].partial[0] = turned_slope[k];
    }
    const Mat3<Dual<1, T>> J = rotation::jacobian(along);
    Mat3<T> plain, changing;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t r = 0; r < 3; ++r) plain(r, c) = J(r, c).value, changing(r, c) = J(r, c).partial[0];
    }
    plain = field.middle * plain, changing = field.middle * changing;
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      const Vec3<T> by = field.turn[0][i] * N1 + field.turn[1][i] * N2;
      const Vec3<T> by_slope = field.turn[0][i] * slope1 + field.turn[1][i] * slope2;
      spin[i] = field.spin[i] + plain * by;
      spin_slope[i] = changing * by + plain * by_slope;
    }
  }
};

}  // namespace dynalin
