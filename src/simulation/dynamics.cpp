#include "simulation/dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "simulation/consistent_points.h"
#include "simulation/event_density.h"
#include "simulation/event_sides.h"
#include "simulation/integration_bounds.h"
#include "simulation/known_event.h"
#include "simulation/motion_equations.h"
#include "simulation/moving_rows.h"
#include "simulation/point_refinement.h"
#include "simulation/pose_change.h"
#include "simulation/stopped_integration.h"

namespace dynalin {

namespace {

// Rows that were left out and are farther than this from being met, in their scales, do not follow from the others;
// the same in errors that a step may have, which leave them so far where they hardly follow.
constexpr double least_left_out = 1e-7, left_out_errors = 100;
// Steps that fail on hardly any way, after which there is no going on.
constexpr int failure_limit = 4;
constexpr double hardly_any_way = 1e-4;  // of the whole time
constexpr double just_beyond = 1e-6;     // of the whole time
constexpr double least_limit_of_moves =
    1e-8;  // of points that are made consistent, in lengths of the model and radians
constexpr int steps_held_by_rounding = 500;
constexpr double same_instant = 1e-12;   // of the whole time
constexpr double errors_that_live = 10;  // of steps, in a motion that has come to rest
constexpr double shortest_bound = 1e-2;  // of steps, by what elements have to resolve: of the whole time

class Dynamics {
 public:
  Dynamics(const System& system, const IntegratorSettings& settings, const Course& course)
      : system_(system),
        times_(course.times),
        statistics_(course.statistics),
        watch_(course.watch),
        findings_(course.findings),
        points_(system, findings_),
        events_(system),
        bounds_(settings, times_) {}

  Result<AdvancedPoint> run(OperatingPoint from) {
    from.mode = AnalysisMode::dynamics;
    auto start = consistent(std::move(from));
    if (!start) return tl::unexpected(start.error());
    point_ = std::move(*start);
    warn_of_change_point(system_, point_, findings_.warnings);
    system_.record(point_);
    const auto begun_with = act_at_start();
    if (!begun_with) return tl::unexpected(begun_with.error());
    const EventAction& at_start = *begun_with;
    watch_point();
    if (!hand_out(point_, Instant::output, at_start.text))
      return AdvancedPoint{std::move(point_), SimulationEnd::stopped};
    if (at_start.ends()) return AdvancedPoint{std::move(point_), end_of(at_start)};
    if (auto changed = change_outputs(at_start); !changed) return tl::unexpected(changed.error());
    if (MotionUnknowns(system_).size() == 0) return pass_time();
    if (auto begun = begin(at_start.step_size); !begun) return tl::unexpected(begun.error());
    while (true) {
      limit_steps();
      const KnownEvent known = KnownEvent::after(system_, point_, times_.end());
      if (known.follows_at_once(point_.time)) {
        auto action = pass_known_event(known);
        if (!action) return tl::unexpected(action.error());
        if (action->ends()) return AdvancedPoint{std::move(point_), end_of(*action)};
        continue;
      }
      const auto outcome = integrator_->step(std::min(known.before, times_.end()));
      count();
      if (outcome == DaeIntegrator::Outcome::failed) {
        if (auto again = begin_again(); !again) return tl::unexpected(again.error());
        continue;
      }
      bool going_on = true;
      if (auto done = hand_out_until(integrator_->time(), going_on); !done) return tl::unexpected(done.error());
      accept(outcome == DaeIntegrator::Outcome::event);
      if (going_on && next_ > times_.count() && outcome != DaeIntegrator::Outcome::event) {
        last_output_.memory = point_.memory, last_output_.delays = point_.delays;
        return AdvancedPoint{std::move(last_output_), SimulationEnd::reached};
      }
      if (!going_on || !hand_out(point_, Instant::between_outputs)) return ended(SimulationEnd::stopped);
      if (outcome == DaeIntegrator::Outcome::event) {
        auto action = pass_event(integrator_->crossed());
        if (!action) return tl::unexpected(action.error());
        if (action->ends()) return AdvancedPoint{std::move(point_), end_of(*action)};
        if (next_ > times_.count()) return ended(SimulationEnd::reached);
      } else if (auto followed = follow(); !followed) {
        return tl::unexpected(followed.error());
      }
    }
  }

