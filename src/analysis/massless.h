// Freedoms without mass: directions ν of the motion that constraints leave open and along which nothing has inertia,
//
//     Φ_q ν = 0,   v_C(ν) = 0 of every mass,   J ω(ν) = 0 of every inertia.
//
// What has mass there is decided on the statements: a mass or principal inertia of zero, not a small one. In the limit
// of vanishing mass the balance of forces along ν holds without inertia. With the left null vectors Y of the augmented
// matrix it reads Yᵀ R(q, q′, z) = 0, R the residuals; its partials by q′ and q along ν are damping C and stiffness K.
// Directions in which C is regular follow the balance with their velocities, and are of first order. In the null space
// of C the balance determines the positions, if WᵀKZ is regular with the null vectors W and Z of C.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/augmented_system.h"
#include "analysis/initial.h"
#include "analysis/rank_split.h"

namespace dynalin {

struct MasslessDirections {
  Eigen::MatrixXd basis;                 // a column each
  std::vector<std::int32_t> coordinate;  // where the basis is the identity; they name the freedoms
  Eigen::Index count() const { return basis.cols(); }
};

// Whether any body lacks mass or inertia about some axis, whatever holds it.
bool lacks_mass(const System&);
MasslessDirections massless_directions(const System&, const Motion&, const ConstraintRows&,
                                       const std::vector<bool>& active);

struct MasslessLimit {
  MasslessDirections directions;
  Eigen::MatrixXd left;                               // Y, in the order of the augmented equations
  Eigen::MatrixXd right;                              // what accelerations along the directions bring with them
  Eigen::MatrixXd on_positions, on_rates, on_states;  // Yᵀ ∂R
  Eigen::MatrixXd on_positions_size, on_rates_size, on_states_size;  // of the sums that make them
  Eigen::MatrixXd residual_on_rates;                                 // ∂R/∂q′ along the directions
  RankSplit damping;                                                 // of C
  Eigen::MatrixXd stiffness;                                         // K of what C leaves open

  Eigen::Index count() const { return directions.count(); }
  Eigen::Index damped() const { return count() - condensed(); }
  Eigen::Index condensed() const { return damping.right_null.cols(); }
  Eigen::MatrixXd condensed_directions() const { return directions.basis * damping.right_null; }
  Eigen::MatrixXd damped_directions() const;
  // Wᵀ of the condensed equations times rows of balances, and the balances that follow velocities.
  Eigen::MatrixXd condensed_rows(const Eigen::MatrixXd& of) const { return damping.left_null.transpose() * of; }
  Eigen::MatrixXd damped_rows(const Eigen::MatrixXd& of) const;
};

struct MasslessRequest {
  const std::vector<bool>& active;
  const std::vector<bool>& cut;  // algebraic equations that inputs replace; may be empty
  bool without_damping = false;
};
// Empty where everything that moves has mass. `eq` must hold all partials, and sizes.
Result<std::optional<MasslessLimit>> massless_limit(const System&, const Motion&, const ConstraintRows&,
                                                    const Equations& eq, const MasslessRequest&);

// Whether nothing moves at a point but by the residue of a static solution, and no force knows the time: then all
// coefficients of the equations are constant. Velocities along massless directions do not count.
bool at_rest(const System&, const OperatingPoint&, const MasslessDirections&);

// "DX of PART/3, AY of PART/4"
std::string names_of(const System&, const MasslessDirections&, const Eigen::MatrixXd& combinations);

}  // namespace dynalin
