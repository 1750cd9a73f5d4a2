#include "perturbation/perturbation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/dense_products.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

std::span<const double> column(const Eigen::Ref<const Matrix>& x, Eigen::Index c) {
  return {x.data() + c * x.outerStride(), static_cast<std::size_t>(x.rows())};
}
std::span<double> column(Eigen::Ref<Matrix>& x, Eigen::Index c) {
  return {x.data() + c * x.outerStride(), static_cast<std::size_t>(x.rows())};
}

// y += factor · M x for sparse M and dense x.
void multiply_add(const ColumnMatrix& m, const Eigen::Ref<const Matrix>& x, Eigen::Ref<Matrix> y, double factor) {
  for (Eigen::Index c = 0; c < x.cols(); ++c) m.multiply_add(column(x, c), column(y, c), factor);
}

// y += factor · Mᵀ x
void multiply_transposed_add(const ColumnMatrix& m, const Eigen::Ref<const Matrix>& x, Eigen::Ref<Matrix> y,
                             double factor) {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    for (std::int32_t k = 0; k < m.columns; ++k) {
      double sum = 0;
      for_each_in_column(m, k, [&](std::int32_t r, double v) { sum += v * x(r, c); });
      y(k, c) += factor * sum;
    }
  }
}

}  // namespace

PerturbationEquations PerturbationEquations::of_state_matrix(const Matrix& A) {
  PerturbationEquations p;
  p.states_ = static_cast<std::int32_t>(A.rows());
  std::vector<Triplet> entries;
  for (std::int32_t c = 0; c < p.states_; ++c) {
    for (std::int32_t r = 0; r < p.states_; ++r) {
      if (A(r, c) != 0.0) entries.push_back({r, c, A(r, c)});
    }
  }
  p.products_ = p.state_rates_on_states_ = compressed(p.states_, p.states_, entries);
  const ColumnMatrix none = compressed(0, 0, {});
  auto lu = std::make_shared<SparseLu>();
  lu->factor(none);
  p.level_.fill(lu);
  p.rates_on_positions_ = p.augmented_on_positions_ = p.augmented_on_rates_ = none;
  p.on_states_ = compressed(0, p.states_, {});
  p.state_rates_on_algebraic_ = compressed(p.states_, 0, {});
  p.roundings_ = p.products_;
  for (double& v : p.roundings_.value) v = std::abs(v);
  return p;
}

void PerturbationEquations::solve_levels(Eigen::Ref<Matrix> b, SparseLu::Refined refined) const {
  if (whole_) return whole_->solve(b, refined);
  level_[0]->solve(b.topRows(n_), refined);
  multiply_add(rates_on_positions_, b.topRows(n_), b.middleRows(n_, n_), -1.0);
  level_[1]->solve(b.middleRows(n_, n_), refined);
  multiply_add(augmented_on_positions_, b.topRows(n_), b.bottomRows(augmented_size_), -1.0);
  multiply_add(augmented_on_rates_, b.middleRows(n_, n_), b.bottomRows(augmented_size_), -1.0);
  level_[2]->solve(b.bottomRows(augmented_size_), refined);
}

Matrix PerturbationEquations::complete(const Matrix& x, SparseLu::Refined refined) const {
  Matrix a = Matrix::Zero(algebraic_, x.cols());
  Matrix padded = Matrix::Zero(on_states_.columns, x.cols());
  padded.topRows(x.rows()) = x;
  multiply_add(on_states_, padded, a, -1.0);
  solve_levels(a, refined);
  return a;
}

Eigen::MatrixXcd PerturbationEquations::motions(const Eigen::MatrixXcd& x) const {
  return by_parts(x, [&](const Matrix& real) -> Matrix {
    if (whole_) return complete(real).topRows(2 * n_);
    Matrix a = Matrix::Zero(2 * n_, real.cols());
    for (Eigen::Index c = 0; c < real.cols(); ++c) {
      for (std::int32_t k = 0; k < states_; ++k) {
        for_each_in_column(on_states_, k, [&](std::int32_t r, double v) {
          if (r < 2 * n_) a(r, c) -= v * real(k, c);
        });
      }
    }
    level_[0]->solve(a.topRows(n_));
    multiply_add(rates_on_positions_, a.topRows(n_), a.bottomRows(n_), -1.0);
    level_[1]->solve(a.bottomRows(n_));
    return a;
  });
}

Matrix PerturbationEquations::complete_left(const Matrix& y) const {
  Matrix a = Matrix::Zero(algebraic_, y.cols());
  multiply_transposed_add(state_rates_on_algebraic_, y, a, -1.0);
  return solve_transposed(std::move(a));
}

Matrix PerturbationEquations::solve_transposed(Matrix a) const {
  if (whole_) {
    whole_->solve_transposed(a);
    return a;
  }
  // Of right-hand sides on the coordinates alone the upper levels have nothing.
  if (!a.bottomRows(augmented_size_).isZero(0)) {
    level_[2]->solve_transposed(a.bottomRows(augmented_size_));
    multiply_transposed_add(augmented_on_rates_, a.bottomRows(augmented_size_), a.middleRows(n_, n_), -1.0);
    multiply_transposed_add(augmented_on_positions_, a.bottomRows(augmented_size_), a.topRows(n_), -1.0);
  }
  if (!a.middleRows(n_, n_).isZero(0)) {
    level_[1]->solve_transposed(a.middleRows(n_, n_));
    multiply_transposed_add(rates_on_positions_, a.middleRows(n_, n_), a.topRows(n_), -1.0);
  }
  level_[0]->solve_transposed(a.topRows(n_));
  return a;
}

