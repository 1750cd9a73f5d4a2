#include "analysis/acceleration_corrections.h"

#include <algorithm>
#include <cmath>

#include "analysis/acceleration_rounding.h"

namespace dynalin {

namespace {

// Of an unknown: the next correction would be as small a part of this one.
constexpr double small_correction = 1e-9;
// Of the largest that the sample makes of any value: what no other sample would come near.
constexpr double times_the_sample = 100;

// Corrects values that are already exact to rounding. What all but vanishes was rounding alone and is zero.
void correct(std::vector<double>& values, std::int32_t offset, const Eigen::MatrixXd& step) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double change = step(offset + static_cast<Eigen::Index>(k), 0);
    values[k] += change;
    if (std::abs(values[k]) <= 1e-3 * std::abs(change)) values[k] = 0;
  }
}

void drop(std::vector<double>& values, std::int32_t offset, const Eigen::VectorXd& rounding) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::abs(values[k]) <= rounding(offset + static_cast<Eigen::Index>(k))) values[k] = 0;
  }
}

}  // namespace

AccelerationCorrections::AccelerationCorrections(const System& system, AccelerationEquations& equations,
                                                 const SparseLu& lu, OperatingPoint& op)
    : system_(system), equations_(equations), lu_(lu), op_(op) {
  for (const bool last : {false, true}) {
    Eigen::MatrixXd step = missing(op);
    defined_ = step.allFinite();
    if (!defined_) return;
    if (last) {
      step.conservativeResize(Eigen::NoChange, 2);
      step.col(1) = missing_beside(system, op, [&](const OperatingPoint& at) { return missing(at); });
      if (!step.col(1).allFinite()) step.col(1).setConstant(std::numeric_limits<double>::infinity());
    }
    lu.solve(step);
    correct(op.acceleration, 0, step);
    correct(op.lambda, equations.augmented().lambda(0), step);
    if (last) last_ = step.col(0), beside_ = step.col(1);
  }
}

bool AccelerationCorrections::settled() {
  const Eigen::VectorXd value = equations_.values(op_).cwiseAbs();
  Eigen::VectorXd size = value;
  equations_.spread_over_axes(size);
  const auto within = [&](const Eigen::VectorXd& allowed) {
    for (Eigen::Index k = 0; k < last_.size(); ++k) {
      if (value(k) != 0 && !(std::abs(last_(k)) <= std::max(small_correction * size(k), allowed(k)))) return false;
    }
    return true;
  };
  return within(Eigen::VectorXd::Zero(last_.size())) || within(rounding_units_of_step * rounding());
}

void AccelerationCorrections::drop_rounding() {
  const std::int32_t lambda = equations_.augmented().lambda(0);
  if (rounding_.size() == 0 && far_above_rounding(op_.acceleration, 0) && far_above_rounding(op_.lambda, lambda))
    return;
  // A force along its arm has a torque of rounding wherever the point is: shaking it does not bring that to light.
  Eigen::VectorXd of_evaluation = rounding_of_solution(lu_, equations_.magnitude());
  equations_.spread_over_axes(of_evaluation);
  drop(op_.acceleration, 0, rounding().cwiseMax(of_evaluation));
  drop(op_.lambda, lambda, rounding());
}

const Eigen::VectorXd& AccelerationCorrections::rounding() {
  if (rounding_.size() == 0) {
    rounding_ = rounding_of_accelerations(system_, lu_, op_, [&](const OperatingPoint& at) { return missing(at); });
  }
  return rounding_;
}

// Whether every value is zero or much more than the sample makes of any.
bool AccelerationCorrections::far_above_rounding(const std::vector<double>& values, std::int32_t offset) const {
  const auto sample = beside_.segment(offset, static_cast<Eigen::Index>(values.size()));
  if (!sample.allFinite()) return false;
  const double least = values.empty() ? 0 : times_the_sample * rounding_of_answer() * sample.cwiseAbs().maxCoeff();
  return std::all_of(values.begin(), values.end(), [&](double v) { return v == 0 || std::abs(v) > least; });
}

}  // namespace dynalin
