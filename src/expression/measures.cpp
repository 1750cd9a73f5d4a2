#include "expression/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

namespace dynalin {

namespace {

// Of a value alone nothing is known but the value.
double rate_of(double x) { return detail::missing(x); }
template <std::size_t N, class T>
Dual<N, T> rate_of(const Dual<N, T>& x) {
  return detail::missing(x);
}
template <class T>
TimeTaylor<T> rate_of(const TimeTaylor<T>& x) {
  return dynalin::differentiate(x);
}
template <class T>
Vec3<T> differentiate(const Vec3<T>& v) {
  return {rate_of(v.x), rate_of(v.y), rate_of(v.z)};
}

// ω = ½ Σ a × a′ over the axes a of the frame.
template <class T>
Vec3<T> angular_velocity(const Frame<T>& f) {
  Vec3<T> sum{};
  for (std::size_t c = 0; c < 3; ++c) sum += cross(f.axes[c], differentiate(f.axes[c]));
  return sum * 0.5;
}

template <class T>
T unknown_like(const T& value) {
  return detail::missing(value);
}
template <class T>
TimeTaylor<T> unknown_like(const TimeTaylor<T>& x) {
  const T none = detail::missing(x.value);
  return {none, none, none};
}
template <class T>
T unknown() {
  return unknown_like(T());
}

// Zero with a gradient that is not defined by whatever any of the numbers varies with.
inline double undefined_zero(std::initializer_list<double>) { return 0.0; }
template <std::size_t N, class T>
Dual<N, T> undefined_zero(std::initializer_list<Dual<N, T>> numbers) {
  Dual<N, T> zero(0.0);
  for (std::size_t k = 0; k < N; ++k) {
    const bool varies =
        std::any_of(numbers.begin(), numbers.end(), [&](const auto& x) { return !(value_of(x.partial[k]) == 0.0); });
    if (varies) zero.partial[k] = detail::missing(T());
  }
  return zero;
}

bool is_zero(double x, double y, double z) { return x == 0.0 && y == 0.0 && z == 0.0; }

// The size of what counts as zero. What stays zero has a size with rates, those of a size that begins to grow are
// unknown.
template <class T>
TimeTaylor<T> size_of_zero(const Vec3<TimeTaylor<T>>& v) {
  TimeTaylor<T> m{undefined_zero({v.x.value, v.y.value, v.z.value}), detail::missing(T()), detail::missing(T())};
  if (!is_zero(value_of(v.x.rate), value_of(v.y.rate), value_of(v.z.rate))) return m;
  m.rate = undefined_zero({v.x.value, v.y.value, v.z.value, v.x.rate, v.y.rate, v.z.rate});
  if (!is_zero(value_of(v.x.acceleration), value_of(v.y.acceleration), value_of(v.z.acceleration))) return m;
  m.acceleration = undefined_zero({v.x.value, v.y.value, v.z.value, v.x.rate, v.y.rate, v.z.rate, v.x.acceleration,
                                   v.y.acceleration, v.z.acceleration});
  return m;
}

double size_of_zero(const Vector&) { return 0.0; }
template <std::size_t N, class T>
Dual<N, T> size_of_zero(const Vec3<Dual<N, T>>& v) {
  return undefined_zero({v.x, v.y, v.z});
}

// In units of the last place of what a difference is taken of.
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();

template <class T>
double largest(const Vec3<T>& v) {
  return std::max({std::fabs(value_of(v.x)), std::fabs(value_of(v.y)), std::fabs(value_of(v.z))});
}

// The norm of a difference of vectors of this size.
template <class T>
T magnitude(const Vec3<T>& v, double size) {
  return largest(v) <= rounding * size ? size_of_zero(v) : norm(v);
}

// Displacement of i from j.
template <class T>
Vec3<T> displacement(const MeasureFrames<T>& f) {
  return f.i.origin - f.j.origin;
}
// Its derivative as an observer on l sees it: r′ − ω_l × r.
template <class T>
Vec3<T> velocity(const MeasureFrames<T>& f) {
  const Vec3<T> r = displacement(f);
  return differentiate(r) - cross(angular_velocity(f.l), r);
}
// r″ − α_l × r − 2 ω_l × u − ω_l × (ω_l × r) with u = r′ − ω_l × r, which is u′ − ω_l × u.
template <class T>
Vec3<T> acceleration(const MeasureFrames<T>& f) {
  const Vec3<T> u = velocity(f);
  return differentiate(u) - cross(angular_velocity(f.l), u);
}
template <class T>
Vec3<T> relative_angular_velocity(const MeasureFrames<T>& f) {
  return angular_velocity(f.i) - angular_velocity(f.j);
}
// α_i − α_j − ω_l × (ω_i − ω_j)
template <class T>
Vec3<T> relative_angular_acceleration(const MeasureFrames<T>& f) {
  const Vec3<T> w = relative_angular_velocity(f);
  return differentiate(w) - cross(angular_velocity(f.l), w);
}

template <class T>
double size_of_displacement(const MeasureFrames<T>& f) {
  return largest(f.i.origin) + largest(f.j.origin);
}
template <class T>
double size_of_velocity(const MeasureFrames<T>& f) {
  return largest(differentiate(f.i.origin)) + largest(differentiate(f.j.origin)) +
         largest(angular_velocity(f.l)) * size_of_displacement(f);
}
template <class T>
double size_of_acceleration(const MeasureFrames<T>& f) {
  const Vec3<T> w = angular_velocity(f.l);
  return largest(differentiate(differentiate(f.i.origin))) + largest(differentiate(differentiate(f.j.origin))) +
         2 * largest(w) * size_of_velocity(f) + largest(differentiate(w)) * size_of_displacement(f);
}
template <class T>
double size_of_angular_velocity(const MeasureFrames<T>& f) {
  return largest(angular_velocity(f.i)) + largest(angular_velocity(f.j));
}
template <class T>
double size_of_angular_acceleration(const MeasureFrames<T>& f) {
  return largest(differentiate(angular_velocity(f.i))) + largest(differentiate(angular_velocity(f.j))) +
         largest(angular_velocity(f.l)) * size_of_angular_velocity(f);
}

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
T psi_with_phi(const MeasureFrames<T>& f, double sign) {
  return angle_of_point(T(direction(f, 2, 1) - sign * direction(f, 1, 2)),
                        T(direction(f, 1, 1) + sign * direction(f, 2, 2)));
}
template <class T>
FirstAndLast<T> psi_and_phi(const MeasureFrames<T>& f) {
  using std::atan2;
  if (const Vec3<T> sine = sine_of_theta(f); largest(sine) <= rounding) {
    const T jump = size_of_zero(sine);
    return {psi_with_phi(f, value_of(direction(f, 3, 3)) > 0 ? 1.0 : -1.0) + jump, jump};
  }
  return {atan2(direction(f, 1, 3), T(-direction(f, 2, 3))), atan2(direction(f, 3, 1), direction(f, 3, 2))};
}
template <class T>
T yaw_with_roll(const MeasureFrames<T>& f, double sign) {
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
    return {yaw_with_roll(f, value_of(direction(f, 3, 1)) > 0 ? 1.0 : -1.0) + jump, jump};
  }
  return {atan2(direction(f, 2, 1), direction(f, 1, 1)), atan2(direction(f, 3, 2), direction(f, 3, 3))};
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
    return dynalin::squared_angle(SmoothAngle<T>{cosine(), dot(c, c) / (dot(a, a) * dot(b, b))}, angle());
  }
};

}  // namespace

