// What takes the places of the rows that freedoms without mass leave vacant in the first two levels of the perturbation
// equations, behind the others of each level: at rest the balances that the augmented equations hold, differentiated,
//
//     Yᵀ(R_q δq′ + R_q′ δq″ + R_z δz′) = 0,
//
// for rates of condensed freedoms and accelerations of damped ones, and once more for accelerations of condensed ones;
// derivatives of inputs are left out, and of z′ and q″ in the last. Where the model moves nothing is known but that the
// states do not ask for it. Such rows are open.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "analysis/augmented_system.h"
#include "perturbation/sized_block.h"
#include "states/massless_states.h"
#include "states/state_choice.h"

namespace dynalin {

class MasslessBalances {
 public:
  // All must outlive this.
  MasslessBalances(const System&, const MasslessStates&, const StateChoice&, const std::vector<std::int32_t>& inputs,
                   SizedBlock& to);

  void take();
  // In ascending order; after take().
  const std::vector<std::int32_t>& open_rows() const { return open_rows_; }

 private:
  void take_in_motion();
  void take_at_rest();
  void once(std::int32_t row, const Eigen::VectorXd& weights);
  void twice(std::int32_t row, const Eigen::VectorXd& weights);
  void place(std::int32_t row, std::int32_t column, const Eigen::RowVectorXd& value, const Eigen::RowVectorXd& size);
  bool driven(const Eigen::VectorXd& weights) const;

  // Of a direction among the condensed ones, or among the damped ones.
  std::int32_t row_of_rate(Eigen::Index k) const;
  std::int32_t row_of_condensed(Eigen::Index k) const;
  std::int32_t row_of_damped(Eigen::Index k) const;

  const MasslessLimit& limit_;
  const bool at_rest_;
  const StateChoice& choice_;
  const std::vector<std::int32_t>& inputs_;
  SizedBlock& to_;
  const AugmentedSystem augmented_;
  const std::int32_t n_;  // coordinates
  std::vector<std::int32_t> open_rows_;
};

}  // namespace dynalin
