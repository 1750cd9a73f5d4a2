#include "elements/families/delay.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "elements/families/defined_unknown.h"

namespace dynalin {

namespace {

// Adds factor · e without its value to a row: what a residual that is not a sum of such terms depends on.
void add_partials(const BoundExpression& e, const Motion& motion, Equations& eq, std::int32_t row, double factor) {
  e.add(motion, eq, row, factor, PartialBy::velocity);
  eq.add_residual(row, -factor * e.value(motion, eq.scratch));
}

}  // namespace

Channel DelayKernel::channel_of(const Atom& atom, const DelayPlace& place, Layout& layout) {
  const auto [known, fresh] = unknown_at_.emplace(std::pair(atom.at.source, atom.at.offset), -1);
  if (!fresh) return {Channel::Kind::algebraic, known->second, 0};
  const std::string statement(place.statement ? place.statement->name : "");
  const std::int64_t id = place.statement ? place.statement->id.value_or(0) : 0;
  std::string owner = place.statement ? fmt::format("in {}/{}", statement, id) : std::string();
  Call& call = calls_.emplace_back(
      Call{.at = atom.at, .written = atom.delayed, .place = place, .owner = std::move(owner), .label = {}});
  call.label = {"DELAY", 0, call.owner, call.at};
  const Expression& lag = call.written->lag;
  ExpressionWorkspace<double> workspace;
  call.never = lag.is_constant() && lag.splines().empty() && !(lag.evaluate<double>({}, workspace) > 0);
  call.unknown = known->second = layout.add_algebraic(call.label);
  call.index = layout.delay_calls.size();
  if (reading_ == DelayReading::pade && !call.never) call.state = layout.add_state({&call.label, StateType::delay});
  layout.delay_calls.push_back({statement, id, call.written->delayed, call.state});
  return {Channel::Kind::algebraic, call.unknown, 0};
}

void DelayKernel::bind(Binder& binder) {
  std::vector<Call*> order;
  for (Call& c : calls_) order.push_back(&c);
  const auto place = [](const Call* c) { return std::tuple(c->place.number, c->place.edited, c->at.offset); };
  std::stable_sort(order.begin(), order.end(), [&](const Call* a, const Call* b) { return place(a) < place(b); });
  for (std::size_t k = 0; k < order.size(); ++k) order[k]->label.id = static_cast<std::int64_t>(k) + 1;
  for (Call* c : order) {
    c->with_rate = reading_ == DelayReading::first_order && !c->never;
    c->value = BoundExpression(c->written->value, binder, c->with_rate ? Binding::rates : Binding::equations);
    if (c->with_rate && c->value.has_switches()) binder.note_switches(c->value);
    c->lag = BoundExpression(c->written->lag, binder);
    c->history = c->written->history.with_curves([&](SplineUse& use) { binder.attach(use); });
  }
}

void DelayKernel::equations(const Motion& motion, Equations& eq) const {
  for (const Call& c : calls_) {
    const std::int32_t row = begin_definition(motion, eq, c.unknown);
    const double tau = c.never ? 0.0 : c.lag.value(motion, eq.scratch);
    const bool rests = is_equilibrium(motion.mode);
    const bool linear = motion.mode == AnalysisMode::linear;
    if (c.state >= 0) add_state(c, motion, eq, tau);
    if (!rests && !linear) {
      add_past(c, motion, eq, row, tau);
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

const DelayHistory* DelayKernel::kept(const Call& c, const Motion& motion) {
  if (!motion.delays || motion.delays->of_call[c.index].empty()) return nullptr;
  return &motion.delays->of_call[c.index];
}

DelayHistory::Reading DelayKernel::before_start(const Call& c, double time, ExpressionScratch& scratch) {
  const std::array<Taylor, 1> at = {Taylor(time, 1.0, 0.0)};
  const Taylor h = c.history.evaluate<Taylor>(std::span(at).first(c.history.atoms().size()), scratch.taylor);
  return {h.value, h.rate, 0};
}

// − e(t − τ), or − e where nothing is delayed. Both are always put: which one counts may change on the way.
void DelayKernel::add_past(const Call& c, const Motion& motion, Equations& eq, std::int32_t row, double tau) const {
  DelayHistory::Reading past{0, 0, 1};
  if (tau > 0) {
    const double s = motion.time - tau;
    const DelayHistory* history = kept(c, motion);
    if (!history || s < history->start()) {
      past = before_start(c, s, eq.scratch);
    } else if (s <= history->end()) {
      past = history->at(s);
    } else {
      const double present = c.value.value(motion, eq.scratch);
      past = history->at(s, motion.time, present);
      past.value -= past.by_present * present;
    }
  }
  c.value.add(motion, eq, row, -past.by_present, PartialBy::velocity);
  if (c.never) return;
  eq.add_residual(row, -past.value);
  add_partials(c.lag, motion, eq, row, past.slope);
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
  add_unknown(motion, eq, row, c.unknown);
}

void DelayKernel::switches(const Motion& motion, ExpressionScratch& scratch, SwitchList& out) const {
  for (const Call& c : calls_) {
    if (c.never) continue;
    const double tau = c.lag.value(motion, scratch), s = motion.time - tau;
    const DelayHistory* history = kept(c, motion);
    out.add(history ? history->switching(s) : -1.0, tau > 0);
    if (!c.lag.is_constant()) out.add(tau);
    if (!c.history.has_switches()) continue;
    const std::size_t first = out.counts.size();
    c.history.switches(std::span(&s, c.history.atoms().size()), scratch.plain, out);
    for (std::size_t k = first; k < out.counts.size(); ++k)
      out.counts[k] = out.counts[k] && tau > 0 && (!history || s < history->start());
  }
}

double DelayKernel::next_event(double time, const DelayHistories& histories) const {
  ExpressionScratch scratch;
  double next = std::numeric_limits<double>::infinity();
  for (const Call& c : calls_) {
    if (c.never || !c.lag.is_constant()) continue;
    const double tau = c.lag.value(Motion(), scratch);
    next = std::min(next, histories.of_call[c.index].next_break(time - tau) + tau);
  }
  return next;
}

void DelayKernel::look_ahead(const Motion& from, const Motion& to, StepReach& reach) const {
  ExpressionScratch scratch;
  for (const Call& c : calls_) {
    const DelayHistory* history = c.never ? nullptr : kept(c, from);
    if (history) history->look_ahead(from.time - c.lag.value(from, scratch), to.time - c.lag.value(to, scratch), reach);
  }
}

namespace {

bool switches_between(const BoundExpression& e, const Motion& before, const Motion& now, ExpressionScratch& scratch) {
  SwitchList a, b;
  e.switches(before, scratch, a);
  e.switches(now, scratch, b);
  return changes_between(a, b);
}

}  // namespace

template <class Keep>
void DelayKernel::record_each(const Motion& motion, DelayHistories& histories, const Keep& keep) const {
  ExpressionScratch scratch;
  for (const Call& c : calls_) {
    if (c.never) continue;
    const double slope = c.with_rate ? c.value.rate(motion, scratch) : std::numeric_limits<double>::quiet_NaN();
    const double oldest =
        c.lag.is_constant() ? motion.time - c.lag.value(motion, scratch) : -std::numeric_limits<double>::infinity();
    keep(c, histories.of_call[c.index], c.value.value(motion, scratch), slope, oldest);
  }
}

void DelayKernel::record(const Motion& motion, DelayHistories& histories) const {
  record_each(motion, histories, [&](const Call&, DelayHistory& h, double value, double slope, double oldest) {
    h.append(motion.time, value, slope, oldest);
  });
}

// A pulse of STEPs begins without a jump of its value and its slope. What reads values that others make may have such
// kinks of theirs: where there is something of any element, delays aside, it has one.
void DelayKernel::record_behind(const Motion& before, const Motion& now, bool by_elements,
                                DelayHistories& histories) const {
  ExpressionScratch scratch;
  record_each(now, histories, [&](const Call& c, DelayHistory& h, double value, double slope, double oldest) {
    const bool changes =
        (by_elements && !c.value.reads_states_only()) || switches_between(c.value, before, now, scratch);
    h.append_behind(now.time, value, slope, oldest, changes);
  });
}

double DelayKernel::longest_step(const Motion& motion) const {
  ExpressionScratch scratch;
  double shortest = std::numeric_limits<double>::infinity();
  for (const Call& c : calls_) {
    if (!c.never && c.lag.is_constant()) shortest = std::min(shortest, c.lag.value(motion, scratch));
  }
  return shortest;
}

void DelayKernel::undefined_values(const Motion& motion, UndefinedValues& undefined_values) const {
  ExpressionScratch scratch;
  for (const Call& c : calls_) {
    c.value.find_undefined(
        motion, c.label, undefined_values,
        c.state < 0 ? BoundExpression::Derivatives::with_rates : BoundExpression::Derivatives::first);
    c.lag.find_undefined(motion, c.label, undefined_values);
    if (c.state < 0) continue;
    if (const double tau = c.lag.value(motion, scratch); !(tau > 0)) {
      undefined_values.add(UndefinedValue{
          &c.label,
          fmt::format("{}: the Padé approximant needs a delay above 0, here it is {:g}", c.label.full_text(), tau)});
    }
  }
}

}  // namespace dynalin
