// A curve in space c(u), −1 ≤ u ≤ 1, as the CURVE statement defines it: a B-spline through its points, or one that
// follows its control points; or what a law says, which may run between other parameters.
//
// The points of an open curve lie at equal steps of u. Its knots are k-fold at both ends and the means of k − 1
// neighbouring parameters between, so that a cubic has no knot at its second and its last point but one: cubics with
// equal steps are reproduced, and four points make one cubic. Control points follow uniform knots, k-fold at the ends.
// A closed curve repeats its first point as its last one and continues with all derivatives up to k − 2 across the
// closure; its knots are uniform.
//
// A law is asked for derivatives at one u, of which c(u + s) is a Taylor polynomial: where a formula needs more of them
// than are known, it gets what is not a number. An open one goes on beyond its parameters, which say where it is looked
// for and drawn.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "base/dual.h"
#include "base/time_taylor.h"
#include "base/vec3.h"
#include "expression/curve_law.h"
#include "expression/switch_list.h"

namespace dynalin {

class ParametricCurve {
 public:
  enum class Shape : std::uint8_t { open, closed };
  enum class Data : std::uint8_t { points, control_points };
  using Points = std::vector<Vec3<double>>;

  // At least `order` points, order 4 for cubics; those of a closed curve with the first one again at the end.
  ParametricCurve(const Points&, Shape, Data, int order = 4);
  // `last` > `first`; a closed one is at both at the same point.
  ParametricCurve(std::shared_ptr<const CurveLaw>, Shape, double first, double last);

  Shape shape() const { return shape_; }
  const CurveLaw* law() const { return law_.get(); }  // null where points define it
  // From the first parameter to the last.
  double range() const { return law_ ? breaks_.back() - breaks_.front() : 2.0; }
  // c and its derivatives with respect to u. A closed curve repeats with its range; an open one goes on along its
  // tangent beyond its ends. At a knot the piece to its right counts.
  template <class T>
  Vec3<T> at(const T& u, int derivative = 0) const;
  // The point with axes: x along the tangent towards growing u, y away from the centre of curvature, z = x × y. Where
  // the curve is straight, a radius of 10⁹ times its size included, y and z are NaN.
  template <class T>
  Frame<T> frame(const T& u) const;
  bool straight_at(double u) const;
  // Whether the curve exists at u.
  bool reaches(double u) const { return law_ || shape_ == Shape::closed || std::abs(u) <= 1 + end_tolerance; }
  // Whether pieces of a polygon meet at u in a corner.
  bool corner_at(double u) const;
  // Where that derivative of the curve has a kink or a jump along u, and where the curve ends.
  void switches(double u, int derivative, SwitchList&) const;
  // u − v, by way of the closure where that is shorter.
  double difference(double u, double v) const;

  // The parameter of the point next to p.
  double nearest(const Vec3<double>& p) const;
  // Parameters spread over the curve, a few for each piece but no more than `most`.
  std::vector<double> samples(std::size_t most) const;
  // The least length that a unit of u moves the point, cusps left out. [length]
  double least_speed() const { return least_speed_; }

 private:
  static constexpr double end_tolerance = 1e-9;  // an end met but for rounding belongs to the curve
  using Knots = std::vector<double>;

  void measure_speed();
  template <class T>
  Vec3<T> at_law(const T& u, int derivative) const;
  void take_open(const Points&, Data);
  void take_closed(const Points&, Data);
  void add_piece(const Knots&, const Points& controls, std::size_t span);
  std::size_t piece(double u) const;

