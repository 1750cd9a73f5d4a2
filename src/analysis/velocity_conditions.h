// What holds of velocities, as linear conditions: constraint rows, and what the dataset states.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/restated.h"
#include "system/system.h"

namespace dynalin {

// coefficients · velocity = value
struct VelocityCondition {
  std::vector<std::int32_t> column;
  std::vector<double> coefficient;
  double value = 0;
  std::string text;  // of what is stated; rows have their own
  Span at;           // of the statement
};

// How far velocities are from a condition, and the size of its terms.
struct Miss {
  double value, size;
};
Miss miss(const VelocityCondition&, const Eigen::VectorXd& velocity);
bool met_to_rounding(const VelocityCondition&, const Eigen::VectorXd& velocity);

// What holds of that which the dataset states: the CM velocity along an axis a is a·(v + ω × c).
std::vector<VelocityCondition> stated_velocities(const System&, const Motion&, const Restated&);

// Constraint rows as conditions that are affine in velocities u: Φ′ = g·u + Φ_t = 0 with Φ_t the rate at rest. Rows on
// velocities need not be affine: Ψ(u₀) + g·(u − u₀) = 0 about velocities u₀.
class AffineRows {
 public:
  // About rest.
  AffineRows(const System&, const OperatingPoint&);
  void linearize_about(Eigen::VectorXd velocity);

  const ConstraintRows& rows() const { return rows_; }
  // What has no value there, nothing where all have one.
  std::string undefined() const;
  // Whether some row on velocities is another one about other velocities, in which all coordinates have a part.
  bool are_curved() const;
  std::vector<VelocityCondition> conditions() const;
  bool are_met(const Eigen::VectorXd& velocity) const;

 private:
  void set(std::int32_t row, VelocityCondition&) const;

  const System& system_;
  OperatingPoint op_;
  ConstraintRows rows_;
  Eigen::VectorXd about_;
};

}  // namespace dynalin
