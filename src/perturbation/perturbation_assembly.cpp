// How the perturbation equations come about: from constraint rows, gradients of chosen coordinates and partials.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "perturbation/along_open_directions.h"
#include "perturbation/massless_balances.h"
#include "perturbation/perturbation.h"
#include "perturbation/perturbed_point.h"
#include "perturbation/roundoff_scales.h"
#include "perturbation/sized_block.h"
#include "system/column_builder.h"

namespace dynalin {

namespace {

// A matrix of entries that are needed no more.
ColumnMatrix taken(std::int32_t rows, std::int32_t columns, Entries& entries) {
  ColumnMatrix m = compressed_columns(rows, columns, [&](auto&& take) {
    for (const Triplet& t : entries) take(t.row, t.column, t.value);
  });
  Entries().swap(entries);
  return m;
}

ColumnMatrix without_zeros(const ColumnMatrix& m) {
  return compressed_columns(m.rows, m.columns, [&](auto&& take) {
    for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) {
      if (v != 0.0) take(r, c, v);
    });
  });
}

}  // namespace

class PerturbationEquations::Assembly {
 public:
  Assembly(const System& system, const PerturbedPoint& at)
      : system_(system),
        augmented_(system),
        rows_(at.rows),
        eq_(at.equations),
        choice_(at.choice),
        inputs_(at.inputs),
        without_damping_(at.without_damping),
        massless_(at.massless ? &*at.massless : nullptr),
        roundoff_scales_(system.layout(), at.motion),
        n_(system.layout().coordinate_count),
        first_state_(2 * n_ + augmented_.size()),
        cut_(system.layout().algebraic.size(), false) {
    for (const std::int32_t u : inputs_) cut_[static_cast<std::size_t>(u)] = true;
    p_.n_ = n_;
    p_.augmented_size_ = augmented_.size();
    p_.algebraic_ = first_state_;
    p_.states_ = choice_.size();
  }

  Result<PerturbationEquations> run() {
    if (auto factored = massless_ ? set_diagonal() : factor_diagonal(); !factored)
      return tl::unexpected(factored.error());
    take();
    join();
    if (massless_) {
      if (auto factored = factor_whole(); !factored) return tl::unexpected(factored.error());
    }
    return std::move(p_);
  }

  ColumnMatrix sizes() {
    roundoff_.noted = Roundoff::Noted::sizes;
    take();
    return taken(p_.unknowns(), p_.unknowns(), roundoff_.entries);
  }

 private:
  void take() {
    take_rows();
    take_partials();
    take_inputs();
    take_rates_of_states();
    if (massless_) {
      MasslessBalances balances(system_, *massless_, choice_, inputs_, balances_);
      balances.take();
      open_rows_ = balances.open_rows();
    }
  }

  // The diagonal of F.
  Result<void> factor_diagonal() {
    const auto factor = [&](std::size_t level, ColumnMatrix m) {
      // Factored once: what elements reserve and is zero here would only fill the factors.
      diagonal_[level] = without_zeros(m);
      m = {};
      auto lu = std::make_shared<SparseLu>();
      if (!lu->factor(diagonal_[level])) return false;
      p_.level_[level] = std::move(lu);
      return true;
    };
    bool square = false;
    const std::vector<bool> every(choice_.gradient.size(), true);
    ColumnMatrix positions = level_matrix(rows_, choice_, choice_.active, every, square);
    if (!square || !factor(0, std::move(positions))) return tl::unexpected(undetermined_positions());
    if (choice_.splits_unequally()) {
      ColumnMatrix rates = level_matrix(rows_, choice_, choice_.velocity_active, choice_.has_rate, square);
      if (!square || !factor(1, std::move(rates))) {
        return tl::unexpected(Failure{"linear analysis",
                                      "the chosen rates do not determine the velocities of the model",
                                      {},
                                      "undetermined-states"});
      }
    } else {
      diagonal_[1] = diagonal_[0];
      p_.level_[1] = p_.level_[0];
    }
    const auto augmented = [&] { return augmented_.matrix(eq_, rows_, choice_.velocity_active, {}, cut_); };
    if (!factor(2, augmented())) {
      return tl::unexpected(Failure{"linear analysis", "the accelerations are not determined",
                                    undetermined(system_, augmented_, augmented()), "undetermined-accelerations"});
    }
    return {};
  }

