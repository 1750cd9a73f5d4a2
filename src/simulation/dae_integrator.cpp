#include "simulation/dae_integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "simulation/hidden_crossings.h"
#include "simulation/ida_solver.h"
#include "simulation/order_trial.h"

namespace dynalin {

namespace {

constexpr int standing_limit = 20;
constexpr int short_steps_limit = 12;  // more than an order is kept for while steps grow
constexpr double part_of_way = 1e-3;   // a first step is no longer than this

StepBounds sound(StepBounds b) {
  b.largest_order = std::clamp(b.largest_order, 1, 5);
  return b;
}

}  // namespace

struct DaeIntegrator::Course {
  DaeProblem& problem;
  StepBounds bounds;
  IdaSolver ida;
  OrderTrial orders;
  std::optional<int> next_order;  // the largest from the next step on, if it changes
  bool fresh = false;             // no step has been made since the last start
  std::optional<double> stated_first;
  int standing = 0;     // steps in a row in which time did not go on
  int short_steps = 0;  // shorter than is allowed, in a row, that do not grow
  std::vector<int> crossed;
  HiddenCrossings hidden;
  // The end of a step whose beginning is all that has been handed out, as something crossed zero in it.
  struct Rest {
    double end;
    Outcome outcome;
    std::vector<int> crossed;
  };
  std::optional<Rest> rest;
  std::vector<double> switches_now;
  std::string reason;
  IntegrationStatistics before;  // of what was before the last start

  Course(DaeProblem& p, const StepBounds& b)
      : problem(p), bounds(sound(b)), ida(p, bounds), orders(bounds.largest_order), crossed(p.switch_count(), 0) {}

  Outcome fail(std::string why) {
    reason = ida.at_its_rounding() < 0 ? std::move(why) : "rounding alone is more than the error that is allowed";
    return Outcome::failed;
  }
  Outcome give_up(std::string why) {
    reason = std::move(why);
    return Outcome::failed;
  }

  std::span<const double> switches_here() {
    switches_now.resize(problem.switch_count());
    problem.switches(ida.t, ida.y(), ida.yp(), switches_now);
    return switches_now;
  }

  // The step from one instant to another, or as far as something crosses zero that is not seen at its end.
  Outcome looked_into(double from, Rest to) {
    const HiddenCrossings::Values inside = [&](double at, std::span<double> found) {
      const DaeProblem::Instant there = ida.within(at);
      problem.switches(at, there.y, there.yp, found);
    };
    if (ida.t != to.end) ida.go_to(to.end);
    std::optional<double> first;
    // IDA compares the ends of its own step: what changes twice in it is not known to it at the end of a part.
    std::span<const int> reported;
    if (to.outcome == Outcome::event) reported = to.crossed;
    if (problem.switch_count() > 0) first = hidden.first(from, to.end, switches_here(), inside, reported);
    if (!first) {
      if (to.outcome == Outcome::event) crossed = std::move(to.crossed);
      return to.outcome;
    }
    ida.go_to(*first);
    crossed.assign(hidden.crossed().begin(), hidden.crossed().end());
    rest = std::move(to);
    return Outcome::event;
  }

  void begin(double at, std::optional<double> first_step) {
    if (ida.begun()) {
      before = total();
      ++before.restarts;
    }
    ida.t = at;
    ida.begin();
    stated_first = first_step ? first_step : bounds.first;
    fresh = true;
    rest.reset();
    hidden.begin(switches_here());
  }

  // IDA's own choice takes the errors of the first step to be as large as what it changes: the shorter by far than they
  // need to be, the less is allowed, down to where rounding is all there is. An error like h² of something that changes
  // in a thousandth of the way ahead allows the mean of both.
  double first_step(double latest) const {
    const double change = 2 * ida.change(), longest = part_of_way * (latest - ida.t);
    return change * longest > 1 ? std::sqrt(longest / change) : longest;
  }

  // Where the next step has to end that may go on to an instant.
  double end_of_step(double latest, std::optional<double> first) const {
    if (!problem.looks_ahead()) return latest;
    const double t = ida.t;
    if (!first && ida.end_of_steps() != t) return latest;  // the rest of a step that is made
    const double end = std::min(t + (first ? *first : ida.next_step()), latest);
    if (!(end > t)) return latest;
    const double part = problem.part_to_make({t, ida.y(), ida.yp()}, first ? ida.by_rates(end) : ida.within(end));
    // One that hardly goes on would count as none.
    constexpr double least_part = 1e-6, least_roundings = 1000;
    const double least = std::max(least_part * (end - t),
                                  least_roundings * std::numeric_limits<double>::epsilon() * (std::abs(t) + end - t));
    return part < 1 ? std::min(latest, t + std::max(least, part * (end - t))) : latest;
  }

