#include "dynalin/mechanism.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "analysis/static_settings.h"
#include "base/read_file.h"
#include "elements/catalogue.h"
#include "linear/cautions.h"
#include "linear/eigen.h"
#include "linear/mode_shapes.h"
#include "linear/stability.h"
#include "linear/still_modes.h"
#include "system/operating_state.h"

namespace dynalin {

struct Mechanism::State {
  SourceRef source;
  std::shared_ptr<const Model> model;
  std::shared_ptr<const System> made;
  const System& system;
  OperatingPoint point;
  bool consistent = false;
  std::optional<OperatingPoint> at_rest;  // what the last static analysis found, if no other one came after it
  int static_iterations = 0;
  double static_imbalance = 0;
  std::vector<std::string> redundant, warnings;

  State(SourceRef text, std::shared_ptr<const Model> m, std::shared_ptr<const System> equations)
      : source(std::move(text)),
        model(std::move(m)),
        made(std::move(equations)),
        system(*made),
        point(system.drawn()) {
    note(system.layout().remarks);
    note(model->settings.remarks);
  }

  void note(const Diagnostics& remarks) {
    for (const Diagnostic& d : remarks.items()) warnings.push_back(d.message);
  }

  const OperatingPoint& point_of(const LinearRequest& request) const {
    return at_rest && request.without_reconciliation ? *at_rest : point;
  }

