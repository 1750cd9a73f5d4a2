// Freedoms without mass in the acceleration initial conditions: the augmented equations do not determine their
// accelerations, and ask for balance instead. Velocities of damped freedoms are unknowns of the same Newton iteration;
// where stiffness alone holds a freedom its pose has to be balanced already.
#pragma once

#include <optional>

#include "analysis/massless.h"

namespace dynalin {

class MasslessBalance {
 public:
  MasslessBalance(const System&, const OperatingPoint&, const std::vector<bool>& active);

  bool any() const { return directions_.count() > 0; }
  // Unknowns beyond those of the augmented equations: velocities of damped freedoms, forces that condensed ones lack.
  Eigen::Index size() const { return limit_ ? limit_->count() : 0; }
  // Looks at the freedoms at this point; from then on residuals and the matrix are bordered. `Equations` must hold all
  // partials, and sizes.
  Result<void> look(const Motion&, const ConstraintRows&, const Equations&);
  ColumnMatrix bordered(const ColumnMatrix&) const;
  // Residuals with what condensed freedoms lack taken out, and the border's own.
  Eigen::VectorXd bordered(Eigen::VectorXd residual) const;
  // The unknowns beyond, and a step of all unknowns added to them.
  Eigen::VectorXd values(const OperatingPoint&) const;
  void update(OperatingPoint&, const Eigen::Ref<const Eigen::VectorXd>& step);
  // The equations must have been evaluated at the point found; `start` are the velocities before.
  Result<void> accept(const std::vector<double>& start, const OperatingPoint& found, const Equations&, Findings&) const;

 private:
  const System& system_;
  const std::vector<bool>& active_;
  MasslessDirections directions_;
  std::optional<MasslessLimit> limit_;
  Eigen::VectorXd lacking_;  // forces on condensed freedoms
};

}  // namespace dynalin
