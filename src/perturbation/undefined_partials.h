// Partials that are no finite numbers: SQRT at 0, an angle at its singularity. The perturbation equations are put
// together with zero in their place. What comes of an entry e at (r, c) in the linear model is then −y_r e a_c, with
// a_c the variation of its unknown and y_r what is passed on by its equation: an entry without one or the other does
// not count, any other is refused by the name of its element.
//
// So is the size of a vector that is zero, which has no partials of the vector: an entry in the equations that take the
// size in counts where the vector varies. That is its variation as a whole, beyond what rounding leaves of the terms
// that it is added up of all through the equations: a vector that symmetry keeps zero is a sum of what cancels.
#pragma once

#include <optional>
#include <vector>

#include "analysis/augmented_system.h"
#include "mechanics/vanishing_source.h"
#include "perturbation/perturbation.h"

namespace dynalin {

class UndefinedPartials {
 public:
  // Takes them out of the equations of the point, which must outlive this.
  UndefinedPartials(const System&, PerturbedPoint&);

  // What to say of a linear model with the variations `a` of all unknowns; nothing if none of the entries counts.
  std::optional<Failure> failure(const PerturbationEquations&, const StateChoice&, const Eigen::MatrixXd& a) const;
  // The same where the equations cannot be solved; nothing if none has been taken out.
  std::optional<Failure> failure() const;
  // Of entries in equations that balances of freedoms without mass take in (rows of the augmented equations): those
  // hold partials of several equations at once, and what has no derivative is not told apart there.
  std::optional<Failure> failure_in_balances(const Eigen::MatrixXd& balances) const;

 private:
  using Entry = Equations::Undefined;
  // Of the sizes that are zero, whether their vectors vary.
  std::vector<bool> vary(const PerturbationEquations&, const Eigen::MatrixXd& a) const;
  std::optional<Failure> named(const std::vector<Entry>&, const std::vector<const VanishingSize*>&) const;

  const System& system_;
  const Motion& motion_;
  AugmentedSystem augmented_;
  std::vector<std::int32_t> outputs_;
  bool without_damping_;
  std::vector<Entry> entries_;
  std::vector<VanishingSize> sizes_;
};

}  // namespace dynalin