  // The same where freedoms without mass leave rows vacant, behind the others of each level.
  Result<void> set_diagonal() {
    const auto condensed = static_cast<std::int32_t>(massless_->limit.condensed());
    const auto all = static_cast<std::int32_t>(massless_->limit.count());
    bool square = false, square_rates = false;
    diagonal_[0] = without_zeros(level_matrix(rows_, choice_, choice_.active, choice_.has_position, square, condensed));
    diagonal_[1] =
        without_zeros(level_matrix(rows_, choice_, choice_.velocity_active, choice_.has_rate, square_rates, all));
    if (!square || !square_rates) return tl::unexpected(undetermined_positions());
    diagonal_[2] = without_zeros(augmented_.matrix(eq_, rows_, choice_.velocity_active, {}, cut_));
    return {};
  }

  Result<void> factor_whole() {
    std::vector<Triplet> entries;
    for_each_entry(p_.products_, [&](std::int32_t r, std::int32_t c, double v) {
      if (r < first_state_ && c < first_state_) entries.push_back({r, c, v});
    });
    auto lu = std::make_shared<SparseLu>();
    const MasslessDirections& d = massless_->limit.directions;
    const auto names = [&](const Eigen::MatrixXd& of) { return names_of(system_, d, of); };
    if (!lu->factor(compressed(first_state_, first_state_, entries))) {
      return tl::unexpected(
          Failure{"limit of vanishing mass",
                  fmt::format("the balance of forces does not determine the freedoms without mass: {}",
                              names(Eigen::MatrixXd::Identity(d.count(), d.count()))),
                  {},
                  "massless-motion"});
    }
    p_.whole_ = std::move(lu);
    p_.open_ = Eigen::MatrixXd::Zero(first_state_, static_cast<Eigen::Index>(open_rows_.size()));
    for (std::size_t k = 0; k < open_rows_.size(); ++k) p_.open_(open_rows_[k], static_cast<Eigen::Index>(k)) = 1;
    p_.whole_->solve(p_.open_);
    // Whether any state follows from what is open, beyond rounding.
    Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(p_.states_, p_.open_.cols()), size = seen;
    const Eigen::RowVectorXd moves = p_.open_.topRows(3 * n_).cwiseAbs().colwise().maxCoeff();
    const Eigen::RowVectorXd others =
        p_.open_.bottomRows(first_state_ - 2 * n_ - augmented_.state(0)).cwiseAbs().colwise().sum();
    for_each_entry(p_.state_rates_on_algebraic_, [&](std::int32_t r, std::int32_t c, double v) {
      seen.row(r) += v * p_.open_.row(c);
      size.row(r) += std::abs(v) * (c < 3 * n_ ? moves : (others + moves).eval());
    });
    if ((seen.array().abs() > rounding_along_open_directions * size.array()).any()) {
      return tl::unexpected(Failure{
          "limit of vanishing mass",
          fmt::format("rates of freedoms without mass ({}) act on the model, and they follow from the derivative of {}",
                      names(Eigen::MatrixXd::Identity(d.count(), d.count())),
                      massless_->at_rest ? "a plant input, which no state-space model has"
                                         : "forces along the motion: that is possible at rest only"),
          {},
          "massless-motion"});
    }
    return {};
  }

