#include "states/near_singularity.h"

#include <algorithm>
#include <cmath>

#include "base/arbitrary_vector.h"
#include "states/state_choice.h"
#include "system/sparse_lu.h"

namespace dynalin {

NearSingularity near_singularity(const System& system, const ConstraintRows& rows, const StateChoice& choice) {
  NearSingularity near;
  bool square = false;
  const std::vector<bool> every(choice.gradient.size(), true);
  ColumnMatrix m = level_matrix(rows, choice, choice.active, every, square);
  if (!square || m.columns == 0) return near;
  Eigen::VectorXd size = Eigen::VectorXd::Zero(m.rows);
  for (std::int32_t c = 0; c < m.columns; ++c) {
    for (auto k = static_cast<std::size_t>(m.start[static_cast<std::size_t>(c)]);
         k < static_cast<std::size_t>(m.start[static_cast<std::size_t>(c) + 1]); ++k) {
      m.value[k] *= system.coordinate_scale(c);
      size(m.row[k]) = std::max(size(m.row[k]), std::abs(m.value[k]));
    }
  }
  for (std::size_t k = 0; k < m.value.size(); ++k) m.value[k] /= size(m.row[k]);
  SparseLu lu;
  if (!lu.factor(m)) return near;
  // Inverse iteration for the least singular value.
  Eigen::MatrixXd left = arbitrary_vector(m.rows, 1).real();
  for (int pass = 0; pass < 3; ++pass) {
    left /= left.norm();
    lu.solve(left, SparseLu::Refined::no);
    const double grown = left.norm();
    left /= grown;
    lu.solve_transposed(left);
    near.distance = 1 / std::max(grown, left.norm());
    if (!std::isfinite(near.distance)) return {};
  }
  const double largest = left.cwiseAbs().maxCoeff();
  Eigen::Index r = 0;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (!choice.active[static_cast<std::size_t>(k)]) continue;
    if (std::abs(left(r++, 0)) >= 0.3 * largest) near.rows.push_back(system.row_text(k));
  }
  for (const StateCoordinate& c : choice.coordinates) {
    if (std::abs(left(r++, 0)) >= 0.3 * largest) near.rows.push_back(c.label.text + " of " + c.label.owner.text());
  }
  return near;
}

}  // namespace dynalin
