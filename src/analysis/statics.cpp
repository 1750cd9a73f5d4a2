#include "analysis/statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "analysis/assembly_moves.h"
#include "analysis/damped_motion.h"
#include "analysis/homotopy.h"
#include "analysis/levenberg_marquardt.h"
#include "analysis/original_method.h"
#include "analysis/pushed_away.h"
#include "analysis/static_descent.h"
#include "analysis/static_refusal.h"
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

// Whether rounding of positions is as large as the mechanism: then nothing can be told of forces. The spread is that of
// half of the markers, which a few that are far out do not change.
std::string too_far_out(const System& system, const OperatingPoint& op) {
  const Layout& layout = system.layout();
  std::array<std::vector<double>, 3> at;
  for (std::size_t m = 1; m < layout.markers.size(); ++m) {
    const MarkerPlace& place = *layout.markers[m];
    const Pose& pose = op.poses[static_cast<std::size_t>(place.body.index)];
    const Vector p = pose.r + pose.R * place.p_BM;
    for (std::size_t c = 0; c < 3; ++c) at[c].push_back(p[c]);
  }
  if (at[0].size() < 3) return {};
  const auto half = static_cast<std::ptrdiff_t>(at[0].size() / 2),
             most = static_cast<std::ptrdiff_t>(at[0].size() * 3 / 4);
  const auto middle = [&](std::vector<double>& x, std::ptrdiff_t k) {
    std::nth_element(x.begin(), x.begin() + k, x.end());
    return x[static_cast<std::size_t>(k)];
  };
  double spread = 0;
  for (std::vector<double>& x : at) {
    const double centre = middle(x, half);
    for (double& v : x) v = std::abs(v - centre);
    spread = std::max(spread, middle(x, most));
  }
  // Markers that are drawn in one place say nothing of the size.
  std::vector<double> distance;
  for (const Pose& pose : op.poses) distance.push_back(norm(pose.r));
  const double coincide =
      4 * std::numeric_limits<double>::epsilon() * middle(distance, static_cast<std::ptrdiff_t>(distance.size() / 2));
  for (std::size_t b = 1; b < op.poses.size(); ++b) {
    const double off = norm(op.poses[b].r) * std::numeric_limits<double>::epsilon();
    if (off <= 1e-6 * spread || spread <= coincide) continue;
    return fmt::format(
        "{} is so far out that its position is known to {:.1e} only, in a model most of which lies within "
        "{:.3g}",
        layout.bodies[b].label.full_text(), off, spread);
  }
  return {};
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
  equations.settle(op);
  equations.evaluate(op, true);
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
             const std::vector<bool>& loose, StaticHistory& history) {
  return relax_by_motion(equations, op, motion, history, options.effort_limit, [&](OperatingPoint& here) {
    return Descent(equations, options, history).polish(here, loose);
  });
}

