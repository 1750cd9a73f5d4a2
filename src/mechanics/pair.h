// What two-marker elements share: the motion of marker I relative to marker J, and how a force on I and
// its reaction on J spread to the two bodies, with all partial derivatives.
//
// Laws know the two markers alone. Variations of their origins and axes, δp_I, δφ_I, δp_J, δφ_J in global axes, are
//
//     δd = R_Jᵀ (δp_I − δp_J + Δ × δφ_J),     δφ = R_Jᵀ (δφ_I − δφ_J)
//
// of the relative pose ξ = (d, φ) in the axes of J, with Δ from J to I. Which coordinates move a marker, and how, is
// said block by block in pair_blocks.h: translation and rotation of its body, modal coordinates where that changes its
// shape.
#pragma once

#include <array>
#include <cstdint>

#include "base/partials.h"
#include "mechanics/equations.h"
#include "mechanics/path.h"

namespace dynalin {

PairMotion pair_motion(const Motion&, const MarkerPlace& I, const MarkerPlace& J);

// Partials of one vector with respect to the variations of the two markers, global axes; columns are components.
struct MarkerPartials {
  Matrix3 origin_I, axes_I, origin_J, axes_J;
};

// What takes the opposite of the force and torque on I: J's body at the origin of I, its body at the origin of J (the
// same for a force along the line between both, but another point that it does its work on), or nothing in the model.
enum class Reaction : std::uint8_t { at_I, at_J, none };
// Which of the two a law gives.
enum class Components : std::uint8_t { force, torque, force_and_torque };

// What cancels in a torque that a law adds up of forces at arms: the sum of their sizes and the longest arm.
struct Levers {
  double force = 0, arm = 0;
};

// The force and torque on I at its origin, global axes.
struct PairForce {
  Vector force, torque;
  MarkerPartials force_on_position, torque_on_position;  // with respect to δp, δφ
  MarkerPartials force_on_velocity, torque_on_velocity;  // with respect to δp′, δφ′
  bool depends_on_velocity = false;
  Reaction reaction = Reaction::at_I;
  Components components = Components::force_and_torque;
  Levers levers;

  bool acts_on_J() const { return reaction != Reaction::none; }
};

// A wrench given in the axes of J as a law of the relative motion.
struct RelativeWrench {
  Vector force, torque;                            // on I, axes of J
  std::array<std::array<double, 6>, 6> on_pose{};  // ∂(force, torque)/∂ξ
  std::array<std::array<double, 6>, 6> on_rate{};  // ∂(force, torque)/∂ξ′
  bool depends_on_rate = false;
  Levers levers;
};
PairForce spread(const PairMotion&, const RelativeWrench&, Partials wanted);
// The same along the axes of J as they are, with all partials.
PairForce along_axes_of_J(const PairMotion&, const RelativeWrench&);

// A force of magnitude F along the line from J to I and its slopes in distance d and rate d′.
struct LineMagnitude {
  double value = 0, on_distance = 0, on_rate = 0;
};
PairForce along_line(const PairMotion&, const LineMagnitude&, Partials wanted);
// Whether I is where J is, to rounding: there the line has no direction.
bool markers_meet(const PairMotion&);
// The same where they meet, of a force that is nothing there: δf = F_d δΔ as for any multiple of Δ. By the rate it
// changes along a line that is not there, and has no partials.
PairForce around_origin(const LineMagnitude&, Partials wanted);
// Of a force that is something there: no value.
PairForce without_direction(Partials wanted);

// Adds force, reaction and partials to the balance of both bodies.
void apply(const PairMotion&, const PairForce&, Equations&, PartialBy velocity_family = PartialBy::damping);
// The partials alone, for forces whose residual is added elsewhere (reactions come from the constraint rows).
void apply_partials(const PairMotion&, const PairForce&, Equations&, PartialBy velocity_family = PartialBy::damping);
// Adds the column of a scalar unknown that scales (force, torque) on I and what takes the opposite.
void apply_column(const PairMotion&, const Vector& force, const Vector& torque, Reaction, PartialBy family,
                  std::int32_t column, Equations&);

// Adds the partials of force and torque on I with respect to the rotation of the axes of any marker.
void apply_turn(const PairMotion&, const MarkerPlace& axes, const Matrix3& force, const Matrix3& torque, Equations&);
// Adds the partials of a force on I of pair `acting` with respect to the coordinates of another pair.
void apply_cross_partials(const PairMotion& acting, const PairMotion& varied, const PairForce&, Equations&,
                          PartialBy velocity_family = PartialBy::damping);

// Adds the partials of row `row` of the equations, given in the axes of J with respect to (d, φ).
void add_partials(std::int32_t row, const PairMotion&, const Vector& on_d, const Vector& on_phi, PartialBy, Equations&);

// Puts the gradient of a position row, given in the axes of J with respect to (d, φ), into the row.
void add_gradient(std::int32_t row, const PairMotion&, const Vec3<Taylor>& on_d, const Vec3<Taylor>& on_phi,
                  ConstraintRows&);

}  // namespace dynalin
