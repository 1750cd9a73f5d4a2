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

// The pencil and what each of its entries may be off, term by term.
template <class Phased>
class PencilMeasurement {
 public:
  PencilMeasurement(const Phased& as, const PerturbationEquations& equations, const ShiftInverse& op,
                    const Subspace& of)
      : as_(as),
        equations_(equations),
        op_(op),
        of_(of),
        n_(equations.states()),
        p_(of.X.cols()),
        algebraic_(equations.unknowns() - n_),
        left_(left_residuals(equations, as)),
        rows_(transposed(equations.products())),
        G_(p_, p_),
        between_(p_, p_),
        size_of_right_(p_) {}

  SubspacePencil run(double distance, double reach) {
    out_.uncertainty.resize(p_, p_), out_.unknown.resize(p_, p_), out_.residual.resize(n_, p_);
    for_few_columns<S>(n_ + algebraic_, p_, [&](Index first, Index count) { measure_columns(first, count); });
    out_.uncertainty += long_eps * (of_.B.cwiseAbs() + G_.cwiseAbs());
    out_.value = of_.B.cast<std::complex<long double>>() + G_.cast<std::complex<long double>>();
    add_defect_of_bases();
    if constexpr (!is_real<S>) {
      if (of_.V.cols() > 0) add_residuals_of_zeros();
    }
    add_rest_of_model(distance, reach);
    out_.uncertainty = upward_from_single * (out_.uncertainty + out_.unknown);
    return std::move(out_);
  }

 private:
  using S = typename Phased::Scalar;

  ColumnsOf<S> completed(const ColumnsOf<S>& x) const {
    return all_unknowns<ColumnsOf<S>>(as_.mapped(x, [&](const Matrix& m) { return equations_.complete(m); }), x);
  }

  // Yᴴ R, R and what they make of the rest of the model.
  void measure_columns(Index first, Index count) {
    Residuals<S> right;
    Matrix variances;
    {
      const ColumnsOf<S> w = completed(as_.X().middleCols(first, count));
      right = residuals(as_, rows_, w, as_.U(), as_.onto().middleCols(first, count).eval());
      variances = equations_.rounding_variances(w);
    }
    right.rounding += static_cast<double>(n_ + algebraic_) * eps * sizes(right.value);
    const auto by_left = left_.y.weigh(right.value, right.rounding, variances);
    right.rounding.resize(0, 0), variances.resize(0, 0);
    const ColumnsOf<S> reduced =
        as_.mapped(right.value, [&](Matrix m) { return equations_.reduced(std::move(m), SparseLu::Refined::no); });
    // Two ways to the same: their difference shows what the factors, and y in few digits, have left.
    const ComplexMatrix of_block = as_.projected(reduced);
    G_.middleCols(first, count) = of_block;
    out_.uncertainty.middleCols(first, count) =
        by_left.rounding + margin_of_difference * (as_.product_of_residual(by_left.product) - of_block).cwiseAbs();
    out_.unknown.middleCols(first, count) = by_left.deviation;
    out_.residual.middleCols(first, count) = as_.right_residual(reduced);
    // What goes through the rest of the model: (S − σ E)⁻¹ by (A − σ)⁻¹, with the algebraic unknowns taken out on both
    // sides.
    const Eigen::VectorXd& unit = op_.units();
    ComplexMatrix R = unit.cwiseInverse().asDiagonal() * out_.residual.middleCols(first, count);
    op_.apply(R);
    R = (unit.asDiagonal() * R).eval();
    R -= of_.X * (of_.Y.adjoint() * R).eval();
    size_of_right_.segment(first, count) = (unit.cwiseInverse().asDiagonal() * R).colwise().norm();
    between_.middleCols(first, count) =
        left_.products(right.value.topRows(algebraic_)) + adjoint_product(left_.of_states, R).cwiseAbs();
  }

