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
// Residuals in units of rounding: those that say nothing, those that Newton's steps alone may settle, and those of a
// force that certainly acted.
constexpr double residual_noise = 100, little_excess = 1e4, certain_excess = 1e5;
constexpr double settled_move = 1e-6;  // of the size of an unknown
constexpr double last_digits = 1e-12;  // the same
constexpr double nearer = 0.8;         // of the least merit or step so far: progress
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
  constexpr double far = 1e6;
  return !(farthest(from, to) <= far * system.length());
}

bool Descent::run(OperatingPoint& op, const FirstFreedoms* loose) {
  loose_ = loose;
  equations_.measure_by(Yardstick::model);
  first_ = lowest_ = op;
  for (iteration_ = 0; iteration_ < options_.iteration_limit; ++iteration_) {
    // A motion that comes closer to rest goes on even in a model so large that the effort is soon spent.
    const bool spent = equations_.effort() > options_.effort_limit;
    if (spent && loose) return false;
    equations_.evaluate(op, true);
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

// Newton's steps in the unknowns' own sizes until nothing but rounding is left.
bool Descent::finish(OperatingPoint& op) {
  constexpr int steps = 60;
  constexpr double no_last_step = 1e-2;  // of the size of an unknown
  OperatingPoint here = op;
  double smallest = infinite, least_excess = infinite;
  int stuck = 0, unbalanced = 0;  // steps since the one that was shorter, and the one that brought balance closer
  std::optional<OperatingPoint> rest, faded, freed;
  for (int k = 0; k < steps; ++k) {
    settle(equations_, here);
    equations_.evaluate(here, true);
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
  equations_.evaluate(op, true);
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
Eigen::VectorXd Descent::determined_step(const RestJudgement& j) const {
  if (std::ranges::find(j.indifferent, true) == j.indifferent.end()) return j.newton;
  return without_undetermined(j.newton);
}

Eigen::VectorXd Descent::without_undetermined(Eigen::VectorXd step) const {
  const AugmentedSystem& augmented = equations_.augmented();
  const Eigen::VectorXd open = undetermined_part(equations_, step);
  const Eigen::Index states = step.size() - augmented.state(0);
  step.head(augmented.lambda(0)) -= open.head(augmented.lambda(0));
  step.tail(states) -= open.tail(states);
  return step;
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
    double work = 0, unseen = 0;
    for (Eigen::Index k = 0; k < d.way.size(); ++k) {
      if (k >= equations_.augmented().lambda(0) && k < equations_.augmented().state(0)) continue;
      work += move.residual(k) * d.way(k);
      unseen += move.rounding(k) * std::abs(d.way(k));
    }
    d.driven = std::abs(work) > residual_noise * unseen;
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
  equations_.evaluate(op, true);
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
  equations_.evaluate(op, true);
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
  return Eigen::VectorXd(step.col(0));
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
    equations_.evaluate(next, false);
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
  equations_.evaluate(op, true);
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
      equations_.evaluate(next, false);
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
    equations_.evaluate(op, true);
  }
  return false;
}

}  // namespace dynalin
