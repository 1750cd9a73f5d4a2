// Makes a point of an integration, which is consistent to the errors that are allowed, consistent to rounding:
// positions and velocities move least onto the constraints, and accelerations, reactions, VARIABLEs and forces follow
// from the equations of initial conditions. Which rows are redundant is taken as known, what rounding makes of values
// is not looked at, and nothing is said: where anything is unusual, analysis/initial.h has to be asked.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/augmented_system.h"
#include "simulation/step_factors.h"
#include "system/system.h"

namespace dynalin {

class PointRefinement {
 public:
  // The rows that are not `active` follow from the others, or are nowhere near to be met.
  PointRefinement(const System&, std::vector<bool> active);

  // Nothing where it does not converge at once, where rows that are left out are not met, or where an element is not
  // defined; a model with freedoms that lack mass is left to others.
  std::optional<OperatingPoint> refined(OperatingPoint);

 private:
  bool find_nearest(const OperatingPoint&);  // the factors of least changes
  Eigen::VectorXd least_change(Eigen::VectorXd of_rows);
  bool refine_position(OperatingPoint&);
  bool refine_velocity(OperatingPoint&);
  bool refine_acceleration(OperatingPoint&);
  void evaluate(const OperatingPoint&, std::initializer_list<PartialBy> wanted);
  void spread_over_axes(Eigen::Ref<Eigen::VectorXd> of_coordinates) const;

  const System& system_;
  std::vector<bool> active_;
  bool lacks_mass_;
  AugmentedSystem augmented_;
  ConstraintRows rows_;
  Equations eq_;
  StepFactors nearest_, balance_;
  Eigen::VectorXd missing_, terms_;  // residuals, with the other sign, and what they are added up from
};

}  // namespace dynalin
