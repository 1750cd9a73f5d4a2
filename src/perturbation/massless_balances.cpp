#include "perturbation/massless_balances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rank_split.h"
#include "perturbation/roundoff_scales.h"

namespace dynalin {

namespace {
constexpr double cancelled = cancelled_units * std::numeric_limits<double>::epsilon();
}

MasslessBalances::MasslessBalances(const System& system, const MasslessStates& massless, const StateChoice& choice,
                                   const std::vector<std::int32_t>& inputs, SizedBlock& to)
    : limit_(massless.limit),
      at_rest_(massless.at_rest),
      choice_(choice),
      inputs_(inputs),
      to_(to),
      augmented_(system),
      n_(system.layout().coordinate_count) {}

std::int32_t MasslessBalances::row_of_rate(Eigen::Index k) const {
  return n_ - static_cast<std::int32_t>(limit_.condensed() - k);
}
std::int32_t MasslessBalances::row_of_condensed(Eigen::Index k) const {
  return 2 * n_ - static_cast<std::int32_t>(limit_.count() - k);
}
std::int32_t MasslessBalances::row_of_damped(Eigen::Index k) const {
  return 2 * n_ - static_cast<std::int32_t>(limit_.damped() - k);
}

void MasslessBalances::take() {
  at_rest_ ? take_at_rest() : take_in_motion();
  std::ranges::sort(open_rows_);
  open_rows_.erase(std::unique(open_rows_.begin(), open_rows_.end()), open_rows_.end());
}

void MasslessBalances::take_in_motion() {
  const auto hold = [&](std::int32_t row, Eigen::Index direction) {
    to_.add(row, 2 * n_ + limit_.directions.coordinate[static_cast<std::size_t>(direction)], 1.0, 1.0, 0.0);
    open_rows_.push_back(row);
  };
  Eigen::Index lost = 0;
  for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
    if (choice_.has_position[k]) continue;
    for (const StateChoice::Entry& e : choice_.gradient[k])
      to_.add(row_of_rate(lost), n_ + e.column, e.c.g, std::abs(e.c.g), 0.0);
    open_rows_.push_back(row_of_rate(lost++));
  }
  for (Eigen::Index k = 0; k < limit_.condensed(); ++k)
    hold(row_of_condensed(k), limit_.damping.other_column[static_cast<std::size_t>(k)]);
  for (Eigen::Index k = 0; k < limit_.damped(); ++k)
    hold(row_of_damped(k), limit_.damping.pivot_column[static_cast<std::size_t>(k)]);
}

void MasslessBalances::take_at_rest() {
  for (Eigen::Index k = 0; k < limit_.condensed(); ++k) {
    const Eigen::VectorXd weights = limit_.damping.left_null.col(k);
    once(row_of_rate(k), weights);
    twice(row_of_condensed(k), weights);
  }
  for (Eigen::Index k = 0; k < limit_.damped(); ++k) {
    once(row_of_damped(k),
         Eigen::VectorXd::Unit(limit_.count(), limit_.damping.pivot_row[static_cast<std::size_t>(k)]));
  }
}

// A balance differentiated once.
void MasslessBalances::once(std::int32_t row, const Eigen::VectorXd& weights) {
  const Eigen::RowVectorXd w = weights.transpose(), size = w.cwiseAbs();
  place(row, n_, w * limit_.on_positions, size * limit_.on_positions_size);
  place(row, 2 * n_, w * limit_.on_rates, size * limit_.on_rates_size);
  const Eigen::RowVectorXd on_states = w * limit_.on_states, state_size = size * limit_.on_states_size;
  for (const std::int32_t z : choice_.differential)
    place(row, 2 * n_ + augmented_.state(z), on_states.segment(z, 1), state_size.segment(z, 1));
  if (driven(weights)) open_rows_.push_back(row);
}

void MasslessBalances::twice(std::int32_t row, const Eigen::VectorXd& weights) {
  const Eigen::RowVectorXd w = weights.transpose();
  place(row, 2 * n_, w * limit_.on_positions, w.cwiseAbs() * limit_.on_positions_size);
  const auto vanish = [&](const Eigen::MatrixXd& of, const Eigen::MatrixXd& size) {
    return ((w * of).array().abs() <= cancelled * (w.cwiseAbs() * size).array()).all();
  };
  const bool plain = vanish(limit_.on_rates, limit_.on_rates_size) && vanish(limit_.on_states, limit_.on_states_size) &&
                     !driven(weights);
  if (!plain) open_rows_.push_back(row);
}

void MasslessBalances::place(std::int32_t row, std::int32_t column, const Eigen::RowVectorXd& value,
                             const Eigen::RowVectorXd& size) {
  for (Eigen::Index c = 0; c < value.size(); ++c) {
    if (!(size(c) > 0)) continue;
    const bool vanishes = std::abs(value(c)) <= cancelled * size(c);
    to_.add(row, column + static_cast<std::int32_t>(c), vanishes ? 0.0 : value(c), size(c),
            RoundoffScales::along_axes * size(c));
  }
}

// An input in the balance would come with its derivative.
bool MasslessBalances::driven(const Eigen::VectorXd& weights) const {
  const Eigen::VectorXd y = limit_.left * weights;
  return std::ranges::any_of(inputs_, [&](std::int32_t u) { return y(augmented_.algebraic(u)) != 0.0; });
}

}  // namespace dynalin
