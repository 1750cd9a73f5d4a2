#include "linear/perturbation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense_products.h"
#include "linear/entry_sizes.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

// Roundings that the entries of the equations have picked up, in units of the last place of the sums made of them.
constexpr double rounding_units = 16;

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

ColumnMatrix transposed(const ColumnMatrix& m) {
  std::vector<Triplet> entries;
  entries.reserve(m.value.size());
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({c, r, v}); });
  return compressed(m.columns, m.rows, entries);
}

// Adds a block to the triplets of a larger matrix.
void place(std::vector<Triplet>& entries, const ColumnMatrix& m, std::int32_t row, std::int32_t column) {
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({row + r, column + c, v}); });
}

using Entries = std::vector<Triplet>;

// Entries of a block of the pencil, and in a list of all blocks the sizes of what they are made of.
class SizedBlock {
 public:
  SizedBlock(std::int32_t row, std::int32_t column, Entries& sizes) : row_(row), column_(column), sizes_(sizes) {}

  Entries values;
  void add(std::int32_t r, std::int32_t c, double value, double size) {
    if (value != 0.0) values.push_back({r, c, value});
    note_size(r, c, size);
  }
  void note_size(std::int32_t r, std::int32_t c, double size) {
    if (size > 0) sizes_.push_back({row_ + r, column_ + c, size});
  }

 private:
  std::int32_t row_, column_;
  Entries& sizes_;
};

}  // namespace

