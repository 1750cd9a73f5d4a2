// The equations of one instant for accelerations, multipliers, algebraic values and state rates. Freedoms without mass
// border them with unknowns of their own.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <span>
#include <vector>

#include "analysis/augmented_system.h"
#include "analysis/massless_balance.h"
#include "system/system.h"

namespace dynalin {

class AccelerationEquations {
 public:
  // Which rows are active is decided by the poses and velocities of the point.
  AccelerationEquations(const System&, const OperatingPoint&);
  AccelerationEquations(const AccelerationEquations&) = delete;
  AccelerationEquations& operator=(const AccelerationEquations&) = delete;

  static constexpr std::initializer_list<PartialBy> unknowns = {PartialBy::acceleration, PartialBy::lambda,
                                                                PartialBy::algebraic, PartialBy::state_rate};
  const AugmentedSystem& augmented() const { return augmented_; }
  const ConstraintRows& rows() const { return rows_; }
  const Equations& equations() const { return equations_; }
  const Partition& partition() const { return partition_; }
  const MasslessBalance& massless() const { return massless_; }

  // What freedoms without mass ask for at a point; nothing where there are none.
  Result<void> look_at_massless(const OperatingPoint&);

  // Minus the residuals at a point, in the order of the augmented matrix, then of the border. What follows speaks of
  // the last point evaluated.
  Eigen::VectorXd evaluate(const OperatingPoint&, std::initializer_list<PartialBy> wanted);
  // Algebraic and differential equations without a finite value or partial keep their unknown as it is; whether any do.
  bool hold_undefined(Eigen::VectorXd& missing);
  // So do those that reactions or accelerations enter.
  bool hold_reactions(Eigen::VectorXd& missing);
  void release();
  // Whether the unknowns enter linearly: accelerations and reactions are all of them, and no force depends on them. The
  // last point must have been evaluated with partials.
  bool linear() const;
  // Partials without a finite value become zero; whether there are any.
  bool clear_undefined() { return !equations_.clear_undefined().empty(); }
  ColumnMatrix matrix() const {
    return massless_.size() > 0 ? massless_.bordered(augmented_matrix()) : augmented_matrix();
  }
  ColumnMatrix augmented_matrix() const;
  // Of each equation at the point of the last evaluation, the sizes of the forces it was added up from; and of its
  // linear terms as well.
  Eigen::VectorXd magnitude() const;
  Eigen::VectorXd terms(const ColumnMatrix&, const OperatingPoint&) const;

  // Adds a step to all unknowns of a point. Forces that condensed freedoms lack are kept here: they enter linearly, so
  // that the next step does not depend on them.
  void move(OperatingPoint&, const Eigen::Ref<const Eigen::VectorXd>& step);
  Eigen::VectorXd values(const OperatingPoint&) const;
  // The same of unknowns that turn with the axes: each three of a body have the largest of them.
  void spread_over_axes(Eigen::VectorXd&) const;

 private:
  bool hold(const std::vector<bool>& equations, Eigen::VectorXd& missing);

  const System& system_;
  AugmentedSystem augmented_;
  ConstraintRows rows_;
  Equations equations_;
  Partition partition_;
  MasslessBalance massless_;  // of the active rows
  std::vector<bool> cut_, held_;
};

}  // namespace dynalin
