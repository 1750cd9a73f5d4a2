// What a joint bears presses its surfaces together: the load is added up of the sizes of forces and moments.
//
// The size of one that is zero has no derivative. It becomes a seed of its own, which the equations hold as constant,
// the mean of all sides; whether it stays so is for the linear model to ask (vanishing_source.h).
//
// Zero is what is no more than rounding: where forces that cancel make a reaction zero, they leave something of it that
// has any sign.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "elements/forces/joint_friction.h"

namespace dynalin {

// What rounding may make of a force and of a moment.
struct ReactionRounding {
  double force = 0, torque = 0;
};

inline constexpr std::size_t most_sizes = 3;  // in the load of any surface

// Sizes of vectors, of duals whose seeds from `first_seed` on are the sizes that are zero.
template <class T, std::size_t first_seed>
class ReactionSizes {
 public:
  struct Vanishing {
    std::array<T, 3> components;
    std::size_t count = 0, seed = 0;
  };

  template <std::size_t n>
  T of(const std::array<T, n>& v, double rounding) {
    const T s = squared(v);
    const double size = std::sqrt(s.value);
    if (size > rounding) return sqrt(s);
    Vanishing& none = vanishing_[count_];
    std::copy(v.begin(), v.end(), none.components.begin());
    none.count = n, none.seed = first_seed + count_++;
    return {size, none.seed};
  }
  T of(const Vec3<T>& v, double rounding) { return of(std::array{v.x, v.y, v.z}, rounding); }
  T of(const T& v, double rounding) { return of(std::array{v}, rounding); }

  std::span<const Vanishing> vanishing() const { return std::span(vanishing_).first(count_); }

 private:
  std::array<Vanishing, most_sizes> vanishing_;
  std::size_t count_ = 0;
};

// The axis of the joint on which friction acts, in the axes of J.
template <class T>
Vec3<T> axis_of(const JointFriction& f, const RelativeFrame<TimeTaylor<T>>& I) {
  if (f.surface == FrictionSurface::yoke_of_I) {
    const auto& a = f.axis == 0 ? I.x : f.axis == 1 ? I.y : I.z;
    return {a.x.value, a.y.value, a.z.value};
  }
  const Vector e = f.surface == FrictionSurface::yoke_of_J ? unit_vectors[f.axis] : unit_vectors[2];
  return {T(e.x), T(e.y), T(e.z)};
}

template <class T>
T overlap(const JointFriction& f, const T& displacement) {
  return f.overlap + f.overlap_growth * (displacement - f.drawn.p.z);
}

// What presses the surfaces together: a force, or where the joint only turns its torque for a coefficient of 1.
template <class T, std::size_t first_seed>
T load(const JointFriction& f, const Vec3<T>& force, const Vec3<T>& torque, const Vec3<T>& axis, const T& displacement,
       const ReactionRounding& rounding, ReactionSizes<T, first_seed>& sizes) {
  T sum(0.0);
  if (f.surface == FrictionSurface::ball) {
    if (f.of_force) sum += f.ball_radius * sizes.of(force, rounding.force);
    return sum;
  }
  const T along = dot(force, axis), about = dot(torque, axis);
  const Vec3<T> across = force - axis * along, bending = torque - axis * about;
  switch (f.surface) {
    case FrictionSurface::slide:
    case FrictionSurface::sleeve:
      if (f.of_force) sum += sizes.of(across, rounding.force);
      if (f.of_bending) sum += sizes.of(bending, rounding.torque) / overlap(f, displacement);
      if (f.of_torsion && f.surface == FrictionSurface::slide)
        sum += sizes.of(about, rounding.torque) * (1.0 / f.reaction_arm);
      break;
    default:
      if (f.of_force)
        sum += f.pin_radius * sizes.of(across, rounding.force) + f.friction_arm * sizes.of(along, rounding.force);
      if (f.of_bending) sum += (f.pin_radius / f.bending_arm) * sizes.of(bending, rounding.torque);
  }
  return sum;
}

}  // namespace dynalin
