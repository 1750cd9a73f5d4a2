#include "selected_modes/subspace_pencil.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "base/arbitrary_vector.h"
#include "base/dense_products.h"
#include "base/parallel.h"
#include "eigenvalues/rounding.h"
#include "eigenvalues/transposed.h"
#include "selected_modes/phased_subspace.h"
#include "selected_modes/short_columns.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using ComplexVector = Eigen::VectorXcd;

// The norms of what the operator does beside the subspace are estimates.
constexpr double margin_of_norms = 10;

template <class S>
struct Residuals {
  ColumnsOf<S> value;
  Matrix rounding;  // no columns if it is not asked for
};
enum class Rounding : bool { left_out, wanted };

// Sum of real factors with numbers, in long double.
template <class S>
struct LongSum;
template <>
struct LongSum<Complex> {
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
  Complex value() const { return {static_cast<double>(re), static_cast<double>(im)}; }
};
template <>
struct LongSum<double> {
  long double sum = 0;
  double size = 0, terms = 2;

  void add(double factor, double v) {
    if (v == 0.0) return;
    sum += static_cast<long double>(factor) * static_cast<long double>(v);
    size += std::abs(factor * v);
    ++terms;
  }
  void subtract(double a, double b) {
    if (a == 0.0 || b == 0.0) return;
    sum -= static_cast<long double>(a) * static_cast<long double>(b);
    size += 2 * std::abs(a * b);
    terms += 2;
  }
  double value() const { return static_cast<double>(sum); }
};

