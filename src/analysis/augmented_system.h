// The coupled equations of one instant as a square sparse matrix:
//
//     ⎡ ∂F/∂q*   −Gᵀ + ∂F/∂λ   ∂F/∂w   ∂F/∂z* ⎤        F  force balance
//     ⎢ G            0            0       0    ⎥        G  constraint rows (inactive ones say λ = 0)
//     ⎢ ∂a/∂q*    ∂a/∂λ        ∂a/∂w   ∂a/∂z* ⎥        a  algebraic equations
//     ⎣ ∂d/∂q*    ∂d/∂λ        ∂d/∂w   ∂d/∂z* ⎦        d  differential equations
//
// with q* the accelerations and z* the state rates for an instant of motion, positions and states for statics.
#pragma once

#include <Eigen/Core>
#include <string>

#include "system/system.h"

namespace dynalin {

struct AugmentedColumns {
  PartialBy coordinates = PartialBy::acceleration;
  PartialBy states = PartialBy::state_rate;
  bool with_coordinates = true;  // without, the diagonal that is added stands alone in their columns
};

class AugmentedSystem {
 public:
  explicit AugmentedSystem(const System&);
  std::int32_t size() const { return size_; }
  std::int32_t lambda(std::int32_t k) const { return n_ + k; }
  std::int32_t algebraic(std::int32_t k) const { return n_ + m_ + k; }
  std::int32_t state(std::int32_t k) const { return n_ + m_ + w_ + k; }
  // Where row r of Equations (balance, algebraic, differential) stands here.
  std::int32_t equation(std::int32_t r) const { return r < n_ ? r : r + m_; }

  // `cut` marks algebraic equations that are replaced by w = given (inputs), `held` states by z* = given.
  ColumnMatrix matrix(const Equations&, const ConstraintRows&, const std::vector<bool>& active, const AugmentedColumns&,
                      const std::vector<bool>& cut = {}, const std::vector<bool>& held = {},
                      std::span<const double> added_diagonal = {}) const;

 private:
  std::int32_t n_, m_, w_, z_, size_;
};

// The unknowns that a singular matrix leaves undetermined, largest first, by name.
std::vector<std::string> undetermined(const System&, const AugmentedSystem&, ColumnMatrix);

}  // namespace dynalin
