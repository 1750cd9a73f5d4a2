#include "linear/balanced.h"

#include <lapacke.h>

namespace dynalin {

Balanced balanced(Eigen::MatrixXd A) {
  const auto n = static_cast<lapack_int>(A.rows());
  Balanced b{std::move(A), Eigen::VectorXd::Ones(n)};
  lapack_int low = 0, high = 0;
  if (n > 0) LAPACKE_dgebal(LAPACK_COL_MAJOR, 'S', n, b.matrix.data(), n, &low, &high, b.scale.data());
  return b;
}

}  // namespace dynalin
