#include "linear/subspace_pencil.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "base/parallel.h"
#include "linear/dense_products.h"
#include "linear/rounding.h"
#include "linear/transposed.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using ComplexVector = Eigen::VectorXcd;

// The norms of what the operator does beside the subspace are estimates.
constexpr double margin_of_norms = 10;

ComplexMatrix with_algebraic(const ComplexMatrix& algebraic, const ComplexMatrix& states) {
  ComplexMatrix all(algebraic.rows() + states.rows(), states.cols());
  all << algebraic, states;
  return all;
}

struct Residuals {
  ComplexMatrix value;
  Matrix rounding;  // no columns if it is not asked for
};
enum class Rounding : bool { left_out, wanted };

// Sum of real factors with complex numbers, in long double.
struct LongSum {
  long double re = 0, im = 0;
  double size = 0, terms = 2;

  void add(double factor, Complex v) {
    if (v == 0.0) return;
    re += static_cast<long double>(factor) * static_cast<long double>(v.real());
    im += static_cast<long double>(factor) * static_cast<long double>(v.imag());
    size += std::abs(factor) * (std::abs(v.real()) + std::abs(v.imag()));
    ++terms;
  }
  void subtract(Complex a, Complex b) {
    if (a == 0.0 || b == 0.0) return;
    const long double ar = a.real(), ai = a.imag(), br = b.real(), bi = b.imag();
    re -= ar * br - ai * bi;
    im -= ar * bi + ai * br;
    size += 2 * (std::abs(a.real()) + std::abs(a.imag())) * (std::abs(b.real()) + std::abs(b.imag()));
    terms += 2;
  }
};

// M w − E U F column by column, given the rows of M: the states of U stand in the last places.
Residuals residuals(const ColumnMatrix& rows, const Eigen::Ref<const ComplexMatrix>& w, const ComplexMatrix& U,
                    const ComplexMatrix& F, Rounding rounding = Rounding::wanted) {
  const Index size = w.rows(), first_state = size - U.rows();
  Residuals r{ComplexMatrix(size, w.cols()), Matrix(size, rounding == Rounding::wanted ? w.cols() : 0)};
  for (Index c = 0; c < w.cols(); ++c) {
    for (Index k = 0; k < size; ++k) {
      LongSum sum;
      for_each_in_column(rows, static_cast<std::int32_t>(k),
                         [&](std::int32_t from, double v) { sum.add(v, w(from, c)); });
      if (k >= first_state) {
        for (Index j = 0; j < F.rows(); ++j) sum.subtract(U(k - first_state, j), F(j, c));
      }
      r.value(k, c) = {static_cast<double>(sum.re), static_cast<double>(sum.im)};
      if (rounding == Rounding::wanted)
        r.rounding(k, c) = long_eps * sum.terms * sum.size + eps * std::abs(r.value(k, c));
    }
  }
  return r;
}

// The largest that (A_c − σ)⁻¹ makes of a vector of unit length, by power iteration in the units of the operator.
double norm_beside(const ShiftInverse& op, const ComplexMatrix& X, const ComplexMatrix& Y) {
  constexpr int steps = 6;
  const Eigen::VectorXd& unit = op.units();
  const ComplexMatrix right = unit.cwiseInverse().asDiagonal() * X, left = unit.asDiagonal() * Y;
  ComplexVector v = arbitrary_vector(op.states(), 7);
  double norm = 0;
  for (int s = 0; s < steps; ++s) {
    v -= right * (left.adjoint() * v);
    const double size = v.norm();
    if (!(size > 0)) return norm;
    v /= size;
    op.apply(v);
    v -= right * (left.adjoint() * v);
    norm = std::max(norm, v.norm());
    v -= left * (right.adjoint() * v);
    op.apply_adjoint(v);
    v -= left * (right.adjoint() * v);
  }
  return norm;
}

