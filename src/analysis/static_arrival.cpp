// The end of a descent: whether a point that is balanced, or nearly, is at rest, and Newton's steps to it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/settled_reactions.h"
#include "analysis/static_descent.h"
#include "analysis/static_step.h"

namespace dynalin {

// Newton's steps in the unknowns' own sizes until nothing but rounding is left.
bool Descent::finish(OperatingPoint& op) {
  constexpr int steps = 60;
  constexpr double no_last_step = 1e-2;  // of the size of an unknown
  OperatingPoint here = op;
  double smallest = std::numeric_limits<double>::infinity(), least_excess = smallest;
  int stuck = 0, unbalanced = 0;  // steps since the one that was shorter, and the one that brought balance closer
  std::optional<OperatingPoint> rest, faded, freed;
  for (int k = 0; k < steps; ++k) {
    settle(equations_, here);
    equations_.evaluate(here, Partials::yes);
    const auto j = judge(equations_, here);
    if (!j) break;
    if (k == 0) {
      if (j->largest < nearer * smallest_move_) smallest_move_ = j->largest, converging_ = iteration_;
    }
    const double excess = equations_.excess();
    unbalanced = excess < 0.5 * least_excess ? 0 : unbalanced + 1;
    least_excess = std::min(least_excess, excess);
    stuck = j->largest < 0.95 * smallest || unbalanced == 0 ? 0 : stuck + 1;
    // What Newton's method cannot improve any more, neither step nor balance, is determined as well as it can be.
    // So is what it would not change but in the last digits, where nothing better was found: one more step may lead
    // where forces have no direction.
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const bool exact = (j->largest <= last_digits && stuck >= 3) || (j->largest <= epsilon && unbalanced >= 2) ||
                       (!rest && j->largest_of_all <= epsilon);
    const bool at_rest = (j->balanced || exact) && (j->determined || (j->excused && stuck >= 2));
    if (at_rest) (came_to_rest(*j) ? rest : freed) = here;
    if (faded_where_it_is(*j) && came_to_rest(*j)) faded = here;
    if (rest && ((j->largest == 0 && unbalanced > 0) || stuck > 0)) break;
    if (!rest && j->largest_at >= 0) {
      doubt_ = fmt::format("{} would still have to change by {:.3g} to balance a rest of {:.3g}",
                           equations_.equation_text(j->largest_at), j->step(j->largest_at),
                           equations_.imbalance_of_functions());
    }
    if (j->largest > no_last_step || stuck > 3) break;
    smallest = std::min(smallest, j->largest);
    double taken = 0;
    here = moved(system_, here, equations_.augmented(), determined_step(*j), 1.0, options_.limits, &taken);
    for (Eigen::Index i = 0; i < j->step.size(); ++i) {
      if (j->step(i) == 0 || move_.size() == 0) continue;
      move_(i) = std::abs(taken * j->step(i)) / j->size(i);
      moved_at_[static_cast<std::size_t>(i)] = -1;
    }
  }
  if (!rest) rest = std::move(faded);
  if (!rest && freed && rests_put_back(*freed)) rest = std::move(freed);
  if (rest) {
    op = std::move(*rest);
    system_.remember(op);
    settle(equations_, op);
    return true;
  }
  equations_.evaluate(op, Partials::yes);
  return false;
}

// A force that vanishes in a higher order leaves a tangent that is lost in rounding before Newton's steps have come to
// their end. It is nothing beside the most that acted where the last step, and the next, have become small; those of a
// force that fades with distance stay large.
bool Descent::faded_where_it_is(const RestJudgement& j) const {
  constexpr double faint = 1e-2 * std::numeric_limits<double>::epsilon();  // of the terms of an equation, at their most
  const AugmentedSystem& augmented = equations_.augmented();
  for (Eigen::Index k = 0; k < move_.size(); ++k) {
    const bool value = k >= augmented.algebraic(0) && k < augmented.state(0);
    if (k >= augmented.lambda(0) && k < augmented.algebraic(0)) continue;
    const double r = std::abs(equations_.residual()(k)), step = std::abs(j.step(k)) / j.size(k);
    const bool vanishes = r <= faint * acted_(k);
    if (!vanishes && r > residual_noise * equations_.rounding()(k)) return false;
    if (!value && step > rest_step && !(vanishes && std::max(move_(k), step) <= settled_move)) return false;
  }
  return move_.size() > 0;
}

// All of Newton's step but what nothing determines. Unknowns that rounding moves as far as the step does may not be
// left where they are one by one: those that stiff elements couple them with would move alone.
Eigen::VectorXd Descent::determined_step(const RestJudgement& j) {
  if (std::ranges::find(j.indifferent, true) == j.indifferent.end()) return j.newton;
  return held_part(without_undetermined(j.newton));
}

Eigen::VectorXd Descent::without_undetermined(Eigen::VectorXd step) const {
  const AugmentedSystem& augmented = equations_.augmented();
  const Eigen::VectorXd open = undetermined_part(equations_, step);
  const Eigen::Index states = step.size() - augmented.state(0);
  step.head(augmented.lambda(0)) -= open.head(augmented.lambda(0));
  step.tail(states) -= open.tail(states);
  return step;
}

// Whether a force acts along a move, and not what rounding leaves of those that are balanced.
bool Descent::is_driven(const Eigen::VectorXd& way, const Eigen::VectorXd& residual,
                        const Eigen::VectorXd& rounding) const {
  double work = 0, unseen = 0;
  for (Eigen::Index k = 0; k < way.size(); ++k) {
    if (k >= equations_.augmented().lambda(0) && k < equations_.augmented().state(0)) continue;
    work += residual(k) * way(k);
    unseen += rounding(k) * std::abs(way(k));
  }
  return std::abs(work) > residual_noise * unseen;
}

// Where a body may roll freely, rounding of forces over rounding of stiffness is a step of any size. It stays where it
// is, as it does where the matrix is singular to the last digit.
Eigen::VectorXd Descent::without_drift(const Eigen::VectorXd& step) {
  constexpr double moved = 1e-9;  // by rounding, of the size of a coordinate
  Eigen::MatrixXd by_rounding = random_signs(equations_.rounding_of_terms(), 1);
  lu_.solve(by_rounding, SparseLu::Refined::no);
  double farthest = 0;
  for (std::int32_t k = 0; k < system_.layout().coordinate_count; ++k)
    farthest = std::max(farthest, std::abs(by_rounding(k, 0)) / system_.coordinate_scale(k));
  return farthest <= moved ? step : held_part(step);
}

// With a little of a typical stiffness P = (J + εD)⁻¹ J leaves of a step what is held by more.
Eigen::VectorXd Descent::held_part(const Eigen::VectorXd& step) {
  constexpr double little = 1e-10;
  SparseLu held;
  if (!equations_.factor(held, equations_.tangent(little, 0))) return step;
  const ColumnMatrix J = equations_.tangent(0, 0);
  const auto P = [&](const Eigen::VectorXd& move) {
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(move.size(), 1);
    for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) { x(r, 0) += v * move(c); });
    held.solve(x);
    return Eigen::VectorXd(x.col(0));
  };
  // Twice: next to nothing is left of one in the other.
  const Eigen::VectorXd once = P(step), kept = P(once), open = (step - once) - (once - kept);
  if (!open.allFinite() || is_driven(open, equations_.residual(), equations_.rounding())) return step;
  return kept;
}

