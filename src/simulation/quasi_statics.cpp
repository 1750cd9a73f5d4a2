#include "simulation/quasi_statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/displace.h"
#include "simulation/events.h"
#include "simulation/hidden_crossings.h"
#include "simulation/pose_change.h"
#include "simulation/prescribed_turning.h"

namespace dynalin {

namespace {

// Of the time between outputs, or of so many steps in which a MOTION turns as far as it may.
constexpr double least_rest_step = 1.0 / 256, steps_of_turning = 8;
// A step is no jump if it ends as near as this, in lengths of the model and radians, to where the last steps lead, or
// within this part of its way.
constexpr double near = 0.05, near_of_way = 0.5;
constexpr double largest_step_turn = 1;  // that a step is predicted by, and that a MOTION makes in it [rad]
// How near the instant at which a sensor triggers is found, as a part of the whole time, in how many equilibria at
// most.
constexpr double instant = 1e-12;
constexpr int location_limit = 60;

Failure at_time(double time, Failure f) {
  f.analysis = "quasi-static simulation";
  f.message = fmt::format("at time {:.9g}: {}", time, f.message);
  return f;
}

// "PART/3 by 0.5" or "PART/3 by 30 degrees": what has moved most.
std::string farthest(const System& system, const Eigen::VectorXd& change) {
  std::string text;
  double most = 0;
  const auto look = [&](const std::string& name, std::int32_t first, std::int32_t count, bool angle) {
    const double way = change.segment(first, count).norm(), relative = way / system.coordinate_scale(first);
    if (relative <= most) return;
    most = relative;
    text = angle ? fmt::format("{} by {:.3g} degrees", name, way * 57.29577951308232)
                 : fmt::format("{} by {:.3g}", name, way);
  };
  for (const BodyBlock& b : system.layout().bodies) {
    if (b.count > 0) look(b.label.full_text(), b.offset, 3, false);
    if (b.turns()) look(b.label.full_text(), b.offset + 3, 3, true);
  }
  for (std::int32_t k = system.layout().body_coordinate_count; k < system.layout().coordinate_count; ++k)
    look(system.layout().coordinate_text(k), k, 1, false);
  return text;
}

class QuasiStaticRun {
 public:
  QuasiStaticRun(const System& system, const StaticsOptions& options, const Course& course)
      : system_(system),
        times_(course.times),
        options_(options),
        statistics_(course.statistics),
        watch_(course.watch),
        findings_(course.findings),
        events_(system),
        turning_(system) {
    nearby_ = options_;
    nearby_.restarts = 0;
    nearby_.tolerance.reset();
  }

  Result<QuasiStaticEnd> run(OperatingPoint from) {
    from.time = times_.start();
    from.mode = AnalysisMode::quasi_statics;
    if (auto first = solve(std::move(from), options_)) {
      at_ = std::move(*first);
    } else {
      return tl::unexpected(at_time(times_.start(), first.error()));
    }
    const auto at_start = act_at_start();
    auto begun = at_start ? follow(*at_start, Instant::output) : tl::unexpected(at_start.error());
    double h = times_.step();
    double pace = h;  // of turning, which a MOTION that stops does not do at once
    while (begun && !end_) {
      const double target = times_.at(next_);
      const double left = target - at_.time, turning = turning_.step(at_, times_.step(), largest_step_turn);
      h = std::min(h, turning);
      pace = std::min(pace, turning);
      const double t = times_.next(at_.time, h, next_);
      const double step = t - at_.time;
      const bool least = step <= 1.5 * least_rest_step * std::min(times_.step(), steps_of_turning * pace);
      auto next = solve(predicted(t), nearby_);
      if (!next && least) next = solve(from_here(t), options_);
      if (!next && least) return tl::unexpected(at_time(t, next.error()));
      const Eigen::VectorXd change = next ? change_between(system_, at_, *next) : Eigen::VectorXd();
      bool jumps = next && is_jump(change, step);
      if (jumps && least && speed_.size() == 0) jumps = !goes_on_evenly(change, step);
      if (!least && (!next || jumps)) {
        ++(next ? statistics_.failed_error_tests : statistics_.failed_iterations);
        h = 0.5 * step;
        continue;
      }
      if (jumps) tell_jump(t, change);
      const bool crosses = cross(*next, jumps);
      // Nothing leads on from a jump.
      speed_ =
          jumps ? Eigen::VectorXd() : Eigen::VectorXd(change_between(system_, at_, *next) / (next->time - at_.time));
      at_ = std::move(*next);
      ++statistics_.steps;
      statistics_.step_size = step;
      at_.progress = progress_of(statistics_);
      h = std::max(2 * step, std::min(h, left));
      pace += step;
      auto action = crosses ? act() : EventAction{};
      begun = action ? follow(*action, instant_of(at_.time == target)) : tl::unexpected(action.error());
    }
    if (!begun) return tl::unexpected(at_time(at_.time, begun.error()));
    return end(*end_);
  }

