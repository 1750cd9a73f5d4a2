// Bristles in equilibria. Nothing slips there, and so the law of friction says nothing of creep: it follows the
// displacement of the surfaces since the model last moved, from the creep of then, and beyond 0.9 of the largest one
// ever less:
//
//     z = Z(z₀* + δ),   Z = x up to 0.9 z_max,  z_max (1 − 0.1 exp(−(x/z_max − 0.9)/0.1)) beyond,   z₀ = Z(z₀*)
//
// in the direction of z₀* + δ. It is a function of where the surfaces are and not of how a search came there. Of a
// surface that turns, δ is the rotation vector since then times the radius, exact about one axis.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "elements/forces/friction_law.h"
#include "mechanics/path.h"

namespace dynalin {

// Where the surfaces and the bristles were, as the memory of an operating point keeps it.
class FrictionReference {
 public:
  static constexpr std::size_t entries = 13;  // displacement along z, three axes of I seen from J, creep

  static std::array<double, entries> of(const RelativeFrame<double>& I, const std::array<double, 3>& creep) {
    return {I.p.z, I.x.x, I.x.y, I.x.z, I.y.x, I.y.y, I.y.z, I.z.x, I.z.y, I.z.z, creep[0], creep[1], creep[2]};
  }
  explicit FrictionReference(std::span<const double> kept) : kept_(kept.first(entries)) {}

  double displacement() const { return kept_[0]; }
  double creep(std::size_t c) const { return kept_[10 + c]; }
  // Rotation vector from there to `I`, in the axes of J.
  template <class T>
  Vec3<T> rotation(const Vec3<T>& x, const Vec3<T>& y, const Vec3<T>& z) const {
    Vec3<T> twice_sine{T(0.0), T(0.0), T(0.0)};
    T trace(0.0);
    const std::array<const Vec3<T>*, 3> now = {&x, &y, &z};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector before{kept_[1 + 3 * k], kept_[2 + 3 * k], kept_[3 + 3 * k]};
      twice_sine += cross(before, *now[k]), trace += dot(before, *now[k]);
    }
    using std::atan2, std::sqrt;
    const T square = dot(twice_sine, twice_sine) * 0.25;
    if (!(value_of(square) > 1e-16)) return twice_sine * 0.5;
    const T sine = sqrt(square);
    return twice_sine * T(atan2(sine, T((trace - 1.0) * 0.5)) / sine * 0.5);
  }

 private:
  std::span<const double> kept_;
};

// Creep after a displacement of the surfaces.
template <class T, std::size_t n>
std::array<T, n> creep_at_rest(const std::array<double, n>& creep, std::array<T, n> displacement, double largest) {
  constexpr double left = 1 - elastic_share;
  // What would have led to the creep of before.
  const double y = std::sqrt(squared(creep)) / largest;
  const double unbounded = y > elastic_share ? elastic_share - left * std::log(std::max(1 - y, 1e-9) / left) : y;
  for (std::size_t k = 0; k < n; ++k) displacement[k] += y > 0 ? creep[k] * (unbounded / y) : 0.0;
  const T x2 = squared(displacement) * (1 / (largest * largest));
  if (value_of(x2) <= elastic_share * elastic_share) return displacement;
  using std::exp, std::sqrt;
  const T x = sqrt(x2);
  const T share = (1.0 - left * exp((elastic_share - x) * (1 / left))) / x;
  for (T& z : displacement) z *= share;
  return displacement;
}

}  // namespace dynalin