// Of (A_c − σ)⁻ᴴ L, column by column.
Eigen::VectorXd left_sizes(const ShiftInverse& op, const Subspace& of, const ComplexMatrix& of_states) {
  const Eigen::VectorXd& unit = op.units();
  Eigen::VectorXd size(of_states.cols());
  for_few_columns(of_states.rows(), of_states.cols(), [&](Index first, Index count) {
    ComplexMatrix L = unit.asDiagonal() * of_states.middleCols(first, count);
    op.apply_adjoint(L);
    L = (unit.cwiseInverse().asDiagonal() * L).eval();
    L -= of.Y * (of.X.adjoint() * L).eval();
    size.segment(first, count) = (unit.asDiagonal() * L).colwise().norm();
  });
  return size;
}

// visit(first, count) for all rows, so many at a time that a copy of them stays small.
template <class Visit>
void for_row_blocks(Index rows, Visit&& visit) {
  constexpr Index at_a_time = 4096;
  for (Index first = 0; first < rows; first += at_a_time) visit(first, std::min(at_a_time, rows - first));
}

// Not by hypot, which is slow: nothing here is near the limits of the numbers.
template <class Columns>
Matrix sizes(const Columns& a) {
  return a.cwiseAbs2().cwiseSqrt();
}

// |a|ᵀ b without a copy of a.
Matrix sizes_product(const ComplexMatrix& a, const Matrix& b) {
  Matrix sum = Matrix::Zero(a.cols(), b.cols());
  for_row_blocks(a.rows(), [&](Index first, Index count) {
    sum += transposed_product(sizes(a.middleRows(first, count)), b.middleRows(first, count));
  });
  return sum;
}

// Columns of which a few digits are enough, each in a unit of its own: half the memory.
class ShortColumns {
 public:
  ShortColumns(Index rows, Index columns) : re_(rows, columns), im_(rows, columns), unit_(columns) {}

  void set(Index first, const ComplexMatrix& columns) {
    for (Index c = 0; c < columns.cols(); ++c) {
      const double largest = columns.rows() > 0 ? columns.col(c).cwiseAbs2().maxCoeff() : 0.0;
      unit_(first + c) = largest > 0 ? std::sqrt(largest) : 1.0;
      re_.col(first + c) = (columns.col(c).real() / unit_(first + c)).cast<float>();
      im_.col(first + c) = (columns.col(c).imag() / unit_(first + c)).cast<float>();
    }
  }
  // Aᴴ b for the first rows of b.
  ComplexMatrix adjoint_times(const ComplexMatrix& b) const {
    ComplexMatrix sum = ComplexMatrix::Zero(re_.cols(), b.cols());
    for_row_blocks(re_.rows(), [&](Index first, Index rows) { add_product(first, b.middleRows(first, rows), sum); });
    return unit_.asDiagonal() * sum;
  }
  // Aᴴ b, |A|ᵀ `rounding_of_b`, and the root of the sum of |A|² `variance`.
  struct Weighed {
    ComplexMatrix product;
    Matrix rounding, deviation;
  };
  Weighed weigh(const ComplexMatrix& b, const Matrix& rounding_of_b, const Matrix& variance) const {
    const Index count = re_.cols(), columns = b.cols();
    Weighed sum{ComplexMatrix::Zero(count, columns), Matrix::Zero(count, columns), Matrix::Zero(count, columns)};
    for_row_blocks(re_.rows(), [&](Index first, Index rows) {
      add_product(first, b.middleRows(first, rows), sum.product);
      Matrix size = sizes_of_rows(first, rows).cast<double>();
      sum.rounding += transposed_product(size, rounding_of_b.middleRows(first, rows));
      size = size.cwiseAbs2();
      sum.deviation += transposed_product(size, variance.middleRows(first, rows));
    });
    sum.product = unit_.asDiagonal() * sum.product;
    sum.rounding = unit_.asDiagonal() * sum.rounding;
    sum.deviation = unit_.asDiagonal() * sum.deviation.cwiseSqrt();
    return sum;
  }

