#include "eigenvalues/eigen.h"

#include <fmt/format.h>
#include <lapacke.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>

#include "base/blas_threads.h"
#include "base/cycle.h"
#include "base/dense_products.h"
#include "eigenvalues/eigen_refinement.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

// Pairs of a real matrix without zero modes, in coordinates of their own.
bool solve_core(Eigen::MatrixXd core, EigenPairs& pairs) {
  const auto n = static_cast<lapack_int>(core.rows());
  if (n == 0) return true;
  std::vector<double> re(static_cast<std::size_t>(n)), im(re), scale(re), unused_e(re), unused_v(re);
  Eigen::MatrixXd right(n, n), left(n, n);
  lapack_int low = 0, high = 0;
  double norm = 0;
  const lapack_int info =
      LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'B', 'V', 'V', 'N', n, core.data(), n, re.data(), im.data(), left.data(), n,
                     right.data(), n, &low, &high, scale.data(), &norm, unused_e.data(), unused_v.data());
  if (info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR) throw std::bad_alloc();
  if (info != 0) return false;
  std::vector<std::size_t> kept;  // one entry a pair
  for (std::size_t k = 0; k < re.size(); ++k) {
    if (im[k] >= 0) kept.push_back(k);
  }
  const auto columns = static_cast<Eigen::Index>(kept.size());
  pairs.right.resize(n, columns), pairs.left.resize(n, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const std::size_t k = kept[static_cast<std::size_t>(c)];
    pairs.values.emplace_back(re[k], im[k]);
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

}  // namespace

std::optional<UnrefinedPairs> unrefined_pairs(const LinearSystem& linear) {
  const Eigen::Index n = linear.A.rows();
  UnrefinedPairs found{split_zero_modes(linear.A, linear.rounding, linear.structural_zeros.get()), {}};
  const Eigen::Index core = n - found.zero.count;
  if (!solve_core(found.zero.block.bottomRightCorner(core, core), found.pairs)) return std::nullopt;
  split_pairs_of_equal_values(found.pairs);
  if (core > 0) map_to_states(found.zero, found.pairs);
  return found;
}

Result<EigenSolution> eigensolve(const LinearSystem& linear, Vectors wanted, const Progress& progress) {
  EigenSolution out;
  out.time = linear.model.time, out.of_equations = linear.model.of_equations;
  out.kinematic_states = linear.kinematic_states;
  out.differential_states = linear.differential_states;
  out.states = linear.model.states;

  const Eigen::MatrixXd& A = linear.A;
  if (A.rows() == 0) return out;
  assert(A.allFinite());  // linearize() refuses what is not, by name
  // Several threads of the BLAS halve the time of large models, and round otherwise than one.
  constexpr Eigen::Index most_for_one_thread = 500;
  std::optional<OneBlasThread> alone;
  if (A.rows() <= most_for_one_thread) alone.emplace();
  const Progress told = progress.of("all modes");
  told.tell([&] { return fmt::format("QR iteration of {} states", A.rows()); });
  std::optional<UnrefinedPairs> found = unrefined_pairs(linear);
  if (!found)
    return tl::unexpected(Failure{"eigensolution", "the QR iteration did not converge", {}, "no-eigensolution"});
  const ZeroModes& zero = found->zero;
  EigenPairs& pairs = found->pairs;
  const Eigen::Index n = A.rows(), z = zero.count;
  std::vector<EigenTrust> trust(pairs.values.size());
  told.tell([&] { return fmt::format("correction and bounds of {} eigenvalues", n - z); });
  if (n > z) trust = refine({*linear.pencil, zero, linear.uncertainty, linear.beside_coefficients}, zero, pairs);

  clear_rounding(pairs, trust);
  split_pairs_of_zeros(pairs, trust);

  const std::vector<std::size_t> order = printed_order(pairs.values);
  out.vectors.resize(n, z + static_cast<Eigen::Index>(order.size()));
  out.vectors.leftCols(z) = zero.vectors().cast<Complex>();
  out.vectors.leftCols(z).colwise().normalize();
  out.modes.assign(static_cast<std::size_t>(z), structural_zero_mode(zero.defective()));
  for (const std::size_t k : order) {
    out.vectors.col(static_cast<Eigen::Index>(out.modes.size())) = pairs.right.col(static_cast<Eigen::Index>(k));
    out.modes.push_back(mode_of(pairs, trust[k], k));
  }
  const Eigen::MatrixXcd image = real_product(A, out.vectors);
  const double size = A.norm();
  for (std::size_t k = 0; k < out.modes.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const Complex lambda = out.modes[k].eigenvalue_hz * cycle;
    out.modes[k].backward_error = size > 0 ? (image.col(at) - lambda * out.vectors.col(at)).norm() / size : 0;
  }
  if (wanted == Vectors::none) out.vectors.resize(0, 0);
  return out;
}

}  // namespace dynalin