 private:
  Result<OperatingPoint> consistent(OperatingPoint op) {
    return points_.at(std::move(op), equations_ ? left_out_limit() : 0.0);
  }

  // By more than the errors of a run. At a singular configuration constraints say nothing of motions that they hold
  // everywhere else: there the integrator knows better.
  bool moved_far(const OperatingPoint& from, const OperatingPoint& to) const {
    const double limit = std::max(bounds_.error, least_limit_of_moves);
    Eigen::VectorXd faster(static_cast<Eigen::Index>(system_.coordinates()));
    for (std::size_t k = 0; k < to.velocity.size(); ++k)
      faster(static_cast<Eigen::Index>(k)) = to.velocity[k] - from.velocity[k];
    return length_of(system_, change_between(system_, from, to)) > limit ||
           length_of(system_, faster) > limit * equations_->fastest();
  }

  double left_out_limit() const { return std::max(least_left_out, left_out_errors * bounds_.tolerance.relative); }

  // Where there is nothing to integrate.
  Result<AdvancedPoint> pass_time() {
    for (; next_ <= times_.count(); ++next_) {
      point_.time = times_.at(next_);
      if (!hand_out(point_, Instant::output)) return AdvancedPoint{std::move(point_), SimulationEnd::stopped};
    }
    return AdvancedPoint{std::move(point_), SimulationEnd::reached};
  }

  // The integration from the point, which is consistent.
  Result<void> begin(std::optional<double> first_step = {}) {
    std::vector<bool> active = rows_of_motion(system_, point_);
    if (!equations_ || equations_->active() != active) {
      integrator_.reset();
      counted_before_ = statistics_;
      refinement_ = std::make_unique<PointRefinement>(system_, active);
      equations_ = std::make_unique<MotionEquations>(system_, events_, point_, std::move(active), bounds_.tolerance);
      integrator_ = std::make_unique<DaeIntegrator>(*equations_, bounds_.steps);
      longest_ = 0;
      y_.resize(equations_->size()), yp_.resize(equations_->size());
    } else {
      equations_->accept(point_);
    }
    equations_->watch_switches(density_.watches());
    equations_->unknowns().pack(point_, y_, yp_);
    integrator_->start(point_.time, y_, yp_, first_step);
    return {};
  }

  Result<void> make_consistent() {
    auto again = consistent(point_);  // a copy: what goes wrong is said of the point
    if (!again) return tl::unexpected(again.error());
    point_ = std::move(*again);
    if (before_event_) {
      system_.record_behind(*before_event_, point_);
      before_event_.reset();
    } else {
      system_.record(point_);
    }
    return {};
  }
  Result<void> begin_at_consistent() {
    if (auto made = make_consistent(); !made) return made;
    return begin();
  }

  // After a step that failed: from the last point that was accepted, with the constraints looked at anew.
  Result<void> begin_again() {
    const double a_little = just_beyond * bounds_.tolerance.duration;
    Failure why = StoppedIntegration{system_, point_, *integrator_, *equations_, a_little}.failure();
    if (point_.time - first_failure_ > hardly_any_way * bounds_.tolerance.duration) {
      first_failure_ = point_.time;
      failures_ = 0;
    }
    if (++failures_ < failure_limit) {
      if (auto begun = begin_at_consistent()) return {};
    }
    return tl::unexpected(std::move(why));
  }

  // The integrator's step becomes the point. At an event values are not those of either side yet.
  void accept(bool event) {
    before_event_.reset();
    if (event && !system_.layout().delay_calls.empty()) {
      // What DELAYs read jumps there.
      before_event_ = sides().before(point_, points_);
      if (before_event_)
        system_.record(*before_event_);
      else
        before_event_ = point_;
    }
    equations_->unknowns().unpack(integrator_->time(), integrator_->y(), integrator_->yp(), point_);
    if (event) sides().leave(point_);
    system_.remember(point_);
    if (before_event_) {
      point_.delays = before_event_->delays;
    } else {
      system_.record(point_);
    }
    if (!event) watch_point();
    equations_->accept(point_);
  }

  EventSides sides() { return {system_, events_, *integrator_, equations_->unknowns()}; }

