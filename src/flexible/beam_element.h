// One element of a geometrically exact beam: forces, inertia and all their partials.
//
// Two nodes with positions r, axes R and slopes r_s of the line of centroids, and a rotation φ of the middle
// (flexible/rotation_field.h). The strains are those of a geometrically exact beam (Reissner 1981, Simo 1985),
//
//     Γ = Rᵀ r′ − e_x,     κ = axial(Rᵀ R′)     less those of the undeformed element,
//
// of stretch and shear, twist and bending, without restriction to their rotations. Γ is a parabola along the element:
// at the ends it is that of the slopes, in the middle such that r′ = R (e_x + Γ) leads from one node to the other. A
// pure bending has Γ = 0, however far it goes, so that nothing locks; for small strains of a straight element r is the
// cubic of places and slopes, which is that of inertia and weight always. The stresses N = C_Γ (Γ + c Γ̇), M = C_κ (κ +
// c κ̇) are integrated over three Gauss points. An inertia of the section with the second moments S has the moment Σ
// S_ab a_a × a_b″ of its axes a; it works on the spin of the section.
#pragma once

#include <Eigen/Core>
#include <array>

#include "flexible/rotation_field.h"

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
using BeamMatrix = Eigen::Matrix<double, beam_coordinates, beam_coordinates>;

struct BeamForces {
  BeamVector elastic, inertia;  // with damping, with weight
  // Partials: of the elastic forces by coordinates and rates, of the inertia by coordinates, rates and accelerations.
  BeamMatrix stiffness, damping, by_position, by_rate, mass;
};

class BeamElement {
 public:
  // The nodes of the undeformed element, in any common frame; the slopes there are the x axes. Finds its length.
  BeamElement(const BeamMaterial&, const std::array<BeamSection, 2>&, const Vector& chord,
              const std::array<Matrix3, 2>& axes);

  double length() const { return length_; }
  double mass() const;
  bool damped() const { return material_.damping > 0; }
  // Of the part that one node stands for, along its axes, about it: half of the mass and of ∫S.
  double nodal_mass(std::size_t node) const;
  Matrix3 nodal_inertia(std::size_t node) const;

  void forces(const BeamMotion&, const Vector& gravity, bool with_partials, BeamForces&) const;
  // The mass matrix alone.
  BeamMatrix mass_matrix(const BeamMotion&) const;
  // Twice the kinetic energy of velocities by X Y Z, RXX RYY RZZ, RXY RXZ RYZ, global axes.
  std::array<double, 9> kinetic_terms(const BeamMotion&, const BeamVector& velocity) const;
  // How the ends are turned against the middle and that against halfway [rad]: none may come near π.
  static double largest_turn(const BeamMotion&);

 private:
  // One Gauss point of strain and rotational inertia.
  struct Point {
    double x, weight;            // from −1 to 1; along the length
    Vector strain, curvature;    // undeformed Γ + e_x, κ
    Vector stretching;           // EA, GA_y, GA_z
    double torsion, yy, zz, yz;  // G J, E I
    Matrix3 second_moments;      // S [mass·length], section axes
  };
  static constexpr std::size_t point_count = 3;
  using Scalar = BeamMotion::Scalar;
  using Turning = Dual<rotation_seeds>;

  // Γ + e_x and κ at the points along a motion, and what each coordinate makes of them.
  struct Strains {
    std::array<Vec3<Scalar>, point_count> strain, curvature;
    std::array<std::array<Vec3<Scalar>, beam_coordinates>, point_count> of_strain, of_curvature;
  };
  struct Stresses {  // times the weights of the points
    std::array<Vector, point_count> force, moment;
  };

  Strains strains_of(const BeamMotion&, const std::array<SectionRotation<Scalar>, point_count>&) const;
  static Vector stretching(const Point&, const Vector&);
  static Vector bending(const Point&, const Vector&);
  Stresses stresses_of(const Strains&) const;
  void add_stiffness(const Strains&, BeamForces&) const;
  void add_held_stresses(const BeamMotion&, const std::array<SectionRotation<Turning>, point_count>&, const Stresses&,
                         BeamForces&) const;
  void add_spin(const Point&, const SectionRotation<Scalar>&, const SectionRotation<Turning>*, BeamForces&) const;
  void add_translation(const BeamMotion&, const Vector& gravity, bool with_partials, BeamForces&) const;

  BeamMaterial material_;
  std::array<BeamSection, 2> sections_;
  double length_ = 0;
  std::array<Point, point_count> points_{};
  Eigen::Matrix4d mass_;          // of r₁, r_s1, r₂, r_s2
  Eigen::Vector4d first_moment_;  // ∫ρA of each
};

}  // namespace dynalin
