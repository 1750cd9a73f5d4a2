#include "perturbation/perturbed_point.h"

#include <algorithm>

#include "analysis/augmented_system.h"
#include "perturbation/perturbation.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

void evaluate(const System& system, const Motion& motion, const ConstraintRows& rows, Equations& equations) {
  system.equations(motion, rows, equations,
                   {PartialBy::position, PartialBy::velocity, PartialBy::damping, PartialBy::acceleration,
                    PartialBy::lambda, PartialBy::algebraic, PartialBy::state, PartialBy::state_rate});
}

}  // namespace

PerturbedPoint::PerturbedPoint(const System& system, const OperatingPoint& op, const LinearOptions& options)
    : motion(system.motion(op)),
      without_damping(options.without_damping),
      without_rate_coupling(options.without_rate_coupling),
      system_(system),
      first_algebraic_(AugmentedSystem(system).algebraic(0)) {
  motion.mode = AnalysisMode::linear;
  rows.resize(system.layout());
  equations.resize(system.layout());
  equations.keep_sizes();
  system.constraints(motion, rows);
  evaluate(system, motion, rows, equations);
  rows.settle(), equations.settle();
}

const ElementTrace& PerturbedPoint::trace() const {
  std::call_once(traced_, [&] {
    Equations again;
    again.resize(system_.layout());
    again.note_elements(&trace_);
    evaluate(system_, motion, rows, again);
  });
  return trace_;
}

// δw = −F_w⁻¹ F_damping δq′ of the equations F = 0 of values, but for those that are inputs.
ColumnMatrix PerturbedPoint::damping_in_outputs() const {
  const auto count = static_cast<std::int32_t>(outputs.size());
  const auto values = static_cast<std::int32_t>(system_.layout().algebraic.size());
  std::vector<Triplet> entries;
  if (without_damping && count > 0) {
    const auto value_of = [&](std::int32_t row) {
      const std::int32_t w = row - equations.algebraic_row(0);
      const bool is_one = w >= 0 && w < values && std::ranges::find(inputs, w) == inputs.end();
      return is_one ? w : -1;
    };
    std::vector<Triplet> of_values;
    for_each_entry(equations.matrix(PartialBy::algebraic), [&](std::int32_t row, std::int32_t w, double v) {
      if (value_of(row) >= 0) of_values.push_back({value_of(row), w, v});
    });
    for (const std::int32_t w : inputs) of_values.push_back({w, w, 1.0});
    Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(values, count);
    for (std::int32_t k = 0; k < count; ++k) seen(outputs[static_cast<std::size_t>(k)], k) = 1;
    // Values that do not follow from each other alone, but through what moves: an output sees its own equation.
    if (SparseLu lu; lu.factor(compressed(values, values, of_values))) lu.solve_transposed(seen);
    for_each_entry(equations.matrix(PartialBy::damping), [&](std::int32_t row, std::int32_t rate, double v) {
      const std::int32_t w = value_of(row);
      for (std::int32_t k = 0; w >= 0 && k < count; ++k) {
        if (seen(w, k) != 0) entries.push_back({k, rate, -v * seen(w, k)});
      }
    });
  }
  return compressed(count, system_.layout().coordinate_count, entries);
}

ColumnMatrix PerturbedPoint::outputs_by_unknowns(const PerturbationEquations& p) const {
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    entries.push_back({static_cast<std::int32_t>(k), p.augmented() + first_algebraic_ + outputs[k], 1.0});
  for_each_entry(damping_in_outputs(), [&](std::int32_t output, std::int32_t rate, double v) {
    entries.push_back({output, p.rates() + rate, v});
  });
  return compressed(static_cast<std::int32_t>(outputs.size()), p.state_columns(), entries);
}

Eigen::MatrixXd PerturbedPoint::outputs_of(const PerturbationEquations& p, const Eigen::MatrixXd& a) const {
  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(outputs.size()), a.cols());
  for_each_entry(outputs_by_unknowns(p),
                 [&](std::int32_t output, std::int32_t unknown, double v) { seen.row(output) += v * a.row(unknown); });
  return seen;
}

}  // namespace dynalin
