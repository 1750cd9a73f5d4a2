#include "linear/eigen.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynalin {

Result<EigenSolution> eigensolve(const LinearSystem& linear, Vectors wanted) {
  EigenSolution out;
  out.time = linear.model.time;
  out.kinematic_states = linear.kinematic_states;
  out.differential_states = linear.differential_states;
  out.states = linear.model.states;

  Eigen::MatrixXd A = linear.model.A;
  const auto n = static_cast<lapack_int>(A.rows());
  if (n == 0) return out;
  if (!A.allFinite()) return tl::unexpected(Failure{"eigensolution", "the state matrix is not finite", {}});
  const bool with_vectors = wanted == Vectors::right;
  std::vector<double> re(static_cast<std::size_t>(n)), im(re), scale(re), rconde(re), rcondv(re);
  Eigen::MatrixXd right(with_vectors ? n : 1, with_vectors ? n : 1), left = right;
  lapack_int low = 0, high = 0;
  double norm = 0;
  const lapack_int info =
      LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'B', with_vectors ? 'V' : 'N', with_vectors ? 'V' : 'N', 'N', n, A.data(), n,
                     re.data(), im.data(), left.data(), with_vectors ? n : 1, right.data(), with_vectors ? n : 1, &low,
                     &high, scale.data(), &norm, rconde.data(), rcondv.data());
  if (info != 0) return tl::unexpected(Failure{"eigensolution", "the QR iteration did not converge", {}});

  std::vector<std::size_t> order;  // one entry a pair
  for (std::size_t k = 0; k < re.size(); ++k) {
    if (im[k] >= 0) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const bool a_real = im[a] == 0, b_real = im[b] == 0;
    if (a_real != b_real) return a_real;
    return a_real ? std::abs(re[a]) < std::abs(re[b]) : im[a] < im[b];
  });
  if (with_vectors) out.vectors.resize(n, static_cast<Eigen::Index>(order.size()));
  for (const std::size_t k : order) {
    double condition = 0;
    if (with_vectors) {
      // Of a pair the columns hold the real and the imaginary part.
      const auto column = [&](const Eigen::MatrixXd& vectors) {
        const auto at = static_cast<Eigen::Index>(k);
        Eigen::VectorXcd v = vectors.col(at).cast<std::complex<double>>();
        if (im[k] != 0) v.imag() = vectors.col(at + 1);
        return Eigen::VectorXcd(v / v.norm());
      };
      const auto v = out.vectors.col(static_cast<Eigen::Index>(out.modes.size())) = column(right);
      condition = 1 / std::abs(column(left).dot(v));
    }
    EigenMode mode;
    mode.eigenvalue_hz = std::complex(re[k], im[k]) / (2 * std::numbers::pi);
    mode.is_real = im[k] == 0;
    mode.condition = condition;
    out.modes.push_back(std::move(mode));
  }
  if (with_vectors) {
    const Eigen::MatrixXcd image = linear.model.A * out.vectors;
    const double size = linear.model.A.norm();
    for (std::size_t k = 0; k < out.modes.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const std::complex<double> lambda = out.modes[k].eigenvalue_hz * (2 * std::numbers::pi);
      out.modes[k].backward_error = size > 0 ? (image.col(at) - lambda * out.vectors.col(at)).norm() / size : 0;
    }
  }
  return out;
}

}  // namespace dynalin
