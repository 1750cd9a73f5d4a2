#include "analysis/equilibrium_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/damped_motion.h"
#include "analysis/homotopy.h"
#include "analysis/levenberg_marquardt.h"
#include "analysis/original_method.h"
#include "analysis/pushed_away.h"
#include "analysis/settled_reactions.h"
#include "analysis/static_refusal.h"
#include "analysis/static_step.h"
#include "analysis/turned_over.h"
#include "analysis/unheld_motion.h"

namespace dynalin {

namespace {

// Where nothing leads downhill, Newton's method may still: slender beams roll up by it.
OriginalMethod newton_at_last() {
  OriginalMethod method;
  method.iteration_limit = 200;
  return method;
}

// Whether anything has kinks, as contacts that close and the functions IMPACT and STEP.
bool may_set_in(const System& system, const OperatingPoint& op) {
  ExpressionScratch scratch;
  SwitchList kinks;
  system.switches(system.motion(op), scratch, kinks);
  return !kinks.value.empty();
}

// Another place to begin: every part turned and moved, every state changed that is not held, at most as far as the
// model is long, a radian or one; the same places in every run.
OperatingPoint elsewhere(const System& system, OperatingPoint op, int k) {
  std::mt19937_64 bits(static_cast<std::uint64_t>(k));
  const auto draw = [&](double size) { return size * (std::ldexp(static_cast<double>(bits() >> 11), -52) - 1); };
  const double size = k % 2 ? 0.3 : 1.0;
  for (std::size_t b = 1; b < op.poses.size(); ++b) {
    Vector shift, turn;
    for (std::size_t c = 0; c < 3; ++c) shift[c] = draw(size * system.length()), turn[c] = draw(3 * size);
    op.poses[b].r += shift;
    op.poses[b].R = orthonormalized(rotation_exponential(turn) * op.poses[b].R);
  }
  for (std::size_t z = 0; z < op.state.size(); ++z) {
    const double change = draw(3 * size);
    if (!system.layout().states[z].held_in_statics) op.state[z] += change;
  }
  return op;
}

// The point settled, if it is an equilibrium within a tolerance that was stated.
std::optional<OperatingPoint> within(const StaticTolerance& tolerance, StaticEquations& equations, OperatingPoint op,
                                     Findings& findings) {
  equations.measure_by(Yardstick::model);
  settle(equations, op);
  equations.evaluate(op, Partials::yes);
  const auto j = judge(equations, op);
  if (!j || !(j->largest <= tolerance.error) || !(equations.imbalance() <= tolerance.imbalance)) return std::nullopt;
  const Eigen::VectorXd& r = equations.residual();
  const Eigen::Index first = equations.augmented().algebraic(0);
  if (r.size() > first && !(r.tail(r.size() - first).cwiseAbs().maxCoeff() <= tolerance.imbalance)) return std::nullopt;
  findings.warnings.warning(
      "loose-equilibrium", {},
      fmt::format("no exact equilibrium was found; this point is within what EQUILIBRIUM allows: a force of {:.3e} is "
                  "out of balance (IMBALANCE {:g}), and the next step would be {:.3e} of the model's size (ERROR {:g})",
                  equations.imbalance(), tolerance.imbalance, j->largest, tolerance.error));
  equations.system().remember(op);
  return op;
}

bool settles(StaticEquations& equations, OperatingPoint& op, const StaticsOptions& options, const DampedMotion& motion,
             const FirstFreedoms& loose, StaticHistory& history) {
  return relax_by_motion(equations, op, motion, history, options.effort_limit, [&](OperatingPoint& here) {
    return Descent(equations, options, history).polish(here, loose);
  });
}

// The search that METHOD=ORIGINAL or DYNAMIC asks for, exactly at rest in the end.
bool asked_for(StaticEquations& equations, OperatingPoint& op, const StaticsOptions& options, StaticHistory& history,
               Findings& findings) {
  if (!options.original && !options.motion) return false;
  const OperatingPoint first = op;
  history.begin(options.original ? "Newton's method" : "damped motion");
  const FirstFreedoms loose = freedoms_at(equations, first);
  const bool found = options.original ? iterate_by_newton(equations, op, *options.original, history) &&
                                            Descent(equations, options, history).polish(op, loose)
                                      : settles(equations, op, options, *options.motion, loose, history);
  if (found && !escaped(equations.system(), first, op) && !turned_over(equations.system(), first, op)) return true;
  findings.warnings.warning(
      "other-search", {},
      options.original
          ? fmt::format("Newton's method of EQUILIBRIUM/METHOD=ORIGINAL came to no equilibrium in {} iterations: the "
                        "default search goes on from the first point",
                        options.original->iteration_limit)
          : "the damped motion of EQUILIBRIUM/DYNAMIC did not settle: the default search goes on from the first point");
  equations.measure_by(Yardstick::model);
  return false;
}

struct Downhill {
  OperatingPoint op;
  bool moved = false, held_states = false;
};

// What loads push off a saddle goes down from there, perhaps to another one. A long way down is gone in parts: each
// search ends after so many steps that bring it no closer to rest.
Downhill off_saddles(StaticEquations& equations, const OperatingPoint& found, const OperatingPoint& drawn,
                     const StaticsOptions& options, StaticHistory& history, Findings& findings) {
  constexpr int most_searches = 12;
  const System& system = equations.system();
  history.begin("saddles");
  Downhill last{found};
  std::optional<Eigen::VectorXd> step = step_off_saddle(equations, found, drawn);
  OperatingPoint op = found;
  for (int k = 0; step && k < most_searches && equations.effort() < options.effort_limit; ++k) {
    if (step->size() > 0) op = moved(system, op, equations.augmented(), *step, 1.0, options.limits);
    Descent descent(equations, options, history);
    const bool rests = descent.run(op);
    // No way goes on where a joint is turned over, or where elements have no definite values, as curves that touch with
    // the same curvature.
    const bool is_no_place =
        rests && (turned_over(system, drawn, op) != nullptr || !system.domain_violation(system.motion(op)).empty());
    if (is_no_place || escaped(system, drawn, op)) break;
    if (rests) {
      last = {op, true, descent.held_states()};
      step = step_off_saddle(equations, op, drawn);
    } else {
      step->resize(0);
    }
    equations.measure_by(Yardstick::model);
  }
  equations.measure_by(Yardstick::model);
  if (step) {
    findings.warnings.warning("saddle", {},
                              "the equilibrium that was found is unstable: loads of the drawn model push it away, and "
                              "the way down from there was not followed to its end");
  }
  return last;
}

}  // namespace

EquilibriumSearch::EquilibriumSearch(const System& system, OperatingPoint drawn, const StaticsOptions& options,
                                     StaticsReport& report, Findings& findings)
    : system_(system),
      options_(options),
      report_(report),
      findings_(findings),
      equations_(system),
      history_(options.progress, options.told.of("static equilibrium")),
      descent_(equations_, options, history_),
      op_(std::move(drawn)) {
  settle_after_motion(equations_, op_);
  drawn_ = op_;
}

Result<OperatingPoint> EquilibriumSearch::run(AtSaddles at_saddles, const std::vector<double>& first_state) {
  const bool asked = found_ = asked_for(equations_, op_, options_, history_, findings_);
  if (!found_) search_downhill();
  if (!found_ && is_hopeless()) return refused();
  if (!found_) {
    loose_ = freedoms_at(equations_, drawn_);
    search_by_other_ways();
  }
  if (!found_ && options_.tolerance) {
    if (auto near = near_enough()) return *std::move(near);
  }
  if (!found_) search_from_other_places();
  if (!found_) return refused();
  // A search that is asked for finds what it finds.
  if (at_saddles == AtSaddles::go_on && !asked) {
    Downhill down = off_saddles(equations_, op_, drawn_, options_, history_, findings_);
    if (down.moved) op_ = std::move(down.op), held_states_ = down.held_states;
  }
  if (held_states_) keep_first_state(first_state);
  equations_.evaluate(op_, Partials::yes);
  if (is_grossly_unbalanced()) return refused();
  OperatingPoint rest = with_report(std::move(op_));
  if (options_.tolerance && report_.imbalance > options_.tolerance->imbalance) {
    findings_.warnings.warning(
        "rounding-above-imbalance", {},
        fmt::format("IMBALANCE of EQUILIBRIUM asks for {:g}, and rounding of the positions alone leaves {:.3e}",
                    options_.tolerance->imbalance, report_.imbalance));
  }
  return rest;
}

// Of the last evaluation. A step so small that it is taken for rounding may end where forces jump, or are out of all
// proportion: no rounding makes as much of them, nor was there less to be balanced at first.
bool EquilibriumSearch::is_grossly_unbalanced() {
  constexpr double gross = 1e-3, far_above_rounding = 1e6;
  const double imbalance = equations_.imbalance();
  if (!(imbalance > gross * equations_.force_scale()) || equations_.excess() < far_above_rounding) return false;
  if (equations_.is_moved_by_rounding_alone()) return false;
  equations_.evaluate(drawn_, Partials::yes);
  const bool is_gross = imbalance > gross * equations_.imbalance();
  equations_.evaluate(op_, Partials::yes);
  return is_gross;
}

bool EquilibriumSearch::is_of_this_mechanism() {
  const ElementLabel* joint = turned_over(system_, drawn_, op_);
  if (joint) turned_ = joint;
  return !joint;
}

void EquilibriumSearch::search_downhill() {
  history_.begin("downhill");
  op_ = drawn_;
  found_ = descent_.run(op_) && is_of_this_mechanism();
  lowest_ = nearest_ = descent_.lowest();
  held_states_ = descent_.held_states();
}

void EquilibriumSearch::note_nearest(const OperatingPoint& point) {
  if (escaped(system_, drawn_, point)) return;
  equations_.evaluate(nearest_, Partials::no);
  const double force = equations_.force_scale(), before = equations_.merit(force);
  equations_.evaluate(point, Partials::no);
  if (equations_.merit(force) < before) nearest_ = point;
}

// Whether no search needs to be made.
bool EquilibriumSearch::is_hopeless() {
  equations_.measure_by(Yardstick::model);
  equations_.evaluate(drawn_, Partials::yes);
  // Nothing can be searched where the equations have no value.
  if (!equations_.residual().allFinite()) return true;
  // What nothing holds at the first point, at the best and at the last is held nowhere, unless forces set in
  // somewhere: contacts of inclined surfaces may have been passed by on the way.
  if (may_set_in(system_, drawn_)) return false;
  const auto unheld = unheld_parts(equations_, drawn_);
  if (!unheld.empty() && unheld == unheld_parts(equations_, lowest_) && unheld == unheld_parts(equations_, op_))
    return true;
  proof_ = unheld_everywhere(equations_, {drawn_, lowest_, op_});
  return !proof_.empty();
}

void EquilibriumSearch::descend(OperatingPoint start) {
  const auto take = [&](Descent& descent, bool rests) {
    found_ = rests && !escaped(system_, drawn_, op_) && is_of_this_mechanism();
    held_states_ = descent.held_states();
    equations_.measure_by(Yardstick::model);
    if (!rests) note_nearest(descent.lowest());
  };
  op_ = start;
  Descent down(equations_, options_, history_);
  take(down, down.run(op_, &loose_));
  if (!may_go_on()) return;
  // Downhill leads away from a saddle.
  op_ = std::move(start);
  Descent beside(equations_, options_, history_);
  take(beside, beside.polish(op_, loose_));
}

void EquilibriumSearch::search_by_other_ways() {
  const auto reduce = [&](StepsMay may) {
    history_.begin(may == StepsMay::climb ? "least squares that may climb" : "least squares");
    for (const OperatingPoint* start : {&lowest_, &drawn_}) {
      OperatingPoint least = *start;
      if (may_go_on() && reduce_imbalance(equations_, least, 100, may)) descend(std::move(least));
    }
  };
  reduce(StepsMay::fall);
  if (may_go_on()) {
    history_.begin("Newton's method");
    OperatingPoint at = drawn_;
    StaticHistory apart({});  // its points need not meet any equation on the way: they say nothing of what is least
    if (iterate_by_newton(equations_, at, newton_at_last(), apart)) descend(std::move(at));
    equations_.measure_by(Yardstick::model);
  }
  for (const OperatingPoint* start : {&lowest_, &drawn_}) {
    for (const bool forward : {true, false}) {
      if (!may_go_on()) break;
      history_.begin("continuation");
      if (auto rest = follow_to_rest(equations_, *start, forward)) descend(std::move(*rest));
    }
  }
  for (const OperatingPoint* start : {&drawn_, &lowest_}) {
    if (!may_go_on()) break;
    history_.begin("damped motion");
    OperatingPoint moving = *start;
    if (settles(equations_, moving, options_, {}, loose_, history_)) descend(std::move(moving));
  }
  reduce(StepsMay::climb);
}

void EquilibriumSearch::search_from_other_places() {
  for (int k = 0; k < options_.restarts && may_go_on(); ++k) {
    history_.begin("from other places");
    OperatingPoint other = elsewhere(system_, drawn_, k);
    if (reduce_imbalance(equations_, other, 60)) descend(std::move(other));
  }
}

// What a tolerance that is stated takes for an equilibrium.
std::optional<OperatingPoint> EquilibriumSearch::near_enough() {
  for (const OperatingPoint* near : {&lowest_, &drawn_}) {
    if (escaped(system_, drawn_, *near)) continue;
    if (auto rest = within(*options_.tolerance, equations_, *near, findings_)) return with_report(*std::move(rest));
  }
  return std::nullopt;
}

// A pure integrator that balances at its first value keeps it. Where only combinations of states are free, these do.
void EquilibriumSearch::keep_first_state(const std::vector<double>& first_state) {
  OperatingPoint kept = op_;
  kept.state = first_state;
  settle(equations_, kept);
  equations_.evaluate(kept, Partials::yes);
  const auto j = judge(equations_, kept);
  if (j && j->balanced && j->determined) {
    op_ = std::move(kept);
    return;
  }
  kept = op_;
  kept.state = first_state;
  equations_.evaluate(op_, Partials::yes);
  auto back = put_back(equations_, op_, kept);
  if (!back) return;
  const FirstFreedoms any{*back, std::vector<bool>(static_cast<std::size_t>(equations_.residual().size()), true)};
  if (Descent(equations_, options_, history_).polish(*back, any)) op_ = *std::move(back);
  equations_.measure_by(Yardstick::model);
}

tl::unexpected<Failure> EquilibriumSearch::refused() {
  equations_.measure_by(Yardstick::model);
  Failure f = static_refusal(equations_, nearest_, proof_, history_.lines());
  if (!descent_.doubt().empty()) f.message += "; " + descent_.doubt();
  if (turned_)
    f.message += fmt::format("; there is one with {} turned over, which no motion leads to", turned_->full_text());
  report_.iterations = history_.iterations();
  report_.imbalance = equations_.imbalance();
  return tl::unexpected(std::move(f));
}

// Of the last evaluation.
OperatingPoint EquilibriumSearch::with_report(OperatingPoint rest) {
  report_.iterations = std::max(0, history_.iterations() - 1);
  report_.imbalance = equations_.imbalance();
  findings_.redundant_rows = equations_.partition().redundant;
  return rest;
}

}  // namespace dynalin
