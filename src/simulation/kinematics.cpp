#include "simulation/kinematics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/contradiction.h"
#include "analysis/stated_limit.h"
#include "simulation/kinematic_equations.h"
#include "simulation/motion_courses.h"
#include "simulation/pose_interpolation.h"
#include "simulation/prescribed_turning.h"

namespace dynalin {

namespace {

constexpr double largest_turn = 0.5;   // of a body in a step [rad]: turns are counted by accepted points
constexpr double least_step = 1e-10;   // of the time between outputs
constexpr double continuation = 0.05;  // of its way: how far a step may differ from what velocities say
constexpr double no_way = 1e-6;        // in lengths of the model and radians: no smaller differences are looked at
constexpr double passage = 1e-4;       // in the same: on so short a way the rows may change their orientation
constexpr double leap = 1e-3;          // half of a way on which a singular configuration is leapt over
constexpr double lost_hold = 1e-5;     // rows that hold so much less than elsewhere leave nothing but rounding
constexpr double loose = 1e-3;         // the same, for what is to blame where nothing goes on
constexpr int creeping_limit = 500;    // steps in a row that are taken for being next to nothing alone,
constexpr double creeping = 1e-3;      // and are shorter than this part of those that are wanted
constexpr std::size_t names_in_a_list = 6;

Failure failure(double time, const std::string& message, std::string_view code, std::vector<std::string> details = {}) {
  return {"kinematic simulation", fmt::format("at time {:.9g}: {}", time, message), std::move(details), code};
}

KinematicEquations::Limits limits_of(const KinematicsSettings& settings, const OperatingPoint& from) {
  constexpr double rotation = 0.5235987755982988;
  constexpr std::int64_t iterations = 25, most_iterations = 1'000'000;
  return {{stated_limit(settings.rotation_limit, rotation),
           stated_limit(settings.translation_limit, std::numeric_limits<double>::infinity())},
          static_cast<int>(std::min(settings.iteration_limit.value_or(iterations), most_iterations)),
          settings.error.value_or(from.redundancy_tolerance)};
}

std::string list(std::vector<std::string> names) {
  if (names.size() <= names_in_a_list) return fmt::format("{}", fmt::join(names, ", "));
  names.resize(names_in_a_list);
  return fmt::format("{} …", fmt::join(names, ", "));
}

class KinematicRun {
 public:
  KinematicRun(const System& system, OperatingPoint from, const KinematicsSettings& settings, const Course& course)
      : system_(system),
        equations_(system),
        turning_(system),
        times_(course.times),
        limits_(limits_of(settings, from)),
        largest_step_(stated_limit(settings.largest_step, std::numeric_limits<double>::infinity())),
        at_(std::move(from)),
        statistics_(course.statistics),
        watch_(course.watch),
        findings_(course.findings) {}

  Result<AdvancedPoint> run() {
    if (auto begun = begin(); !begun) return tl::unexpected(begun.error());
    bool goes_on = look_at_accepted(at_, Instant::output);
    double h = std::min(times_.step(), largest_step_);
    std::int64_t k = 1;  // the next output
    while (k <= times_.count() && goes_on) {
      const double target = times_.at(k), left = target - at_.time;
      const double step = turning_.step(at_, std::min({h, largest_step_, step_by_turns(left)}), 2 * largest_turn);
      const double t = times_.next(at_.time, step, k);
      auto next = attempt(t, passage);
      const bool leaps = !next && nears_singular_ && way_ <= leap;
      if (leaps) next = attempt(at_.time + 2 * (t - at_.time), 4 * leap);
      if (next) {
        h = std::max(2 * (next->time - at_.time), std::min(h, left));
        statistics_.step_size = next->time - at_.time;
        ++statistics_.steps;
        next->progress = progress_of(statistics_);
        if (creeps_ == creeping_limit) return tl::unexpected(contradicted_rates(*next));
        if (leaps) goes_on = look_at_leapt(*next, k);
        at_ = std::move(*next);
        if (leaps && (k > times_.count() || !goes_on)) break;
        const bool output = at_.time == target;
        if (output) ++k;
        goes_on = look_at_accepted(at_, instant_of(output));
        continue;
      }
      if (choose_other_rows()) continue;
      h = 0.5 * (t - at_.time);
      const double rounding = 16 * std::numeric_limits<double>::epsilon() * std::abs(at_.time);
      if (h < std::max(least_step * times_.step(), rounding)) return tl::unexpected(explained());
    }
    findings_.redundant_rows = equations_.partition().redundant;
    return AdvancedPoint{std::move(at_), goes_on ? SimulationEnd::reached : SimulationEnd::stopped};
  }

