// Compiled routines of a CONTACT: the normal force and the friction at one place, and what they are told of it.
//
// The derivatives of a routine by its arguments and those of the arguments by the motion make the derivatives of the
// force. Friction is told the speed of slip alone, and gives a force along it: where nothing slips it is that of a
// damper, whose constant is the slope of the routine.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "base/vec3.h"
#include "expression/routine.h"
#include "routine/given_inputs.h"

namespace dynalin {

// One place where shapes overlap, as routines are told of it: each point from the origin of the marker of its shape,
// each normal out of its surface, both along the axes of that marker.
template <class T>
struct ContactPlace {
  Vec3<T> point_I, normal_I, point_J, normal_J;
  T gap, gap_rate;
};

// How they slip there: along the surface, with the angular velocity `spin` about the normal out of J, under the normal
// force N.
template <class T>
struct ContactSlip {
  Vec3<T> normal, velocity;
  T spin, N;
};

// TIME and MODE, which every routine is told.
struct RoutineTime {
  double time, mode;
};

// What two bodies do to each other at a place of contact, on I.
template <class T>
struct ContactFriction {
  Vec3<T> force, torque;
};

namespace detail {

// TIME, MODE and the arguments of a routine of a CONTACT.
template <class T>
class ContactArguments {
 public:
  ContactArguments(const RoutineTime& at, std::initializer_list<Vec3<T>> vectors, std::initializer_list<T> numbers) {
    take(T(at.time)), take(T(at.mode));
    for (const Vec3<T>& v : vectors) take(v.x), take(v.y), take(v.z);
    for (const T& x : numbers) take(x);
  }
  RoutineInputs<double> plain() const {
    static constexpr std::array<std::int32_t, most> order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return {std::span(values_).first(count_), std::span(order).first(count_)};
  }
  std::span<const double> values() const { return std::span(values_).first(count_); }

  // Value `which` of the routine, with the derivatives that T carries.
  T called(const Routine& routine, std::size_t which) const {
    if constexpr (std::is_same_v<T, double>) {
      return routine.value(plain(), which);
    } else {
      const std::span<const double> slopes = routine.partials(plain(), which);
      T out(0.0);
      for (std::size_t k = first_given; k < count_; ++k) {
        for (std::size_t s = 0; s < out.partial.size(); ++s)
          if (with_derivatives_[k].partial[s] != 0) out.partial[s] += slopes[k] * with_derivatives_[k].partial[s];
      }
      out.value = routine.value(plain(), which);
      return out;
    }
  }
  double slope(const Routine& routine, std::size_t which, std::size_t argument) const {
    return routine.partials(plain(), which)[first_given + argument];
  }

 private:
  static constexpr std::size_t most = first_given + given_to_pressure;
  void take(const T& x) { values_[count_] = value_of(x), with_derivatives_[count_++] = x; }
  std::array<double, most> values_{};
  std::array<T, most> with_derivatives_{};
  std::size_t count_ = 0;
};

}  // namespace detail

template <class T>
detail::ContactArguments<T> pressure_arguments(const ContactPlace<T>& p, const RoutineTime& at) {
  return {at, {p.point_I, p.normal_I, p.point_J, p.normal_J}, {p.gap, p.gap_rate}};
}
// No number where the routine gives more than one.
template <class T>
T called_pressure(const Routine& routine, const ContactPlace<T>& place, const RoutineTime& at) {
  const auto arguments = pressure_arguments(place, at);
  const T N = arguments.called(routine, 0);
  const bool one = routine.value(arguments.plain(), 1) == 0 && routine.value(arguments.plain(), 2) == 0;
  return one ? N : T(std::numeric_limits<double>::quiet_NaN());
}
template <class T>
detail::ContactArguments<T> friction_arguments(const ContactPlace<T>& p, const ContactSlip<T>& s,
                                               const RoutineTime& at) {
  using std::sqrt;
  const T square = dot(s.velocity, s.velocity);
  const T speed = value_of(square) > 0 ? T(sqrt(square)) : T(0.0);
  return {at, {p.point_I, p.point_J, Vec3<T>{speed, T(0.0), s.spin}}, {s.N}};
}

template <class T>
ContactFriction<T> called_friction(const Routine& routine, const ContactPlace<T>& place, const ContactSlip<T>& s,
                                   const RoutineTime& at) {
  using std::abs, std::sqrt;
  constexpr std::size_t of_speed = 6;  // among its arguments
  // Below such a part of the normal force friction grows with the speed as it does at rest.
  constexpr double nothing = 1e-8;
  const Vec3<T>& slip = s.velocity;
  const T square = dot(slip, slip);
  const bool slips = value_of(square) > 0;
  const auto arguments = friction_arguments(place, s, at);
  std::array<T, 3> f;
  for (std::size_t k = 0; k < 3; ++k) f[k] = arguments.called(routine, k);
  const Vec3<T> across = cross(s.normal, slip), torque = s.normal * f[2];
  const double along = value_of(f[0]), aside = value_of(f[1]), least = nothing * std::abs(value_of(s.N));
  if constexpr (!std::is_same_v<T, double>) {
    if (std::abs(along) <= least && std::abs(aside) <= least) {
      const double by_speed = arguments.slope(routine, 0, of_speed),
                   across_by_speed = arguments.slope(routine, 1, of_speed);
      return {slip * T(by_speed) + across * T(across_by_speed), torque};
    }
  }
  if (slips) {
    const T speed = sqrt(square);
    return {(slip * f[0] + across * f[1]) / speed, torque};
  }
  // At rest it has no direction.
  const T none(std::abs(along) <= least && std::abs(aside) <= least ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  return {{none, none, none}, torque};
}

}  // namespace dynalin