 private:
  void add_product(Index first, const ComplexMatrix& b, ComplexMatrix& sum) const {
    const Index columns = b.cols();
    Matrix parts(b.rows(), 2 * columns);
    parts << b.real(), b.imag();
    const auto times = [&](const Eigen::MatrixXf& a) {
      return transposed_product(a.middleRows(first, b.rows()).cast<double>(), parts);
    };
    const Matrix re = times(re_), im = times(im_);
    sum.real() += re.leftCols(columns) + im.rightCols(columns);
    sum.imag() += re.rightCols(columns) - im.leftCols(columns);
  }
  // |A|, whose squares would be beyond the range of these numbers.
  Eigen::ArrayXXf sizes_of_rows(Index first, Index rows) const {
    const Eigen::ArrayXXf re = re_.middleRows(first, rows).array().abs(),
                          im = im_.middleRows(first, rows).array().abs(),
                          larger = re.max(im).max(std::numeric_limits<float>::min());
    return larger * (1 + (re.min(im) / larger).square()).sqrt();
  }

  Eigen::MatrixXf re_, im_;
  Eigen::VectorXd unit_;
};

// All unknowns of the left vectors, and their residuals Aᴴ Y − Y Bᴴ with the algebraic unknowns taken out. Those of
// algebraic unknowns only meet other residuals, rounding of rounding: of them stands here what any column has at most,
// each in a unit of its own.
struct LeftResiduals {
  ShortColumns y;
  ComplexMatrix of_states;
  Eigen::VectorXd largest, unit;

  // Of products with residuals of algebraic unknowns, at most.
  Matrix products(const ComplexMatrix& of_algebraic) const {
    return unit * (largest.transpose() * sizes(of_algebraic));
  }
};

LeftResiduals left_residuals(const PerturbationEquations& equations, const Subspace& of) {
  const Index n = equations.states(), p = of.Y.cols(), algebraic = equations.unknowns() - n;
  LeftResiduals left{ShortColumns(n + algebraic, p), ComplexMatrix(n, p), Eigen::VectorXd::Zero(algebraic),
                     Eigen::VectorXd::Zero(p)};
  std::mutex of_largest;
  const ComplexMatrix onto = of.B.adjoint();
  for_few_columns(n + algebraic, p, [&](Index first, Index count) {
    auto L = left.of_states.middleCols(first, count);
    ComplexMatrix L_a;
    {
      const ComplexMatrix Y = of.Y.middleCols(first, count);
      const ComplexMatrix y =
          with_algebraic(by_parts(Y, [&](const Matrix& m) { return equations.complete_left(m); }), Y);
      left.y.set(first, y);
      const ComplexMatrix value =
          residuals(equations.products(), y, of.Y, onto.middleCols(first, count), Rounding::left_out).value;
      L = value.bottomRows(n);
      L_a = value.topRows(algebraic);
    }
    L_a = by_parts(L_a, [&](Matrix m) { return equations.solve_transposed(std::move(m)); });
    for (Index k = 0; k < n; ++k) {
      for_each_in_column(equations.by_states_and_inputs(), static_cast<std::int32_t>(k),
                         [&](std::int32_t r, double v) { L.row(k) -= v * L_a.row(r); });
    }
    Matrix each = sizes(L_a);
    for (Index c = 0; c < count; ++c) {
      double& unit = left.unit(first + c);
      if (algebraic > 0) unit = each.col(c).maxCoeff();
      if (!each.col(c).allFinite()) unit = std::numeric_limits<double>::infinity();
      if (unit > 0) each.col(c) /= unit;
    }
    const std::lock_guard lock(of_largest);
    left.largest = left.largest.cwiseMax(each.rowwise().maxCoeff());
  });
  return left;
}

}  // namespace

