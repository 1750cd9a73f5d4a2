// A beam element that bends, twists, stretches and shears in space.
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

#include "flexible/beam_element.h"
#include "flexible/rotation_field.h"

namespace dynalin {

class SpatialBeam final : public BeamElement {
 public:
  // The nodes of the undeformed element, in any common frame; the slopes there are the x axes. Finds its length.
  SpatialBeam(const BeamMaterial&, const std::array<BeamSection, 2>&, const Vector& chord,
              const std::array<Matrix3, 2>& axes);

  std::size_t coordinates() const override { return beam_coordinates; }
  void forces(const BeamMotion&, const Vector& gravity, Partials wanted, BeamForces&) const override;
  BeamMatrix mass_matrix(const BeamMotion&) const override;
  std::array<double, 9> kinetic_terms(const BeamMotion&, const BeamVector& velocity) const override;
  double largest_turn(const BeamMotion&) const override;
  bool turns_sections(std::size_t coordinate) const override;
  Spins spins(const BeamMotion&) const override;
  SectionMotion section_along(const BeamMotion&, std::size_t load_point) const override;
  BeamMatrix moments_by_position(const BeamMotion&, const Moments&) const override;

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

  std::array<Point, point_count> points_{};
};

}  // namespace dynalin
