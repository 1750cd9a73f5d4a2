// An element of a beam by its energies: strains and sections along it as functions of its pose, over numbers or jets.
// Rotations are quaternions; forces are what virtual work along each of its coordinates says, by jets.
#pragma once

#include <array>
#include <vector>

#include "gauss_points.h"
#include "jet.h"
#include "mechanism.h"

namespace dynalin::oracle {

// Forces and moments by length, global axes, at the points of the line.
struct LineLoads {
  std::array<Vec, line_points> force, moment;
};

// A place along a beam: S, position, velocity and acceleration of the line there, and 3-1-3 angles, angular velocity
// and angular acceleration of the section (of beams in space).
struct LinePoint {
  Real place = 0;
  std::array<Vec, 3> motion, turning;
};

// Of r1, s1, r2, s2; x from 0 to 1.
inline std::array<Real, 4> cubics(Real x, Real length) {
  const Real y = 1 - x;
  return {y * y * (1 + 2 * x), length * x * y * y, x * x * (1 + 2 * y), -length * x * x * y};
}

template <class T>
struct BeamPose {
  std::array<Vector3<T>, 2> r, s;                 // places and slopes of the ends
  std::array<std::array<Vector3<T>, 3>, 2> axis;  // of the ends
  Vector3<T> phi;                                 // of the middle
};

// Along an element: strains and axes of sections at the points of strains, axes and places at the points of the line.
template <class T>
struct BeamShape {
  std::array<Vector3<T>, strain_points> stretch, curvature;  // Gamma + e_x, kappa
  std::array<std::array<Vector3<T>, 3>, strain_points> axis;
  std::array<std::array<Vector3<T>, 3>, line_points> line_axis;
  std::array<Vector3<T>, line_points> place;
};

// The coordinates: r1, spin of 1, r2, spin of 2, s1, s2, phi.
inline constexpr std::size_t beam_freedoms = 21;

// What a unit of each coordinate makes of strains, and the spins of sections.
struct BeamDirections {
  struct One {
    std::array<Vec, strain_points> stretch, curvature, spin;
    std::array<Vec, line_points> line_spin, place;
  };
  std::array<One, beam_freedoms> by;
};

class BeamElement {
 public:
  BeamElement() = default;
  // Between nodes k and k + 1.
  BeamElement(const Beam& beam, std::size_t k, Real ucf);

  // What acts on each coordinate: less than elasticity and damping, inertia and weight, for jets along the motion.
  [[nodiscard]] std::array<Real, beam_freedoms> loads(const BeamPose<Jet>& along, const BeamDirections& by,
                                                      const Vec& gravity) const;
  [[nodiscard]] std::array<Real, beam_freedoms> loads(const LineLoads& on, const BeamDirections& by) const;
  [[nodiscard]] BeamDirections directions(const BeamPose<Real>& pose) const;
  [[nodiscard]] Real mass(const BeamPose<Real>& pose, const BeamDirections& by, std::size_t a, std::size_t b) const;
  [[nodiscard]] Real length() const { return length_; }

  template <class T>
  [[nodiscard]] BeamShape<T> shape(const BeamPose<T>& pose) const;

 private:
  [[nodiscard]] Vec spun(std::size_t point, const std::array<Vec, 3>& axes, const Vec& w) const;  // inertia times w

  Real length_ = 1;
  struct StrainPoint {
    Real weight = 0;
    Vec stretch, curvature;                    // undeformed
    Vec stretching;                            // EA, GA/ASY, GA/ASZ
    Real torsion = 0, yy = 0, zz = 0, yz = 0;  // GJ, E times second moments
    std::array<Real, 3> second{};              // density times the integrals of z z, y y, y z
  };
  std::array<StrainPoint, strain_points> strain_{};
  std::array<Real, line_points> line_weight_{}, line_mass_{};
  Real damping_ = 0;
};

}  // namespace dynalin::oracle
