// How many eigenvalues of a conservative model are in a region, by the inertia of symmetric matrices:
//
//     ⎡ K − σ M   Gᵀ ⎤     has a negative pivot for each mode with ω² < σ, and one for each row of G.
//     ⎣ G         0  ⎦
//
// What was factored stands for the perturbation equations as they are: where the solutions of both differ by more than
// `largest_difference`, rounding, asymmetry or what has been left out might move an eigenvalue across σ, and there is
// no count.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "selected_modes/conservative_model.h"
#include "selected_modes/mode_region.h"

namespace dynalin {

class InertiaCount {
 public:
  // Analyses the pattern.
  explicit InertiaCount(const std::shared_ptr<const ConservativeModel>& model) : factors_(model, FactorsFor::inertia) {}

  // Of a disc with its centre on the imaginary axis, or a band; both members of pairs. Nothing if not to be trusted.
  std::optional<Eigen::Index> eigenvalues_inside(const ModeRegion&);
  // Modes with ω² < σ.
  std::optional<Eigen::Index> below(double sigma);

  static constexpr double largest_difference = 1e-3;

 private:
  bool stands_for_the_equations(double sigma) const;

  ConservativeFactors factors_;
  std::map<double, std::optional<Eigen::Index>> below_;
};

}  // namespace dynalin