  // After a step without event: whether the constraints that were left out still follow from the others, and whether
  // events may be looked for again.
  Result<void> follow() {
    note_rounding();
    const bool strayed = equations_->left_out_violation(point_) > left_out_limit();
    const bool look_again = density_.watch_again(statistics_.steps);
    if (strayed || look_again) return begin_at_consistent();
    return {};
  }

  // Output times up to t. At the last the constraints are looked at anew: others may go on from there.
  Result<void> hand_out_until(double t, bool& going_on) {
    for (; going_on && next_ <= times_.count() && times_.at(next_) <= t; ++next_) {
      OperatingPoint at = point_;
      integrator_->interpolate(times_.at(next_), y_, yp_);
      equations_->unknowns().unpack(times_.at(next_), y_, yp_, at);
      auto found = next_ < times_.count() ? refinement_->refined(at) : std::nullopt;
      if (!found) {
        auto whole = consistent(at);
        if (!whole) return tl::unexpected(whole.error());
        found = std::move(*whole);
      }
      last_output_ = moved_far(at, *found) ? std::move(at) : std::move(*found);
      going_on = hand_out(last_output_, Instant::output);
    }
    return {};
  }

  bool hand_out(const OperatingPoint& point, Instant instant, std::string_view text = {}) {
    return !watch_ || watch_({system_, point, instant == Instant::output, statistics_, text}) == GoOn::yes;
  }

  Result<AdvancedPoint> ended(SimulationEnd end) {
    auto whole = consistent(std::move(point_));
    if (!whole) return tl::unexpected(whole.error());
    return AdvancedPoint{std::move(*whole), end};
  }
  SimulationEnd end_of(const EventAction& action) const {
    if (stopped_) return SimulationEnd::stopped;
    return action.halts ? SimulationEnd::halted : SimulationEnd::returned;
  }

  // From right before an event, where the point is.
  Result<EventAction> pass_known_event(const KnownEvent& known) {
    std::vector<double> before(events_.size()), behind(events_.size());
    std::vector<int> crossed(events_.size());
    events_.values(system_.motion(point_), before);
    before_event_ = point_;
    point_.time = known.behind;
    if (auto made = make_consistent(); !made) return tl::unexpected(made.error());
    events_.values(system_.motion(point_), behind);
    for (std::size_t k = 0; k < crossed.size(); ++k)
      crossed[k] = before[k] * behind[k] < 0 ? (behind[k] > 0 ? 1 : -1) : 0;
    return pass_event(crossed, Restart::always);
  }

  // What sensors watch at the point, which may jump from there to the next event.
  void watch_point() {
    if (events_.size() == events_.switch_count()) return;
    watched_.resize(events_.size());
    events_.values(system_.motion(point_), watched_);
  }
  // What sensors do at once may make the conditions of others hold.
  Result<EventAction> act_at_start() {
    EventAction action = events_.at_start(point_);
    for (EventAction more = action; more.restart;) {
      if (auto again = make_consistent(); !again) return tl::unexpected(again.error());
      more = events_.at_start(point_);
      action.add(more);
    }
    return action;
  }

  // What follows from switches and sensors at the point; where nothing does the integration goes on.
  enum class Restart : bool { where_asked, always };
  Result<EventAction> pass_event(std::span<const int> crossed, Restart restart = Restart::where_asked) {
    if (auto passed = density_.pass(point_.time, bounds_.tolerance.duration); !passed)
      return tl::unexpected(passed.error());
    EventAction action = events_.at(crossed, point_);
    action.restart = action.restart || restart == Restart::always;
    bool anew = false;
    std::vector<char> seen(crossed.size());
    std::ranges::transform(crossed, seen.begin(), [](int way) { return way != 0; });
    for (EventAction next = action; next.restart || next.output || next.ends() || next.refactor || next.step_size;) {
      anew = true;
      const std::vector<double> values = point_.algebraic, rates = point_.state_rate;
      if (auto made = make_consistent(); !made) return tl::unexpected(made.error());
      if (next.restart) density_.note_jumps(system_.layout(), values, rates, point_);
      // What sensors watch may have jumped with it; each acts once at an instant.
      const std::vector<double> before = watched_;
      watch_point();
      std::vector<int> jumped = events_.passed(before, watched_);
      for (std::size_t k = 0; k < jumped.size(); ++k)
        if (std::exchange(seen[k], seen[k] || jumped[k] != 0)) jumped[k] = 0;
      next = events_.at(jumped, point_);
      action.add(next);
    }
    if (!anew) watch_point();
    // An output of this instant is there already, unless something jumps in it.
    const bool is_told =
        !action.restart && std::abs(point_.time - last_output_.time) <= same_instant * bounds_.tolerance.duration;
    const bool output = (action.output || action.ends()) && !is_told;
    if ((output || !action.text.empty()) && !hand_out(point_, instant_of(output), action.text))
      action.returns = stopped_ = true;
    if (action.ends()) return action;
    if (auto changed = change_outputs(action); !changed) return tl::unexpected(changed.error());
    if (action.restart) {
      density_.note_restart(
          statistics_.steps, point_.time, [&] { return system_.kinks(system_.motion(point_)); }, findings_.warnings);
    }
    if (!anew) {
      equations_->accept(point_);
    } else if (auto begun = begin(action.step_size); !begun) {
      return tl::unexpected(begun.error());
    }
    return action;
  }