Result<PerturbationEquations> PerturbationEquations::make(const System& system, const Motion& motion,
                                                          const ConstraintRows& rows, const Equations& eq,
                                                          const StateChoice& choice,
                                                          const std::vector<std::int32_t>& inputs,
                                                          bool without_damping) {
  PerturbationEquations p;
  const Layout& layout = system.layout();
  const std::int32_t n = p.n_ = layout.coordinate_count;
  const Saddle saddle(system);
  p.saddle_size_ = saddle.size();
  p.algebraic_ = 2 * n + saddle.size();
  p.states_ = choice.size();
  std::vector<bool> cut(layout.algebraic.size(), false);
  for (const std::int32_t u : inputs) cut[static_cast<std::size_t>(u)] = true;

  // The diagonal of F.
  const std::vector<bool> every(choice.gradient.size(), true);
  std::array<ColumnMatrix, 3> diagonal;
  bool square = false;
  const auto factor = [&](std::size_t level) {
    auto lu = std::make_shared<SparseLu>();
    if (!lu->factor(diagonal[level])) return false;
    p.level_[level] = std::move(lu);
    return true;
  };
  diagonal[0] = level_matrix(rows, choice, choice.active, every, square);
  if (!square || !factor(0)) return tl::unexpected(undetermined_positions());
  if (choice.splits_unequally()) {
    diagonal[1] = level_matrix(rows, choice, choice.velocity_active, choice.has_rate, square);
    if (!square || !factor(1)) {
      return tl::unexpected(
          Failure{"linear analysis", "the chosen rates do not determine the velocities of the model", {}});
    }
  } else {
    diagonal[1] = diagonal[0];
    p.level_[1] = p.level_[0];
  }
  diagonal[2] = saddle.matrix(eq, rows, choice.velocity_active, {}, cut);
  if (!factor(2)) {
    return tl::unexpected(
        Failure{"linear analysis", "the accelerations are not determined", undetermined(system, saddle, diagonal[2])});
  }

  // What lies below it, and the columns of states and inputs.
  const std::int32_t first_saddle = 2 * n, first_state = p.algebraic_;
  const EntrySizes entry_sizes(layout, motion);
  Entries sizes;
  SizedBlock below_10(n, 0, sizes), below_20(first_saddle, 0, sizes), below_21(first_saddle, n, sizes),
      coordinates(0, 0, sizes), rates(n, n, sizes), states(0, first_state, sizes);
  std::int32_t held = 0, r = 0;
  const auto note_gradient = [](SizedBlock& block, std::int32_t at, const auto& row,
                                const std::vector<RowCoefficients>& size) {
    for (std::size_t e = 0; e < row.size(); ++e) block.note_size(at, row[e].column, size[e].g);
  };
  const auto add_rate_row = [&](const auto& row, const std::vector<RowCoefficients>& size) {
    for (std::size_t e = 0; e < row.size(); ++e) {
      below_10.add(r, row[e].column, row[e].c.v, size[e].v);
    }
    note_gradient(rates, r++, row, size);
  };
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const auto row = rows.row(k);
    const std::vector<RowCoefficients> size = entry_sizes.of_row(row);
    if (choice.active[static_cast<std::size_t>(k)]) note_gradient(coordinates, held++, row, size);
    if (!choice.velocity_active[static_cast<std::size_t>(k)]) continue;
    add_rate_row(row, size);
    for (std::size_t e = 0; e < row.size(); ++e) {
      below_21.add(saddle.lambda(k), row[e].column, row[e].c.a1, size[e].a1);
      below_20.add(saddle.lambda(k), row[e].column, row[e].c.a0, size[e].a0);
    }
  }
  for (std::size_t k = 0; k < choice.gradient.size(); ++k) {
    const auto& row = choice.gradient[k];
    const std::vector<RowCoefficients> size = entry_sizes.of_row(row);
    states.add(held, choice.position_state[k], -1.0, 1.0);
    note_gradient(coordinates, held++, row, size);
    if (!choice.has_rate[k]) continue;
    states.add(n + r, choice.rate_state[k], -1.0, 1.0);
    add_rate_row(row, size);
  }
  const auto add = [&](Column family, auto&& add_entry) {
    const ColumnMatrix& m = eq.matrix(family);
    const ColumnMatrix size = entry_sizes.of(eq, family);
    for (std::int32_t c = 0; c < m.columns; ++c) {
      for (std::int32_t e = m.start[static_cast<std::size_t>(c)]; e < m.start[static_cast<std::size_t>(c) + 1]; ++e) {
        const auto at = static_cast<std::size_t>(e);
        const std::int32_t w = m.row[at] - n;
        const bool replaced = w >= 0 && w < static_cast<std::int32_t>(cut.size()) && cut[static_cast<std::size_t>(w)];
        if (!replaced) add_entry(m.row[at], c, m.value[at], size.value[at]);
      }
    }
  };
  const auto to = [&](SizedBlock& block) {
    return
        [&](std::int32_t row, std::int32_t c, double v, double size) { block.add(saddle.equation(row), c, v, size); };
  };
  add(Column::position, to(below_20));
  add(Column::velocity, to(below_21));
  if (!without_damping) add(Column::damping, to(below_21));
  constexpr std::int32_t constant = -1;
  std::vector<std::int32_t> state_of(layout.states.size(), constant);
  for (std::size_t k = 0; k < choice.differential.size(); ++k) {
    state_of[static_cast<std::size_t>(choice.differential[k])] =
        choice.first_differential + static_cast<std::int32_t>(k);
  }
  add(Column::state, [&](std::int32_t row, std::int32_t c, double v, double size) {
    const std::int32_t state = state_of[static_cast<std::size_t>(c)];
    if (state != constant) states.add(first_saddle + saddle.equation(row), state, v, size);
  });
  for (std::size_t u = 0; u < inputs.size(); ++u) {
    states.add(first_saddle + saddle.algebraic(inputs[u]), p.states_ + static_cast<std::int32_t>(u), -1.0, 0.0);
  }
  p.rates_on_positions_ = compressed(n, n, below_10.values);
  p.saddle_on_positions_ = compressed(saddle.size(), n, below_20.values);
  p.saddle_on_rates_ = compressed(saddle.size(), n, below_21.values);
  p.on_states_ = compressed(p.algebraic_, p.states_ + static_cast<std::int32_t>(inputs.size()), states.values);

  // The rates of states.
  SizedBlock on_algebraic(first_state, 0, sizes), on_states(first_state, first_state, sizes);
  for (std::size_t k = 0; k < choice.gradient.size(); ++k) {
    const std::int32_t position = choice.position_state[k], rate = choice.rate_state[k];
    if (rate >= 0) on_states.add(position, rate, 1.0, 0.0);
    const auto& row = choice.gradient[k];
    const std::vector<RowCoefficients> size = entry_sizes.of_row(row);
    for (std::size_t e = 0; e < row.size(); ++e) {
      const auto& [c, g] = row[e];
      if (rate >= 0) {
        on_algebraic.add(rate, 2 * n + c, g.g, size[e].g);
        on_algebraic.add(rate, n + c, g.a1, size[e].a1);
        on_algebraic.add(rate, c, g.a0, size[e].a0);
      } else {
        on_algebraic.add(position, n + c, g.g, size[e].g);
        on_algebraic.add(position, c, g.v, size[e].v);
      }
    }
  }
  for (std::size_t k = 0; k < choice.differential.size(); ++k) {
    on_algebraic.add(choice.first_differential + static_cast<std::int32_t>(k),
                     2 * n + saddle.state(choice.differential[k]), 1.0, 1.0);
  }
  p.state_rates_on_algebraic_ = compressed(p.states_, p.algebraic_, on_algebraic.values);
  p.state_rates_on_states_ = compressed(p.states_, p.states_, on_states.values);
  p.sizes_ = compressed(p.unknowns(), p.unknowns(), sizes);

  Entries all;
  place(all, diagonal[0], 0, 0);
  place(all, p.rates_on_positions_, n, 0);
  place(all, diagonal[1], n, n);
  place(all, p.saddle_on_positions_, 2 * n, 0);
  place(all, p.saddle_on_rates_, 2 * n, n);
  place(all, diagonal[2], 2 * n, 2 * n);
  for (const Triplet& t : states.values) {
    if (t.column < p.states_) all.push_back({t.row, p.algebraic_ + t.column, t.value});
  }
  place(all, p.state_rates_on_algebraic_, p.algebraic_, 0);
  place(all, p.state_rates_on_states_, p.algebraic_, p.algebraic_);
  p.pencil_ = compressed(p.unknowns(), p.unknowns(), all);
  return p;
}

