// The linear model as forces: what has to act along the chosen coordinates x to give them a motion,
//
//     Q   = M x″ + C x′ + K x + Z z − P u        x the chosen coordinates, z differential states, u inputs
//     z′  = …,   y = …                           in the same five variations
//
// Free motion is Q = 0. It is the mechanism with every chosen coordinate driven: the rows of the coordinates join the
// constraints, and Q are their multipliers,
//
//     ⎡ F_q″   −Gᵀ  −Xᵀ  F_w … ⎤ (δq″, δλ, Q, δw, δz′) = −(F_q δq + F_q′ δq′ + F_z δz)
//     ⎣ [G; X]   0    0    0   ⎦                          [−(a1 δq′ + a0 δq); x″ − 2 X′ δq′ − X″ δq]
//
// so that M, C and K are those of the coordinates, symmetric where the forces are, whereas the state matrix holds M⁻¹
// of them (second_order.h). A matrix of an element is what is left of the balance when all else is taken away:
// Vᵀ (its own partials) with V the velocities that x′ gives the coordinates of the model; all of them add up to the
// whole. Reactions work nothing in V; of constraints the change of direction of their reactions remains.
#pragma once

#include <memory>

#include "dynalin/physical_matrices.h"
#include "linear/linear_system.h"

namespace dynalin {

// NODAMPIN leaves the damping of forces out of a linear model: as it does, or what forces have all the same.
enum class DampingOfForces : std::uint8_t { as_linearized, whole };

class PhysicalEquations {
 public:
  // Coordinates without mass stay what they are: their rows and columns of M are zero.
  static Result<PhysicalEquations> make(const System&, const Perturbation&,
                                        DampingOfForces = DampingOfForces::as_linearized);

  const PhysicalMatrices& whole() const { return whole_; }
  // Elements that contribute, in the order of the model; the labels are those of the system.
  std::vector<const ElementLabel*> elements() const;
  // What one of them contributes to Q; zero for one that is not among them.
  MotionMap of(const ElementLabel&) const;
  // What the motions make of the unknowns of a family: all coordinates of the layout, their rates (`velocity`) …
  MotionMap of_unknowns(PartialBy family) const { return split(variation(family)); }

 private:
  class Assembly;

  // Of all coordinates and unknowns, by x″, x′, x, z and u.
  struct Variations {
    Eigen::MatrixXd dq, dqdot, dqddot, dlambda, dw, dz, dz_rate;
  };
  const Eigen::MatrixXd& variation(PartialBy) const;
  MotionMap split(const Eigen::MatrixXd& by_all) const;

  PhysicalMatrices whole_;
  Eigen::MatrixXd velocities_;  // V
  bool without_damping_ = false;
  Variations variations_;
  std::shared_ptr<const PerturbedPoint> at_;
};

}  // namespace dynalin
