#include "analysis/static_descent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/balance.h"
#include "analysis/settled_reactions.h"
#include "analysis/static_step.h"

namespace dynalin {

namespace {

// Iterations after which a motion that has come no closer to rest goes round in a circle or away.
constexpr int descent_patience = 80;
// Iterations near balance after which steps that do not become smaller never will: a force that fades or misses zero.
constexpr int patience_with_steps = 40;
constexpr double stalled = 0.25;  // of the imbalance before: Newton's method, but for what it does not see, does better
// Of the forces at play, from far to near: where Newton's steps are tried after others alone, what may be left to a
// finer yardstick, and where slopes are rounding.
constexpr double far_from_balance = 1e-3, left_to_parts = 1e-5, no_slope = 1e-6;
constexpr double no_hold = 1e-7;  // of the stiffness: an implicit step that is Newton's
// Of Newton's step where states are free, in comparable units: far above rounding, far below what determines a state.
constexpr double newton_state_hold = 1e-8;

constexpr double infinite = std::numeric_limits<double>::infinity();

double farthest(const OperatingPoint& from, const OperatingPoint& to) {
  double largest = 0;
  for (std::size_t b = 1; b < to.poses.size(); ++b) {
    const double way = norm(to.poses[b].r - from.poses[b].r);
    if (!(way <= largest)) largest = way;
  }
  return largest;
}

}  // namespace

bool escaped(const System& system, const OperatingPoint& from, const OperatingPoint& to) {
  constexpr double escaping_lengths = 1e6;
  return !(farthest(from, to) <= escaping_lengths * system.length());
}

bool Descent::run(OperatingPoint& op, const FirstFreedoms* loose) {
  loose_ = loose;
  equations_.measure_by(Yardstick::model);
  first_ = lowest_ = op;
  for (iteration_ = 0; iteration_ < options_.iteration_limit; ++iteration_) {
    // A motion that comes closer to rest goes on even in a model so large that the effort is soon spent.
    const bool spent = equations_.effort() > options_.effort_limit;
    if (spent && loose) return false;
    equations_.evaluate(op, Partials::yes);
    // One yardstick for the whole search, or a step could pass by growing what it is measured against.
    force_ = std::max(force_, equations_.force_scale());
    merit_ = equations_.merit(force_);
    history_.add(std::isfinite(merit_) ? equations_.imbalance_of_functions() : infinite, equations_.rate_of_states());
    if (!std::isfinite(merit_)) return false;
    if (iteration_ == 0) first_force_ = force_;
    bool all_is_rounding = false;
    if (iteration_ == 0 && !loose) {
      const bool balanced = balanced_to_rounding(equations_);
      if (balanced || equations_.is_moved_by_rounding_alone()) {
        const auto j = judge(equations_, op);
        // A load no larger than what rounding may do to stiff elements moves soft ones all the same.
        if (balanced && (!j || (j->determined && equations_.excess() <= 1))) return true;
        all_is_rounding = j && j->determined && j->largest <= last_digits;
      }
    }
    if (escaped(system_, first_, op)) return false;
    note_arrivals();
    // Against the first yardstick: forces that grow without end do not make a point better.
    const double merit = equations_.merit(first_force_);
    if (merit < nearer * lowest_merit_ || merit == 0) improved_ = iteration_;
    // What falls freely comes no closer to rest until it lands.
    if (const double way = farthest(first_, op); way > 1.2 * way_) way_ = way, improved_ = iteration_;
    // Nor does what turns under a steady load, until it meets a stop.
    if (turned_ > 1.2 * turned_before_ && turned_ > 1) {
      if (std::abs(merit - steady_) <= 0.02 * merit) improved_ = iteration_;
      turned_before_ = turned_, steady_ = merit;
    }
    if (merit < lowest_merit_ || (merit == 0 && equations_.yardstick() == Yardstick::part))
      lowest_merit_ = merit, lowest_ = op;
    // Where forces are balanced and Newton's steps do not help, states that are held go on by ever less.
    const int patience = inputs_lead_ ? descent_patience / 8 : spent ? descent_patience / 4 : descent_patience;
    if (iteration_ > improved_ + patience) return false;
    const double level = std::sqrt(merit_);
    if (level <= force_balance || equations_.excess() <= little_excess || all_is_rounding) {
      if (finish(op)) return true;
      if (iteration_ > converging_ + patience_with_steps) return false;
      stalled_ = level >= stalled * before_ || level == 0 ? stalled_ + 1 : 0;
      if (stalled_ == 3 && equations_.yardstick() == Yardstick::model) {
        change_yardstick();
        continue;
      }
    } else {
      converging_ = iteration_;
    }
    before_ = level;
    if (newton(op, level)) continue;
    if (!implicit(op)) {
      if (equations_.yardstick() == Yardstick::part || level > left_to_parts) return false;
      change_yardstick();
      continue;
    }
    transient_ = hold_ > no_hold;
  }
  return false;
}

// What moves now is too light to count among the forces of the model.
void Descent::change_yardstick() {
  equations_.measure_by(Yardstick::part);
  hold_ = 1;
  transient_ = false;
  before_ = lowest_merit_ = std::numeric_limits<double>::infinity();
  improved_ = converging_ = iteration_;
}

void Descent::note_move(const Eigen::VectorXd& step, double factor) {
  const AugmentedSystem& augmented = equations_.augmented();
  bool pushed = false;
  double turn = 0;
  for (const BodyBlock& b : system_.layout().bodies) {
    if (b.turns()) turn = std::max(turn, factor * step.segment<3>(b.offset + 3).norm());
  }
  turned_ += turn;
  for (Eigen::Index k = 0; k < step.size(); ++k) {
    if (excess_(k) <= residual_noise) continue;  // nothing pushed there, whatever a nearly singular matrix makes of it
    const auto i = static_cast<std::int32_t>(k);
    const bool pose = i < augmented.lambda(0);
    if (!pose && i < augmented.state(0)) continue;
    move_(k) = std::abs(factor * step(k)) / (pose ? system_.coordinate_scale(i) : 1.0);
    moved_at_[static_cast<std::size_t>(k)] = pushes_;
    pushed = true;
  }
  if (!pushed) return;
  moves_[static_cast<std::size_t>(pushes_) % moves_.size()] = {pushes_, factor * step, pushing_, blur_};
  ++pushes_;
}

std::optional<Eigen::VectorXd> Descent::solve(double hold) {
  // A state that nothing determines takes its time as everything does on the way down.
  const double hold_states = std::max(hold, newton_state_hold);
  bool factored = equations_.factor(lu_, equations_.tangent(hold, held_states_ ? hold_states : 0));
  // Where coordinates are free, holding states does not help, and those that are determined would only be late.
  if (!factored && !held_states_)
    factored = held_states_ = equations_.factor(lu_, equations_.tangent(hold, hold_states));
  // Beside states that are free, free coordinates are held by as little, or no Newton's step leads inputs to zero.
  if (!factored && hold == 0 && held_states_)
    factored = equations_.factor(lu_, equations_.tangent(newton_state_hold, newton_state_hold));
  if (!factored) return std::nullopt;
  Eigen::MatrixXd step = -equations_.residual();
  lu_.solve(step);
  if (!step.allFinite()) return std::nullopt;
  // Newton's is the least: where only a combination of states is free, it keeps its value.
  if (held_states_ && hold == 0) return without_undetermined(step.col(0));
  return hold < no_hold ? without_drift(step.col(0)) : Eigen::VectorXd(step.col(0));
}

// Where it goes downhill, so that it does not climb to an unstable equilibrium; close to the solution rounding
// decides and the step is taken as it is. So it is where forces are balanced and integrators still have an input, and
// from there on: no slope tells where that vanishes.
bool Descent::newton(OperatingPoint& op, double level) {
  inputs_lead_ = held_states_ && (equations_.imbalance() <= no_slope * force_ || (inputs_lead_ && !transient_));
  if (transient_ && level >= far_from_balance && !inputs_lead_) return false;
  transient_ = true;
  const auto step = solve(0);
  if (!step || (level >= no_slope && !inputs_lead_ && equations_.slope(*step) >= 0)) return false;
  for (const double fraction : {1.0, 0.5, 0.25}) {
    double taken = 0;
    OperatingPoint next = moved(system_, op, equations_.augmented(), *step, fraction, options_.limits, &taken);
    // A matrix that is all but singular sends what nothing holds beyond everything.
    if (escaped(system_, first_, next)) break;
    if (level > no_slope) settle(equations_, next);
    equations_.evaluate(next, Partials::no);
    constexpr double rounding_of_merit = 1e-24;
    const double after = equations_.merit(force_);
    if (after <= (level < force_balance ? 4 * merit_ + rounding_of_merit : merit_ * (1 - 0.5 * fraction))) {
      hold_ *= after <= merit_ ? std::clamp(0.5 * std::sqrt(after / std::max(merit_, 1e-300)), 0.05, 0.5) : 2.0;
      op = std::move(next);
      note_move(*step, taken);
      system_.remember(op);
      transient_ = false;
      return true;
    }
  }
  equations_.evaluate(op, Partials::yes);
  return false;
}

// An implicit step of a damped motion: downhill, and as long as the linear model foretells the slope along the step.
// Reactions do no work along it, so the slope speaks of the pose alone; the imbalance may grow on the way.
bool Descent::implicit(OperatingPoint& op) {
  for (int k = 0; k < 40; ++k) {  // a factor of 1e24: forces may be functions, whose stiffness is not known before
    const auto step = solve(hold_);
    const double slope = step ? equations_.slope(*step) : 0;
    if (step && slope < 0) {
      double taken = 0;
      OperatingPoint next = moved(system_, op, equations_.augmented(), *step, 1.0, options_.limits, &taken);
      settle(equations_, next);
      const double foretold = -hold_ * equations_.damping(*step);
      equations_.evaluate(next, Partials::no);
      const double off = std::abs(equations_.slope(*step) - foretold) / -slope;
      if (off <= 0.5 && equations_.residual().allFinite()) {
        hold_ *= off < 0.1 ? 0.25 : off < 0.25 ? 0.5 : 1.0;
        op = std::move(next);
        note_move(*step, taken);
        system_.remember(op);
        return true;
      }
    }
    hold_ *= 4;
    equations_.evaluate(op, Partials::yes);
  }
  return false;
}

}  // namespace dynalin