  Shape shape_;
  std::size_t order_;
  std::vector<double> breaks_;             // between the pieces, ends included
  std::vector<Vec3<double>> coefficient_;  // order_ for each piece, of powers of u − (middle of the piece)
  std::shared_ptr<const CurveLaw> law_;    // else null; breaks_ divide its range evenly
  double least_speed_ = 0;
};

namespace detail {

inline bool all_zero(double x) { return x == 0.0; }
inline double unknown_unless_zero(double x) { return x == 0.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN(); }
template <std::size_t N, class T>
bool all_zero(const Dual<N, T>& x) {
  for (const T& p : x.partial)
    if (!all_zero(p)) return false;
  return all_zero(x.value);
}
template <std::size_t N, class T>
Dual<N, T> unknown_unless_zero(const Dual<N, T>& x) {
  Dual<N, T> y;
  y.value = unknown_unless_zero(x.value);
  for (std::size_t k = 0; k < N; ++k) y.partial[k] = unknown_unless_zero(x.partial[k]);
  return y;
}
template <class T>
bool all_zero(const TimeTaylor<T>& x) {
  return all_zero(x.value) && all_zero(x.rate) && all_zero(x.acceleration);
}
template <class T>
TimeTaylor<T> unknown_unless_zero(const TimeTaylor<T>& x) {
  return {unknown_unless_zero(x.value), unknown_unless_zero(x.rate), unknown_unless_zero(x.acceleration)};
}

}  // namespace detail

// c⁽ᵈ⁾(u + s) = Σ c⁽ᵈ⁺ʲ⁾ sʲ/j!, where s has no value: a power of it is zero in all that T carries but for a few j.
template <class T>
Vec3<T> ParametricCurve::at_law(const T& u, int derivative) const {
  const double x = value_of(u), first = breaks_.front();
  const double turns = shape_ == Shape::closed ? range() * std::floor((x - first) / range()) : 0.0;
  const T s = u - T(x);
  T power(1.0);
  Vec3<T> sum{T(0.0), T(0.0), T(0.0)};
  constexpr int most_powers = 6;
  for (int j = 0; j < most_powers && !detail::all_zero(power); ++j) {
    const int order = derivative + j;
    const Vec3<double> c = order <= CurveLaw::highest_order
                               ? law_->derivative(x - turns, order)
                               : Vec3<double>{1, 1, 1} * std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] = sum[k] + (std::isfinite(c[k]) ? power * c[k] : detail::unknown_unless_zero(power));
    power = power * s * (1.0 / (j + 1));
  }
  return sum;
}

template <class T>
Vec3<T> ParametricCurve::at(const T& u, int derivative) const {
  if (law_) return at_law(u, derivative);
  const double x = value_of(u);
  if (!reaches(x)) {
    const double end = std::copysign(1.0, x);
    const Vec3<double> p = at(end), slope = at(end, 1);
    const T s = u - T(end);
    const auto along = [&](double value, double rate) {
      return derivative == 0 ? T(value) + s * rate : T(derivative == 1 ? rate : 0.0);
    };
    return {along(p.x, slope.x), along(p.y, slope.y), along(p.z, slope.z)};
  }
  const double turns = shape_ == Shape::closed ? 2 * std::floor((x - breaks_.front()) / 2) : 0.0;
  const std::size_t k = piece(x - turns);
  const T s = u - T(turns + 0.5 * (breaks_[k] + breaks_[k + 1]));
  Vec3<T> sum{T(0.0), T(0.0), T(0.0)};
  const auto lowest = static_cast<std::size_t>(derivative);
  for (std::size_t j = order_; j-- > lowest;) {
    double factor = 1;
    for (std::size_t i = 0; i < lowest; ++i) factor *= static_cast<double>(j - i);
    const Vec3<double> c = coefficient_[k * order_ + j] * factor;
    sum = {sum.x * s + c.x, sum.y * s + c.y, sum.z * s + c.z};
  }
  return sum;
}

template <class T>
Frame<T> ParametricCurve::frame(const T& u) const {
  const Vec3<T> tangent = at(u, 1);
  const Vec3<T> x = tangent / norm(tangent);
  if (straight_at(value_of(u))) {
    const T none(std::numeric_limits<double>::quiet_NaN());
    const Vec3<T> unknown{none, none, none};
    return {at(u), {x, unknown, unknown}};
  }
  const Vec3<T> across = cross(at(u, 2), tangent);
  const Vec3<T> z = across / norm(across);
  return {at(u), {x, cross(z, x), z}};
}

}  // namespace dynalin