  // IDA counts anew from each start.
  IntegrationStatistics total() const { return followed_by(before, ida.since_begin()); }
};

DaeIntegrator::DaeIntegrator(DaeProblem& problem, const StepBounds& bounds)
    : course_(std::make_unique<Course>(problem, bounds)) {}
DaeIntegrator::~DaeIntegrator() = default;

void DaeIntegrator::start(double t, std::span<const double> y, std::span<const double> yp,
                          std::optional<double> first_step) {
  std::ranges::copy(y, course_->ida.y().begin());
  std::ranges::copy(yp, course_->ida.yp().begin());
  course_->begin(t, first_step);
}

void DaeIntegrator::limit_steps(double longest) { course_->ida.limit_steps(longest); }

DaeIntegrator::Outcome DaeIntegrator::step(double latest) {
  Course& c = *course_;
  if (c.rest) return c.looked_into(c.ida.t, *std::exchange(c.rest, std::nullopt));
  if (const auto order = std::exchange(c.next_order, std::nullopt)) {
    c.ida.limit_order(*order);
    c.begin(c.ida.t, std::nullopt);
  }
  std::optional<double> first;
  if (std::exchange(c.fresh, false)) first = c.stated_first ? *c.stated_first : c.first_step(latest);
  const double before = c.ida.t;
  using Went = IdaSolver::Went;
  switch (c.ida.step(c.end_of_step(latest, first), latest, first)) {
    case Went::well:
      break;
    case Went::to_switch:
      return c.looked_into(before, {c.ida.t, Outcome::event, {c.ida.crossed().begin(), c.ida.crossed().end()}});
    case Went::error_too_large:
      return c.fail("no step is short enough for the error that is allowed");
    case Went::without_values:
      return c.give_up("the equations have no finite values");
    case Went::singular:
      return c.give_up("the equations are singular");
    case Went::between_zeros:
      return c.fail("a function that switches is zero at two instants that are hardly apart");
    case Went::too_short:
      return c.fail("the next time is too near for a step");
    case Went::not_converged:
      return c.fail("the iteration of a step does not converge however short it is");
  }
  // Steps that differ from none by rounding alone lead nowhere.
  const double t = c.ida.t;
  const bool moved = t - before > 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
  c.standing = moved ? 0 : c.standing + 1;
  if (c.standing > standing_limit) return c.fail("time stands still: no step is short enough");
  if (c.bounds.least && t < latest) {
    const double used = c.ida.last_step(), next = c.ida.next_step();
    // After a start steps are short, and grow.
    const bool is_short = next < *c.bounds.least;
    c.short_steps = is_short && next <= used ? c.short_steps + 1 : 0;
    if (is_short && (next < used || c.short_steps > short_steps_limit))
      return c.give_up("the error that is allowed asks for steps shorter than HMIN");
  }
  c.next_order = c.orders.after_step(t - before, latest - t);
  return c.looked_into(before, {t, Outcome::step, {}});
}

double DaeIntegrator::time() const { return course_->ida.t; }
std::span<const double> DaeIntegrator::y() const { return std::as_const(course_->ida).y(); }
std::span<const double> DaeIntegrator::yp() const { return std::as_const(course_->ida).yp(); }

void DaeIntegrator::interpolate(double t, std::span<double> y, std::span<double> yp) const {
  const DaeProblem::Instant there = course_->ida.within(t);
  std::copy_n(there.y.begin(), y.size(), y.begin());
  std::copy_n(there.yp.begin(), yp.size(), yp.begin());
}

std::span<const int> DaeIntegrator::crossed() const { return course_->crossed; }
const std::string& DaeIntegrator::reason() const { return course_->reason; }

std::int64_t DaeIntegrator::at_its_rounding() const { return course_->ida.at_its_rounding(); }

std::int64_t DaeIntegrator::hardest_unknown() const {
  const IdaSolver& ida = course_->ida;
  return ida.at_its_rounding() >= 0 ? ida.at_its_rounding() : ida.largest_error();
}

IntegrationStatistics DaeIntegrator::statistics() const { return course_->total(); }

}  // namespace dynalin