  void accept(OperatingPoint op, const Findings& findings) {
    point = std::move(op);
    consistent = true;
    redundant.clear();
    for (const std::int32_t r : findings.redundant_rows) redundant.push_back(system.row_text(r));
    note(findings.warnings);
  }
};

namespace {

[[noreturn]] void fail(const Failure& f) {
  std::vector<std::string> messages{f.message};
  messages.insert(messages.end(), f.details.begin(), f.details.end());
  std::string text = f.analysis + ": " + f.message;
  for (const std::string& d : f.details) text += "\n  " + d;
  throw Error(text, std::move(messages));
}

template <class T>
T value_or_throw(Result<T> result) {
  if (!result) fail(result.error());
  return std::move(*result);
}

LinearOptions options_of(const Model& model, const LinearRequest& request) {
  LinearOptions options;
  const auto find = [&](std::optional<std::int64_t> id, std::string_view statement) -> std::optional<ElementHandle> {
    if (!id) return std::nullopt;
    const auto handle = model.find(statement, *id);
    if (!handle) fail({"linear analysis", fmt::format("{}/{} does not exist", statement, *id), {}});
    return handle;
  };
  options.pstate = find(request.pstate, "PSTATE");
  options.pinput = find(request.pinput, "PINPUT");
  options.poutput = find(request.poutput, "POUTPUT");
  options.without_damping = request.without_damping;
  options.principal_states = request.principal_states;
  options.without_rate_coupling = request.without_rate_coupling;
  if (request.rm) {
    const auto marker = model.find_marker(*request.rm);
    if (!marker) fail({"linear analysis", fmt::format("MARKER/{} does not exist", *request.rm), {}});
    if (model.marker(*marker).floating) {
      fail({"linear analysis", fmt::format("MARKER/{} is floating", *request.rm), {}});
    }
    options.rm = *marker;
  }
  return options;
}

}  // namespace

Mechanism::Mechanism(std::unique_ptr<State> state) : state_(std::move(state)) {}
Mechanism::Mechanism(Mechanism&&) noexcept = default;
Mechanism& Mechanism::operator=(Mechanism&&) noexcept = default;
Mechanism::~Mechanism() = default;

Mechanism Mechanism::load(const std::string& path, const ReadingOptions& options) {
  auto text = read_file(path);
  if (!text) {
    const std::string message = path + " cannot be read: " + text.error();
    throw Error(message, {message});
  }
  return from_text(std::move(*text), path, options);
}

Mechanism Mechanism::from_text(std::string dataset, std::string name, const ReadingOptions& options) {
  const auto source = std::make_shared<const SourceText>(std::move(name), std::move(dataset));
  auto parsed = parse_dataset(source);
  Diagnostics diagnostics = std::move(parsed.diagnostics);
  const bool read = !diagnostics.has_errors();
  const auto written = std::make_shared<Dataset>(std::move(parsed.value));
  auto built = build_model(written, catalogue(), {.user_value = options.user_value, .read_once = written});
  if (built.value->dataset == written) written->release_arguments();
  if (read || built.diagnostics.has_errors()) diagnostics.append(std::move(built.diagnostics));
  std::vector<std::string> messages;
  for (const Diagnostic& d : diagnostics.items()) messages.push_back(d.message);
  if (diagnostics.has_errors()) throw Error(render(diagnostics), std::move(messages));
  const std::shared_ptr<const Model> model = std::move(built.value);
  auto system = System::make(model, {options.pade_delays ? DelayReading::pade : DelayReading::first_order});
  if (!system) {
    std::vector<std::string> reasons;
    for (const Diagnostic& d : system.error().items()) reasons.push_back(d.message);
    throw Error(render(system.error()), std::move(reasons));
  }
  auto state = std::make_unique<State>(source, model, std::move(*system));
  state->warnings.insert(state->warnings.begin(), messages.begin(), messages.end());
  return Mechanism(std::move(state));
}

void Mechanism::initial_conditions() {
  Findings findings;
  state_->accept(value_or_throw(dynalin::initial_conditions(state_->system, findings)), findings);
  state_->at_rest.reset();
}

int Mechanism::static_equilibrium(bool restore_velocities) {
  Findings findings;
  StaticsReport report;
  StaticsOptions options = statics_options(state_->model->settings.equilibrium);
  options.restore_velocities = restore_velocities;
  state_->accept(value_or_throw(static_operating_point(state_->system, state_->point, options, report, findings)),
                 findings);
  state_->at_rest = std::move(report.at_rest);
  state_->static_iterations = report.iterations, state_->static_imbalance = report.imbalance;
  return report.iterations;
}

StateSpace Mechanism::state_space(const LinearRequest& request) {
  if (!state_->consistent) initial_conditions();
  LinearSystem linear =
      value_or_throw(linearize(state_->system, state_->point_of(request), options_of(*state_->model, request)));
  state_->note(linear.warnings);
  return std::move(linear.model);
}

EigenSolution Mechanism::eigensolution(const LinearRequest& request) {
  if (!state_->consistent) initial_conditions();
  const LinearSystem linear =
      value_or_throw(linearize(state_->system, state_->point_of(request), options_of(*state_->model, request)));
  state_->note(linear.warnings);
  EigenSolution solution = value_or_throw(eigensolve(linear));
  solution.rm = request.rm.value_or(0);
  solution.pstate = request.pstate.value_or(0);
  solution.without_damping = request.without_damping;
  solution.original = request.principal_states && request.without_rate_coupling && request.without_reconciliation;
  clear_still_modes(state_->system, state_->point_of(request), linear, solution);
  name_movers(state_->system, state_->point_of(request), linear, solution);
  map_shapes(state_->system, linear, solution);
  state_->note(cautions(state_->system, state_->point_of(request), linear, solution));
  return solution;
}

OperatingState Mechanism::operating_state() const { return dynalin::operating_state(state_->system, state_->point); }

std::vector<BodyState> Mechanism::bodies() const { return operating_state().bodies; }

StaticResult Mechanism::static_result() const {
  if (!state_->at_rest) fail({"results", "no static analysis has been made", {}});
  return {state_->static_iterations, state_->static_imbalance, stability_of(state_->system, *state_->at_rest),
          dynalin::operating_state(state_->system, *state_->at_rest)};
}

const Units& Mechanism::units() const { return state_->model->units; }

double Mechanism::variable(std::int64_t id) const {
  const auto handle = state_->model->find("VARIABLE", id);
  if (!handle) fail({"results", fmt::format("VARIABLE/{} does not exist", id), {}});
  return state_->point.algebraic[static_cast<std::size_t>(state_->system.signals().variable({*handle}).index)];
}

const std::vector<std::string>& Mechanism::redundant_rows() const { return state_->redundant; }
const std::vector<std::string>& Mechanism::warnings() const { return state_->warnings; }

}  // namespace dynalin