bool may_jump(Measure m) {
  switch (m) {
    case Measure::PSI:
    case Measure::PHI:
    case Measure::YAW:
    case Measure::ROLL:
    case Measure::PSI_PLUS_PHI:
    case Measure::PSI_MINUS_PHI:
    case Measure::YAW_PLUS_ROLL:
    case Measure::YAW_MINUS_ROLL:
      return true;
    default:
      return false;
  }
}

std::string_view place_without_gradient(Measure m) {
  switch (m) {
    case Measure::DM:
    case Measure::VM:
    case Measure::WM:
    case Measure::ACCM:
    case Measure::WDTM:
      return "where it is 0";
    case Measure::VR:
      return "where the markers coincide";
    case Measure::PSI:
    case Measure::PHI:
      return "where THETA is 0 or π";
    case Measure::YAW:
    case Measure::ROLL:
      return "where PITCH is π/2 or −π/2";
    case Measure::PSI_PLUS_PHI:
      return "where THETA is π";
    case Measure::PSI_MINUS_PHI:
      return "where THETA is 0";
    case Measure::YAW_PLUS_ROLL:
      return "where PITCH is −π/2";
    case Measure::YAW_MINUS_ROLL:
      return "where PITCH is π/2";
    case Measure::PITCH:
      return "where it is π/2 or −π/2";
    case Measure::THETA:
    case Measure::INCANG:
      return "where it is 0 or π";
    case Measure::THETA_SQUARED:
    case Measure::INCANG_SQUARED:
      return "where the angle is π";
    default:
      return {};
  }
}