  // Yᴴ X and Yᴴ V as computed.
  void add_defect_of_bases() {
    const Index z = of_.V.cols();
    ComplexMatrix off(p_, p_ + z);
    off << adjoint_product(of_.Y, of_.X), adjoint_product(of_.Y, of_.V.cast<Complex>());
    off.leftCols(p_).diagonal().array() -= 1.0;
    Matrix of_sizes(p_, p_ + z);
    of_sizes << sizes_product(of_.Y, of_.X.cwiseAbs()), sizes_product(of_.Y, of_.V.cwiseAbs());
    const Matrix defect = off.cwiseAbs() + static_cast<double>(n_) * eps * of_sizes;
    out_.uncertainty += 1.1 * defect.leftCols(p_) * G_.cwiseAbs();
  }

  // The equations hold the zeros to rounding only: to first order Yᴴ (A V − V N)(λ − N)⁻¹ C.
  void add_residuals_of_zeros() {
    const ComplexMatrix of_zero = of_.V.cast<Complex>();
    const Residuals<S> zero = residuals(as_, rows_, completed(of_zero), of_zero, of_.N.cast<Complex>().eval());
    const Matrix from_zero = left_.y.adjoint_times(zero.value).cwiseAbs();
    Matrix through(of_.V.cols(), p_);
    for (Index j = 0; j < p_; ++j) {
      ComplexMatrix shifted = -of_.N.cast<Complex>();
      shifted.diagonal().array() += of_.B(j, j);
      through.col(j) = shifted.partialPivLu().solve(of_.C.col(j)).cwiseAbs();
    }
    out_.uncertainty += first_order_margin * (from_zero * through);
  }

  // Lᴴ (z − A_c)⁻¹ R
  void add_rest_of_model(double distance, double reach) {
    // One column after the other: the rest of the way is made beside it.
    double beside = 0;
    Eigen::VectorXd size_of_left(p_);
    in_parallel(2, [&](std::size_t task) {
      if (task == 0) {
        beside = norm_beside(op_, of_.X, of_.Y);
      } else {
        size_of_left = left_sizes(op_, of_, left_.of_states);
      }
    });
    const double amplified = 1 + margin_of_norms * reach * std::max(beside, largest_condition() / distance);
    out_.uncertainty += between_ + reach * amplified * size_of_left * size_of_right_.transpose();
  }

  // 1/distance is the resolvent of a normal matrix. The units of the operator are those of modes near its shift: of far
  // lower ones rates and positions are so unlike in them that a pair of others, or a zero in a chain, makes more of
  // what it is given, by no more than the condition of the modes in the subspace.
  double largest_condition() const {
    const Eigen::VectorXd& unit = op_.units();
    double largest = 1;
    for (Index j = 0; j < p_; ++j) {
      const double of_right = of_.X.col(j).cwiseQuotient(unit).norm(), of_left = of_.Y.col(j).cwiseProduct(unit).norm();
      largest = std::max(largest, of_right * of_left);
    }
    return largest;
  }

  const Phased& as_;
  const PerturbationEquations& equations_;
  const ShiftInverse& op_;
  const Subspace& of_;
  const Index n_, p_, algebraic_;  // states, vectors, unknowns beside the states
  const LeftResiduals<S> left_;
  const ColumnMatrix rows_;
  ComplexMatrix G_;  // Yᴴ R
  Matrix between_;
  Eigen::VectorXd size_of_right_;
  SubspacePencil out_;
};

}  // namespace

SubspacePencil measured(const PerturbationEquations& equations, const ShiftInverse& op, const Subspace& of,
                        double distance, double reach) {
  // Factors of a conservative model say that it is one.
  const auto real = op.symmetric() ? RealSubspace::of(of) : std::nullopt;
  if (real) return PencilMeasurement(*real, equations, op, of).run(distance, reach);
  return PencilMeasurement(ComplexSubspace(of), equations, op, of).run(distance, reach);
}

}  // namespace dynalin
