// An element of a beam that stays in a plane, by its energies: strains, angles and places along it as functions of its
// pose in the plane, over numbers or jets. Forces are what virtual work along each of its coordinates says, by jets.
//
// The line is the cubic between places r and slopes s of both ends, of the undeformed length l; v are its slopes at the
// ends and in the middle. Stretch is |v| - 1, along the element the parabola through these three; the direction of the
// line is that of v in the middle and the parabola through the angles from there to the slopes of the ends.
#pragma once

#include <array>

#include "beams.h"
#include "gauss_points.h"
#include "jet.h"
#include "mechanism.h"

namespace dynalin::oracle {

// Which global axes lead along the plane, and which out of it: a, b and the normal are right-handed.
struct PlaneAxes {
  int a = 0, b = 1, normal = 2;
};
[[nodiscard]] PlaneAxes axes_of(BeamPlane plane);
// Along a and b, and 0.
template <class T>
[[nodiscard]] Vector3<T> in_plane(const PlaneAxes& axes, const Vector3<T>& v) {
  return {component(v, axes.a), component(v, axes.b), T(0)};
}

// Places and slopes of the ends, in the plane.
template <class T>
struct PlanePose {
  std::array<Vector3<T>, 2> r, s;
};

template <class T>
struct PlaneShape {
  std::array<T, strain_points> stretch, curvature;  // eps, kappa
  std::array<T, line_points> angle;                 // apart from whole turns
  std::array<Vector3<T>, line_points> place;
};

// The coordinates: r1, s1, r2, s2, along a and b each.
inline constexpr std::size_t plane_freedoms = 8;
using PlaneLoads = std::array<Real, plane_freedoms>;

class PlaneElement {
 public:
  PlaneElement() = default;
  // Between nodes k and k + 1.
  PlaneElement(const Beam& beam, std::size_t k, Real ucf);

  // What acts on each coordinate: less than elasticity and damping, inertia and weight, for jets along the motion.
  [[nodiscard]] PlaneLoads loads(const PlanePose<Jet>& along, const Vec& gravity) const;
  [[nodiscard]] PlaneLoads loads(const PlanePose<Real>& pose, const LineLoads& on) const;
  [[nodiscard]] Real mass(std::size_t a, std::size_t b) const;
  [[nodiscard]] Real length() const { return length_; }
  template <class T>
  [[nodiscard]] PlaneShape<T> shape(const PlanePose<T>& pose) const;

 private:
  // What a unit of each coordinate makes of the shape.
  [[nodiscard]] std::array<PlaneShape<Real>, plane_freedoms> directions(const PlanePose<Real>& pose) const;

  PlaneAxes axes_;
  Real length_ = 1, damping_ = 0;
  struct StrainPoint {
    Real weight = 0, stretching = 0, bending = 0;  // EA, EI
    Real curvature = 0;                            // undeformed
  };
  std::array<StrainPoint, strain_points> strain_{};
  std::array<Real, line_points> line_weight_{}, line_mass_{};
};

}  // namespace dynalin::oracle
