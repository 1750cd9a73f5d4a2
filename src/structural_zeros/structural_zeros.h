// Which zero eigenvalues follow from the structure of the model: motions of bodies along which every single element's
// own contribution vanishes. That a sum over elements vanishes to rounding says only that a model nearby has a zero; a
// soft spring beside a stiff one, or coefficients that all but cancel, must not be taken for none.
//
// A direction with displacements δq, rates δq′ and accelerations δq″ is one of the structure if for all bodies that
// elements connect there is one small motion τ of the axes in which forces are seen, so that every force W_e changes as
// it is carried along,
//
//     δW_e = τ × W_e   (ad*_τ),     reactions up to multipliers of their own,
//
// and if every quantity that laws of forces and differential equations read stays what it is. With Σ W_e = 0 the
// balance then holds as well. Both sides are measured element by element, each in its own size.
//
// Chains: directions with A v in the span of earlier ones, as a velocity that a displacement grows with.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mechanics/element_trace.h"
#include "perturbation/perturb.h"
#include "states/state_choice.h"

namespace dynalin {

class StructuralZeros {
 public:
  StructuralZeros(const System&, const Perturbation&);
  ~StructuralZeros();

  // The directions of states (columns) that A maps into the span of `earlier` ones, which must come from here or be
  // exact themselves, without those that are in it. `limit` is what counts as nothing of an element's own contribution.
  Eigen::MatrixXd beyond(const Eigen::MatrixXd& earlier, double limit) const;
  // The same among the displacements of computed columns of states, which are exact to `rounding`.
  Eigen::MatrixXd beyond(const Eigen::MatrixXd& earlier, const Eigen::MatrixXd& columns, double rounding) const;

  // States that the motion of bodies does not depend on: what a direction does to them follows from it.
  const std::vector<bool>& driven() const { return driven_; }

 private:
  class Contributions;

  std::vector<bool> driven_;
  std::unique_ptr<const Contributions> contributions_;
};

}  // namespace dynalin
