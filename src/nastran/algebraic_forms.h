// What motions make of the algebraic unknowns w (VARIABLEs, FUNCTION-valued forces, outputs of controllers) and of the
// multipliers that some of them read: sparse forms in δq, δq′, δq″, δz and δz′.
//
// w follows from its own equations. Most refer to others in a sequence and are put into each other one by one; what
// refers to itself in a loop is solved together. Multipliers are unknown before the whole model is solved: they are
// those of the mechanism along its chosen coordinates x (linear/physical_matrices.h), with x = X q put in, which is
// the same on all motions that the constraints let pass.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "linear/linear_system.h"
#include "perturbation/perturbed_point.h"

namespace dynalin::nastran {

// By position, velocity, acceleration, state or state_rate, and column of that family.
using MotionForm = std::map<std::pair<PartialBy, std::int32_t>, double>;

class AlgebraicForms {
 public:
  static Result<AlgebraicForms> make(const System&, const Perturbation&);

  // Adds `value` times the unknown of a family to a form. Damping is a velocity, or nothing where it is left out.
  void add(PartialBy family, std::int32_t column, double value, MotionForm&) const;
  // A row of the algebraic or differential equations as a form.
  MotionForm row(const System&, std::int32_t row) const;

 private:
  using Row = std::vector<std::pair<std::pair<PartialBy, std::int32_t>, double>>;

  bool without_damping_ = false;
  std::vector<Row> rows_;  // of algebraic, then differential equations
  std::vector<MotionForm> algebraic_, lambda_;
  class Solving;
};

}  // namespace dynalin::nastran