// M w − Σ U F column by column, given the rows of M: the states of U stand in the last places.
template <class Phased, class S = typename Phased::Scalar>
Residuals<S> residuals(const Phased& of, const ColumnMatrix& rows, const ColumnsOf<S>& w, const ColumnsOf<S>& U,
                       const ColumnsOf<S>& F, Rounding rounding = Rounding::wanted) {
  const Index size = w.rows(), first_state = size - U.rows();
  Residuals<S> r{ColumnsOf<S>(size, w.cols()), Matrix(size, rounding == Rounding::wanted ? w.cols() : 0)};
  for (Index c = 0; c < w.cols(); ++c) {
    for (Index k = 0; k < size; ++k) {
      LongSum<S> sum;
      for_each_in_column(rows, static_cast<std::int32_t>(k),
                         [&](std::int32_t from, double v) { sum.add(v, w(from, c)); });
      if (k >= first_state) {
        const double sign = of.sign(k - first_state);
        for (Index j = 0; j < F.rows(); ++j) sum.subtract(sign * U(k - first_state, j), F(j, c));
      }
      r.value(k, c) = sum.value();
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

// Not by hypot, which is slow: nothing here is near the limits of the numbers.
template <class Columns>
Matrix sizes(const Columns& a) {
  if constexpr (is_real<typename Columns::Scalar>) {
    return a.cwiseAbs();
  } else {
    return a.cwiseAbs2().cwiseSqrt();
  }
}

// |a|ᵀ b without a copy of a.
Matrix sizes_product(const ComplexMatrix& a, const Matrix& b) {
  Matrix sum = Matrix::Zero(a.cols(), b.cols());
  for_few_rows(a.rows(), [&](Index first, Index count) {
    sum += transposed_product(sizes(a.middleRows(first, count)), b.middleRows(first, count));
  });
  return sum;
}

// All unknowns of the left vectors, and their residuals Aᴴ Y − Y Bᴴ with the algebraic unknowns taken out. Those of
// algebraic unknowns only meet other residuals, rounding of rounding: of them stands here what any column has at most,
// each in a unit of its own.
template <class S>
struct LeftResiduals {
  ShortColumns<S> y;
  ComplexMatrix of_states;
  Eigen::VectorXd largest, unit;

  // Of products with residuals of algebraic unknowns, at most.
  Matrix products(const ColumnsOf<S>& of_algebraic) const { return unit * (largest.transpose() * sizes(of_algebraic)); }
};

template <class Phased, class S = typename Phased::Scalar>
LeftResiduals<S> left_residuals(const PerturbationEquations& equations, const Phased& of) {
  const Index n = equations.states(), p = of.Y().cols(), algebraic = equations.unknowns() - n;
  LeftResiduals<S> left{ShortColumns<S>(n + algebraic, p), ComplexMatrix(n, p), Eigen::VectorXd::Zero(algebraic),
                        Eigen::VectorXd::Zero(p)};
  std::mutex of_largest;
  for_few_columns<S>(n + algebraic, p, [&](Index first, Index count) {
    ColumnsOf<S> L, L_a;
    {
      const ColumnsOf<S> Y = of.Y().middleCols(first, count);
      const ColumnsOf<S> y =
          all_unknowns<ColumnsOf<S>>(of.mapped(Y, [&](const Matrix& m) { return equations.complete_left(m); }), Y);
      left.y.set(first, y);
      const ColumnsOf<S> value = residuals(of, equations.products(), y, of.Y(),
                                           of.left_onto().middleCols(first, count).eval(), Rounding::left_out)
                                     .value;
      L = value.bottomRows(n);
      L_a = value.topRows(algebraic);
    }
    L_a = of.mapped(std::move(L_a), [&](Matrix m) { return equations.solve_transposed(std::move(m)); });
    for (Index k = 0; k < n; ++k) {
      for_each_in_column(equations.by_states_and_inputs(), static_cast<std::int32_t>(k),
                         [&](std::int32_t r, double v) { L.row(k) -= v * L_a.row(r); });
    }
    left.of_states.middleCols(first, count) = of.left_residual(std::move(L));
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

template <class Phased>
SubspacePencil measured_as(const Phased& as, const PerturbationEquations& equations, const ShiftInverse& op,
                           const Subspace& of, double distance, double reach) {
  using S = typename Phased::Scalar;
  const Index n = equations.states(), p = of.X.cols(), z = of.V.cols(), algebraic = equations.unknowns() - n;
  const auto completed = [&](const ColumnsOf<S>& x) {
    return all_unknowns<ColumnsOf<S>>(as.mapped(x, [&](const Matrix& m) { return equations.complete(m); }), x);
  };
  const LeftResiduals<S> left = left_residuals(equations, as);
  const ColumnMatrix rows = transposed(equations.products());
  const Eigen::VectorXd& unit = op.units();

  ComplexMatrix G(p, p);
  Matrix between(p, p);
  Eigen::VectorXd size_of_right(p), size_of_left(p);
  SubspacePencil out;
  out.uncertainty.resize(p, p), out.unknown.resize(p, p), out.residual.resize(n, p);
  for_few_columns<S>(n + algebraic, p, [&](Index first, Index count) {
    Residuals<S> right;
    Matrix variances;
    {
      const ColumnsOf<S> w = completed(as.X().middleCols(first, count));
      right = residuals(as, rows, w, as.U(), as.onto().middleCols(first, count).eval());
      variances = equations.rounding_variances(w);
    }
    right.rounding += static_cast<double>(n + algebraic) * eps * sizes(right.value);
    const auto by_left = left.y.weigh(right.value, right.rounding, variances);
    right.rounding.resize(0, 0), variances.resize(0, 0);
    const ColumnsOf<S> reduced =
        as.mapped(right.value, [&](Matrix m) { return equations.reduced(std::move(m), SparseLu::Refined::no); });
    // Two ways to the same: their difference shows what the factors, and y in few digits, have left.
    const ComplexMatrix of_block = as.projected(reduced);
    G.middleCols(first, count) = of_block;
    out.uncertainty.middleCols(first, count) =
        by_left.rounding + margin_of_difference * (as.product_of_residual(by_left.product) - of_block).cwiseAbs();
    out.unknown.middleCols(first, count) = by_left.deviation;
    out.residual.middleCols(first, count) = as.right_residual(reduced);
    // What goes through the rest of the model: (S − σ E)⁻¹ by (A − σ)⁻¹, with the algebraic unknowns taken out on both
    // sides.
    ComplexMatrix R = unit.cwiseInverse().asDiagonal() * out.residual.middleCols(first, count);
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
  ComplexMatrix off(p, p + z);
  off << adjoint_product(of.Y, of.X), adjoint_product(of.Y, of.V.cast<Complex>());
  off.leftCols(p).diagonal().array() -= 1.0;
  Matrix of_sizes(p, p + z);
  of_sizes << sizes_product(of.Y, of.X.cwiseAbs()), sizes_product(of.Y, of.V.cwiseAbs());
  const Matrix defect = off.cwiseAbs() + static_cast<double>(n) * eps * of_sizes;
  out.uncertainty += 1.1 * defect.leftCols(p) * G.cwiseAbs();
  if constexpr (!is_real<S>) {
    if (z > 0) {
      // The equations hold the zeros to rounding only: to first order Yᴴ (A V − V N)(λ − N)⁻¹ C.
      const ComplexMatrix of_zero = of.V.cast<Complex>();
      const Residuals<S> zero = residuals(as, rows, completed(of_zero), of_zero, of.N.cast<Complex>().eval());
      const Matrix from_zero = left.y.adjoint_times(zero.value).cwiseAbs();
      Matrix through(z, p);
      for (Index j = 0; j < p; ++j) {
        ComplexMatrix shifted = -of.N.cast<Complex>();
        shifted.diagonal().array() += of.B(j, j);
        through.col(j) = shifted.partialPivLu().solve(of.C.col(j)).cwiseAbs();
      }
      out.uncertainty += first_order_margin * (from_zero * through);
    }
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

}  // namespace

SubspacePencil measured(const PerturbationEquations& equations, const ShiftInverse& op, const Subspace& of,
                        double distance, double reach) {
  // Factors of a conservative model say that it is one.
  const auto real = op.symmetric() ? RealSubspace::of(of) : std::nullopt;
  return real ? measured_as(*real, equations, op, of, distance, reach)
              : measured_as(ComplexSubspace(of), equations, op, of, distance, reach);
}

}  // namespace dynalin
