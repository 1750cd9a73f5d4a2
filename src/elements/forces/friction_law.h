// The law of dry friction on a surface: from the slip velocity u [length/time] and the creep z [length] of bristles
// between the surfaces to the direction s, |s| ≤ 1, and to the coefficient. u and z have a component for each
// direction in which the surface slips.
//
//     |u| < v_s             stiction: z carries the load, and follows u
//     v_s … r v_s           the coefficient goes from MU_STATIC to MU_DYNAMIC by a cubic step
//     beyond                sliding: s = u/|u|
//
// With the cubic step through zero, b(x) = x (3 − x²)/2 for |x| ≤ 1 and ±1 beyond, b of u/v_s and σ of z/z_max,
//
//     s = σ (1 − |b|²) + b |b| + b (1 − |b|) (1 − |σ|²)
//
// This is b without bristles and σ at rest, rises with both, and has a derivative everywhere: at rest the stiffness of
// the bristles and a damping of 3/2 (1 − |σ|²)/v_s. Bristles are elastic up to 0.9 z_max and then yield to creep that
// goes on outwards, so that they never pass z_max:
//
//     z′ = u − a(|z|/z_max) max(u·z, 0) z/|z|²,      a a cubic step from 0 at 0.9 to 1 at 1
//
// The published text says that stiction follows creep and velocity, not how: both formulas are ours.
//
// The LuGre formulation (Canudas de Wit, Olsson, Åström, Lischinsky 1995) in place of all that, times the load:
//
//     z′ = u − σ₀ |u| z/g,      μ s = σ₀ z + σ₁ z′ + σ₂ u,      μ = g = MU_DYNAMIC + (MU_STATIC − MU_DYNAMIC)
//     exp(−|u|²/v_s²)
//
// At rest |u| has a kink: where z is not zero, more load and less load find other stiffnesses. Its derivative is taken
// as zero there, the mean of both.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/dual.h"
#include "base/smooth_step.h"

namespace dynalin {

// Which part of the law acts: static friction fades out where sliding begins, or sliding alone without bristles.
enum class FrictionEffect : std::uint8_t { all, stiction, sliding };

// Up to this part of the largest deformation bristles follow the surfaces.
inline constexpr double elastic_share = 0.9;

enum class FrictionFormulation : std::uint8_t { stick_slip, lugre };

template <class T, std::size_t n>
T squared(const std::array<T, n>& v) {
  T sum(0.0);
  for (const T& x : v) sum += x * x;
  return sum;
}

// The size of what is multiplied with itself further on: at zero nothing of its derivative is left.
template <class T, std::size_t n>
T size_beside_itself(const std::array<T, n>& v) {
  using std::sqrt;
  const T s = squared(v);
  return value_of(s) > 0 ? sqrt(s) : T(0.0);
}

// b(v/limit) in the direction of v.
template <class T, std::size_t n>
std::array<T, n> step_through_zero(std::array<T, n> v, double limit) {
  using std::sqrt;
  const T x2 = squared(v) * (1.0 / (limit * limit));
  const T factor = value_of(x2) < 1.0 ? (3.0 - x2) * 0.5 : 1.0 / sqrt(x2);
  for (T& x : v) x = x * (1.0 / limit) * factor;
  return v;
}

struct FrictionLaw {
  double mu_static = 0.5, mu_dynamic = 0.3;
  double stiction_velocity = 0.1;     // v_s [length/time]
  double transition = 1.5;            // r
  double largest_deformation = 0.01;  // z_max [length]
  FrictionEffect effect = FrictionEffect::all;
  FrictionFormulation formulation = FrictionFormulation::stick_slip;
  double bristle_stiffness = 50, bristle_damping = 0, viscosity = 0;  // σ₀ [1/length], σ₁, σ₂ [time/length]

  bool has_bristles() const { return effect != FrictionEffect::sliding; }
  // As far as bristles bend where nothing slips.
  double largest_creep() const {
    return formulation == FrictionFormulation::lugre ? mu_static / bristle_stiffness : largest_deformation;
  }

  // 0 in stiction, 1 in sliding.
  template <class T>
  T slides(const T& speed) const {
    const double width = (transition - 1.0) * stiction_velocity;
    if (value_of(speed) <= stiction_velocity) return T(0.0);
    if (value_of(speed) >= stiction_velocity + width) return T(1.0);
    return smooth_step(T((speed - stiction_velocity) * (1.0 / width)));
  }

  template <class T>
  T coefficient(const T& speed) const {
    using std::exp;
    if (formulation == FrictionFormulation::lugre)
      return mu_dynamic +
             (mu_static - mu_dynamic) * exp(-(speed * speed) * (1.0 / (stiction_velocity * stiction_velocity)));
    if (effect == FrictionEffect::sliding) return T(mu_dynamic);
    if (effect == FrictionEffect::stiction) return T(mu_static);
    return mu_static + (mu_dynamic - mu_static) * slides(speed);
  }

  template <class T, std::size_t n>
  std::array<T, n> direction(const std::array<T, n>& u, const std::array<T, n>& z) const {
    if (formulation == FrictionFormulation::lugre) {
      const T g = coefficient(size_beside_itself(u));
      std::array<T, n> rate = creep_rate(u, z);
      for (std::size_t k = 0; k < n; ++k)
        rate[k] = (bristle_stiffness * z[k] + bristle_damping * rate[k] + viscosity * u[k]) / g;
      return rate;
    }
    std::array<T, n> s = step_through_zero(u, stiction_velocity);
    if (!has_bristles()) return s;
    const std::array<T, n> sigma = step_through_zero(z, largest_deformation);
    const T b = size_beside_itself(s);
    const T of_b = b + (1.0 - b) * (1.0 - squared(sigma)), of_sigma = 1.0 - b * b;
    for (std::size_t k = 0; k < n; ++k) s[k] = s[k] * of_b + sigma[k] * of_sigma;
    if (effect == FrictionEffect::stiction) {
      const T left = 1.0 - slides(size_beside_itself(u));
      for (T& x : s) x = x * left;
    }
    return s;
  }

  template <class T, std::size_t n>
  std::array<T, n> creep_rate(std::array<T, n> u, const std::array<T, n>& z) const {
    if (formulation == FrictionFormulation::lugre) {
      const T speed = size_beside_itself(u);
      const T back = bristle_stiffness * speed / coefficient(speed);
      for (std::size_t k = 0; k < n; ++k) u[k] -= back * z[k];
      return u;
    }
    T outwards(0.0);
    for (std::size_t k = 0; k < n; ++k) outwards += u[k] * z[k];
    const T size = size_beside_itself(z);
    const T x = size * (1.0 / largest_deformation);
    if (value_of(outwards) <= 0 || value_of(x) <= elastic_share) return u;
    const T yields = value_of(x) < 1.0 ? smooth_step(T((x - elastic_share) * (1.0 / (1.0 - elastic_share)))) : T(1.0);
    const T back = yields * outwards / (size * size);
    for (std::size_t k = 0; k < n; ++k) u[k] -= back * z[k];
    return u;
  }

  bool sticks(double speed) const { return has_bristles() && speed < stiction_velocity; }
};

}  // namespace dynalin
