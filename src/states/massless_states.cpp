#include "states/massless_states.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/massless_runaway.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

// A column becomes dependent where some row has an entry of this part of its largest.
constexpr double pivot_threshold = 0.1;
// One that is wanted as such already has to be regular only.
constexpr double wanted_threshold = 1e-6;
constexpr double rank_tolerance = 1e-9;

// One column for each row, taken in the given order; fewer where rows are dependent on those columns.
std::vector<Index> pivot_columns(Matrix rows, const std::vector<Index>& order, double threshold) {
  std::vector<Index> found;
  const Eigen::VectorXd first = rows.cwiseAbs().rowwise().maxCoeff();
  std::vector<bool> used(static_cast<std::size_t>(rows.rows()), false);
  for (const Index c : order) {
    Index best = -1;
    double share = 0;
    for (Index r = 0; r < rows.rows(); ++r) {
      if (used[static_cast<std::size_t>(r)]) continue;
      const double largest = rows.row(r).cwiseAbs().maxCoeff();
      if (largest <= rank_tolerance * first(r)) continue;
      const double s = std::abs(rows(r, c)) / largest;
      if (s >= threshold && s > share) best = r, share = s;
    }
    if (best < 0) continue;
    used[static_cast<std::size_t>(best)] = true;
    found.push_back(c);
    for (Index r = 0; r < rows.rows(); ++r) {
      if (used[static_cast<std::size_t>(r)] || rows(r, c) == 0.0) continue;
      const double factor = rows(r, c) / rows(best, c);
      rows.row(r) -= factor * rows.row(best);
      rows(r, c) = 0;
    }
  }
  return found;
}

void put_first(std::vector<Index>& order, const std::vector<Index>& wanted) {
  std::stable_partition(order.begin(), order.end(),
                        [&](Index c) { return std::find(wanted.begin(), wanted.end(), c) != wanted.end(); });
}

class Taker {
 public:
  Taker(const System& system, const ConstraintRows& rows, StateChoice& choice, MasslessStates& states)
      : system_(system),
        rows_(rows),
        choice_(choice),
        states_(states),
        limit_(states.limit),
        count_(static_cast<Index>(choice.gradient.size())) {}

  Result<void> run() {
    measure();
    const std::vector<bool> every(choice_.gradient.size(), true);
    const std::vector<bool> had_rate = choice_.has_rate;
    const auto on_coordinates = motion_of(choice_.active, every);
    const auto on_chosen_rates = motion_of(choice_.velocity_active, had_rate);
    if (!on_coordinates || !on_chosen_rates) return tl::unexpected(undetermined_positions());

    // Positions that follow from balance.
    std::vector<Index> order = least_wanted_first();
    put_first(order, pivot_columns(moved_along(limit_.condensed_directions()), order, pivot_threshold));
    const Matrix positions = limit_.condensed_rows(limit_.on_positions) * *on_coordinates * unit_.asDiagonal();
    const std::vector<Index> condensed = pivot_columns(positions, order, wanted_threshold);
    if (static_cast<Index>(condensed.size()) < limit_.condensed()) return undetermined();

    // Rates that follow from balance, or with the positions.
    order = least_wanted_first();
    std::erase_if(order, [&](Index c) { return !had_rate[static_cast<std::size_t>(c)]; });
    put_first(order, pivot_columns(moved_along(limit_.damped_directions()), order, pivot_threshold));
    put_first(order, condensed);
    Matrix rates(limit_.count(), count_);
    rates.topRows(limit_.condensed()) = limit_.condensed_rows(limit_.on_positions) * *on_chosen_rates;
    rates.bottomRows(limit_.damped()) = limit_.damped_rows(limit_.on_rates) * *on_chosen_rates;
    const std::vector<Index> without_rate = pivot_columns(rates * unit_.asDiagonal(), order, wanted_threshold);
    if (static_cast<Index>(without_rate.size()) < limit_.count()) return undetermined();

    const auto is_condensed = [&](Index c) {
      return std::find(condensed.begin(), condensed.end(), c) != condensed.end();
    };
    for (const Index c : condensed) choice_.has_position[static_cast<std::size_t>(c)] = false;
    for (const Index c : without_rate) choice_.has_rate[static_cast<std::size_t>(c)] = false;
    for (const Index c : condensed) {
      if (choice_.has_rate[static_cast<std::size_t>(c)]) return undetermined();
    }
    list_states(system_.layout(), choice_);
    std::vector<Index> listed = without_rate;
    std::sort(listed.begin(), listed.end());
    for (const Index c : listed) {
      const StateLabel& label = choice_.coordinates[static_cast<std::size_t>(c)].label;
      if (!is_condensed(c)) ++states_.first_order;
      states_.remarks.warning(
          "massless-freedom", {},
          is_condensed(c)
              ? fmt::format(
                    "{} of {} has no mass and is held by stiffness alone: it follows from the balance of forces "
                    "and is no state (limit of vanishing mass)",
                    label.text, label.owner.text())
              : fmt::format("{} of {} has no mass: its velocity follows from the balance of damping and other forces, "
                            "and it is a state of first order (limit of vanishing mass)",
                            label.text, label.owner.text()));
    }
    for (const auto& [grows, what] : {std::pair(runaway_by_damping(system_, limit_), "damping"),
                                      std::pair(runaway_by_stiffness(system_, limit_), "stiffness")}) {
      if (grows.cols() > 0) {
        states_.remarks.warning(
            "massless-runaway", {},
            fmt::format("{} of freedoms without mass drives them on ({}): with a small mass, the same in all of them, "
                        "they would run away at once, which the limit of vanishing mass does not show",
                        what, names_of(system_, limit_.directions, grows)));
      }
    }
    return {};
  }