template <class T>
T evaluate_measure(Measure measure, const MeasureFrames<T>& f) {
  const auto component = [&](const Vec3<T>& v, Measure x) {
    const auto axis = static_cast<std::size_t>(measure) - static_cast<std::size_t>(x);
    return dot(f.k.axes[axis], v);
  };
  // clang-format off
  switch (measure) {
    case Measure::DX: case Measure::DY: case Measure::DZ: return component(displacement(f), Measure::DX);
    case Measure::DM: return magnitude(displacement(f), size_of_displacement(f));
    case Measure::VX: case Measure::VY: case Measure::VZ: return component(velocity(f), Measure::VX);
    case Measure::VM: return magnitude(velocity(f), size_of_velocity(f));
    case Measure::VR: return rate_of(magnitude(displacement(f), size_of_displacement(f)));
    case Measure::WX: case Measure::WY: case Measure::WZ:
      return component(relative_angular_velocity(f), Measure::WX);
    case Measure::WM: return magnitude(relative_angular_velocity(f), size_of_angular_velocity(f));
    case Measure::ACCX: case Measure::ACCY: case Measure::ACCZ: return component(acceleration(f), Measure::ACCX);
    case Measure::ACCM: return magnitude(acceleration(f), size_of_acceleration(f));
    case Measure::WDTX: case Measure::WDTY: case Measure::WDTZ:
      return component(relative_angular_acceleration(f), Measure::WDTX);
    case Measure::WDTM: return magnitude(relative_angular_acceleration(f), size_of_angular_acceleration(f));
    case Measure::AX: return angle_of_point(-direction(f, 2, 3), direction(f, 3, 3));
    case Measure::AY: return angle_of_point(direction(f, 1, 3), direction(f, 3, 3));
    case Measure::AZ: return angle_of_point(direction(f, 2, 1), direction(f, 1, 1));
    case Measure::PSI: return psi_and_phi(f).first;
    case Measure::THETA: return theta(f);
    case Measure::PHI: return psi_and_phi(f).last;
    case Measure::YAW: return yaw_and_roll(f).first;
    case Measure::PITCH: return pitch(f);
    case Measure::ROLL: return yaw_and_roll(f).last;
    case Measure::INCANG: return Segments<T>(f).angle();
    case Measure::INCANG_SQUARED: return Segments<T>(f).squared_angle();
    case Measure::INCANG_COSINE: return Segments<T>(f).cosine();
    case Measure::THETA_SQUARED: return theta_squared(f);
    case Measure::PSI_PLUS_PHI: case Measure::PSI_MINUS_PHI: {
      const double sign = measure == Measure::PSI_PLUS_PHI ? 1.0 : -1.0;
      const auto [psi, phi] = psi_and_phi(f);
      return of_both(psi_with_phi(f, sign), 1 + sign * value_of(direction(f, 3, 3)), psi, T(sign * phi));
    }
    case Measure::YAW_PLUS_ROLL: case Measure::YAW_MINUS_ROLL: {
      const double sign = measure == Measure::YAW_PLUS_ROLL ? 1.0 : -1.0;
      const auto [yaw, roll] = yaw_and_roll(f);
      return of_both(yaw_with_roll(f, sign), 1 + sign * value_of(direction(f, 3, 1)), yaw, T(sign * roll));
    }
    case Measure::UVX_X: case Measure::UVX_Y: case Measure::UVX_Z: case Measure::UVY_X: case Measure::UVY_Y:
    case Measure::UVY_Z: case Measure::UVZ_X: case Measure::UVZ_Y: case Measure::UVZ_Z: {
      const auto n = static_cast<std::size_t>(measure) - static_cast<std::size_t>(Measure::UVX_X);
      return direction(f, n % 3 + 1, n / 3 + 1);
    }
  }
  // clang-format on
  return T(std::numeric_limits<double>::quiet_NaN());
}

template double evaluate_measure(Measure, const MeasureFrames<double>&);
template Dual<6> evaluate_measure(Measure, const MeasureFrames<Dual<6>>&);
template Dual<6, Dual<6>> evaluate_measure(Measure, const MeasureFrames<Dual<6, Dual<6>>>&);
template TimeTaylor<double> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<double>>&);
template TimeTaylor<Dual<6>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<6>>>&);
template TimeTaylor<Dual<12>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<12>>>&);
template TimeTaylor<Dual<18>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<18>>>&);
template TimeTaylor<Dual<6, Dual<6>>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<6, Dual<6>>>>&);

}  // namespace dynalin