// The search that METHOD=ORIGINAL or DYNAMIC asks for, exactly at rest in the end.
bool asked_for(StaticEquations& equations, OperatingPoint& op, const StaticsOptions& options, StaticHistory& history,
               Findings& findings) {
  if (!options.original && !options.motion) return false;
  const OperatingPoint first = op;
  const std::vector<bool> loose = free_unknowns(equations, first);
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

Result<OperatingPoint> find_equilibrium(const System& system, OperatingPoint op, const StaticsOptions& options,
                                        StaticsReport& report, Findings& findings) {
  if (const auto& driven = system.layout().velocity_driven; !driven.empty()) {
    Failure f{"static analysis",
              "motions that prescribe a velocity or an acceleration contradict rest",
              {},
              "motion-at-rest"};
    for (const ElementLabel* label : driven) f.details.push_back(label->full_text());
    return tl::unexpected(f);
  }
  if (const std::string far = too_far_out(system, op); !far.empty())
    return tl::unexpected(Failure{"static analysis", far, {}, "far-markers"});
  // An equilibrium in the course of a quasi-static simulation is one of those. Otherwise parts are put together first:
  // what assembly moves has not slipped.
  const bool in_course = op.mode == AnalysisMode::quasi_statics;
  if (!in_course) op.mode = AnalysisMode::initial_conditions;
  op.delays.reset();  // at rest the past is the present
  const std::vector<double> first_state = op.state;
  for (auto* x : {&op.velocity, &op.acceleration, &op.state_rate}) std::fill(x->begin(), x->end(), 0.0);
  auto assembled = assemble_position(system, op, findings);
  if (!assembled) return assembled;
  // Between points of a simulation nothing is drawn.
  if (!in_course) warn_of_moves(system, op, *assembled, findings.warnings);
  op = std::move(*assembled);
  if (!in_course) op.mode = AnalysisMode::statics;

  StaticEquations equations(system);
  StaticHistory history(options.progress);
  Descent descent(equations, options, history);
  equations.settle(op);
  const OperatingPoint drawn = op;
  const bool asked = asked_for(equations, op, options, history, findings);
  bool found = asked;
  const ElementLabel* turned = nullptr;  // by a point that was balanced otherwise
  const auto is_of_this_mechanism = [&] {
    const ElementLabel* joint = turned_over(system, drawn, op);
    if (joint) turned = joint;
    return !joint;
  };
  if (!found) op = drawn, found = descent.run(op) && is_of_this_mechanism();
  const OperatingPoint lowest = descent.lowest();
  std::vector<std::string> proof;
  const auto refuse = [&] {
    equations.measure_by(Yardstick::model);
    Failure f = static_refusal(equations, lowest, proof, history.lines());
    if (!descent.doubt().empty()) f.message += "; " + descent.doubt();
    if (turned) {
      f.message += fmt::format("; there is one with {} turned over, which no motion leads to", turned->full_text());
    }
    report.iterations = history.iterations();
    report.imbalance = equations.imbalance();
    return f;
  };
  if (!found) {
    equations.measure_by(Yardstick::model);
    equations.evaluate(drawn, true);
    // Nothing can be searched where the equations have no value.
    if (!equations.residual().allFinite()) return tl::unexpected(refuse());
    // What nothing holds at the first point, at the best and at the last is held nowhere, unless forces set in
    // somewhere: contacts of inclined surfaces may have been passed by on the way.
    if (!may_set_in(system, drawn)) {
      const auto unheld = unheld_parts(equations, drawn);
      if (!unheld.empty() && unheld == unheld_parts(equations, lowest) && unheld == unheld_parts(equations, op))
        return tl::unexpected(refuse());
      proof = unheld_everywhere(equations, {drawn, lowest, op});
      if (!proof.empty()) return tl::unexpected(refuse());
    }
  }
  std::vector<bool> loose;  // what nothing held to begin with
  if (!found) loose = free_unknowns(equations, drawn);
  bool held_states = descent.held_states();
  const auto descend = [&](OperatingPoint start) {
    op = std::move(start);
    Descent again(equations, options, history);
    found = again.run(op, &loose) && !escaped(system, drawn, op) && is_of_this_mechanism();
    held_states = again.held_states();
    equations.measure_by(Yardstick::model);
  };
  const auto go_on = [&] { return !found && equations.effort() < options.effort_limit; };
  for (const OperatingPoint* start : {&lowest, &drawn}) {
    OperatingPoint least = *start;
    if (go_on() && reduce_imbalance(equations, least, 100)) descend(std::move(least));
  }
  if (go_on()) {
    OperatingPoint at = drawn;
    StaticHistory apart({});  // its points need not meet any equation on the way: they say nothing of what is least
    if (iterate_by_newton(equations, at, newton_at_last(), apart)) descend(std::move(at));
    equations.measure_by(Yardstick::model);
  }
  for (const OperatingPoint* start : {&lowest, &drawn}) {
    for (const bool forward : {true, false}) {
      if (!go_on()) break;
      if (auto rest = follow_to_rest(equations, *start, forward)) descend(std::move(*rest));
    }
  }
  for (const OperatingPoint* start : {&drawn, &lowest}) {
    if (!go_on()) break;
    OperatingPoint moving = *start;
    if (settles(equations, moving, options, {}, loose, history)) descend(std::move(moving));
  }
  if (!found && options.tolerance) {
    for (const OperatingPoint* near : {&lowest, &drawn}) {
      if (escaped(system, drawn, *near)) continue;
      auto loose_rest = within(*options.tolerance, equations, *near, findings);
      if (!loose_rest) continue;
      report.iterations = std::max(0, history.iterations() - 1);
      report.imbalance = equations.imbalance();
      findings.redundant_rows = equations.partition().redundant;
      return *std::move(loose_rest);
    }
  }
  for (int k = 0; k < options.restarts && go_on(); ++k) {
    OperatingPoint other = elsewhere(system, drawn, k);
    if (reduce_imbalance(equations, other, 60)) descend(std::move(other));
  }
  if (!found) return tl::unexpected(refuse());
  // A simulation goes on where it is, and a search that is asked for finds what it finds.
  if (!in_course && !asked) {
    Downhill down = off_saddles(equations, op, drawn, options, history, findings);
    if (down.moved) op = std::move(down.op), held_states = down.held_states;
  }
  if (held_states) {
    // A pure integrator that balances at its first value keeps it.
    OperatingPoint kept = op;
    kept.state = first_state;
    equations.settle(kept);
    equations.evaluate(kept, true);
    const auto j = judge(equations, kept);
    if (j && j->balanced && j->determined) op = std::move(kept);
  }
  equations.evaluate(op, true);
  report.iterations = std::max(0, history.iterations() - 1);
  report.imbalance = equations.imbalance();
  if (options.tolerance && report.imbalance > options.tolerance->imbalance) {
    findings.warnings.warning(
        "rounding-above-imbalance", {},
        fmt::format("IMBALANCE of EQUILIBRIUM asks for {:g}, and rounding of the positions alone leaves {:.3e}",
                    options.tolerance->imbalance, report.imbalance));
  }
  findings.redundant_rows = equations.partition().redundant;
  return op;
}

Result<OperatingPoint> static_operating_point(const System& system, OperatingPoint start, const StaticsOptions& options,
                                              StaticsReport& report, Findings& findings) {
  auto op = find_equilibrium(system, std::move(start), options, report, findings);
  if (op) {
    // What statics alone evaluate keeps its value at rest where velocities come back.
    system.remember(*op);
    report.at_rest = *op;
  }
  if (op && op->time == 0 && options.restore_velocities) op = initial_velocity(system, std::move(*op), findings);
  if (op) op = reconcile_velocity(system, std::move(*op), findings);
  // Those of the dataset, and those that a MOTION prescribes.
  const bool moves = op && std::ranges::any_of(op->velocity, [](double v) { return v != 0; });
  if (moves) op->mode = AnalysisMode::initial_conditions;
  if (op) op = solve_acceleration(system, std::move(*op), findings);
  return op;
}

}  // namespace dynalin
