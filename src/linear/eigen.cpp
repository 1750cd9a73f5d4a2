#include "linear/eigen.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "linear/dense_products.h"
#include "linear/eigen_refinement.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
constexpr double cycle = 2 * std::numbers::pi;

// Pairs of a real matrix without zero modes, in coordinates of their own.
bool solve_core(Eigen::MatrixXd core, bool with_vectors, EigenPairs& pairs) {
  const auto n = static_cast<lapack_int>(core.rows());
  if (n == 0) return true;
  std::vector<double> re(static_cast<std::size_t>(n)), im(re), scale(re), unused_e(re), unused_v(re);
  Eigen::MatrixXd right(with_vectors ? n : 1, with_vectors ? n : 1), left = right;
  lapack_int low = 0, high = 0;
  double norm = 0;
  const char wanted = with_vectors ? 'V' : 'N';
  const lapack_int leading = with_vectors ? n : 1;
  const lapack_int info = LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'B', wanted, wanted, 'N', n, core.data(), n, re.data(),
                                         im.data(), left.data(), leading, right.data(), leading, &low, &high,
                                         scale.data(), &norm, unused_e.data(), unused_v.data());
  if (info != 0) return false;
  std::vector<std::size_t> kept;  // one entry a pair
  for (std::size_t k = 0; k < re.size(); ++k) {
    if (im[k] >= 0) kept.push_back(k);
  }
  const auto columns = static_cast<Eigen::Index>(kept.size());
  if (with_vectors) pairs.right.resize(n, columns), pairs.left.resize(n, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const std::size_t k = kept[static_cast<std::size_t>(c)];
    pairs.values.emplace_back(re[k], im[k]);
    if (!with_vectors) continue;
    // Of a pair the columns hold the real and the imaginary part.
    const auto at = static_cast<Eigen::Index>(k);
    pairs.right.col(c) = right.col(at).cast<Complex>();
    pairs.left.col(c) = left.col(at).cast<Complex>();
    if (im[k] == 0) continue;
    pairs.right.col(c).imag() = right.col(at + 1);
    pairs.left.col(c).imag() = left.col(at + 1);
  }
  return true;
}

// From [N C; 0 B] to A: the part of a right eigenvector in the space of the zero modes follows from (N − λ) u = −C y.
void map_to_states(const ZeroModes& zero, EigenPairs& pairs) {
  const Eigen::Index n = zero.block.rows(), z = zero.count;
  if (z == 0) {
    pairs.right = zero.scale.asDiagonal() * pairs.right;
    pairs.left = zero.scale.cwiseInverse().asDiagonal() * pairs.left;
  } else {
    const Eigen::MatrixXcd C = zero.block.topRightCorner(z, n - z).cast<Complex>();
    Eigen::MatrixXcd full(n, pairs.right.cols());
    full.bottomRows(n - z) = pairs.right;
    full.topRows(z) = -C * pairs.right;
    for (Eigen::Index k = 0; k < full.cols(); ++k) {
      Eigen::MatrixXcd N = zero.block.topLeftCorner(z, z).cast<Complex>();
      N.diagonal().array() -= pairs.values[static_cast<std::size_t>(k)];
      full.col(k).head(z) = N.triangularView<Eigen::Upper>().solve(full.col(k).head(z)).eval();
    }
    pairs.right = real_product(zero.right(), full);
    pairs.left = real_product(zero.left().rightCols(n - z), pairs.left);
  }
  pairs.right.colwise().normalize();
  pairs.left.colwise().normalize();
}

}  // namespace

std::optional<UnrefinedPairs> unrefined_pairs(const LinearSystem& linear, Vectors wanted) {
  const bool with_vectors = wanted == Vectors::right;
  const Eigen::Index n = linear.model.A.rows();
  UnrefinedPairs found{split_zero_modes(linear.model.A, linear.rounding), {}};
  const Eigen::Index core = n - found.zero.count;
  if (!solve_core(found.zero.block.bottomRightCorner(core, core), with_vectors, found.pairs)) return std::nullopt;
  if (with_vectors && core > 0) map_to_states(found.zero, found.pairs);
  return found;
}

Result<EigenSolution> eigensolve(const LinearSystem& linear, Vectors wanted) {
  EigenSolution out;
  out.time = linear.model.time;
  out.kinematic_states = linear.kinematic_states;
  out.differential_states = linear.differential_states;
  out.states = linear.model.states;

  const Eigen::MatrixXd& A = linear.model.A;
  if (A.rows() == 0) return out;
  if (!A.allFinite()) return tl::unexpected(Failure{"eigensolution", "the state matrix is not finite", {}});
  const bool with_vectors = wanted == Vectors::right;
  std::optional<UnrefinedPairs> found = unrefined_pairs(linear, wanted);
  if (!found) return tl::unexpected(Failure{"eigensolution", "the QR iteration did not converge", {}});
  auto& [zero, pairs] = *found;
  const Eigen::Index n = A.rows(), z = zero.count;
  std::vector<EigenTrust> trust(pairs.values.size());
  if (with_vectors && n > z) trust = refine(*linear.equations, zero, pairs);

  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < pairs.values.size(); ++k) order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Complex x = pairs.values[a], y = pairs.values[b];
    const bool x_real = x.imag() == 0, y_real = y.imag() == 0;
    if (x_real != y_real) return x_real;
    return x_real ? std::abs(x.real()) < std::abs(y.real()) : x.imag() < y.imag();
  });

  if (with_vectors) {
    out.vectors.resize(n, z + static_cast<Eigen::Index>(order.size()));
    out.vectors.leftCols(z) = zero.vectors().cast<Complex>();
    out.vectors.leftCols(z).colwise().normalize();
  }
  for (Eigen::Index k = 0; k < z; ++k) {
    EigenMode mode;
    mode.is_real = mode.structural_zero = true;
    if (with_vectors) mode.condition = zero.defective() ? std::numeric_limits<double>::infinity() : 1.0;
    out.modes.push_back(std::move(mode));
  }
  for (const std::size_t k : order) {
    EigenMode mode;
    mode.eigenvalue_hz = pairs.values[k] / cycle;
    mode.is_real = pairs.values[k].imag() == 0;
    if (with_vectors) {
      const auto at = static_cast<Eigen::Index>(k);
      out.vectors.col(static_cast<Eigen::Index>(out.modes.size())) = pairs.right.col(at);
      mode.condition = 1 / std::abs(pairs.left.col(at).dot(pairs.right.col(at)));
      mode.error_bound_hz = trust[k].bound / cycle;
      mode.refined = trust[k].refined;
    }
    out.modes.push_back(std::move(mode));
  }
  if (with_vectors) {
    const Eigen::MatrixXcd image = real_product(A, out.vectors);
    const double size = A.norm();
    for (std::size_t k = 0; k < out.modes.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const Complex lambda = out.modes[k].eigenvalue_hz * cycle;
      out.modes[k].backward_error = size > 0 ? (image.col(at) - lambda * out.vectors.col(at)).norm() / size : 0;
    }
  }
  return out;
}

}  // namespace dynalin
