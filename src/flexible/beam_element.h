// One element of a geometrically exact beam: forces, inertia and all their partials.
//
// Two nodes with positions r, axes R and slopes r_s of the line of centroids; an element that bends in space has a
// rotation of its middle besides (flexible/spatial_beam.h), one that stays in a plane has not (flexible/plane_beam.h).
// What deforms it is their matter. The line of its mass, with inertia and weight, is the cubic of places and slopes.
#pragma once

#include <Eigen/Core>
#include <array>

#include "base/partials.h"
#include "base/time_taylor.h"
#include "base/vec3.h"

namespace dynalin {

struct BeamSection {
  double area = 0;                  // [length²]
  double torsion = 0;               // J [length⁴]
  double yy = 0, zz = 0, yz = 0;    // ∫z², ∫y², ∫yz [length⁴]
  double shear_y = 1, shear_z = 1;  // area by the area that carries shear
};

struct BeamMaterial {
  double density = 0;   // dynamical [force·time²/length⁴]
  double E = 0, G = 0;  // [force/length²]
  double damping = 0;   // c [time]
};

// Where an element is along a motion; global axes.
struct BeamMotion {
  using Scalar = TimeTaylor<double>;
  Vec3<Scalar> chord;                  // r₂ − r₁
  std::array<Vector, 2> acceleration;  // of r₁, r₂
  std::array<Mat3<Scalar>, 2> axes;
  std::array<Vec3<Scalar>, 2> slope;
  Vec3<Scalar> middle;  // φ
};

// Coordinates: r₁, θ₁, r₂, θ₂, the slopes of both, φ.
inline constexpr std::size_t beam_coordinates = 21;
using BeamVector = Eigen::Matrix<double, beam_coordinates, 1>;
// θ₁, θ₂ or φ.
constexpr bool is_beam_rotation(std::size_t coordinate) {
  return (coordinate >= 3 && coordinate < 6) || (coordinate >= 9 && coordinate < 12) || coordinate >= 18;
}
using BeamMatrix = Eigen::Matrix<double, beam_coordinates, beam_coordinates>;

struct BeamForces {
  BeamVector elastic, inertia;  // with damping, with weight
  // Partials: of the elastic forces by coordinates and rates, of the inertia by coordinates, rates and accelerations.
  BeamMatrix stiffness, damping, by_position, by_rate, mass;

  void clear(Partials wanted);
};

// Where loads along an element are integrated (flexible/beam_load.h).
inline constexpr std::size_t beam_load_points = 4;

class BeamElement {
 public:
  virtual ~BeamElement() = default;

  double length() const { return length_; }  // undeformed
  double mass() const;
  bool damped() const { return material_.damping > 0; }
  // Of the part that one node stands for, along its axes, about it: half of the mass and of ∫S.
  double nodal_mass(std::size_t node) const;
  Matrix3 nodal_inertia(std::size_t node) const;

  // The first so many of the coordinates are there; what belongs to others is zero.
  virtual std::size_t coordinates() const = 0;
  virtual void forces(const BeamMotion&, const Vector& gravity, Partials wanted, BeamForces&) const = 0;
  // The mass matrix alone.
  virtual BeamMatrix mass_matrix(const BeamMotion&) const;
  // Twice the kinetic energy of velocities by X Y Z, RXX RYY RZZ, RXY RXZ RYZ, global axes.
  virtual std::array<double, 9> kinetic_terms(const BeamMotion&, const BeamVector& velocity) const;
  // How the ends are turned against the middle and that against halfway [rad]: none may come near π.
  virtual double largest_turn(const BeamMotion&) const = 0;

  // Whether sections turn with a coordinate.
  virtual bool turns_sections(std::size_t coordinate) const = 0;
  // Spins of the sections at the load points, by the coordinates, global axes.
  using Spins = std::array<std::array<Vector, beam_coordinates>, beam_load_points>;
  virtual Spins spins(const BeamMotion&) const = 0;
  // The section at one of them along a motion: its axes, global components, and its spins.
  struct SectionMotion {
    Mat3<BeamMotion::Scalar> axes;
    std::array<Vec3<BeamMotion::Scalar>, beam_coordinates> spin;
  };
  virtual SectionMotion section_along(const BeamMotion&, std::size_t load_point) const = 0;
  // How what moments there do to the coordinates changes with these, while the moments keep their global components.
  using Moments = std::array<Vector, beam_load_points>;
  virtual BeamMatrix moments_by_position(const BeamMotion&, const Moments&) const = 0;

 protected:
  BeamElement(const BeamMaterial&, const std::array<BeamSection, 2>&, double length);
  BeamElement(const BeamElement&) = default;
  BeamElement& operator=(const BeamElement&) = default;

  void add_translation(const BeamMotion&, const Vector& gravity, Partials wanted, BeamForces&) const;
  const BeamMaterial& material() const { return material_; }
  // Varies linearly from one node to the other; x from −1 to 1.
  BeamSection section_at(double x) const;

 private:
  BeamMaterial material_;
  std::array<BeamSection, 2> sections_;
  double length_;
  Eigen::Matrix4d mass_;          // of r₁, r_s1, r₂, r_s2
  Eigen::Vector4d first_moment_;  // ∫ρA of each
};

}  // namespace dynalin