 private:
  Result<void> begin() {
    at_.mode = AnalysisMode::kinematics;
    at_.redundancy_tolerance = limits_.redundancy_tolerance;
    if (!equations_.choose_rows(at_)) {
      std::vector<std::string> free;
      for (const std::int32_t k : equations_.partition().independent)
        free.push_back(system_.layout().coordinate_text(k));
      std::string message = fmt::format(
          "KINEMATICS needs a model without degrees of freedom, and this one has {}; SIMULATE/DYNAMICS or "
          "SIMULATE/TRANSIENT integrates its motion. Nothing determines these",
          free.size());
      return tl::unexpected(failure(at_.time, std::move(message), "freedoms-in-kinematics", std::move(free)));
    }
    auto complete = reconcile_velocity(system_, std::move(at_), findings_).and_then([&](OperatingPoint op) {
      return dynalin::solve_acceleration(system_, std::move(op), findings_);
    });
    if (!complete) return tl::unexpected(complete.error());
    at_ = std::move(*complete);
    measure_orientation();
    return {};
  }

  // Of the rows at the last accepted point; nothing is known of how they hold elsewhere.
  void measure_orientation() {
    OperatingPoint here = at_;
    const bool solved = !equations_.solve_position(here, limits_);
    orientation_ = solved ? equations_.orientation() : 0;
    hold_ = 0;
    for (int pass = 0; solved && pass < 4; ++pass) hold_ = equations_.hold();
  }

  // Rows that were redundant may have to take the place of others on the way. Once a point.
  bool choose_other_rows() {
    if (equations_.partition().redundant.empty() || rows_chosen_at_ == at_.time) return false;
    rows_chosen_at_ = at_.time;
    const std::vector<bool> before = equations_.partition().active;
    if (!equations_.choose_rows(at_) || equations_.partition().active == before) return false;
    measure_orientation();
    return true;
  }

  // The longest step in which no body turns too far.
  double step_by_turns(double longest) const {
    double h = longest;
    for (const BodyBlock& b : system_.layout().bodies) {
      if (!b.turns()) continue;
      const double w = norm(three(at_.velocity, b.offset + 3)), a = norm(three(at_.acceleration, b.offset + 3));
      // w h + a h²/2 = largest_turn
      const double root = w + std::sqrt(w * w + 2 * a * largest_turn);
      if (root > 0) h = std::min(h, 2 * largest_turn / root);
    }
    return h;
  }