  // Steps in a row that rounding held short.
  void note_rounding() {
    const std::int64_t unknown = integrator_->at_its_rounding();
    steps_at_rounding_ = unknown < 0 ? 0 : steps_at_rounding_ + 1;
    if (steps_at_rounding_ != steps_held_by_rounding || !points_.is_new("rounding-above-error")) return;
    findings_.warnings.warning("rounding-above-error", {},
                               fmt::format("at time {:g} rounding leaves more of {} than the error that is allowed: "
                                           "steps are as short as it makes them, and a larger ERROR loses nothing",
                                           point_.time, equations_->unknowns().text(unknown)));
  }

  // From the point on, to the same end.
  Result<void> change_outputs(const EventAction& action) {
    if (!action.output_step || point_.time >= times_.end()) return {};
    const OutputTimes changed(point_.time, times_.end(), *action.output_step);
    if (auto refusal = changed.refusal()) return tl::unexpected(std::move(*refusal));
    if (bounds_.steps.largest == times_.step()) bounds_.steps.largest = changed.step();
    times_ = changed;
    next_ = 1;
    return {};
  }

  void limit_steps() {
    // What is far shorter than the whole converges without bounding steps (delay_history.h).
    const double resolved =
        std::max(system_.longest_step(equations_->motion()), shortest_bound * bounds_.tolerance.duration);
    const double longest = std::min(bounds_.steps.largest.value_or(bounds_.tolerance.duration), resolved);
    if (longest == longest_) return;
    longest_ = longest;
    integrator_->limit_steps(longest);
  }

  void count() {
    statistics_ = followed_by(counted_before_, integrator_->statistics());
    point_.progress = progress_of(statistics_);
    point_.progress.left_over = errors_that_live * bounds_.tolerance.relative;
  }

  const System& system_;
  OutputTimes times_;
  IntegrationStatistics& statistics_;
  const SimulationWatch& watch_;
  Findings& findings_;
  ConsistentPoints points_;
  Events events_;
  IntegrationBounds bounds_;
  double longest_ = 0;  // step, as the integrator has it
  std::unique_ptr<MotionEquations> equations_;
  std::unique_ptr<DaeIntegrator> integrator_;
  std::unique_ptr<PointRefinement> refinement_;
  IntegrationStatistics counted_before_;
  OperatingPoint point_, last_output_;
  std::vector<double> watched_;                 // by sensors, at the last point that they have acted on
  std::optional<OperatingPoint> before_event_;  // where the last step ended at one
  std::vector<double> y_, yp_;
  std::int64_t next_ = 1;  // output
  int failures_ = 0, steps_at_rounding_ = 0;
  EventDensity density_;
  bool stopped_ = false;                                             // by the watch
  double first_failure_ = -std::numeric_limits<double>::infinity();  // of those that are counted [time]
};

}  // namespace

Result<AdvancedPoint> advance_dynamics(const System& system, OperatingPoint from, const IntegratorSettings& settings,
                                       const Course& course) {
  return Dynamics(system, settings, course).run(std::move(from));
}

std::size_t degrees_of_freedom(const System& system, const OperatingPoint& op) {
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(system.motion(op), rows);
  return system.partition(rows, RowLevel::velocity).independent.size();
}

}  // namespace dynalin
