// Measures that are zero but for rounding: their sizes count as zero, and their gradients are known only where nothing
// varies them.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "base/time_taylor.h"
#include "base/vec3.h"

namespace dynalin::measured {

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

inline bool is_zero(double x, double y, double z) { return x == 0.0 && y == 0.0 && z == 0.0; }

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

inline double size_of_zero(const Vector&) { return 0.0; }
template <std::size_t N, class T>
Dual<N, T> size_of_zero(const Vec3<Dual<N, T>>& v) {
  return undefined_zero({v.x, v.y, v.z});
}

// In units of the last place of what a difference is taken of.
inline constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();

template <class T>
double largest(const Vec3<T>& v) {
  return std::max({std::fabs(value_of(v.x)), std::fabs(value_of(v.y)), std::fabs(value_of(v.z))});
}

// The norm of a difference of vectors of this size.
template <class T>
T magnitude(const Vec3<T>& v, double size) {
  return largest(v) <= rounding * size ? size_of_zero(v) : norm(v);
}

}  // namespace dynalin::measured
