#include "elements/families/delay.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace dynalin {

namespace {

// Adds factor · e without its value to a row: what a residual that is not a sum of such terms depends on.
void add_partials(const BoundExpression& e, const Motion& motion, Equations& eq, std::int32_t row, double factor) {
  e.add(motion, eq, row, factor, PartialBy::velocity);
  eq.add_residual(row, -factor * e.value(motion, eq.scratch));
}

}  // namespace

Channel DelayKernel::channel_of(const Atom& atom, std::string owner, Layout& layout) {
  const auto [known, fresh] = unknown_at_.emplace(atom.at.offset, -1);
  if (!fresh) return {Channel::Kind::algebraic, known->second, 0};
  Call& call =
      calls_.emplace_back(Call{.at = atom.at, .written = atom.delayed, .owner = std::move(owner), .label = {}});
  call.label = {"DELAY", 0, call.owner, call.at};
  const Expression& lag = call.written->lag;
  ExpressionWorkspace<double> workspace;
  call.never = lag.is_constant() && lag.splines().empty() && !(lag.evaluate<double>({}, workspace) > 0);
  call.unknown = known->second = layout.add_algebraic(call.label);
  if (reading_ == DelayReading::pade && !call.never) call.state = layout.add_state({&call.label, StateType::delay});
  return {Channel::Kind::algebraic, call.unknown, 0};
}

void DelayKernel::bind(Binder& binder) {
  std::vector<Call*> order;
  for (Call& c : calls_) order.push_back(&c);
  std::sort(order.begin(), order.end(), [](const Call* a, const Call* b) { return a->at.offset < b->at.offset; });
  for (std::size_t k = 0; k < order.size(); ++k) order[k]->label.id = static_cast<std::int64_t>(k) + 1;
  for (Call* c : order) {
    const bool needs_rate = reading_ == DelayReading::first_order && !c->never;
    c->value = BoundExpression(c->written->value, binder, needs_rate ? Binding::rates : Binding::equations);
    c->lag = BoundExpression(c->written->lag, binder);
    c->history = c->written->history.with_curves([&](SplineUse& use) { binder.attach(use); });
  }
}

void DelayKernel::equations(const Motion& motion, Equations& eq) const {
  for (const Call& c : calls_) {
    const std::int32_t row = eq.algebraic_row(c.unknown);
    eq.add_residual(row, motion.algebraic[static_cast<std::size_t>(c.unknown)]);
    eq.add(PartialBy::algebraic, row, c.unknown, 1.0);
    const double tau = c.never ? 0.0 : c.lag.value(motion, eq.scratch);
    const bool rests = motion.mode == AnalysisMode::statics || motion.mode == AnalysisMode::quasi_statics;
    const bool linear = motion.mode == AnalysisMode::linear;
    if (c.state >= 0) add_state(c, motion, eq, tau);
    if (!rests && !linear) {
      add_history(c, motion, eq, row, tau);
    } else if (c.state >= 0) {
      const double z = motion.state[static_cast<std::size_t>(c.state)];
      eq.add_residual(row, -2.0 * z);
      eq.add(PartialBy::state, row, c.state, -2.0);
      c.value.add(motion, eq, row, 1.0, PartialBy::velocity);
    } else {
      c.value.add(motion, eq, row, -1.0, PartialBy::velocity);
      if (linear && !c.never) add_first_order(c, motion, eq, row, tau);
    }
  }
}

// − history(t − τ), or − e where nothing is delayed. Both are always put: which one counts may change on the way.
void DelayKernel::add_history(const Call& c, const Motion& motion, Equations& eq, std::int32_t row, double tau) const {
  const bool delayed = tau > 0;
  c.value.add(motion, eq, row, delayed ? 0.0 : -1.0, PartialBy::velocity);
  if (c.never) return;
  const std::array<Taylor, 1> time = {Taylor(motion.time - tau, 1.0, 0.0)};
  const Taylor h = c.history.evaluate<Taylor>(std::span(time).first(c.history.atoms().size()), eq.scratch.taylor);
  if (delayed) eq.add_residual(row, -h.value);
  add_partials(c.lag, motion, eq, row, delayed ? h.rate : 0.0);
}

// + τ e′
void DelayKernel::add_first_order(const Call& c, const Motion& motion, Equations& eq, std::int32_t row,
                                  double tau) const {
  const bool delayed = tau > 0;
  c.value.add_rate(motion, eq, row, delayed ? tau : 0.0, PartialBy::velocity);
  add_partials(c.lag, motion, eq, row, delayed ? c.value.rate(motion, eq.scratch) : 0.0);
}

// τ z′ − e + w
void DelayKernel::add_state(const Call& c, const Motion& motion, Equations& eq, double tau) const {
  const std::int32_t row = eq.state_row(c.state);
  const double rate = motion.state_rate[static_cast<std::size_t>(c.state)];
  // Without a delay nothing determines z′; undefined_value() says so.
  eq.add_residual(row, tau > 0 ? tau * rate : std::numeric_limits<double>::quiet_NaN());
  eq.add(PartialBy::state_rate, row, c.state, tau);
  add_partials(c.lag, motion, eq, row, rate);
  c.value.add(motion, eq, row, -1.0, PartialBy::velocity);
  eq.add_residual(row, motion.algebraic[static_cast<std::size_t>(c.unknown)]);
  eq.add(PartialBy::algebraic, row, c.unknown, 1.0);
}

void DelayKernel::remember(const Motion& motion, Memory& memory) const {
  for (const Call& c : calls_) {
    c.value.remember(motion, memory);
    c.lag.remember(motion, memory);
  }
}

void DelayKernel::undefined_values(const Motion& motion, std::vector<UndefinedValue>& undefined_values) const {
  ExpressionScratch scratch;
  for (const Call& c : calls_) {
    c.value.find_undefined(
        motion, c.label, undefined_values,
        c.state < 0 ? BoundExpression::Derivatives::with_rates : BoundExpression::Derivatives::first);
    c.lag.find_undefined(motion, c.label, undefined_values);
    if (c.state < 0) continue;
    if (const double tau = c.lag.value(motion, scratch); !(tau > 0)) {
      undefined_values.push_back(
          {&c.label,
           fmt::format("{}: the Padé approximant needs a delay above 0, here it is {:g}", c.label.full_text(), tau)});
    }
  }
}

}  // namespace dynalin
