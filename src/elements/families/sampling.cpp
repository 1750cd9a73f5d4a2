#include "elements/families/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynalin {

namespace {

// Samples are taken this part of their time later than asked for, so that outputs at the same instant, whose times are
// rounded otherwise, come before all of them.
constexpr double part_later = 1e-12;

bool samples_in(AnalysisMode mode) { return mode == AnalysisMode::dynamics; }

}  // namespace

void Sampling::bind(const ElementLabel& owner, Binder& binder) {
  for (std::size_t n = 0; n < size(); ++n) {
    update_.emplace_back(law_.update[n], binder, Binding::observation);
    kept_.push_back(binder.add_memory(owner, "discrete", n < law_.initial.size() ? law_.initial[n] : 0.0));
  }
  period_ = BoundExpression(law_.period, binder, Binding::observation);
  next_kept_ = binder.add_memory(owner, "next sample", law_.offset);
  period_kept_ = binder.add_memory(owner, "period", 0.0);
}

double Sampling::value(const Motion& motion, std::size_t n) const {
  const double held = motion.memory[static_cast<std::size_t>(kept_[n])];
  return std::isfinite(next(motion)) ? held : std::numeric_limits<double>::quiet_NaN();
}

double Sampling::slack(const Motion& motion) const {
  return part_later * (std::abs(next(motion)) + motion.memory[static_cast<std::size_t>(period_kept_)]);
}

double Sampling::crossing(const Motion& motion) const {
  if (!samples_in(motion.mode) || !std::isfinite(next(motion))) return -1;
  return motion.time - next(motion) - slack(motion);
}

// The first instant of sampling behind that time, if there is one: the next must be later than this one is taken. Those
// of a constant period are counted, so that they do not drift.
double Sampling::behind(double time, double period) const {
  if (!(period > 0) || !std::isfinite(period) || period <= part_later * std::abs(time))
    return std::numeric_limits<double>::quiet_NaN();
  if (!period_.is_constant()) return time + period;
  const double later = time + part_later * (std::abs(time) + period);
  return law_.offset + (std::floor((later - law_.offset) / period) + 1) * period;
}

bool Sampling::sample(const Motion& motion, Memory& memory) const {
  ExpressionScratch scratch;
  Motion at = motion;
  if (std::abs(motion.time - next(motion)) <= 2 * slack(motion)) at.time = next(motion);
  bool changed = false;
  for (std::size_t n = 0; n < size(); ++n) {
    double& held = memory[static_cast<std::size_t>(kept_[n])];
    const double now = update_[n].value(at, scratch);
    changed = changed || now != held;
    held = now;
  }
  const double period = period_.value(at, scratch), then = behind(at.time, period);
  memory[static_cast<std::size_t>(next_kept_)] = then;
  memory[static_cast<std::size_t>(period_kept_)] = period;
  return changed || !std::isfinite(then);
}

void Sampling::find_undefined(const Motion& motion, const ElementLabel& of, UndefinedValues& undefined) const {
  if (!std::isfinite(next(motion))) period_.find_undefined(motion, of, undefined);
  for (std::size_t n = 0; n < size(); ++n) {
    if (!std::isfinite(value(motion, n))) update_[n].find_undefined(motion, of, undefined);
  }
}

std::string Sampling::failure(const Motion& motion) const {
  if (!std::isfinite(next(motion))) {
    const std::string said_by = law_.period_name.empty() ? "" : fmt::format(", as {} says", law_.period_name);
    const double period = motion.memory[static_cast<std::size_t>(period_kept_)];
    return fmt::format(
        "the time between its samples is {:g}{}, and must be {}", period, said_by,
        period > 0 && std::isfinite(period) ? fmt::format("more than {:g} of TIME", part_later) : "positive");
  }
  for (std::size_t n = 0; n < size(); ++n) {
    if (!std::isfinite(value(motion, n)))
      return fmt::format("{} gave no finite number for discrete state {}", law_.update_name, n + 1);
  }
  return {};
}

}  // namespace dynalin
