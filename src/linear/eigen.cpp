#include "linear/eigen.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynalin {

Result<EigenSolution> eigensolve(const LinearSystem& linear) {
  EigenSolution out;
  out.time = linear.model.time;
  out.kinematic_states = linear.kinematic_states;
  out.differential_states = linear.differential_states;
  out.states = linear.model.states;

  Eigen::MatrixXd A = linear.model.A;
  const auto n = static_cast<lapack_int>(A.rows());
  if (n == 0) return out;
  if (!A.allFinite()) return tl::unexpected(Failure{"eigensolution", "the state matrix is not finite", {}});
  std::vector<double> re(static_cast<std::size_t>(n)), im(re), scale(re), rconde(re), rcondv(re);
  lapack_int low = 0, high = 0;
  double norm = 0;
  const lapack_int info =
      LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'B', 'N', 'N', 'N', n, A.data(), n, re.data(), im.data(), nullptr, 1, nullptr, 1,
                     &low, &high, scale.data(), &norm, rconde.data(), rcondv.data());
  if (info != 0) return tl::unexpected(Failure{"eigensolution", "the QR iteration did not converge", {}});
  for (std::size_t k = 0; k < re.size(); ++k) {
    if (im[k] < 0) continue;  // one entry a pair
    out.modes.push_back({std::complex(re[k], im[k]) / (2 * std::numbers::pi), im[k] == 0});
  }
  std::stable_sort(out.modes.begin(), out.modes.end(), [](const EigenMode& a, const EigenMode& b) {
    if (a.is_real != b.is_real) return a.is_real;
    if (a.is_real) return std::abs(a.eigenvalue_hz.real()) < std::abs(b.eigenvalue_hz.real());
    return a.eigenvalue_hz.imag() < b.eigenvalue_hz.imag();
  });
  return out;
}

}  // namespace dynalin
