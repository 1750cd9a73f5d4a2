#include "nastran_reader/regular_pencil.h"

#include <lapacke.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "base/dense_products.h"

namespace dynalin::nastran_reader {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::size_t size_of(const Pencil& p) { return static_cast<std::size_t>(p.E.rows()); }

// Distance of each value to the nearest other one.
std::vector<double> distances(const std::vector<Complex>& values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a].imag() < values[b].imag(); });
  std::vector<double> out(values.size(), HUGE_VAL);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Complex z = values[order[i]];
    for (const int direction : {-1, 1}) {
      for (std::size_t j = i + static_cast<std::size_t>(direction); j < order.size();
           j += static_cast<std::size_t>(direction)) {
        const Complex other = values[order[j]];
        if (std::abs(other.imag() - z.imag()) >= out[order[i]]) break;
        out[order[i]] = std::min(out[order[i]], std::abs(other - z));
      }
    }
  }
  return out;
}

// Columns k and k + 1 of what LAPACK gives for a pair hold the real and the imaginary part.
struct Packed {
  const MatrixXd& m;
  Complex dot(const Packed& other, Index k, bool pair) const {
    if (!pair) return m.col(k).dot(other.m.col(k));
    const auto re = m.col(k), im = m.col(k + 1), other_re = other.m.col(k), other_im = other.m.col(k + 1);
    return {re.dot(other_re) + im.dot(other_im), re.dot(other_im) - im.dot(other_re)};
  }
};

// λ + wᴴ(A − λE)x / wᴴEx, where the step is small beside the distance to others.
void correct(const Pencil& p, const MatrixXd& left, const MatrixXd& right, std::vector<Complex>& values) {
  const MatrixXd Ax = transposed_product(MatrixXd(p.A.transpose()), right);
  const MatrixXd Ex = transposed_product(MatrixXd(p.E.transpose()), right);
  const std::vector<double> distance = distances(values);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool pair = values[k].imag() != 0;
    const auto at = static_cast<Index>(k);
    // A motion of its own velocity: the residual is formed before it is weighed, so that what cancels does so exactly.
    const Complex z = values[k];
    MatrixXd residual(p.E.rows(), pair ? 2 : 1);
    residual.col(0) = Ax.col(at) - z.real() * Ex.col(at);
    if (pair) {
      residual.col(0) += z.imag() * Ex.col(at + 1);
      residual.col(1) = Ax.col(at + 1) - z.real() * Ex.col(at + 1) - z.imag() * Ex.col(at);
    }
    const MatrixXd w = left.middleCols(at, pair ? 2 : 1), e = Ex.middleCols(at, pair ? 2 : 1);
    const Complex slope = Packed{w}.dot(Packed{e}, 0, pair);
    const Complex step = Packed{w}.dot(Packed{residual}, 0, pair) / slope;
    const bool usable = std::isfinite(step.real()) && std::isfinite(step.imag()) &&
                        std::abs(step) <= 0.1 * std::min(distance[k], std::abs(z));
    if (usable) values[k] = z + step;
    if (!pair) continue;
    values[k + 1] = std::conj(values[k]);
    ++k;
  }
}

std::optional<std::vector<Complex>> by_standard_problem(const Pencil& p, const Scales& scales,
                                                        const Eigen::PartialPivLU<MatrixXd>& factors,
                                                        Correction correction) {
  const auto n = static_cast<lapack_int>(p.E.rows());
  std::vector<double> re(size_of(p)), im(re), scale(re), unused_e(re), unused_v(re);
  MatrixXd S = factors.solve(scales.of(p.A));
  const bool vectors = correction == Correction::by_vectors;
  MatrixXd left(vectors ? n : 1, vectors ? n : 1), right(left.rows(), left.cols());
  lapack_int low = 0, high = 0;
  double norm = 0;
  const char job = vectors ? 'V' : 'N';
  const lapack_int info =
      LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'B', job, job, 'N', n, S.data(), n, re.data(), im.data(), left.data(), n,
                     right.data(), n, &low, &high, scale.data(), &norm, unused_e.data(), unused_v.data());
  if (info == LAPACK_WORK_MEMORY_ERROR) throw std::bad_alloc();
  if (info != 0) return std::nullopt;
  std::vector<Complex> values;
  for (std::size_t k = 0; k < re.size(); ++k) values.emplace_back(re[k], im[k]);
  if (!vectors) return values;
  // From vectors of S to those of the pencil.
  S = factors.transpose().solve(left);
  left = scales.rows.asDiagonal() * S;
  right = scales.columns.asDiagonal() * right;
  correct(p, left, right, values);
  return values;
}

std::optional<std::vector<Complex>> by_qz(const Pencil& p) {
  const auto n = static_cast<lapack_int>(p.E.rows());
  MatrixXd A = p.A, E = p.E;
  std::vector<double> re(size_of(p)), im(re), beta(re), left(re), right(re), unused_e(re), unused_v(re);
  lapack_int low = 0, high = 0;
  double norm_a = 0, norm_e = 0;
  const lapack_int info = LAPACKE_dggevx(LAPACK_COL_MAJOR, 'B', 'N', 'N', 'N', n, A.data(), n, E.data(), n, re.data(),
                                         im.data(), beta.data(), nullptr, n, nullptr, n, &low, &high, left.data(),
                                         right.data(), &norm_a, &norm_e, unused_e.data(), unused_v.data());
  if (info == LAPACK_WORK_MEMORY_ERROR) throw std::bad_alloc();
  if (info != 0) return std::nullopt;
  std::vector<Complex> values;
  for (std::size_t k = 0; k < re.size(); ++k) values.emplace_back(re[k] / beta[k], im[k] / beta[k]);
  return values;
}

}  // namespace

std::optional<std::vector<Complex>> regular_eigenvalues(const Pencil& p, Correction correction) {
  if (p.E.rows() == 0) return std::vector<Complex>{};
  const Scales scales = equilibrating(p.E);
  const Eigen::PartialPivLU<MatrixXd> factors(scales.of(p.E));
  constexpr double well_conditioned = 1e-9;
  return factors.rcond() > well_conditioned ? by_standard_problem(p, scales, factors, correction) : by_qz(p);
}

}  // namespace dynalin::nastran_reader
