// The equations of rest at one point: force balance, constraints, algebraic and differential equations with all
// velocities, accelerations and rates zero, and the scales that make their residuals comparable.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/augmented_system.h"
#include "base/partials.h"
#include "system/system.h"

namespace dynalin {

// What the equations are measured by: forces of the whole model, which far from rest tells what matters, or those of
// each part, which shows a light part beside a heavy one.
enum class Yardstick : bool { model, part };

class StaticEquations {
 public:
  explicit StaticEquations(const System&);

  void evaluate(const OperatingPoint&, Partials wanted);

  const System& system() const { return system_; }
  const AugmentedSystem& augmented() const { return augmented_; }
  const Partition& partition() const { return part_; }
  // In the order of the augmented matrix. Held states and rows that are not active have none.
  const Eigen::VectorXd& residual() const { return residual_; }
  // Sums of the sizes of all that is in an equation, without sign.
  const Eigen::VectorXd& magnitude() const { return magnitude_; }
  // How far off residuals may be because numbers are rounded, ε (Σ |terms| + Σ |J| |x|): stiff elements turn the
  // rounding of positions into forces, through values of functions as well. Of the last evaluation with partials.
  const Eigen::VectorXd& rounding() const { return rounding_; }
  // The part of it that rounding of places and states does not make: what their rounding adds to residuals, in both
  // parts of an element alike, is undone by moving them as little.
  const Eigen::VectorXd& rounding_of_terms() const { return rounding_of_terms_; }
  // How far off coordinates, values and states are because they are rounded.
  const Eigen::VectorXd& rounding_of_unknowns() const { return rounding_of_unknowns_; }
  // Largest residual in units of its rounding.
  double excess() const;

  // Largest unbalanced force, moments by length.
  double imbalance() const;
  // Whether no force is out of balance by more than rounding makes of the one that it makes most of: reactions pass it
  // on to parts that have none of their own. Of the last evaluation with partials.
  bool is_moved_by_rounding_alone() const;
  // The imbalance once forces have the values of their functions, to first order; of the last evaluation with partials.
  double imbalance_of_functions() const;
  // The fastest rate of a state, but for rounding; of the last evaluation with partials.
  double rate_of_states() const;
  // The size of the forces at play: reactions, weights, what is unbalanced.
  double force_scale() const { return force_scale_; }
  // Whether functions have no derivative at the last point that was evaluated with partials.
  bool has_undefined_partials() const { return undefined_; }

  void measure_by(Yardstick);
  Yardstick yardstick() const { return yardstick_; }
  // Sum of squares of residuals in comparable units; forces are measured against `force`, or those of each part against
  // the largest that were seen on it since `measure_by`, less what rounding explains.
  double merit(double force) const;
  double merit(const Eigen::VectorXd& residual, double force) const;
  // The equation that is farthest from being met, in words.
  std::string worst(double force) const;
  std::string equation_text(Eigen::Index row) const;  // "DZ of PART/2", "the value of VARIABLE/3"

  // Units of equations (as in `merit`) and of unknowns (lengths, radians, sizes of forces, values and states), that
  // make them comparable.
  Eigen::VectorXd row_units(double force) const;
  Eigen::VectorXd column_units(const OperatingPoint&) const;

  // Work of the imbalance along a step of the coordinates, and the step's size in the metric that `tangent` holds with.
  double slope(const Eigen::VectorXd& step) const;
  double damping(const Eigen::VectorXd& step) const;

  // Partials of the residual with `hold` times a typical stiffness added to the coordinates, and `hold_states` to the
  // states in units that make rows and columns comparable: rates may be of any size beside the states.
  ColumnMatrix tangent(double hold, double hold_states) const;

  // The metric D, as one for coordinate k: a typical stiffness of the first point that was evaluated with partials.
  double holding(std::int32_t k) const {
    const double s = system_.length() / system_.coordinate_scale(k);
    return (yardstick_ == Yardstick::model ? stiffness_ : own_stiffness_[static_cast<std::size_t>(k)]) * s * s;
  }
  // D in the place of the stiffness, states held: what reactions and values follow from (settled_reactions.h).
  ColumnMatrix holding_matrix() const;

  // From now on evaluations with partials have those by velocities, accelerations and rates as well.
  void look_at_motion() { motion_ = true; }
  // The tangent of a motion on which velocities, accelerations and rates change by multiples of the displacement: the
  // stiffness with these multiples of dampings, masses and the coefficients of rates.
  ColumnMatrix tangent_of_motion(double by_velocity, double by_acceleration, double by_rate, double hold = 0) const;
  // What accelerations add to the equations, in the order of the matrix.
  Eigen::VectorXd inertia(const Eigen::VectorXd& acceleration) const;
  // What velocities and accelerations add to the balance of the coordinates, through functions as well.
  Eigen::VectorXd forces_of_motion(const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration) const;

  // Factors and keeps count of the work so far, about the number of products.
  bool factor(SparseLu&, ColumnMatrix);
  double effort() const { return effort_; }

 private:
  // 1 for a force, 1/length for a moment.
  double force_unit(std::int32_t k) const { return system_.coordinate_scale(k) / system_.length(); }
  double unit(Eigen::Index k, double force) const;
  Partition partition_at_rest() const;
  void measure_stiffness();
  void measure_forces(const OperatingPoint&);
  void measure_rounding(const OperatingPoint&);
  void carry_rounding_of_values();
  void measure_parts();

  bool undefined_ = false, motion_ = false;
  const System& system_;
  AugmentedSystem augmented_;
  std::int32_t coordinates_;
  ConstraintRows rows_;
  Equations eq_;
  Partition part_;
  std::vector<bool> held_;
  Eigen::VectorXd residual_, magnitude_, rounding_, rounding_of_terms_, rounding_of_unknowns_;
  double force_scale_ = 0, stiffness_ = 0, effort_ = 0;
  Yardstick yardstick_ = Yardstick::model;
  Eigen::VectorXd own_scale_;          // by equation, the largest magnitude seen; a body's rows share theirs
  std::vector<double> own_stiffness_;  // by coordinate, as force per length
};

}  // namespace dynalin
