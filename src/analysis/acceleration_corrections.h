// Accelerations and reactions that have been found, corrected by residuals: what is zero by the structure of the model,
// such as the load of a body in free fall, becomes exactly zero, and so does what is zero but for roundings of the
// point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/acceleration_equations.h"
#include "system/sparse_lu.h"

namespace dynalin {

// A step no longer than this, in units of what roundings of the point make of it, corrects nothing.
inline constexpr double rounding_units_of_step = 8;

class AccelerationCorrections {
 public:
  // Makes the corrections. The point and its factored equations are kept by reference.
  AccelerationCorrections(const System&, AccelerationEquations&, const SparseLu&, OperatingPoint&);

  // Whether the equations have a value at the point: the last step may have led to where a function has none.
  bool defined() const { return defined_; }
  // Whether the last correction was no more than what rounds.
  bool settled();
  // Nothing is dropped where a single sample of what roundings of the point do leaves no doubt of any value: then the
  // others, six more residuals, are not asked for.
  void drop_rounding();
  // Of every unknown, what roundings of the point may make of it.
  const Eigen::VectorXd& rounding();

 private:
  Eigen::VectorXd missing(const OperatingPoint& at) { return equations_.evaluate(at, {}); }
  bool far_above_rounding(const std::vector<double>& values, std::int32_t offset) const;

  const System& system_;
  AccelerationEquations& equations_;
  const SparseLu& lu_;
  OperatingPoint& op_;
  bool defined_ = true;
  Eigen::VectorXd last_, beside_, rounding_;  // the last correction; the answer to the sample; of every unknown
};

}  // namespace dynalin