  // Constraints and chosen coordinates on the three levels, in the order of level_matrix.
  void take_rows() {
    std::int32_t coordinate = 0, rate = 0;
    const auto take_rate = [&](const auto& row, const std::vector<RowCoefficients>& size,
                               const std::vector<RowCoefficients>& rounding) {
      for (std::size_t e = 0; e < row.size(); ++e)
        below_10_.add(rate, row[e].column, row[e].c.v, size[e].v, rounding[e].v);
      rates_.note_gradient_roundings(rate, row, rounding);
      rates_.note_gradient(rate++, row, size);
    };
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      const auto row = rows_.row(k);
      const std::vector<RowCoefficients> size = roundoff_scales_.of_row(row);
      const std::vector<RowCoefficients> rounding = roundoff_scales_.roundings_of_row(row, size);
      if (choice_.active[static_cast<std::size_t>(k)]) positions_.note_gradient_roundings(coordinate++, row, rounding);
      if (!choice_.velocity_active[static_cast<std::size_t>(k)]) continue;
      take_rate(row, size, rounding);
      coupled_.note_gradient_roundings(augmented_.lambda(k), row, rounding);
      for (std::size_t e = 0; e < row.size(); ++e) {
        below_21_.add(augmented_.lambda(k), row[e].column, row[e].c.a1, size[e].a1, rounding[e].a1);
        below_20_.add(augmented_.lambda(k), row[e].column, row[e].c.a0, size[e].a0, rounding[e].a0);
        coupled_.note_rounding(row[e].column, augmented_.lambda(k), rounding[e].g);
      }
    }
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      const auto& row = choice_.gradient[k];
      const std::vector<RowCoefficients> size = roundoff_scales_.of_row(row);
      const std::vector<RowCoefficients> rounding = roundoff_scales_.roundings_of_row(row, size);
      if (choice_.has_position[k]) {
        states_.add(coordinate, choice_.position_state[k], -1.0, 1.0, 0.0);
        positions_.note_gradient_roundings(coordinate++, row, rounding);
      }
      if (!choice_.has_rate[k]) continue;
      states_.add(n_ + rate, choice_.rate_state[k], -1.0, 1.0, 0.0);
      take_rate(row, size, rounding);
    }
  }

  // take(row of the augmented, column, value, size, rounding) for all entries but those of equations that inputs have
  // cut.
  template <class Take>
  void for_partials(PartialBy family, Take&& take) const {
    const ColumnMatrix& m = eq_.matrix(family);
    const std::vector<double> size = roundoff_scales_.of(eq_, family);
    const std::vector<double> rounding = roundoff_scales_.roundings(eq_, family, size);
    for (std::int32_t c = 0; c < m.columns; ++c) {
      for (std::int32_t e = m.start[static_cast<std::size_t>(c)]; e < m.start[static_cast<std::size_t>(c) + 1]; ++e) {
        const auto at = static_cast<std::size_t>(e);
        const std::int32_t w = m.row[at] - n_;
        const bool replaced = w >= 0 && w < static_cast<std::int32_t>(cut_.size()) && cut_[static_cast<std::size_t>(w)];
        if (!replaced) take(augmented_.equation(m.row[at]), c, m.value[at], size[at], rounding[at]);
      }
    }
  }

  void take_partials() {
    const auto to = [](SizedBlock& block) {
      return [&](std::int32_t row, std::int32_t c, double v, double size, double rounding) {
        block.add(row, c, v, size, rounding);
      };
    };
    for_partials(PartialBy::position, to(below_20_));
    for_partials(PartialBy::velocity, to(below_21_));
    if (!without_damping_) for_partials(PartialBy::damping, to(below_21_));
    constexpr std::int32_t constant = -1;
    std::vector<std::int32_t> state_of(system_.layout().states.size(), constant);
    for (std::size_t k = 0; k < choice_.differential.size(); ++k) {
      state_of[static_cast<std::size_t>(choice_.differential[k])] =
          choice_.first_differential + static_cast<std::int32_t>(k);
    }
    for_partials(PartialBy::state, [&](std::int32_t row, std::int32_t c, double v, double size, double rounding) {
      const std::int32_t state = state_of[static_cast<std::size_t>(c)];
      if (state != constant) states_.add(2 * n_ + row, state, v, size, rounding);
    });
    // Of what stands on the diagonal.
    const auto unknowns = [&](PartialBy family, std::int32_t first) {
      for_partials(family, [&, first](std::int32_t row, std::int32_t c, double, double, double rounding) {
        coupled_.note_rounding(row, first + c, rounding);
      });
    };
    unknowns(PartialBy::acceleration, 0);
    unknowns(PartialBy::lambda, augmented_.lambda(0));
    unknowns(PartialBy::algebraic, augmented_.algebraic(0));
    unknowns(PartialBy::state_rate, augmented_.state(0));
  }

  void take_inputs() {
    for (std::size_t u = 0; u < inputs_.size(); ++u) {
      const std::int32_t column = p_.states_ + static_cast<std::int32_t>(u);
      states_.add(2 * n_ + augmented_.algebraic(inputs_[u]), column, -1.0, 0.0, 0.0);
    }
  }

  void take_rates_of_states() {
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      const std::int32_t position = choice_.position_state[k], rate = choice_.rate_state[k];
      if (position < 0) continue;
      if (rate >= 0) rates_on_states_.push_back({position, rate, 1.0});
      const auto& row = choice_.gradient[k];
      const std::vector<RowCoefficients> size = roundoff_scales_.of_row(row),
                                         rounding = roundoff_scales_.roundings_of_row(row, size);
      for (std::size_t e = 0; e < row.size(); ++e) {
        const std::int32_t c = row[e].column;
        const RowCoefficients& g = row[e].c;
        if (rate >= 0) {
          rates_on_algebraic_.add(rate, 2 * n_ + c, g.g, size[e].g, rounding[e].g);
          rates_on_algebraic_.add(rate, n_ + c, g.a1, size[e].a1, rounding[e].a1);
          rates_on_algebraic_.add(rate, c, g.a0, size[e].a0, rounding[e].a0);
        } else {
          rates_on_algebraic_.add(position, n_ + c, g.g, size[e].g, rounding[e].g);
          rates_on_algebraic_.add(position, c, g.v, size[e].v, rounding[e].v);
        }
      }
    }
    for (std::size_t k = 0; k < choice_.differential.size(); ++k) {
      rates_on_algebraic_.add(choice_.first_differential + static_cast<std::int32_t>(k),
                              2 * n_ + augmented_.state(choice_.differential[k]), 1.0, 1.0, 0.0);
    }
  }

  void join() {
    const std::int32_t states = p_.states_, all = p_.unknowns();
    p_.roundings_ = taken(all, all, roundoff_.entries);
    p_.products_ = compressed_columns(all, all, [&](auto&& take) {
      const auto place = [&](const Entries& block, std::int32_t row, std::int32_t column) {
        for (const Triplet& t : block) take(row + t.row, column + t.column, t.value);
      };
      const auto place_level = [&](std::size_t level, std::int32_t first) {
        for_each_entry(diagonal_[level],
                       [&](std::int32_t r, std::int32_t c, double v) { take(first + r, first + c, v); });
      };
      place_level(0, 0);
      place(below_10_.values, n_, 0);
      place_level(1, n_);
      place(below_20_.values, 2 * n_, 0);
      place(below_21_.values, 2 * n_, n_);
      place_level(2, 2 * n_);
      place(balances_.values, 0, 0);
      for (const Triplet& t : states_.values) {
        if (t.column < states) take(t.row, first_state_ + t.column, t.value);
      }
      place(rates_on_algebraic_.values, first_state_, 0);
      place(rates_on_states_, first_state_, first_state_);
    });
    p_.rates_on_positions_ = taken(n_, n_, below_10_.values);
    p_.augmented_on_positions_ = taken(augmented_.size(), n_, below_20_.values);
    p_.augmented_on_rates_ = taken(augmented_.size(), n_, below_21_.values);
    p_.on_states_ = taken(first_state_, states + static_cast<std::int32_t>(inputs_.size()), states_.values);
    p_.state_rates_on_algebraic_ = taken(states, first_state_, rates_on_algebraic_.values);
    p_.state_rates_on_states_ = taken(states, states, rates_on_states_);
  }

  const System& system_;
  const AugmentedSystem augmented_;
  const ConstraintRows& rows_;
  const Equations& eq_;
  const StateChoice& choice_;
  const std::vector<std::int32_t>& inputs_;
  const bool without_damping_;
  const MasslessStates* massless_;  // null where everything has mass
  const RoundoffScales roundoff_scales_;
  const std::int32_t n_, first_state_;
  std::vector<bool> cut_;  // algebraic equations that inputs replace
  PerturbationEquations p_;
  std::array<ColumnMatrix, 3> diagonal_;
  Entries rates_on_states_;
  Roundoff roundoff_;
  // Blocks of F below the diagonal, what is noted of those on it, [G H] and P.
  SizedBlock below_10_{n_, 0, roundoff_}, below_20_{2 * n_, 0, roundoff_}, below_21_{2 * n_, n_, roundoff_};
  SizedBlock positions_{0, 0, roundoff_}, rates_{n_, n_, roundoff_}, coupled_{2 * n_, 2 * n_, roundoff_};
  SizedBlock balances_{0, 0, roundoff_};  // in the rows that freedoms without mass leave vacant
  std::vector<std::int32_t> open_rows_;
  SizedBlock states_{0, first_state_, roundoff_}, rates_on_algebraic_{first_state_, 0, roundoff_};
};

Result<PerturbationEquations> PerturbationEquations::make(const System& system, const PerturbedPoint& at) {
  return Assembly(system, at).run();
}

ColumnMatrix PerturbationEquations::sizes(const System& system, const PerturbedPoint& at) {
  return Assembly(system, at).sizes();
}

}  // namespace dynalin
