// Variations of a path, and how formulas are seeded with them.
//
// The motion of a body is varied as r(t) + δr(t), exp(skew(δθ(t))) R(t), global axes. A quantity X(t)
// that depends on the path answers with
//
//     δX = Σ_l X_l δq^(l)           l = 0, 1, 2: δq, δq′, δq″
//
// and X_l is the dual part of X when δq(t) is seeded with e t^l / l!. Level 0 (a constant variation)
// on TimeTaylor<Dual> therefore gives Φ_q, Φ_q′ and Φ_q″ of a position row in one pass. For an axis a(t) of the
// body a rotation seed e at level l gives e × a(t) t^l / l!.
#pragma once

#include <array>

#include "base/dual.h"
#include "base/time_taylor.h"
#include "base/vec3.h"
#include "mechanics/motion.h"

namespace dynalin {

// I seen from J: origin and axes of I in the axes of J, from the origin of J. x_I·y_J reads I.x.y.
template <class T>
struct RelativeFrame {
  Vec3<T> p;
  Vec3<T> x, y, z;
};

inline constexpr std::array<Vector, 3> unit_vectors = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};

namespace path {

// A component without variation.
template <std::size_t N>
TimeTaylor<Dual<N>> constant(const Taylor& x) {
  return {Dual<N>(x.value), Dual<N>(x.rate), Dual<N>(x.acceleration)};
}
template <std::size_t N>
Vec3<TimeTaylor<Dual<N>>> constant(const Vec3<Taylor>& v) {
  return {constant<N>(v.x), constant<N>(v.y), constant<N>(v.z)};
}

// Adds the variation direction(t) t^level/level! to v as partial `seed`.
template <std::size_t N>
void vary(Vec3<TimeTaylor<Dual<N>>>& v, std::size_t seed, std::size_t level, const Vec3<Taylor>& direction) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Taylor& d = direction[k];
    if (level == 0) {
      v[k].value.partial[seed] += d.value;
      v[k].rate.partial[seed] += d.rate;
      v[k].acceleration.partial[seed] += d.acceleration;
    } else if (level == 1) {
      v[k].rate.partial[seed] += d.value;
      v[k].acceleration.partial[seed] += 2.0 * d.rate;
    } else {
      v[k].acceleration.partial[seed] += d.value;
    }
  }
}

// e_axis × v(t)
inline Vec3<Taylor> turned(std::size_t axis, const Vec3<Taylor>& v) {
  const Taylor zero(0.0);
  return axis == 0   ? Vec3<Taylor>{zero, -v.z, v.y}
         : axis == 1 ? Vec3<Taylor>{v.z, zero, -v.x}
                     : Vec3<Taylor>{-v.y, v.x, zero};
}

// The relative frame with seeds 0–2 on its origin and 3–5 on its rotation, both in the axes of J;
// with N = 12 the same again at level 1 in seeds 6–11. Seeds beyond are left to the caller.
template <std::size_t N>
RelativeFrame<TimeTaylor<Dual<N>>> seeded(const RelativeFrame<Taylor>& I) {
  RelativeFrame<TimeTaylor<Dual<N>>> s{constant<N>(I.p), constant<N>(I.x), constant<N>(I.y), constant<N>(I.z)};
  for (std::size_t level = 0; 6 * (level + 1) <= N; ++level) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<Taylor> along{Taylor(unit_vectors[k].x), Taylor(unit_vectors[k].y), Taylor(unit_vectors[k].z)};
      vary(s.p, 6 * level + k, level, along);
      vary(s.x, 6 * level + 3 + k, level, turned(k, I.x));
      vary(s.y, 6 * level + 3 + k, level, turned(k, I.y));
      vary(s.z, 6 * level + 3 + k, level, turned(k, I.z));
    }
  }
  return s;
}

// Two nested first-order variations of a relative pose: the inner one gives the gradient g_i along a unit
// displacement e_i held fixed in the axes of J, the outer one varies the pose at which that gradient is taken.
// For a scalar f on this scalar f.partial[i].partial[k] = ∂g_i/∂ξ_k. It is not the symmetric Hessian.
// Seeds from 6 on are left to the caller.
template <std::size_t N>
using NestedDuals = Dual<N, Dual<N>>;
using NestedDual = NestedDuals<6>;

template <std::size_t N = 6>
RelativeFrame<NestedDuals<N>> nested(const RelativeFrame<Taylor>& I) {
  RelativeFrame<NestedDuals<N>> s;
  for (std::size_t c = 0; c < 3; ++c) {
    s.p[c].value = Dual<N>(I.p[c].value, c);
    s.p[c].partial[c] = Dual<N>(1.0);
  }
  const auto axis = [](const Vec3<Taylor>& a) {
    Vec3<Dual<N>> varied{Dual<N>(a.x.value), Dual<N>(a.y.value), Dual<N>(a.z.value)};
    const Vector plain = value(a);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector turned = cross(unit_vectors[k], plain);
      for (std::size_t c = 0; c < 3; ++c) varied[c].partial[3 + k] = turned[c];
    }
    Vec3<NestedDuals<N>> result;
    for (std::size_t c = 0; c < 3; ++c) result[c].value = varied[c];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<Dual<N>> turned = cross(unit_vectors[i], varied);
      for (std::size_t c = 0; c < 3; ++c) result[c].partial[3 + i] = turned[c];
    }
    return result;
  };
  s.x = axis(I.x), s.y = axis(I.y), s.z = axis(I.z);
  return s;
}

}  // namespace path
}  // namespace dynalin
