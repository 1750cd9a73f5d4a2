// How the perturbation equations come about: from constraint rows, gradients of chosen coordinates and partials.
#include "linear/entry_sizes.h"
#include "linear/perturbation.h"

namespace dynalin {

namespace {

using Entries = std::vector<Triplet>;

// Adds a block to the triplets of a larger matrix.
void place(Entries& entries, const ColumnMatrix& m, std::int32_t row, std::int32_t column) {
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({row + r, column + c, v}); });
}

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
  // The sizes of a gradient whose values stand elsewhere.
  template <class Row>
  void note_gradient(std::int32_t r, const Row& row, const std::vector<RowCoefficients>& size) {
    for (std::size_t e = 0; e < row.size(); ++e) note_size(r, row[e].column, size[e].g);
  }

 private:
  std::int32_t row_, column_;
  Entries& sizes_;
};

}  // namespace

class PerturbationEquations::Assembly {
 public:
  Assembly(const System& system, const Motion& motion, const ConstraintRows& rows, const Equations& eq,
           const StateChoice& choice, const std::vector<std::int32_t>& inputs, bool without_damping)
      : system_(system),
        saddle_(system),
        rows_(rows),
        eq_(eq),
        choice_(choice),
        inputs_(inputs),
        without_damping_(without_damping),
        entry_sizes_(system.layout(), motion),
        n_(system.layout().coordinate_count),
        first_state_(2 * n_ + saddle_.size()),
        cut_(system.layout().algebraic.size(), false) {
    for (const std::int32_t u : inputs) cut_[static_cast<std::size_t>(u)] = true;
    p_.n_ = n_;
    p_.saddle_size_ = saddle_.size();
    p_.algebraic_ = first_state_;
    p_.states_ = choice.size();
  }

  Result<PerturbationEquations> run() {
    if (auto factored = factor_diagonal(); !factored) return tl::unexpected(factored.error());
    take_rows();
    take_partials();
    take_inputs();
    take_rates_of_states();
    join();
    return std::move(p_);
  }

 private:
  // The diagonal of F.
  Result<void> factor_diagonal() {
    const auto factor = [&](std::size_t level) {
      auto lu = std::make_shared<SparseLu>();
      if (!lu->factor(diagonal_[level])) return false;
      p_.level_[level] = std::move(lu);
      return true;
    };
    bool square = false;
    const std::vector<bool> every(choice_.gradient.size(), true);
    diagonal_[0] = level_matrix(rows_, choice_, choice_.active, every, square);
    if (!square || !factor(0)) return tl::unexpected(undetermined_positions());
    if (choice_.splits_unequally()) {
      diagonal_[1] = level_matrix(rows_, choice_, choice_.velocity_active, choice_.has_rate, square);
      if (!square || !factor(1)) {
        return tl::unexpected(
            Failure{"linear analysis", "the chosen rates do not determine the velocities of the model", {}});
      }
    } else {
      diagonal_[1] = diagonal_[0];
      p_.level_[1] = p_.level_[0];
    }
    diagonal_[2] = saddle_.matrix(eq_, rows_, choice_.velocity_active, {}, cut_);
    if (!factor(2)) {
      return tl::unexpected(Failure{"linear analysis", "the accelerations are not determined",
                                    undetermined(system_, saddle_, diagonal_[2])});
    }
    return {};
  }

