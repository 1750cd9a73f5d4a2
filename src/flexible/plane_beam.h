// A beam element that bends and stretches in a plane parallel to two global axes, and neither shears nor twists.
//
// Two nodes with places r and slopes s of the line of centroids, whose directions are those of their sections. Along
// the line stand
//
//     v₁ = s₁,     v_m = (3/2) (r₂ − r₁)/l − ¼ (s₁ + s₂),     v₂ = s₂
//
// at the first end, in the middle, at the second end: the slopes of the cubic of places and slopes there. Of each the
// length |v| and the angle are interpolated on their own, by the parabolas of the three, so that
//
//     ε = |v| − 1,     κ = ψ′,  ψ = angle of v_m + N₁ δ₁ + N₂ δ₂,     δ_i the angle from v_m to s_i,
//
// are stretch and bending of the line (less those of the undeformed element). ε knows nothing of bending and ψ nothing
// of stretch, however far they go, so that nothing locks; for small strains of a straight element the line is the
// cubic, which is that of inertia and weight always. Angles against v_m do not know where the element stands. The
// stresses N = EA (ε + c ε̇), M = EI (κ + c κ̇), I the second moment about the normal of the plane, are integrated over
// three Gauss points, which are exact. The element is as long as makes |v_m| = 1 undeformed.
#pragma once

#include "flexible/beam_element.h"

namespace dynalin {

// Global axes: two in the plane, the second a quarter of a turn about the normal from the first.
struct BeamPlane {
  std::size_t first, second, normal;
};

class PlaneBeam final : public BeamElement {
 public:
  // The nodes of the undeformed element in the plane, global axes; the slopes there are the x axes.
  PlaneBeam(const BeamPlane&, const BeamMaterial&, const std::array<BeamSection, 2>&, const Vector& chord,
            const std::array<Matrix3, 2>& axes);

  std::size_t coordinates() const override { return 18; }
  void forces(const BeamMotion&, const Vector& gravity, Partials wanted, BeamForces&) const override;
  double largest_turn(const BeamMotion&) const override;
  bool turns_sections(std::size_t coordinate) const override;
  Spins spins(const BeamMotion&) const override;
  SectionMotion section_along(const BeamMotion&, std::size_t load_point) const override;
  BeamMatrix moments_by_position(const BeamMotion&, const Moments&) const override;

 private:
  // One of v along a motion, in the plane: n = v/|v| and p a quarter of a turn from it.
  struct Direction {
    double size, size_rate, turn_rate;
    Eigen::Vector2d n, p;
    // Partials by v: of the angle, of the rate of the angle by v, and of the angle twice.
    Eigen::Vector2d of_angle() const { return p / size; }
    Eigen::Vector2d of_turn_rate() const { return -(size_rate * p + turn_rate * size * n) / (size * size); }
    Eigen::Matrix2d of_angle_twice() const { return -(n * p.transpose() + p * n.transpose()) / (size * size); }
  };
  using Directions = std::array<Direction, 3>;  // of v₁, v_m, v₂
  // What v of a direction is of r₁, s₁, r₂, s₂.
  using Shares = Eigen::Matrix<double, 3, 4>;
  using Block = std::array<std::array<Eigen::Matrix2d, 3>, 3>;

  Eigen::Vector2d in_plane(const Vector& v) const;
  Directions directions(const BeamMotion&) const;
  // δ₁, 0, δ₂
  static Eigen::Vector3d angles(const Directions&);
  // Forces on the directions, and partials of these by them, become those of the coordinates.
  void add(const std::array<Eigen::Vector2d, 3>& on, BeamVector& out) const;
  void add(const Block& by, BeamMatrix& out) const;

  BeamPlane plane_;
  Shares shares_;
  Eigen::Matrix3d stretching_, bending_;  // ∫EA N Nᵀ, ∫EI N′ N′ᵀ, of |v| and of the angles of v
  Eigen::Vector3d undeformed_;            // angles
  // How far the sections of the ends are turned about x from where y lies in the plane; between them it varies
  // linearly.
  std::array<double, 2> roll_;
};

}  // namespace dynalin