PerturbationEquations PerturbationEquations::of_state_matrix(const Matrix& A) {
  PerturbationEquations p;
  p.states_ = static_cast<std::int32_t>(A.rows());
  Entries entries;
  for (std::int32_t c = 0; c < p.states_; ++c) {
    for (std::int32_t r = 0; r < p.states_; ++r) {
      if (A(r, c) != 0.0) entries.push_back({r, c, A(r, c)});
    }
  }
  p.pencil_ = p.state_rates_on_states_ = compressed(p.states_, p.states_, entries);
  const ColumnMatrix none = compressed(0, 0, {});
  auto lu = std::make_shared<SparseLu>();
  lu->factor(none);
  p.level_.fill(lu);
  p.rates_on_positions_ = p.saddle_on_positions_ = p.saddle_on_rates_ = none;
  p.on_states_ = compressed(0, p.states_, {});
  p.state_rates_on_algebraic_ = compressed(p.states_, 0, {});
  p.sizes_ = p.pencil_;
  for (double& v : p.sizes_.value) v = std::abs(v);
  return p;
}

void PerturbationEquations::solve_levels(Matrix& b) const {
  level_[0]->solve(b.topRows(n_));
  multiply_add(rates_on_positions_, b.topRows(n_), b.middleRows(n_, n_), -1.0);
  level_[1]->solve(b.middleRows(n_, n_));
  multiply_add(saddle_on_positions_, b.topRows(n_), b.bottomRows(saddle_size_), -1.0);
  multiply_add(saddle_on_rates_, b.middleRows(n_, n_), b.bottomRows(saddle_size_), -1.0);
  level_[2]->solve(b.bottomRows(saddle_size_));
}

