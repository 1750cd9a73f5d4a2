#include "eigenvalues/eigen_residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/dense_products.h"
#include "eigenvalues/rounding.h"
#include "eigenvalues/uncertainty_along.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using ComplexVector = Eigen::VectorXcd;

constexpr double least_product = 1e-12;  // |yᴴ x| of |y|ᵀ|x|

// The part that a row may have in any column of unit length, at most.
Eigen::VectorXd largest_share(const Matrix& sizes) {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(sizes.rows());
  for (Index c = 0; c < sizes.cols(); ++c) {
    const double norm = sizes.col(c).norm();
    if (norm > 0) share = share.cwiseMax(sizes.col(c) / norm);
  }
  return share;
}

// y_iᴴ x_i: where they are nearly orthogonal the rounding of a sum in double would count.
ComplexVector products_of_pairs(const EigenPairs& pairs) {
  ComplexVector products(pairs.right.cols());
  for (Index i = 0; i < products.size(); ++i) {
    long double re = 0, im = 0;
    for (Index k = 0; k < pairs.right.rows(); ++k) {
      const std::complex<long double> x(pairs.right(k, i)), y(pairs.left(k, i));
      re += y.real() * x.real() + y.imag() * x.imag();
      im += y.real() * x.imag() - y.imag() * x.real();
    }
    products(i) = {static_cast<double>(re), static_cast<double>(im)};
  }
  return products;
}

}  // namespace

EigenResiduals::EigenResiduals(const StructuredPencil& pencil, const ZeroModes& zero, const EigenPairs& pairs)
    : pairs_(pairs), floor_(Eigen::VectorXd::Zero(pairs.right.cols())) {
  unit_ = products_of_pairs(pairs);
  const Matrix right = pairs.right.cwiseAbs(), left = pairs.left.cwiseAbs();
  const Eigen::VectorXd sums = left.cwiseProduct(right).colwise().sum().transpose();
  complete_ = right.allFinite() && left.allFinite() && (unit_.cwiseAbs().array() > least_product * sums.array()).all();
  if (!complete_) return;
  BothProducts products = both_products(pairs.left, pairs.right);
  product_ = std::move(products.adjoint), product_conjugate_ = std::move(products.transposed);
  row_floor_.resize(count(), 3), column_floor_.resize(count(), 3);
  const ComplexVector of_unit = unit_.cwiseInverse();
  const double rounding = static_cast<double>(pairs.right.rows()) * eps;
  product_rounding_ = rounding * of_unit.cwiseAbs().asDiagonal() * transposed_product(left, right);
  uncertain_ = of_unit.cwiseAbs().asDiagonal() * uncertainty_along(pencil, pairs);
  const ComplexMatrix reduced = measure(pencil);
  const auto in_units = [&](ComplexMatrix& plain, ComplexMatrix& crossed) {
    plain = of_unit.asDiagonal() * plain;
    crossed = of_unit.conjugate().asDiagonal() * crossed;
  };
  products = both_products(pairs.left, reduced);
  along_ = std::move(products.adjoint), along_conjugate_ = std::move(products.transposed);
  in_units(along_, along_conjugate_);
  in_units(product_, product_conjugate_);
  measure_floors(pencil, reduced);
  measure_zero_modes(pencil, zero, reduced);
}

// The residuals reduced to the states, and in floor_ what their own sums round.
ComplexMatrix EigenResiduals::measure(const StructuredPencil& pencil) {
  const PerturbationEquations& equations = pencil.equations();
  const Index n = equations.states(), N = equations.unknowns();
  ComplexMatrix reduced(n, count());
  rounding_share_ = Eigen::VectorXd::Zero(N);
  left_shares_.resize(N - n, count()), left_units_.resize(count());
  std::mutex sharing;
  for_column_blocks(count(), [&](Index first, Index columns) {
    Eigen::VectorXd rounding_share = Eigen::VectorXd::Zero(N);
    const ComplexMatrix x = pairs_.right.middleCols(first, columns), y = pairs_.left.middleCols(first, columns);
    const ComplexMatrix a = by_parts(x, [&](const Matrix& m) { return equations.complete(m); });
    const ComplexMatrix b = by_parts(y, [&](const Matrix& m) { return equations.complete_left(m); });
    ComplexMatrix r(N, columns);
    for (Index c = 0; c < columns; ++c) {
      const Eigen::VectorXd of_b = b.col(c).cwiseAbs();
      const double largest = of_b.size() > 0 ? of_b.maxCoeff() : 0;
      left_units_(first + c) = largest;
      left_shares_.col(first + c) = (largest > 0 ? Eigen::VectorXd(of_b / largest) : of_b).cast<float>();
      ComplexVector w(N);
      w << a.col(c), x.col(c);
      const PencilResidual of = pencil.residual(value(pairs_, {first + c, false}), w);
      r.col(c) = of.value;
      floor_(first + c) = of_b.dot(of.rounding.head(b.rows())) + y.col(c).cwiseAbs().dot(of.rounding.tail(n));
      if (pencil.zero_residuals().cols() > 0) {
        const ComplexVector out = pencil.taken_out(w);
        floor_(first + c) +=
            first_order_margin * std::abs(b.col(c).dot(out.head(b.rows())) + y.col(c).dot(out.tail(n)));
      }
      const double norm = of.rounding.norm();
      column_floor_(first + c, 0) = norm;
      if (norm > 0) rounding_share = rounding_share.cwiseMax(of.rounding / norm);
    }
    {
      const std::lock_guard lock(sharing);
      rounding_share_ = rounding_share_.cwiseMax(rounding_share);
    }
    reduced.middleCols(first, columns) = by_parts(r, [&](const Matrix& m) { return equations.reduced(m); });
    for (Index c = 0; c < columns; ++c) {
      const Complex other = b.col(c).dot(r.col(c).head(b.rows())) + y.col(c).dot(r.col(c).tail(n));
      const double off = std::abs(other - y.col(c).dot(reduced.col(first + c)));
      const double sum = y.col(c).cwiseAbs().dot(reduced.col(first + c).cwiseAbs());
      floor_(first + c) += margin_of_difference * off + static_cast<double>(N) * eps * sum;
      floor_(first + c) = floor_(first + c) / std::abs(unit_(first + c)) + uncertain_(first + c, first + c);
      column_floor_(first + c, 1) = sum > 0 ? off / sum : 0;
    }
  });
  return reduced;
}

