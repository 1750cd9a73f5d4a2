#include "simulation/quasi_statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/displace.h"
#include "simulation/pose_change.h"

namespace dynalin {

namespace {

constexpr double least_step = 1.0 / 256;  // of the time between outputs
// A step is no jump if it ends as near as this, in lengths of the model and radians, to where the last steps lead, or
// within this part of its way.
constexpr double near = 0.05, near_of_way = 0.5;

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

class Run {
 public:
  Run(const System& system, const OutputTimes& times, const StaticsOptions& options, IntegrationStatistics& statistics,
      const SimulationWatch& watch, Findings& findings)
      : system_(system), times_(times), options_(options), statistics_(statistics), watch_(watch), findings_(findings) {
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
    bool goes_on = look_at_accepted(true);
    double h = times_.step();
    for (std::int64_t k = 1; k <= times_.count() && goes_on; ++k) {
      const double target = times_.at(k);
      while (at_.time < target && goes_on) {
        const double left = target - at_.time;
        const double t = h >= left * (1 - 1e-9) ? target : at_.time + (2 * h > left ? 0.5 * left : h);
        const double step = t - at_.time;
        const bool least = step <= 1.5 * least_step * times_.step();
        auto next = solve(predicted(t), nearby_);
        if (!next && least) next = solve(from_here(t), options_);
        if (!next && least) return tl::unexpected(at_time(t, next.error()));
        const Eigen::VectorXd change = next ? change_between(system_, at_, *next) : Eigen::VectorXd();
        const bool jumps = next && is_jump(change, step);
        if (!least && (!next || jumps)) {
          ++(next ? statistics_.failed_error_tests : statistics_.failed_iterations);
          h = 0.5 * step;
          continue;
        }
        if (jumps) tell_jump(t, change);
        // Nothing leads on from a jump.
        speed_ = jumps ? Eigen::VectorXd() : Eigen::VectorXd(change / step);
        at_ = std::move(*next);
        ++statistics_.steps;
        statistics_.step_size = step;
        h = std::max(2 * step, std::min(h, left));
        goes_on = look_at_accepted(t == target);
      }
    }
    return end(goes_on ? SimulationEnd::reached : SimulationEnd::stopped);
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
    constexpr double largest_turn = 1;
    if (speed_.size() > 0) displace(system_, op, (t - at_.time) * speed_, {largest_turn});
    return op;
  }
  bool is_jump(const Eigen::VectorXd& change, double step) const {
    const double way = length_of(system_, change);
    const double off = speed_.size() > 0 ? length_of(system_, change - step * speed_) : way;
    return off > std::max(near, speed_.size() > 0 ? near_of_way * way : 0.0);
  }
  void tell_jump(double t, const Eigen::VectorXd& change) {
    findings_.warnings.warning(
        "equilibrium-jump", {},
        fmt::format("between times {:.9g} and {:.9g} no equilibrium continues the one before: the "
                    "mechanism jumps to another, {}",
                    at_.time, t, farthest(system_, change)));
  }

  // The one place where every equilibrium is looked at.
  bool look_at_accepted(bool output) {
    if (!watch_) return true;
    return watch_(SimulationStep{system_, at_, output, statistics_}) == GoOn::yes;
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
  const OutputTimes& times_;
  StaticsOptions options_, nearby_;
  IntegrationStatistics& statistics_;
  const SimulationWatch& watch_;
  Findings& findings_;

  OperatingPoint at_;
  StaticsReport report_;
  Eigen::VectorXd speed_;  // of the last step, empty if there is none
};

}  // namespace

Result<QuasiStaticEnd> advance_quasi_statics(const System& system, OperatingPoint from, const OutputTimes& times,
                                             const StaticsOptions& options, IntegrationStatistics& statistics,
                                             const SimulationWatch& watch, Findings& findings) {
  return Run(system, times, options, statistics, watch, findings).run(std::move(from));
}

}  // namespace dynalin