  // The point at a time, if a step leads there. The rows may change their orientation on a way of `longest_passage`.
  std::optional<OperatingPoint> attempt(double t, double longest_passage) {
    OperatingPoint to = at_;
    to.time = t;
    const double h = t - at_.time;
    advance_courses(system_, at_, to);
    Eigen::VectorXd way(static_cast<Eigen::Index>(system_.coordinates()));
    for (Eigen::Index k = 0; k < way.size(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      way(k) = h * (at_.velocity[at] + 0.5 * h * at_.acceleration[at]);
    }
    missed_.reset();
    refused_.reset();
    way_ = length_of(system_, way);
    nears_singular_ = false;
    const std::int64_t evaluations = equations_.evaluations(), factorizations = equations_.factorizations(),
                       iterations = equations_.iterations();
    const bool reached = predicted(way, to) && !(missed_ = equations_.solve_position(to, limits_));
    const double hold = reached ? equations_.hold() : 0;
    const int orientation = reached ? equations_.orientation() : 0;
    nears_singular_ = (reached && hold < lost_hold * hold_) || missed_ == KinematicEquations::Missed::singular;
    const bool completed = reached && !nears_singular_ && complete(to);
    statistics_.evaluations += equations_.evaluations() - evaluations;
    statistics_.jacobians += equations_.factorizations() - factorizations;
    statistics_.iterations += equations_.iterations() - iterations;
    if (!completed) {
      ++statistics_.failed_iterations;
      return std::nullopt;
    }
    const bool turned = orientation_ != 0 && orientation != orientation_;
    const Way made = way_of(to);
    if (!made.continues || (turned && made.length > longest_passage)) {
      ++statistics_.failed_error_tests;
      return std::nullopt;
    }
    if (turned) {
      findings_.warnings.warning(
          "passed-singular", {},
          fmt::format("at time {:.6g} the mechanism passes a singular configuration, where it could go on in more than "
                      "one way; it goes on as it moved before",
                      0.5 * (at_.time + t)));
    }
    orientation_ = orientation;
    hold_ = std::max(hold_, hold);
    // A motion that is next to nothing itself is followed in steps as long as any.
    const bool is_short = h < creeping * std::min(times_.step(), largest_step_);
    creeps_ = made.creeps && is_short ? creeps_ + 1 : 0;
    system_.remember(to);
    return to;
  }

  bool predicted(const Eigen::VectorXd& way, OperatingPoint& to) {
    return way.allFinite() &&
           displace(system_, to, way, {2 * largest_turn, std::numeric_limits<double>::infinity()}) == 1.0;
  }

  bool complete(OperatingPoint& to) {
    equations_.solve_velocity(to);
    const OperatingPoint before = to;
    if (equations_.solve_acceleration(to)) return true;
    Findings ignored;
    auto solved = dynalin::solve_acceleration(system_, before, ignored);
    if (!solved) {
      refused_ = solved.error();
      return false;
    }
    to = std::move(*solved);
    return true;
  }

  // Whether the way from the last point agrees with velocities and accelerations at both ends,
  // Δq = h/2 (v₀ + v₁) + h²/12 (a₀ − a₁) up to the fifth order, part by part, and how long it is.
  struct Way {
    bool continues = true;
    bool creeps = false;  // what it is off is not looked at on so short a way
    double length = 0;
  };
  Way way_of(const OperatingPoint& to) const {
    const auto vector = [](const std::vector<double>& x) {
      return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    };
    const double h = to.time - at_.time;
    const Eigen::VectorXd change = change_between(system_, at_, to);
    const Eigen::VectorXd v0 = h * vector(at_.velocity), v1 = h * vector(to.velocity);
    const Eigen::VectorXd off =
        change - 0.5 * (v0 + v1) - h * h / 12 * (vector(at_.acceleration) - vector(to.acceleration));
    Way way;
    for_each_part(system_.layout(), [&](std::int32_t first, std::int32_t count) {
      const double scale = system_.coordinate_scale(first);
      const double length = std::max(
          {change.segment(first, count).norm(), v0.segment(first, count).norm(), v1.segment(first, count).norm()});
      const double away = off.segment(first, count).norm();
      if (!(away <= std::max(continuation * length, no_way * scale))) way.continues = false;
      way.creeps = way.creeps || (away > continuation * length && length > 0.01 * no_way * scale);
      way.length = std::max(way.length, length / scale);
    });
    return way;
  }

  // The one place where every accepted point is looked at.
  bool look_at_accepted(const OperatingPoint& point, Instant instant) {
    if (!watch_) return true;
    return watch_(SimulationStep{system_, point, instant == Instant::output, statistics_}) == GoOn::yes;
  }

  // Outputs on a leap lie between its ends; the run may end with one of them.
  bool look_at_leapt(OperatingPoint& next, std::int64_t& k) {
    for (; k <= times_.count() && times_.at(k) <= next.time; ++k) {
      OperatingPoint output = interpolated(system_, at_, next, times_.at(k));
      const bool goes_on = look_at_accepted(output, Instant::output), last = k == times_.count();
      if (goes_on && !last) continue;
      next = std::move(output);
      ++k;
      return goes_on;
    }
    return true;
  }

  // What drives the mechanism otherwise than it says: the function of time in a row differs from one instant to the
  // next by something else than what its rates make.
  Failure contradicted_rates(const OperatingPoint& to) const {
    ConstraintRows rows;
    rows.resize(system_.layout());
    const auto along = [&](double time) {
      OperatingPoint there = to;
      there.time = time;
      std::fill(there.velocity.begin(), there.velocity.end(), 0.0);
      std::fill(there.acceleration.begin(), there.acceleration.end(), 0.0);
      system_.constraints(system_.motion(there), rows);
      std::vector<Taylor> all;
      for (std::int32_t k = 0; k < rows.size(); ++k) all.push_back(rows.along_motion(k));
      return all;
    };
    const std::vector<Taylor> before = along(at_.time), after = along(to.time);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double change = after[k].value - before[k].value,
                   said = 0.5 * (to.time - at_.time) * (before[k].rate + after[k].rate);
      if (std::abs(change - said) > continuation * std::max(std::abs(change), std::abs(said)))
        names.push_back(system_.row_text(static_cast<std::int32_t>(k)));
    }
    const std::string named = names.empty() ? "the mechanism" : list(names);
    return failure(at_.time,
                   fmt::format("{} moves otherwise than its velocities and accelerations say: where a compiled routine "
                               "drives it, the derivatives that it gives are not those of its function",
                               named),
                   "wrong-derivatives", std::move(names));
  }