 private:
  tl::unexpected<Failure> undetermined() const {
    return tl::unexpected(
        Failure{"limit of vanishing mass",
                fmt::format("no choice of states determines the freedoms without mass: {}",
                            names_of(system_, limit_.directions, Matrix::Identity(limit_.count(), limit_.count()))),
                {},
                "massless-motion"});
  }

  // A unit of a chosen coordinate is what a unit of the scaled coordinates of the layout makes of it.
  void measure() {
    unit_ = Eigen::VectorXd::Zero(count_);
    for (Index k = 0; k < count_; ++k) {
      for (const StateChoice::Entry& e : choice_.gradient[static_cast<std::size_t>(k)])
        unit_(k) = std::max(unit_(k), std::abs(e.c.g * system_.coordinate_scale(e.column)));
    }
  }

  std::vector<Index> least_wanted_first() const {
    std::vector<Index> order;
    for (Index k = count_; k-- > 0;) order.push_back(k);
    return order;
  }

  // What coordinates of the layout do where the chosen ones move by a unit each; zero for those that are not used.
  std::optional<Matrix> motion_of(const std::vector<bool>& active, const std::vector<bool>& used) const {
    bool square = false;
    SparseLu lu;
    const ColumnMatrix level = level_matrix(rows_, choice_, active, used, square);
    if (!square || !lu.factor(level)) return std::nullopt;
    const Index n = level.rows;
    Index held = n;
    for (const bool u : used) held -= u;
    Matrix motion = Matrix::Zero(n, count_);
    for (Index k = 0, at = held; k < count_; ++k) {
      if (used[static_cast<std::size_t>(k)]) motion(at++, k) = 1;
    }
    lu.solve(motion);
    return motion;
  }

  // Chosen coordinates along directions, a row each.
  Matrix moved_along(const Matrix& directions) const {
    Matrix out = Matrix::Zero(directions.cols(), count_);
    for (Index k = 0; k < count_; ++k) {
      for (const StateChoice::Entry& e : choice_.gradient[static_cast<std::size_t>(k)])
        out.col(k) += e.c.g * directions.row(e.column).transpose() / unit_(k);
    }
    return out;
  }

  const System& system_;
  const ConstraintRows& rows_;
  StateChoice& choice_;
  MasslessStates& states_;
  const MasslessLimit& limit_;
  const Index count_;
  Eigen::VectorXd unit_;
};

}  // namespace

Result<void> take_massless_states(const System& system, const ConstraintRows& rows, StateChoice& choice,
                                  MasslessStates& states) {
  return Taker(system, rows, choice, states).run();
}

}  // namespace dynalin