SubspacePencil measured(const PerturbationEquations& equations, const ShiftInverse& op, const Subspace& of,
                        double distance, double reach) {
  const Index n = equations.states(), p = of.X.cols(), z = of.V.cols(), algebraic = equations.unknowns() - n;
  const auto completed = [&](const ComplexMatrix& x) {
    return with_algebraic(by_parts(x, [&](const Matrix& m) { return equations.complete(m); }), x);
  };
  const LeftResiduals left = left_residuals(equations, of);
  ComplexMatrix with_zeros, F(p + z, p);
  if (z > 0) with_zeros.resize(n, p + z), with_zeros << of.X, of.V.cast<Complex>();
  const ComplexMatrix& U = z > 0 ? with_zeros : of.X;
  F << of.B, of.C;
  const ColumnMatrix rows = transposed(equations.products());
  const Eigen::VectorXd& unit = op.units();

  ComplexMatrix G(p, p);
  Matrix between(p, p);
  Eigen::VectorXd size_of_right(p), size_of_left(p);
  SubspacePencil out;
  out.uncertainty.resize(p, p), out.unknown.resize(p, p), out.residual.resize(n, p);
  for_few_columns(n + algebraic, p, [&](Index first, Index count) {
    Residuals right;
    Matrix variances;
    {
      const ComplexMatrix w = completed(of.X.middleCols(first, count));
      right = residuals(rows, w, U, F.middleCols(first, count));
      variances = equations.rounding_variances(w);
    }
    right.rounding += static_cast<double>(n + algebraic) * eps * sizes(right.value);
    const ShortColumns::Weighed by_left = left.y.weigh(right.value, right.rounding, variances);
    right.rounding.resize(0, 0), variances.resize(0, 0);
    auto reduced = out.residual.middleCols(first, count);
    reduced = by_parts(right.value, [&](Matrix m) { return equations.reduced(std::move(m), SparseLu::Refined::no); });
    // Two ways to the same: their difference shows what the factors, and y in few digits, have left.
    const ComplexMatrix of_block = adjoint_product(of.Y, reduced);
    G.middleCols(first, count) = of_block;
    out.uncertainty.middleCols(first, count) =
        by_left.rounding + margin_of_difference * (by_left.product - of_block).cwiseAbs();
    out.unknown.middleCols(first, count) = by_left.deviation;
    // What goes through the rest of the model: (S − σ E)⁻¹ by (A − σ)⁻¹, with the algebraic unknowns taken out on both
    // sides.
    ComplexMatrix R = unit.cwiseInverse().asDiagonal() * reduced;
    op.apply(R);
    R = (unit.asDiagonal() * R).eval();
    R -= of.X * (of.Y.adjoint() * R).eval();
    size_of_right.segment(first, count) = (unit.cwiseInverse().asDiagonal() * R).colwise().norm();
    between.middleCols(first, count) =
        left.products(right.value.topRows(algebraic)) + adjoint_product(left.of_states, R).cwiseAbs();
  });
  out.uncertainty += long_eps * (of.B.cwiseAbs() + G.cwiseAbs());
  out.value = of.B.cast<std::complex<long double>>() + G.cast<std::complex<long double>>();
  // Yᴴ X and Yᴴ V as computed.
  ComplexMatrix off = adjoint_product(of.Y, U);
  off.leftCols(p).diagonal().array() -= 1.0;
  const Matrix defect = off.cwiseAbs() + static_cast<double>(n) * eps * sizes_product(of.Y, U.cwiseAbs());
  out.uncertainty += 1.1 * defect.leftCols(p) * G.cwiseAbs();
  if (z > 0) {
    // The equations hold the zeros to rounding only: to first order Yᴴ (A V − V N)(λ − N)⁻¹ C.
    ComplexMatrix of_zero = of.V.cast<Complex>();
    const Residuals zero = residuals(rows, completed(of_zero), of_zero, of.N.cast<Complex>());
    const Matrix from_zero = left.y.adjoint_times(zero.value).cwiseAbs();
    Matrix through(z, p);
    for (Index j = 0; j < p; ++j) {
      ComplexMatrix shifted = -of.N.cast<Complex>();
      shifted.diagonal().array() += of.B(j, j);
      through.col(j) = shifted.partialPivLu().solve(of.C.col(j)).cwiseAbs();
    }
    out.uncertainty += first_order_margin * (from_zero * through);
  }

  // One column after the other: the rest of the way is made beside it.
  double beside = 0;
  in_parallel(2, [&](std::size_t task) {
    if (task == 0) {
      beside = norm_beside(op, of.X, of.Y);
    } else {
      size_of_left = left_sizes(op, of, left.of_states);
    }
  });
  const double amplified = 1 + margin_of_norms * reach * std::max(beside, 1 / distance);
  out.uncertainty += between + reach * amplified * size_of_left * size_of_right.transpose();
  out.uncertainty = upward_from_single * (out.uncertainty + out.unknown);
  return out;
}

}  // namespace dynalin