 private:
  Result<OperatingPoint> solve(OperatingPoint start, const StaticsOptions& options) {
    Findings findings;
    auto found = find_equilibrium(system_, std::move(start), options, report_, findings);
    statistics_.iterations += report_.iterations;
    if (!found) return found;
    findings_.redundant_rows = std::move(findings.redundant_rows);
    findings_.warnings.append(std::move(findings.warnings));
    system_.remember(*found);
    return found;
  }

  OperatingPoint from_here(double t) const {
    OperatingPoint op = at_;
    op.time = t;
    return op;
  }
  OperatingPoint predicted(double t) const {
    OperatingPoint op = from_here(t);
    if (speed_.size() > 0) displace(system_, op, (t - at_.time) * speed_, {largest_step_turn});
    return op;
  }
  bool is_jump(const Eigen::VectorXd& change, double step) const {
    const double way = length_of(system_, change);
    const double off = speed_.size() > 0 ? length_of(system_, change - step * speed_) : way;
    return off > std::max(near, speed_.size() > 0 ? near_of_way * way : 0.0);
  }
  // Whether the middle of a step lies between its ends, where nothing is known of steps before.
  bool goes_on_evenly(const Eigen::VectorXd& change, double step) {
    const auto middle = solve(from_here(at_.time + 0.5 * step), nearby_);
    return middle && length_of(system_, change - 2 * change_between(system_, at_, *middle)) <=
                         near_of_way * length_of(system_, change);
  }
  void tell_jump(double t, const Eigen::VectorXd& change) {
    findings_.warnings.warning(
        "equilibrium-jump", {},
        fmt::format("between times {:.9g} and {:.9g} no equilibrium continues the one before: the "
                    "mechanism jumps to another, {}",
                    at_.time, t, farthest(system_, change)));
  }

  std::vector<double> watched(const OperatingPoint& op) {
    std::vector<double> values(events_.size());
    events_.values(system_.motion(op), values);
    return values;
  }
  // Of sensors alone: kinks and jumps of forces need no step of their own.
  bool crosses(const std::vector<double>& from, const std::vector<double>& to) {
    crossed_ = events_.passed(from, to);
    return std::ranges::any_of(crossed_, [](int way) { return way != 0; });
  }

  // Where what sensors watch turns back between two equilibria, the next one is where it is beyond.
  void go_back_to_hidden(const std::vector<double>& before, OperatingPoint& next, std::vector<double>& after) {
    const auto of_sensors = [&](const std::vector<double>& all) {
      return std::span<const double>(all).subspan(events_.switch_count());
    };
    hidden_.begin(of_sensors(before));
    const auto values = [&](double t, std::span<double> out) {
      const auto between = solve(predicted(t), nearby_);
      std::ranges::copy(of_sensors(between ? watched(*between) : before), out.begin());
    };
    const auto t = hidden_.seen(at_.time, next.time, of_sensors(after), values);
    auto between = t ? solve(predicted(*t), nearby_) : tl::unexpected(Failure{});
    if (!between) return;
    next = std::move(*between);
    after = watched(next);
  }