Matrix PerturbationEquations::reduced(Matrix residuals, SparseLu::Refined refined) const {
  auto a = residuals.topRows(algebraic_);
  solve_levels(a, refined);
  Matrix r = residuals.bottomRows(states_);
  multiply_add(state_rates_on_algebraic_, a, r, -1.0);
  return r;
}

Matrix PerturbationEquations::state_matrices(const Matrix& a) const {
  const Eigen::Index columns = a.cols(), inputs = columns - states_;
  Matrix rates = Matrix::Zero(states_, columns);
  multiply_add(state_rates_on_algebraic_, a, rates, 1.0);
  multiply_add(state_rates_on_states_, Matrix::Identity(states_, columns), rates, 1.0);
  // Residuals of all equations at (a, x, x′) as computed.
  for_column_blocks(columns, [&](Eigen::Index first, Eigen::Index count) {
    std::vector<long double> sum(static_cast<std::size_t>(unknowns()));
    const auto add = [&](const ColumnMatrix& m, std::int32_t column, long double factor) {
      for_each_in_column(m, column, [&](std::int32_t row, double v) {
        sum[static_cast<std::size_t>(row)] += factor * static_cast<long double>(v);
      });
    };
    Matrix residual(unknowns(), count);
    for (Eigen::Index c = first; c < first + count; ++c) {
      std::fill(sum.begin(), sum.end(), 0.0L);
      for (std::int32_t k = 0; k < algebraic_; ++k) {
        if (a(k, c) != 0.0) add(products_, k, static_cast<long double>(a(k, c)));
      }
      if (c < columns - inputs) {
        add(products_, algebraic_ + static_cast<std::int32_t>(c), 1.0L);
      } else {
        add(on_states_, static_cast<std::int32_t>(c), 1.0L);
      }
      for (std::int32_t k = 0; k < unknowns(); ++k) {
        const long double rate = k < algebraic_ ? 0.0L : static_cast<long double>(rates(k - algebraic_, c));
        residual(k, c - first) = static_cast<double>(sum[static_cast<std::size_t>(k)] - rate);
      }
    }
    rates.middleCols(first, count) += reduced(std::move(residual));
  });
  return rates;
}

PerturbationEquations::Roundings PerturbationEquations::roundings(const Matrix& a, const ColumnMatrix& sizes) const {
  // Displacements keep their digits, one by one; rates are sums where the model moves or constraints hold rates alone.
  const bool rates_are_sums = whole_ || !rates_on_positions_.value.empty() || level_[1] != level_[0];
  const Eigen::Index first_row = whole_ ? 0 : rates_are_sums ? n_ : 2 * n_, rows = algebraic_ - first_row;
  Matrix adjoint(algebraic_, states_);
  for_column_blocks(states_, [&](Eigen::Index first, Eigen::Index count) {
    Matrix unit = Matrix::Zero(states_, count);
    unit.middleRows(first, count).setIdentity();
    adjoint.middleCols(first, count) = complete_left(unit).cwiseAbs();
  });
  // Rows without roundings take no part.
  std::vector<Eigen::Index> rounded;
  {
    std::vector<bool> any(static_cast<std::size_t>(unknowns()), false);
    for (const std::int32_t r : roundings_.row) any[static_cast<std::size_t>(r)] = true;
    for (Eigen::Index r = 0; r < algebraic_; ++r) {
      if (any[static_cast<std::size_t>(r)]) rounded.push_back(r);
    }
  }
  const TransposedFactor adjoint_of_sums(adjoint.bottomRows(rows)),
      adjoint_of_rounded(adjoint(rounded, Eigen::all).cwiseAbs2());
  adjoint.resize(0, 0);
  Matrix total(states_, states_), of_coefficients(states_, states_);
  ColumnMatrix squares = roundings_;
  for (double& v : squares.value) v *= v;
  const Eigen::Index summed = whole_ ? 3 * n_ : 2 * n_;  // differentiated balances are sums of accelerations as well
  for_column_blocks(states_, [&](Eigen::Index first, Eigen::Index count) {
    Matrix parts = Matrix::Zero(unknowns(), count), sums = parts;
    parts.topRows(algebraic_) = a.block(0, first, algebraic_, count).cwiseAbs();
    parts.bottomRows(states_).middleRows(first, count).setIdentity();
    multiply_add(squares, parts.cwiseAbs2(), sums, 1.0);
    of_coefficients.middleCols(first, count) =
        adjoint_of_rounded * sums(rounded, Eigen::all).eval() + sums.bottomRows(states_);
    parts.middleRows(summed, algebraic_ - summed).setZero();
    sums.setZero();
    multiply_add(sizes, parts, sums, 1.0);
    total.middleCols(first, count) =
        adjoint_of_sums * sums.middleRows(first_row, rows).eval() + sums.bottomRows(states_);
  });
  constexpr double unit = std::numeric_limits<double>::epsilon();
  return {units_of_rounding * unit * total, unit / 2 * of_coefficients.cwiseSqrt()};
}

template <class Columns>
Matrix PerturbationEquations::variances_of(const Columns& right) const {
  constexpr double half_unit = std::numeric_limits<double>::epsilon() / 2;
  Matrix sums = Matrix::Zero(unknowns(), right.cols());
  for (Eigen::Index c = 0; c < right.cols(); ++c) {
    for_each_entry(roundings_, [&](std::int32_t r, std::int32_t k, double v) {
      sums(r, c) += v * v * std::norm(half_unit * right(k, c));
    });
  }
  return sums;
}
Matrix PerturbationEquations::rounding_variances(const Eigen::MatrixXcd& right) const { return variances_of(right); }
Matrix PerturbationEquations::rounding_variances(const Matrix& right) const { return variances_of(right); }

}  // namespace dynalin
