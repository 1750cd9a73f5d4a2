#include "linear/eigen_residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense_products.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using ComplexVector = Eigen::VectorXcd;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double least_product = 1e-12;  // |yᴴ x| of unit vectors

}  // namespace

EigenResiduals::EigenResiduals(const StructuredPencil& pencil, const ZeroModes& zero, const EigenPairs& pairs)
    : pairs_(pairs), floor_(Eigen::VectorXd::Zero(pairs.right.cols())) {
  const ComplexMatrix reduced = measure(pencil);
  product_ = adjoint_product(pairs.left, pairs.right);
  product_conjugate_ = transposed_product(pairs.left, pairs.right);
  unit_ = product_.diagonal();
  find_defective(zero);
  for (Index i = 0; i < count(); ++i) {
    // The components are sums in double of residuals that are themselves rounding.
    floor_(i) += 1e-8 * pairs.left.col(i).cwiseAbs().dot(reduced.col(i).cwiseAbs());
    if (defective(i)) continue;
    floor_(i) /= std::abs(unit_(i));
  }
  const ComplexVector of_unit = unit_.unaryExpr([](const Complex& u) { return u == 0.0 ? u : 1.0 / u; });
  const auto in_units = [&](ComplexMatrix& plain, ComplexMatrix& crossed) {
    plain = of_unit.asDiagonal() * plain;
    crossed = of_unit.conjugate().asDiagonal() * crossed;
  };
  along_ = adjoint_product(pairs.left, reduced);
  along_conjugate_ = transposed_product(pairs.left, reduced);
  in_units(along_, along_conjugate_);
  in_units(product_, product_conjugate_);
  measure_zero_modes(pencil, zero, reduced);
}

// The residuals reduced to the states, and in floor_ what their own sums round.
ComplexMatrix EigenResiduals::measure(const StructuredPencil& pencil) {
  const PerturbationEquations& equations = pencil.equations();
  const Index n = equations.states(), N = equations.unknowns();
  ComplexMatrix reduced(n, count());
  for_column_blocks(count(), [&](Index first, Index columns) {
    const ComplexMatrix x = pairs_.right.middleCols(first, columns), y = pairs_.left.middleCols(first, columns);
    const ComplexMatrix a = by_parts(x, [&](const Matrix& m) { return equations.complete(m); });
    const ComplexMatrix b = by_parts(y, [&](const Matrix& m) { return equations.complete_left(m); });
    ComplexMatrix r(N, columns);
    for (Index c = 0; c < columns; ++c) {
      ComplexVector w(N);
      w << a.col(c), x.col(c);
      const PencilResidual of = pencil.residual(value(pairs_, {first + c, false}), w);
      r.col(c) = of.value;
      const ComplexVector out = pencil.taken_out(w);
      floor_(first + c) = b.col(c).cwiseAbs().dot(of.rounding.head(b.rows())) +
                          y.col(c).cwiseAbs().dot(of.rounding.tail(n)) +
                          first_order_margin * std::abs(b.col(c).dot(out.head(b.rows())) + y.col(c).dot(out.tail(n)));
    }
    reduced.middleCols(first, columns) = by_parts(r, [&](const Matrix& m) { return equations.reduced(m); });
  });
  return reduced;
}

void EigenResiduals::find_defective(const ZeroModes& zero) {
  defective_bound_ = Eigen::VectorXd::Zero(count());
  const double size = zero.block.norm(), change = 16 * eps * size;
  const auto orthogonal = [&](Index i) { return std::abs(unit_(i)) <= least_product; };
  for (Index i = 0; i < count(); ++i) {
    if (!orthogonal(i)) continue;
    int together = 0;
    const auto close = [&](const Member& j) {
      return std::abs(value(pairs_, {i, false}) - value(pairs_, j)) <= 1e-3 * size;
    };
    for (Index j = 0; j < count(); ++j) {
      if (!orthogonal(j)) continue;
      if (close({j, false})) ++together;
      if (!pairs_.real(j) && close({j, true})) ++together;
    }
    const double k = std::max(together, 2);
    defective_bound_(i) = std::pow(2 * size, 1 - 1 / k) * std::pow(change, 1 / k);
  }
}

void EigenResiduals::measure_zero_modes(const StructuredPencil& pencil, const ZeroModes& zero,
                                        const ComplexMatrix& reduced) {
  const Index z = zero.count, n = pencil.equations().states();
  zero_coupling_ = Eigen::VectorXd::Zero(count());
  zero_share_ = ComplexMatrix::Zero(n, count());
  if (z == 0 || count() == 0) return;
  const Matrix T0 = zero.right().leftCols(z), chains = zero.block.topLeftCorner(z, z);
  const ComplexMatrix from_zero =
      adjoint_product(pairs_.left, pencil.equations().reduced(pencil.zero_residuals()).cast<Complex>());
  // Dual to the zero modes: the upper rows of T⁻¹ less what belongs to the other modes.
  const ComplexMatrix dual = pencil.zero_shares().cast<Complex>();
  const ComplexMatrix U = dual * pairs_.right, onto = dual * reduced;
  for (Index i = 0; i < count(); ++i) {
    if (defective(i)) continue;
    const Member me{i, false};
    ComplexVector to_zero = onto.col(i);
    for (Index j = 0; j < count(); ++j) {
      if (defective(j)) continue;
      to_zero -= U.col(j) * g({j, false}, me);
      if (!pairs_.real(j)) to_zero -= U.col(j).conjugate() * g({j, true}, me);
    }
    ComplexMatrix shifted = -chains.cast<Complex>();
    shifted.diagonal().array() += value(pairs_, me);
    const ComplexVector through = shifted.triangularView<Eigen::Upper>().solve(to_zero);
    zero_share_.col(i) = T0 * through;
    zero_coupling_(i) = from_zero.row(i).cwiseAbs().dot(through.cwiseAbs()) / std::abs(unit_(i));
  }
}

}  // namespace dynalin