  // Constraints and chosen coordinates on the three levels, in the order of level_matrix.
  void take_rows() {
    std::int32_t coordinate = 0, rate = 0;
    const auto take_rate = [&](const auto& row, const std::vector<RowCoefficients>& size) {
      for (std::size_t e = 0; e < row.size(); ++e) below_10_.add(rate, row[e].column, row[e].c.v, size[e].v);
      rates_.note_gradient(rate++, row, size);
    };
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      const auto row = rows_.row(k);
      const std::vector<RowCoefficients> size = entry_sizes_.of_row(row);
      if (choice_.active[static_cast<std::size_t>(k)]) ++coordinate;
      if (!choice_.velocity_active[static_cast<std::size_t>(k)]) continue;
      take_rate(row, size);
      for (std::size_t e = 0; e < row.size(); ++e) {
        below_21_.add(saddle_.lambda(k), row[e].column, row[e].c.a1, size[e].a1);
        below_20_.add(saddle_.lambda(k), row[e].column, row[e].c.a0, size[e].a0);
      }
    }
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      const auto& row = choice_.gradient[k];
      const std::vector<RowCoefficients> size = entry_sizes_.of_row(row);
      states_.add(coordinate++, choice_.position_state[k], -1.0, 1.0);
      if (!choice_.has_rate[k]) continue;
      states_.add(n_ + rate, choice_.rate_state[k], -1.0, 1.0);
      take_rate(row, size);
    }
  }

  // take(row of the saddle, column, value, size) for all entries but those of equations that inputs have cut.
  template <class Take>
  void for_partials(Column family, Take&& take) const {
    const ColumnMatrix& m = eq_.matrix(family);
    const ColumnMatrix size = entry_sizes_.of(eq_, family);
    for (std::int32_t c = 0; c < m.columns; ++c) {
      for (std::int32_t e = m.start[static_cast<std::size_t>(c)]; e < m.start[static_cast<std::size_t>(c) + 1]; ++e) {
        const auto at = static_cast<std::size_t>(e);
        const std::int32_t w = m.row[at] - n_;
        const bool replaced = w >= 0 && w < static_cast<std::int32_t>(cut_.size()) && cut_[static_cast<std::size_t>(w)];
        if (!replaced) take(saddle_.equation(m.row[at]), c, m.value[at], size.value[at]);
      }
    }
  }

  void take_partials() {
    const auto to = [](SizedBlock& block) {
      return [&](std::int32_t row, std::int32_t c, double v, double size) { block.add(row, c, v, size); };
    };
    for_partials(Column::position, to(below_20_));
    for_partials(Column::velocity, to(below_21_));
    if (!without_damping_) for_partials(Column::damping, to(below_21_));
    constexpr std::int32_t constant = -1;
    std::vector<std::int32_t> state_of(system_.layout().states.size(), constant);
    for (std::size_t k = 0; k < choice_.differential.size(); ++k) {
      state_of[static_cast<std::size_t>(choice_.differential[k])] =
          choice_.first_differential + static_cast<std::int32_t>(k);
    }
    for_partials(Column::state, [&](std::int32_t row, std::int32_t c, double v, double size) {
      const std::int32_t state = state_of[static_cast<std::size_t>(c)];
      if (state != constant) states_.add(2 * n_ + row, state, v, size);
    });
  }

  void take_inputs() {
    for (std::size_t u = 0; u < inputs_.size(); ++u) {
      const std::int32_t column = p_.states_ + static_cast<std::int32_t>(u);
      states_.add(2 * n_ + saddle_.algebraic(inputs_[u]), column, -1.0, 0.0);
    }
  }

  void take_rates_of_states() {
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      const std::int32_t position = choice_.position_state[k], rate = choice_.rate_state[k];
      if (rate >= 0) rates_on_states_.push_back({position, rate, 1.0});
      const auto& row = choice_.gradient[k];
      const std::vector<RowCoefficients> size = entry_sizes_.of_row(row);
      for (std::size_t e = 0; e < row.size(); ++e) {
        const auto& [c, g] = row[e];
        if (rate >= 0) {
          rates_on_algebraic_.add(rate, 2 * n_ + c, g.g, size[e].g);
          rates_on_algebraic_.add(rate, n_ + c, g.a1, size[e].a1);
          rates_on_algebraic_.add(rate, c, g.a0, size[e].a0);
        } else {
          rates_on_algebraic_.add(position, n_ + c, g.g, size[e].g);
          rates_on_algebraic_.add(position, c, g.v, size[e].v);
        }
      }
    }
    for (std::size_t k = 0; k < choice_.differential.size(); ++k) {
      rates_on_algebraic_.add(choice_.first_differential + static_cast<std::int32_t>(k),
                              2 * n_ + saddle_.state(choice_.differential[k]), 1.0, 1.0);
    }
  }

  void join() {
    p_.rates_on_positions_ = compressed(n_, n_, below_10_.values);
    p_.saddle_on_positions_ = compressed(saddle_.size(), n_, below_20_.values);
    p_.saddle_on_rates_ = compressed(saddle_.size(), n_, below_21_.values);
    p_.on_states_ = compressed(first_state_, p_.states_ + static_cast<std::int32_t>(inputs_.size()), states_.values);
    p_.state_rates_on_algebraic_ = compressed(p_.states_, first_state_, rates_on_algebraic_.values);
    p_.state_rates_on_states_ = compressed(p_.states_, p_.states_, rates_on_states_);
    p_.sizes_ = compressed(p_.unknowns(), p_.unknowns(), sizes_);
    Entries all;
    place(all, diagonal_[0], 0, 0);
    place(all, p_.rates_on_positions_, n_, 0);
    place(all, diagonal_[1], n_, n_);
    place(all, p_.saddle_on_positions_, 2 * n_, 0);
    place(all, p_.saddle_on_rates_, 2 * n_, n_);
    place(all, diagonal_[2], 2 * n_, 2 * n_);
    for (const Triplet& t : states_.values) {
      if (t.column < p_.states_) all.push_back({t.row, first_state_ + t.column, t.value});
    }
    place(all, p_.state_rates_on_algebraic_, first_state_, 0);
    place(all, p_.state_rates_on_states_, first_state_, first_state_);
    p_.pencil_ = compressed(p_.unknowns(), p_.unknowns(), all);
  }

  const System& system_;
  const Saddle saddle_;
  const ConstraintRows& rows_;
  const Equations& eq_;
  const StateChoice& choice_;
  const std::vector<std::int32_t>& inputs_;
  const bool without_damping_;
  const EntrySizes entry_sizes_;
  const std::int32_t n_, first_state_;
  std::vector<bool> cut_;  // algebraic equations that inputs replace
  PerturbationEquations p_;
  std::array<ColumnMatrix, 3> diagonal_;
  Entries sizes_, rates_on_states_;
  // Blocks of F below the diagonal, the sizes of the second on it, [G H] and P.
  SizedBlock below_10_{n_, 0, sizes_}, below_20_{2 * n_, 0, sizes_}, below_21_{2 * n_, n_, sizes_};
  SizedBlock rates_{n_, n_, sizes_};
  SizedBlock states_{0, first_state_, sizes_}, rates_on_algebraic_{first_state_, 0, sizes_};
};

Result<PerturbationEquations> PerturbationEquations::make(const System& system, const Motion& motion,
                                                          const ConstraintRows& rows, const Equations& eq,
                                                          const StateChoice& choice,
                                                          const std::vector<std::int32_t>& inputs,
                                                          bool without_damping) {
  return Assembly(system, motion, rows, eq, choice, inputs, without_damping).run();
}

}  // namespace dynalin
