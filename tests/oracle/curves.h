// Curves c(u), -1 <= u <= 1, of CURVE statements: splines of order k as polynomials plus truncated powers at the knots.
#pragma once

#include <cmath>
#include <vector>

#include "jet.h"
#include "mechanism.h"
#include "small_algebra.h"

namespace dynalin::oracle {

class CurveShape {
 public:
  CurveShape(const Curve& curve, const NumberMatrix& points);

  // Derivative by u. A closed curve has the period 2; an open one goes on along its tangent.
  template <class T>
  [[nodiscard]] Vector3<T> at(const T& u, int derivative = 0) const;
  // How far the next knot is, or the next end.
  [[nodiscard]] Real clearance(Real u) const;

 private:
  void take_open(const std::vector<Vec>& points, bool controls);
  void take_closed(const std::vector<Vec>& points, bool controls);
  // Coefficients for values at parameters; a closed curve also repeats its derivatives.
  void interpolate(const std::vector<Real>& parameters, const std::vector<Vec>& values);
  [[nodiscard]] Real basis(std::size_t k, Real u, int derivative) const;

  bool closed_ = false;
  std::size_t order_ = 4;
  Real first_ = -1;
  std::vector<Real> knots_;       // inside
  std::vector<Vec> coefficient_;  // of the powers of u - first, then of those of u - knot
};

// n (n - 1) ... of `count` factors.
[[nodiscard]] inline Real falling(std::size_t n, int count) {
  Real product = 1;
  for (int k = 0; k < count; ++k) product *= static_cast<Real>(n) - static_cast<Real>(k);
  return product;
}

template <class T>
Vector3<T> CurveShape::at(const T& u, int derivative) const {
  const Real x = value_of(u);
  const auto constant = [](const Vec& v) { return Vector3<T>{T(v.x), T(v.y), T(v.z)}; };
  if (!closed_ && std::fabs(x) > 1) {
    const Real end = x > 0 ? 1 : -1;
    if (derivative > 1) return constant({});
    const Vector3<T> slope = constant(at<Real>(end, 1));
    return derivative == 1 ? slope : constant(at<Real>(end)) + (u - T(end)) * slope;
  }
  const T s = u - T(closed_ ? first_ + 2 * std::floor((x - first_) / 2) : first_);
  Vector3<T> sum = constant({});
  const auto lowest = static_cast<std::size_t>(derivative);
  for (std::size_t j = order_; j-- > lowest;) sum = s * sum + constant(falling(j, derivative) * coefficient_[j]);
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    const T beyond = s - T(knots_[k] - first_);
    if (value_of(beyond) <= 0) break;
    T power(falling(order_ - 1, derivative));
    for (std::size_t j = lowest; j + 1 < order_; ++j) power = power * beyond;
    sum += power * constant(coefficient_[order_ + k]);
  }
  return sum;
}

}  // namespace dynalin::oracle