// Off the diagonal products of a share of the row and one of the column bound Σ_r |y_ri| δ_rj: those of the rounding of
// the residuals, of their sums, and of P E.
void EigenResiduals::measure_floors(const StructuredPencil& pencil, const ComplexMatrix& reduced) {
  const Index n = pencil.equations().states();
  const double relative = margin_of_difference * column_floor_.col(1).maxCoeff() + static_cast<double>(n) * eps;
  const Eigen::VectorXd sum_share = largest_share(reduced.cwiseAbs());
  const Index algebraic = left_shares_.rows();
  for (Index i = 0; i < count(); ++i) {
    const double unit = std::abs(unit_(i));
    const Eigen::VectorXd y = pairs_.left.col(i).cwiseAbs();
    const double shares = left_shares_.col(i).cast<double>().dot(rounding_share_.head(algebraic));
    row_floor_(i, 0) = (upward_from_single * left_units_(i) * shares + y.dot(rounding_share_.tail(n))) / unit;
    row_floor_(i, 1) = y.dot(sum_share) / unit;
  }
  left_shares_.resize(0, 0);
  for (Index j = 0; j < count(); ++j) column_floor_(j, 1) = relative * reduced.col(j).norm();
  row_floor_.col(2).setZero(), column_floor_.col(2).setZero();
  // E = G − P E: with column sums of |P| below a quarter, those of |E| are at most those of |G| and a third.
  Eigen::VectorXd of_p = Eigen::VectorXd::Zero(count()), of_g = of_p;
  for (Index i = 0; i < count(); ++i) {
    for_others(i, [&](const Member& j) {
      const double share = std::abs(p({i, false}, j)) + product_rounding_(i, j.at);
      row_floor_(i, 2) = std::max(row_floor_(i, 2), share);
      of_p(j.at) += share;
      of_g(j.at) += std::abs(g({i, false}, j)) + floor(i, j.at);
    });
    of_g(i) += std::abs(g({i, false}, {i, false})) + floor_(i);
  }
  // Of pairs the rows of the conjugates are the same with columns exchanged: their sums are within twice these.
  if (!(of_p.maxCoeff() <= 0.125)) complete_ = false;
  column_floor_.col(2) = (2 * 4.0 / 3) * of_g;
  for (Index i = 0; i < count(); ++i) {
    const Member me{i, false};
    double mixed = 0;
    for_others(i, [&](const Member& j) {
      const double onto = std::abs(g(j, me)) + floor(j.at, i);
      mixed += (std::abs(p(me, j)) + product_rounding_(i, j.at)) * onto;
    });
    floor_(i) += mixed;
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
  const ComplexMatrix along_zero = adjoint_product(pairs_.left, T0.cast<Complex>());
  // Dual to the zero modes: the upper rows of T⁻¹ less what belongs to the other modes.
  const ComplexMatrix dual = pencil.zero_shares().cast<Complex>();
  const ComplexMatrix U = dual * pairs_.right, onto = dual * reduced;
  for (Index i = 0; i < count(); ++i) {
    const Member me{i, false};
    ComplexVector to_zero = onto.col(i);
    for (Index j = 0; j < count(); ++j) {
      to_zero -= U.col(j) * g({j, false}, me);
      if (!pairs_.real(j)) to_zero -= U.col(j).conjugate() * g({j, true}, me);
    }
    ComplexMatrix shifted = -chains.cast<Complex>();
    shifted.diagonal().array() += value(pairs_, me);
    const ComplexVector through = shifted.triangularView<Eigen::Upper>().solve(to_zero);
    if (!through.allFinite()) {  // nothing tells a value of zero from those of the structure
      zero_coupling_(i) = std::numeric_limits<double>::infinity();
      continue;
    }
    zero_share_.col(i) = T0 * through;
    zero_coupling_(i) = from_zero.row(i).cwiseAbs().dot(through.cwiseAbs()) / std::abs(unit_(i));
    // What the left vector is off from one that does not see the zero modes.
    floor_(i) += along_zero.row(i).cwiseAbs().dot(to_zero.cwiseAbs()) / std::abs(unit_(i));
  }
}

}  // namespace dynalin