  // Whether what sensors watch passes what it is compared with on the way to the next equilibrium, which then becomes
  // the first behind that. Nothing is located within a jump.
  bool cross(OperatingPoint& next, bool jumps) {
    if (events_.size() == events_.switch_count()) return false;
    std::vector<double> before = watched(at_), after = watched(next);
    if (!jumps) go_back_to_hidden(before, next, after);
    double from = at_.time;
    const double width = instant * (times_.end() - times_.start());
    double beyond = 1e-3;  // of what is left: in turns on both sides of where a straight line meets zero
    for (int k = 0; k < location_limit && !jumps && crosses(before, after) && next.time - from > width; ++k) {
      double part = 1;
      for (std::size_t i = 0; i < before.size(); ++i) {
        if (crossed_[i] != 0) part = std::min(part, std::abs(before[i]) / std::abs(before[i] - after[i]));
      }
      part = std::clamp(part + beyond, 1e-3, 1 - 1e-3);
      beyond = -beyond;
      const double t = from + part * (next.time - from);
      if (!(t > from && t < next.time)) break;
      auto between = solve(predicted(t), nearby_);
      if (!between) break;
      std::vector<double> values = watched(*between);
      if (crosses(before, values)) {
        next = std::move(*between), after = std::move(values);
      } else {
        from = t, before = std::move(values);
      }
    }
    return crosses(before, after);
  }

  // Where a sensor has changed what forces follow from.
  Result<void> solve_anew() {
    auto again = solve(at_, options_);
    if (!again) return tl::unexpected(again.error());
    at_ = std::move(*again);
    speed_ = {};
    return {};
  }
  Result<EventAction> act_at_start() {
    EventAction action = events_.at_start(at_);
    for (EventAction more = action; more.restart;) {
      if (auto again = solve_anew(); !again) return tl::unexpected(again.error());
      more = events_.at_start(at_);
      action.add(more);
    }
    return action;
  }
  // What crossed sensors do, and others whose values jump with it, each once.
  Result<EventAction> act() {
    EventAction action;
    std::vector<int> seen = crossed_;
    for (bool any = true; any;) {
      const std::vector<double> before = watched(at_);
      const EventAction more = events_.at(crossed_, at_);
      action.add(more);
      if (!more.restart) break;
      if (auto again = solve_anew(); !again) return tl::unexpected(again.error());
      crosses(before, watched(at_));
      any = false;
      for (std::size_t k = 0; k < seen.size(); ++k) {
        if (seen[k] != 0) crossed_[k] = 0;
        if (crossed_[k] != 0) seen[k] = crossed_[k], any = true;
      }
    }
    return action;
  }

  // Hands out the equilibrium at hand, as every one is, and does what sensors ask for there.
  Result<void> follow(const EventAction& action, Instant which) {
    const bool handed_out = which == Instant::output || action.output || action.ends();
    const bool goes_on =
        !watch_ || watch_(SimulationStep{system_, at_, handed_out, statistics_, action.text}) == GoOn::yes;
    if (!goes_on) {
      end_ = SimulationEnd::stopped;
    } else if (action.ends()) {
      end_ = action.halts ? SimulationEnd::halted : SimulationEnd::returned;
    } else if (at_.time >= times_.end()) {
      end_ = SimulationEnd::reached;
    } else if (action.output_step) {
      times_ = OutputTimes(at_.time, times_.end(), *action.output_step);
      if (auto refusal = times_.refusal()) return tl::unexpected(std::move(*refusal));
      next_ = 1;
    } else {
      while (times_.at(next_) <= at_.time) ++next_;
    }
    return {};
  }

  Result<QuasiStaticEnd> end(SimulationEnd how) {
    report_.at_rest = at_;
    at_.mode = AnalysisMode::statics;
    auto moving = reconcile_velocity(system_, std::move(at_), findings_).and_then([&](OperatingPoint op) {
      return solve_acceleration(system_, std::move(op), findings_);
    });
    if (!moving) return tl::unexpected(at_time(report_.at_rest.time, moving.error()));
    return QuasiStaticEnd{std::move(*moving), std::move(report_), how};
  }

  const System& system_;
  OutputTimes times_;
  StaticsOptions options_, nearby_;
  IntegrationStatistics& statistics_;
  const SimulationWatch& watch_;
  Findings& findings_;
  Events events_;
  HiddenCrossings hidden_;
  PrescribedTurning turning_;

  OperatingPoint at_;
  std::int64_t next_ = 1;  // output
  std::vector<int> crossed_;
  std::optional<SimulationEnd> end_;
  StaticsReport report_;
  Eigen::VectorXd speed_;  // of the last step, empty if there is none
};

}  // namespace

Result<QuasiStaticEnd> advance_quasi_statics(const System& system, OperatingPoint from, const StaticsOptions& options,
                                             const Course& course) {
  return QuasiStaticRun(system, options, course).run(std::move(from));
}

}  // namespace dynalin
