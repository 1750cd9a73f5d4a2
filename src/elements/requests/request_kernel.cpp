#include "elements/requests/request_kernel.h"

#include <fmt/format.h>

#include <cmath>

namespace dynalin {

namespace {

// Hands on what does not change the equations. The first thing that a function asks for beyond that, or that is wrong
// with it, is kept as the reason to leave it out.
class ReadingBinder final : public Binder {
 public:
  explicit ReadingBinder(Binder& of) : of_(of) {}
  const std::optional<Diagnostic>& problem() const { return problem_; }

  const Signals& signals() const override { return of_.signals(); }
  Channel data(const Atom& atom) override {
    const Channel c = signals().data(atom);
    if (atom.function->reads != DataSource::state_rate || c.kind == Channel::Kind::none) return c;
    const Layout& layout = signals().layout();
    const auto k = static_cast<std::size_t>(c.index);
    if (c.kind == Channel::Kind::state && !layout.states[k].held_in_dynamics)
      return {Channel::Kind::state_rate, c.index, 0};
    if (c.kind != Channel::Kind::algebraic) return {Channel::Kind::constant, 0, 0};
    if (layout.algebraic[k].rate >= 0) return {Channel::Kind::algebraic, layout.algebraic[k].rate, 0};
    problem("unknown-rate", atom.at,
            std::string(atom.at.text()) + " is the rate of an algebraic value, which no equation of the model needs",
            "a VARIABLE with this DIF1 has it");
    return {Channel::Kind::constant, 0, 0};
  }
  Channel rate_of(const Channel&) override { return {Channel::Kind::constant, 0, 0}; }  // no rate is ever asked for
  Channel delayed(const Atom& atom) override {
    problem("request-left-out", atom.at, "a DELAY is a quantity of the model, and requests add none to it",
            "a VARIABLE with this DELAY can be requested");
    return {Channel::Kind::constant, 0, 0};
  }
  std::int32_t sensor_value(std::int64_t id) override { return of_.sensor_value(id); }
  // Nothing follows from a request.
  void note_analysis() override {}
  void note_switches(const BoundExpression&) override {}
  void attach(SplineUse& use) override { of_.attach(use); }
  std::int32_t add_memory(const ElementLabel& owner, std::string_view name, double initial) override {
    return of_.add_memory(owner, name, initial);
  }
  std::int32_t count_turns(Measure measure, MarkerId i, MarkerId j) override { return of_.count_turns(measure, i, j); }
  void problem(std::string_view code, const Span& at, std::string text, std::string hint) override {
    if (!problem_) problem_ = Diagnostic{Severity::warning, code, at, std::move(text), std::move(hint), {}};
  }

 private:
  Binder& of_;
  std::optional<Diagnostic> problem_;
};

}  // namespace

std::array<std::string_view, 8> column_names(RequestKind kind) {
  switch (kind) {
    case RequestKind::displacement:
      return {"MAG", "X", "Y", "Z", "", "PSI", "THETA", "PHI"};
    case RequestKind::velocity:
      return {"VM", "VX", "VY", "VZ", "WM", "WX", "WY", "WZ"};
    case RequestKind::acceleration:
      return {"ACCM", "ACCX", "ACCY", "ACCZ", "WDTM", "WDTX", "WDTY", "WDTZ"};
    case RequestKind::force:
      return {"FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"};
    case RequestKind::functions:
      break;
  }
  return {"F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8"};
}

std::shared_ptr<const std::vector<RequestComponent>> components_of(RequestKind kind) {
  using List = std::shared_ptr<const std::vector<RequestComponent>>;
  const auto make = [](RequestKind of) -> List {
    std::vector<RequestComponent> list;
    int place = 0;
    for (const std::string_view name : column_names(of)) {
      ++place;
      if (!name.empty()) list.push_back({.name = std::string(name), .place = place});
    }
    return std::make_shared<const std::vector<RequestComponent>>(std::move(list));
  };
  static const std::array<List, 4> lists = {make(RequestKind::displacement), make(RequestKind::velocity),
                                            make(RequestKind::acceleration), make(RequestKind::force)};
  return lists[static_cast<std::size_t>(kind) - 1];
}

void RequestKernel::leave_out(const ElementLabel& label, const std::string& what, const Diagnostic& why) {
  layout_.remarks.warning("request-left-out", why.at.source ? why.at : label.at,
                          fmt::format("{} is left out: {}", what, why.message), why.hint);
}

void RequestKernel::bind(Binder& binder) {
  for (const WantedRequest& w : found(binder.signals())) wanted_.push_back(w);
  bound_.reserve(wanted_.size());
  for (const WantedRequest& w : wanted_) {
    if (w.info->kind == RequestKind::functions)
      bind_functions(w, binder);
    else
      bind_markers(w, binder.signals());
  }
  std::vector<WantedRequest>().swap(wanted_);
}

void RequestKernel::bind_markers(const WantedRequest& w, const Signals& signals) {
  const std::array ids = {signals.marker(w.info->marker_I), signals.marker(w.info->marker_J),
                          signals.marker(w.info->axes)};
  for (const MarkerId m : ids) {
    if (signals.has_place(m)) continue;
    const std::string name = signals.layout().marker_label(m).full_text();
    return leave_out(
        *w.label, w.info->request.text(),
        {Severity::warning, "request-left-out", {}, "nothing gives the floating " + name + " a place", {}, {}});
  }
  bound_.push_back({w.info, w.label, MarkerRequest(w.info->kind, signals, ids[0], ids[1], ids[2])});
}

void RequestKernel::bind_functions(const WantedRequest& w, Binder& binder) {
  ReadingBinder reading(binder);
  Functions functions;
  functions.reserve(w.functions->size());
  for (const Expression& e : *w.functions) functions.emplace_back(e, reading, Binding::observation);
  if (reading.problem())
    leave_out(*w.label, w.info->request.text(), *reading.problem());
  else
    bound_.push_back({w.info, w.label, std::move(functions)});
}

void RequestKernel::evaluate(const Motion& motion, std::size_t request, std::vector<double>& values) const {
  if (const auto* markers = std::get_if<MarkerRequest>(&bound_[request].values))
    return markers->evaluate(motion, values);
  ExpressionScratch scratch;
  for (const BoundExpression& f : std::get<Functions>(bound_[request].values))
    values.push_back(f.value(motion, scratch) + 0.0);
}

std::string RequestKernel::undefined_value(const Motion& motion, std::size_t request) const {
  const Bound& of = bound_[request];
  std::vector<double> values;
  evaluate(motion, request, values);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k])) continue;
    const std::string text = fmt::format("{} of {} has no finite value at time {:g}", of.info->components()[k].name,
                                         of.info->request.text(), motion.time);
    const auto* functions = std::get_if<Functions>(&of.values);
    const std::string reason = functions ? (*functions)[k].undefined(motion).reason : std::string();
    return reason.empty() ? text : text + ": " + reason;
  }
  return {};
}

}  // namespace dynalin