Matrix PerturbationEquations::complete(const Matrix& x) const {
  Matrix a = Matrix::Zero(algebraic_, x.cols());
  Matrix padded = Matrix::Zero(on_states_.columns, x.cols());
  padded.topRows(x.rows()) = x;
  multiply_add(on_states_, padded, a, -1.0);
  solve_levels(a);
  return a;
}

Matrix PerturbationEquations::complete_left(const Matrix& y) const {
  Matrix a = Matrix::Zero(algebraic_, y.cols());
  multiply_add(transposed(state_rates_on_algebraic_), y, a, -1.0);
  level_[2]->solve_transposed(a.bottomRows(saddle_size_));
  multiply_add(transposed(saddle_on_rates_), a.bottomRows(saddle_size_), a.middleRows(n_, n_), -1.0);
  level_[1]->solve_transposed(a.middleRows(n_, n_));
  multiply_add(transposed(saddle_on_positions_), a.bottomRows(saddle_size_), a.topRows(n_), -1.0);
  multiply_add(transposed(rates_on_positions_), a.middleRows(n_, n_), a.topRows(n_), -1.0);
  level_[0]->solve_transposed(a.topRows(n_));
  return a;
}

Matrix PerturbationEquations::reduced(const Matrix& residuals) const {
  Matrix a = residuals.topRows(algebraic_);
  solve_levels(a);
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
  std::vector<long double> sum(static_cast<std::size_t>(unknowns()));
  const auto add = [&](const ColumnMatrix& m, std::int32_t column, long double factor) {
    for_each_in_column(m, column, [&](std::int32_t row, double v) {
      sum[static_cast<std::size_t>(row)] += factor * static_cast<long double>(v);
    });
  };
  for_column_blocks(columns, [&](Eigen::Index first, Eigen::Index count) {
    Matrix residual(unknowns(), count);
    for (Eigen::Index c = first; c < first + count; ++c) {
      std::fill(sum.begin(), sum.end(), 0.0L);
      for (std::int32_t k = 0; k < algebraic_; ++k) {
        if (a(k, c) != 0.0) add(pencil_, k, static_cast<long double>(a(k, c)));
      }
      if (c < columns - inputs) {
        add(pencil_, algebraic_ + static_cast<std::int32_t>(c), 1.0L);
      } else {
        add(on_states_, static_cast<std::int32_t>(c), 1.0L);
      }
      for (std::int32_t k = 0; k < unknowns(); ++k) {
        const long double rate = k < algebraic_ ? 0.0L : static_cast<long double>(rates(k - algebraic_, c));
        residual(k, c - first) = static_cast<double>(sum[static_cast<std::size_t>(k)] - rate);
      }
    }
    rates.middleCols(first, count) += reduced(residual);
  });
  return rates;
}

Matrix PerturbationEquations::rounding(const Matrix& a) const {
  Matrix total(states_, states_);
  for_column_blocks(states_, [&](Eigen::Index top, Eigen::Index height) {
    Matrix unit = Matrix::Zero(states_, height);
    unit.middleRows(top, height).setIdentity();
    const Matrix adjoint = complete_left(unit).cwiseAbs();
    for_column_blocks(states_, [&](Eigen::Index first, Eigen::Index count) {
      // Displacements and rates are what they are; roundings of what follows from them count where they arise.
      Matrix parts = Matrix::Zero(unknowns(), count), sums = parts;
      parts.topRows(2 * n_) = a.block(0, first, 2 * n_, count).cwiseAbs();
      parts.bottomRows(states_).middleRows(first, count).setIdentity();
      multiply_add(sizes_, parts, sums, 1.0);
      total.block(top, first, height, count) =
          transposed_product(adjoint, sums.topRows(algebraic_).eval()) + sums.middleRows(algebraic_ + top, height);
    });
  });
  return rounding_units * std::numeric_limits<double>::epsilon() * total;
}

}  // namespace dynalin