// What nothing but rounding determines may be anywhere. It is where it is because nothing moved it, or because what
// moved it ended; where a force only fades, the steps stay large until the force is lost in rounding.
bool Descent::came_to_rest(const RestJudgement& j) {
  constexpr double lost = 1e-5;  // of a step, in what is found of it
  struct Drift {
    Eigen::VectorXd way;
    bool driven = false;
  };
  std::array<Drift, 4> drifts;
  const auto drift_of = [&](std::size_t n) -> const Drift& {
    Drift& d = drifts[n];
    if (d.way.size() > 0) return d;
    const Move& move = moves_[n];
    d.way = undetermined_part(equations_, move.step);
    d.driven = is_driven(d.way, move.residual, move.rounding);
    return d;
  };
  for (Eigen::Index k = 0; k < move_.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!j.indifferent[i]) continue;
    if (loose_ && !loose_->free[i]) return false;
    if (arrived_[i] || move_(k) <= settled_move) continue;
    // A part that may spin about any axis leaves its angles about all of them open, but not each alone; and one that
    // nothing pushes along what is open drifts there as a matrix that is all but singular has it.
    const auto n = static_cast<std::size_t>(moved_at_[i]) % moves_.size();
    if (moved_at_[i] < 0 || moves_[n].at != moved_at_[i]) return false;
    const Drift& drift = drift_of(n);
    const double longest =
        moves_[n].step.cwiseQuotient(j.size).head(system_.layout().coordinate_count).cwiseAbs().maxCoeff();
    if (drift.driven && std::abs(drift.way(k)) / j.size(k) > std::max(settled_move, lost * longest)) return false;
  }
  return true;
}

// Whether a point where all is balanced, but something is held by nothing that was held at first, is at rest with that
// where it was.
bool Descent::rests_put_back(OperatingPoint& op) {
  if (!loose_ || !may_put_back_) return false;
  equations_.evaluate(op, Partials::yes);
  const auto j = judge(equations_, op);
  auto back = j ? put_back(equations_, op, loose_->at) : std::nullopt;
  if (!back) return false;
  FirstFreedoms loose{loose_->at, j->indifferent};
  for (std::size_t k = 0; k < loose.free.size(); ++k) loose.free[k] = loose.free[k] || loose_->free[k];
  Descent there(equations_, options_, history_);
  there.may_put_back_ = false;
  if (!there.finish_at(*back, loose)) return false;
  op = *std::move(back);
  return true;
}

bool Descent::polish(OperatingPoint& op, const FirstFreedoms& loose) {
  equations_.measure_by(Yardstick::model);
  return finish_at(op, loose);
}

bool Descent::finish_at(OperatingPoint& op, const FirstFreedoms& loose) {
  loose_ = &loose;
  equations_.evaluate(op, Partials::yes);
  if (!equations_.residual().allFinite()) return false;
  first_ = lowest_ = op;
  note_arrivals();
  return finish(op);
}

void Descent::note_arrivals() {
  const Eigen::Index n = equations_.residual().size();
  if (move_.size() == 0) {
    move_ = Eigen::VectorXd::Zero(n);
    excess_before_ = Eigen::VectorXd::Zero(n);
    excess_ = Eigen::VectorXd::Zero(n);
    arrived_.assign(static_cast<std::size_t>(n), false);
    moved_at_.assign(static_cast<std::size_t>(n), -1);
    acted_ = Eigen::VectorXd::Zero(n);
  }
  acted_ = acted_.cwiseMax(equations_.magnitude());
  for (Eigen::Index k = 0; k < n; ++k) {
    const double r = std::abs(equations_.residual()(k));
    const double now = r == 0 ? 0.0 : r / equations_.rounding()(k);
    if (now <= residual_noise && std::max(excess_(k), excess_before_(k)) >= certain_excess)
      arrived_[static_cast<std::size_t>(k)] = true;
    if (now > little_excess) arrived_[static_cast<std::size_t>(k)] = false;
    excess_before_(k) = excess_(k);
    excess_(k) = now;
  }
  pushing_ = equations_.residual();
  blur_ = equations_.rounding();
}

}  // namespace dynalin
