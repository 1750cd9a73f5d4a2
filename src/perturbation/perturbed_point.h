// What the perturbation equations of a point are made of: motion, constraint rows, partials and the states that were
// chosen. It outlives them, for what is asked of single elements.
#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "mechanics/element_trace.h"
#include "states/linear_options.h"
#include "states/massless_states.h"
#include "states/state_choice.h"

namespace dynalin {

class PerturbationEquations;

struct PerturbedPoint {
  PerturbedPoint(const System&, const OperatingPoint&, const LinearOptions&);

  // What damping that NODAMPIN leaves out of forces does to outputs, directly or through other values: rows are
  // outputs, columns rates of all coordinates. Empty where nothing is left out.
  ColumnMatrix damping_in_outputs() const;
  // What outputs see of all unknowns a, a row each, and of columns of them (perturbation.h).
  ColumnMatrix outputs_by_unknowns(const PerturbationEquations&) const;
  Eigen::MatrixXd outputs_of(const PerturbationEquations&, const Eigen::MatrixXd& columns) const;
  // What each element adds, evaluated when it is asked for first: beside a large model it would be the longest of all
  // lists, and few ask.
  const ElementTrace& trace() const;

  Motion motion;
  ConstraintRows rows;
  Equations equations;
  StateChoice choice;
  std::optional<StateChoice> with_massless;   // the choice before freedoms without mass lost their states, if any did
  std::vector<std::int32_t> inputs, outputs;  // algebraic unknowns
  std::optional<MasslessStates> massless;     // nothing where everything has mass
  bool without_damping, without_rate_coupling;

 private:
  const System& system_;
  std::int32_t first_algebraic_;  // among the unknowns of the augmented system
  mutable std::once_flag traced_;
  mutable ElementTrace trace_;
};

}  // namespace dynalin
