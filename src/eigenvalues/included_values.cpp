#include "eigenvalues/included_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense_products.h"
#include "eigenvalues/inclusion.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

constexpr Index most_in_long_double = 300;

// The lower right block of T⁻¹ A T as the sparse equations have it.
struct Core {
  LongMatrix value;
  Matrix uncertainty;
};

// S w − E (X B + T₀ C) of the columns X of T that belong to the core: what B is off, in long double.
struct Residuals {
  Matrix value, rounding;
};
Residuals residuals_of(const ColumnMatrix& S, const Matrix& a, const Matrix& T, const Matrix& images) {
  const Index N = S.rows, n = T.rows(), columns = a.cols(), z = T.cols() - columns;
  Residuals r{Matrix(N, columns), Matrix(N, columns)};
  LongVector sum(N);
  Eigen::VectorXd terms(N), size(N);
  for (Index c = 0; c < columns; ++c) {
    sum.setZero(), size.setZero(), terms.setConstant(2);
    for (std::int32_t k = 0; k < S.columns; ++k) {
      const double w = k < a.rows() ? a(k, c) : T(k - a.rows(), z + c);
      if (w == 0) continue;
      for_each_in_column(S, k, [&](std::int32_t row, double v) {
        sum(row) += static_cast<long double>(v) * static_cast<long double>(w);
        size(row) += std::abs(v) * std::abs(w);
        ++terms(row);
      });
    }
    for (Index k = 0; k < T.cols(); ++k) {
      const double factor = images(k, c);
      if (factor == 0) continue;
      for (Index row = 0; row < n; ++row) {
        if (T(row, k) == 0) continue;
        sum(N - n + row) -= static_cast<long double>(T(row, k)) * static_cast<long double>(factor);
        size(N - n + row) += std::abs(T(row, k) * factor);
        ++terms(N - n + row);
      }
    }
    r.value.col(c) = sum.cast<double>();
    r.rounding.col(c) = long_eps * terms.cwiseProduct(size) + eps * r.value.col(c).cwiseAbs();
  }
  return r;
}

Core measure(const StructuredPencil& pencil, const ZeroModes& zero) {
  const PerturbationEquations& equations = pencil.equations();
  const Index n = equations.states(), z = zero.count, m = n - z, N = equations.unknowns();
  const Matrix T = zero.right(), L = zero.left();
  const Matrix X = T.rightCols(m), Y = L.rightCols(m), B = zero.block.bottomRightCorner(m, m);
  const Residuals r = residuals_of(equations.products(), equations.complete(X), T, zero.block.rightCols(m));
  const Matrix ya = equations.complete_left(Y), reduced = equations.reduced(r.value);
  Matrix y(N, m);
  y << ya, Y;
  const Matrix G = transposed_product(y, r.value), other = transposed_product(Y, reduced);
  const Matrix size_of_y = y.cwiseAbs(), size_of_r = r.value.cwiseAbs();

  Core core{B.cast<long double>() + G.cast<long double>(), {}};
  core.uncertainty = transposed_product(size_of_y, r.rounding) + margin_of_difference * (G - other).cwiseAbs() +
                     static_cast<double>(N) * eps * transposed_product(size_of_y, size_of_r) +
                     long_eps * (B.cwiseAbs() + G.cwiseAbs());
  // T⁻ᵀ as computed is not quite that.
  const LongMatrix product = Y.transpose().cast<long double>() * T.cast<long double>();
  Matrix off = product.cast<double>();
  off.rightCols(m).diagonal().array() = (product.rightCols(m).diagonal().array() - 1.0L).cast<double>();
  off = off.cwiseAbs() + static_cast<double>(n) * long_eps * (Y.cwiseAbs().transpose() * T.cwiseAbs());
  core.uncertainty += 1.1 * off * (L.transpose() * reduced).cwiseAbs();
  core.uncertainty += transposed_product(Matrix(Y.cwiseAbs()), Matrix(pencil.uncertainty() * X.cwiseAbs()));
  core.uncertainty *= upward_from_single;
  return core;
}

// What the equations as assembled do to the block through the zero modes, which they hold to rounding only: to first
// order dualᴴ R (c − N)⁻¹ C basis.
double zero_coupling(const ZeroModes& zero, const Matrix& from_zero, const InclusionDisc& disc) {
  const Index z = zero.count;
  if (z == 0 || std::abs(disc.centre) <= disc.radius) return 0;
  const Matrix C = zero.block.topRightCorner(z, zero.block.cols() - z);
  ComplexMatrix through = real_product(C, disc.basis), shifted = -zero.block.topLeftCorner(z, z).cast<Complex>();
  shifted.diagonal().array() += disc.centre;
  shifted.triangularView<Eigen::Upper>().solveInPlace(through);
  const ComplexMatrix onto = disc.dual.adjoint() * from_zero.cast<Complex>();
  return first_order_margin * (onto.cwiseAbs() * through.cwiseAbs()).norm();
}

}  // namespace

std::optional<IncludedValues> included_values(const StructuredPencil& pencil, const ZeroModes& zero) {
  const Index z = zero.count, m = zero.block.rows() - z;
  if (m > most_in_long_double) return std::nullopt;
  const Core core = measure(pencil, zero);
  if (!core.uncertainty.allFinite()) return std::nullopt;
  const auto discs = inclusion_discs(core.value.cast<std::complex<long double>>(), core.uncertainty, true);
  if (!discs) return std::nullopt;

  const Matrix from_zero = zero.left().rightCols(m).transpose() * pencil.equations().reduced(pencil.zero_residuals());
  IncludedValues out;
  Index columns = 0;
  for (const InclusionDisc& disc : *discs) columns += disc.count;
  out.pairs.right.resize(m, columns), out.pairs.left.resize(m, columns);
  Index at = 0;
  for (const InclusionDisc& disc : *discs) {
    const double coupling = zero_coupling(zero, from_zero, disc);
    const double radius = coupling > 0 ? disc.radius_under(disc.tau + coupling) : disc.radius;
    const double bound = std::max(disc.radius, radius) + 2 * eps * std::abs(disc.centre);
    out.pairs.right.middleCols(at, disc.count) = disc.right;
    out.pairs.left.middleCols(at, disc.count) = disc.left;
    out.pairs.values.insert(out.pairs.values.end(), static_cast<std::size_t>(disc.count), disc.centre);
    out.trust.insert(out.trust.end(), static_cast<std::size_t>(disc.count), {bound, 0, false, disc.count});
    at += disc.count;
  }
  map_to_states(zero, out.pairs);
  return out;
}

}  // namespace dynalin