  // Which of several redundant rows it is that will not hold is not known; those that move parts begin with it.
  std::string contradicting(const OperatingPoint& here) const {
    const Partition& part = equations_.partition();
    std::vector<std::int32_t> suspects;
    for (const std::int32_t k : part.redundant)
      if (system_.layout().rows[static_cast<std::size_t>(k)].prescribed) suspects.push_back(k);
    if (suspects.empty()) suspects = part.redundant;
    if (suspects.size() != 1) {
      std::vector<std::string> names;
      for (const std::int32_t k : suspects) names.push_back(system_.row_text(k));
      return list(std::move(names)) + " cannot hold together with the others";
    }
    ConstraintRows rows;
    rows.resize(system_.layout());
    system_.constraints(system_.motion(here), rows);
    return contradiction(system_, scaled_gradients(system_, rows), part.active, suspects.front());
  }

  // Why no step leads on from the last accepted point.
  Failure explained() {
    if (refused_) return failure(at_.time, refused_->message, refused_->code, refused_->details);
    const auto missed = missed_;
    OperatingPoint here = at_;
    const bool known = !equations_.solve_position(here, limits_);
    const double hold = known ? equations_.hold() : 0;
    if (!known || hold < loose * hold_) {
      const auto loosest = known ? equations_.loosest() : KinematicEquations::Loosest{};
      std::vector<std::string> details = loosest.rows;
      return failure(at_.time,
                     fmt::format("the mechanism comes to a singular configuration, where {} no longer determine {}",
                                 list(loosest.rows), list(loosest.coordinates)),
                     "stopped-mechanism", std::move(details));
    }
    if (missed == KinematicEquations::Missed::contradicted) {
      std::vector<std::string> rows;
      for (const std::int32_t k : equations_.partition().redundant) rows.push_back(system_.row_text(k));
      return failure(at_.time, "the constraints begin to contradict each other: " + contradicting(here),
                     "contradicting-constraints", std::move(rows));
    }
    // What is defined here and not a moment later has ended.
    for (const double ahead :
         {0.0, 2 * least_step * times_.step(), 32 * std::numeric_limits<double>::epsilon() * at_.time}) {
      OperatingPoint later = at_;
      later.time += ahead;
      const std::string undefined = system_.undefined_value(system_.motion(later));
      if (!undefined.empty()) return failure(at_.time, undefined, "undefined-value");
    }
    return failure(at_.time, "no position of the mechanism follows: what drives it jumps", "stopped-mechanism");
  }

  static Vector three(const std::vector<double>& x, std::int32_t first) {
    const auto k = static_cast<std::size_t>(first);
    return {x[k], x[k + 1], x[k + 2]};
  }

  const System& system_;
  KinematicEquations equations_;
  PrescribedTurning turning_;
  const OutputTimes& times_;
  KinematicEquations::Limits limits_;
  double largest_step_;
  OperatingPoint at_;
  IntegrationStatistics& statistics_;
  const SimulationWatch& watch_;
  Findings& findings_;

  int orientation_ = 0;  // of the rows at the accepted point, 0 if not known
  double hold_ = 0;      // most of what the rows have held so far
  double rows_chosen_at_ = std::numeric_limits<double>::quiet_NaN();
  int creeps_ = 0;  // steps in a row that went on only because they were short
  // Of the last attempt: how long its way was to be, whether it came to where the rows hold nothing, what went wrong.
  double way_ = 0;
  bool nears_singular_ = false;
  std::optional<KinematicEquations::Missed> missed_;
  std::optional<Failure> refused_;
};

}  // namespace

bool needs_integration(const System& system) {
  const Layout& layout = system.layout();
  const auto sources = system.event_sources();
  return std::any_of(sources.begin(), sources.end(), [](const auto* s) { return s->event_count() > 0; }) ||
         !layout.delay_calls.empty() ||
         std::any_of(layout.states.begin(), layout.states.end(), [](const auto& z) { return z.varies(); }) ||
         std::any_of(layout.rows.begin(), layout.rows.end(),
                     [](const auto& r) { return r.level == RowLevel::velocity; });
}

Result<AdvancedPoint> advance_kinematics(const System& system, OperatingPoint from, const KinematicsSettings& settings,
                                         const Course& course) {
  return KinematicRun(system, std::move(from), settings, course).run();
}

}  // namespace dynalin
