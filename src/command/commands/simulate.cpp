// SIMULATE/{INITIAL_CONDITIONS [, DISPLACEMENT | VELOCITY | ACCELERATION] | STATICS}: finds an operating point.
// SIMULATE/{KINEMATICS | DYNAMICS | TRANSIENT | STATICS}, {END= | DURATION=} [, {DTOUT= | STEPS=}]: leads it through
// time.
#include "command/commands/simulate.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <chrono>

#include "analysis/static_settings.h"
#include "command/interruption.h"
#include "command/progress_line.h"
#include "command/run_state.h"
#include "command/step_output.h"
#include "output/message_file.h"
#include "system/operating_state.h"

namespace dynalin::commands {

namespace {

struct SimulateArguments {
  bool initial = false, statics = false, kinematics = false, dynamics = false, transient = false;
  bool displacement = false, velocity = false, acceleration = false;
  std::optional<double> end, duration, step;
  std::optional<std::int64_t> steps;

  using W = SimulateArguments;
  static constexpr double latest = 1e100;  // squares of times, and accelerations by them, are numbers
  static constexpr std::string_view level = "with INITIAL_CONDITIONS: the last level that is made";
  static constexpr std::array<Argument<W>, 12> arguments = {{
      {.name = "INITIAL_CONDITIONS",
       .slot = &W::initial,
       .help = "positions, velocities, accelerations and reactions that agree with constraints and forces"},
      {.name = "STATICS",
       .slot = &W::statics,
       .help = "a position of rest in which all forces balance; with END or DURATION one at every output"},
      {.name = "KINEMATICS", .slot = &W::kinematics, .help = "motion that is prescribed, through time"},
      {.name = "DYNAMICS", .slot = &W::dynamics, .help = "integrates the equations of motion"},
      {.name = "TRANSIENT",
       .slot = &W::transient,
       .help = "DYNAMICS where there are degrees of freedom, else KINEMATICS"},
      {.name = "DISPLACEMENT", .slot = &W::displacement, .help = level},
      {.name = "VELOCITY", .slot = &W::velocity, .help = level},
      {.name = "ACCELERATION", .slot = &W::acceleration, .help = level},
      {.name = "END",
       .slot = &W::end,
       .unit = "time",
       .help = "the time at which it ends",
       .maximum = latest,
       .ends = "DURATION"},
      {.name = "DURATION",
       .slot = &W::duration,
       .unit = "time",
       .help = "how long it goes on",
       .maximum = latest,
       .ends = "END"},
      {.name = "DTOUT", .slot = &W::step, .unit = "time", .help = "time between outputs", .ends = "STEPS"},
      {.name = "STEPS",
       .slot = &W::steps,
       .minimum = 1,
       .help = "number of outputs behind the start",
       .maximum = static_cast<double>(OutputTimes::most),
       .ends = "DTOUT"},
  }};
};

std::shared_ptr<const CommandAction> read_simulate(CommandReader& reader) {
  SimulateArguments w;
  if (!read_arguments(w, reader)) return nullptr;
  const Span whole = reader.statement().at;
  if (w.initial + w.statics + w.kinematics + w.dynamics + w.transient != 1) {
    reader.error("missing-option", whole,
                 "SIMULATE takes exactly one of INITIAL_CONDITIONS, STATICS, KINEMATICS, DYNAMICS, TRANSIENT");
    return nullptr;
  }
  bool sound = true;
  const auto refuse = [&](std::string_view code, const Span& at, std::string message) {
    reader.error(code, at, std::move(message));
    sound = false;
  };
  for (const auto& [first, second] : {std::pair{"END", "DURATION"}, std::pair{"DTOUT", "STEPS"}}) {
    if (reader.given(first) && reader.given(second))
      refuse("excluded-arguments", reader.at(second), fmt::format("SIMULATE takes one of {} and {}", first, second));
  }
  for (const auto& [value, name] : {std::pair{w.duration, "DURATION"}, std::pair{w.step, "DTOUT"}}) {
    if (value && !(*value > 0)) refuse("value-out-of-range", reader.at(name), fmt::format("{} must be positive", name));
  }
  const bool through_time = w.end || w.duration;
  const bool needs_time = w.kinematics || w.dynamics || w.transient;
  if (needs_time && !through_time) refuse("missing-argument", whole, "a simulation over time needs END or DURATION");
  for (const char* name : {"END", "DURATION", "DTOUT", "STEPS"}) {
    if (w.initial && reader.given(name))
      refuse("unexpected-argument", reader.at(name), fmt::format("{} does not go with INITIAL_CONDITIONS", name));
  }
  for (const char* name : {"DISPLACEMENT", "VELOCITY", "ACCELERATION"}) {
    if (!w.initial && reader.given(name))
      refuse("unexpected-argument", reader.at(name), fmt::format("{} goes with INITIAL_CONDITIONS alone", name));
  }
  for (const char* name : {"DTOUT", "STEPS"}) {
    if (w.statics && !through_time && reader.given(name))
      refuse("missing-argument", reader.at(name), fmt::format("{} of STATICS goes with END or DURATION", name));
  }
  if (!sound) return nullptr;
  auto action = std::make_shared<Simulate>();
  action->initial_conditions = w.initial;
  if ((w.displacement || w.velocity) && !w.acceleration)
    action->last_level = w.velocity ? Level::velocity : Level::position;
  if (w.kinematics) action->kind = SimulationKind::kinematics;
  if (w.dynamics) action->kind = SimulationKind::dynamics;
  if (w.transient) action->kind = SimulationKind::transient;
  if (w.statics && through_time) action->kind = SimulationKind::quasi_statics;
  action->end = w.end, action->duration = w.duration, action->output_step = w.step, action->steps = w.steps;
  return action;
}

StudyResult<void> find_start(RunState& run, Level last) {
  if (auto ready = run.make_consistent(last); !ready) return ready;
  const OperatingState state = operating_state(run.system(), run.point.values);
  run.show(StepKind::initial_conditions, state, run.point.values);
  run.json.add(run.command, state);
  run.json.add_requests(requests_at(run.system(), run.point.values).values);
  return {};
}

StudyResult<void> find_rest(RunState& run) {
  write_begin(run.message, "Static Solution");
  StaticsOptions options = statics_options(run.settings.equilibrium);
  options.restore_velocities = !run.environment.statics_stay_at_rest;
  ProgressLine line(run.status_line());
  if (run.preferences.iterations) fmt::print(run.message, "  Iteration   Imbalance\n");
  options.progress = [&](int iteration, double imbalance) {
    if (run.preferences.iterations) fmt::print(run.message, "  {:9d}   {:.5E}\n", iteration, imbalance);
  };
  options.told = line.progress();
  auto found = static_equilibrium(run.point, options);
  line.clear();
  if (!found) return tl::unexpected(found.error());
  write_static_result(run.message, found->point.statics->iterations, found->point.statics->imbalance);
  write_end(run.message, "Static Solution");
  run.accept(std::move(*found));
  line.say("stability of the equilibrium");
  const StaticResult result = static_result(run.point);
  line.clear();
  fmt::print(run.message, "  Stability: {}\n", result.stability.text());
  if (run.terminal)
    fmt::print(*run.terminal, "static equilibrium after {} iteration{}, imbalance {:.3e}, {}\n", result.iterations,
               result.iterations == 1 ? "" : "s", result.imbalance, result.stability.text());
  const OperatingPoint& at_rest = run.point.statics->at_rest;
  run.show(StepKind::statics, result.at_rest, at_rest);
  // Velocities of the dataset that have come back make another point of it.
  const std::vector<double>& velocity = run.point.values.velocity;
  run.shown = std::all_of(velocity.begin(), velocity.end(), [](double v) { return v == 0; });
  run.json.add(run.command, result);
  run.json.add_requests(requests_at(run.system(), at_rest).values);
  return {};
}

// Time reached, step, order, iterations, and what is left to wait at the pace so far.
class TimeProgress {
 public:
  TimeProgress(double start, double end) : start_(start), end_(end) {}
  std::string text(const SimulationStep& at) const {
    const IntegrationStatistics& s = at.statistics;
    const double done = (at.point.time - start_) / (end_ - start_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begun_;
    const std::string left =
        done > 0 ? fmt::format(", {} left", seconds_text(elapsed.count() * (1 - done) / done)) : "";
    return fmt::format("time {:.6g} of {:.6g} ({:.0f} %), step {:.2e}, order {}, {} iterations{}", at.point.time, end_,
                       100 * done, s.step_size, s.order, s.iterations, left);
  }

 private:
  double start_, end_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

StepKind step_kind(SimulationKind kind) {
  if (kind == SimulationKind::kinematics) return StepKind::kinematics;
  return kind == SimulationKind::quasi_statics ? StepKind::quasi_statics : StepKind::dynamics;
}

// One line of what was done, for the terminal.
std::string summary_of(const SimulatedPoint& found) {
  const IntegrationStatistics& s = found.statistics;
  const double t = found.point.values.time;
  if (found.kind == SimulationKind::quasi_statics)
    return fmt::format("quasi-statics to {:g}: {} step{}", t, s.steps, s.steps == 1 ? "" : "s");
  const std::string_view name = found.kind == SimulationKind::kinematics ? "kinematics" : "dynamics";
  const std::string by = s.order > 0 ? fmt::format(", order {} at the end (SUNDIALS IDA)", s.order) : "";
  return fmt::format("{} to {:g}: {} steps, {} evaluations, {} Jacobians{}", name, t, s.steps, s.evaluations,
                     s.jacobians, by);
}

// The first of the SENSORs that say so of themselves, a line each.
std::string ending_sensor(std::string_view said, std::string_view how) {
  const std::size_t ends = said.find(how);
  if (ends == std::string_view::npos) return "a SENSOR";
  const std::size_t line_before = said.rfind('\n', ends);
  const std::string_view line = said.substr(line_before == std::string_view::npos ? 0 : line_before + 1);
  return std::string(line.substr(0, line.find(" triggers ")));
}

std::string ending_of(SimulationEnd end, std::string_view said) {
  switch (end) {
    case SimulationEnd::reached:
      return "";
    case SimulationEnd::returned:
      return fmt::format(", ended by {} with RETURN", ending_sensor(said, "(RETURN)"));
    case SimulationEnd::halted:
      return fmt::format(", the run ended by {} with HALT", ending_sensor(said, "(HALT)"));
    case SimulationEnd::stopped:
      return ", interrupted";
  }
  return "";
}

constexpr CommandKind simulate_kind = {.name = "SIMULATE",
                                       .use = CommandUse::analysis,
                                       .summary = "finds an operating point, or leads it through time",
                                       .example = "SIMULATE/STATICS",
                                       .arguments = detail::argument_infos<SimulateArguments>,
                                       .read = read_simulate};

}  // namespace

StudyResult<void> Simulate::run(RunState& run) const {
  if (kind) return run_over_time(run);
  return initial_conditions ? find_start(run, last_level) : find_rest(run);
}

StudyResult<void> Simulate::run_over_time(RunState& run) const {
  if (auto ready = run.make_consistent(); !ready) return ready;
  const double start = run.time(), last = end ? *end : start + *duration;
  if (!(last > start)) {
    return tl::unexpected(StudyFailure(Failure{"simulation",
                                               fmt::format("END={:g} is not after the present time, {:g}", last, start),
                                               {},
                                               "end-of-simulation"}));
  }
  const double step = output_step.value_or(last - start);
  SimulationRequest request{
      .kind = *kind, .times = steps ? OutputTimes::of_count(start, last, *steps) : OutputTimes(start, last, step)};
  request.integrator = run.settings.integrator;
  request.kinematics = run.settings.kinematics;
  request.statics = statics_options(run.settings.equilibrium);
  StepOutput output(run, step_kind(kind_at(run.point, *kind)), request.times, request.integrator);
  ProgressLine line(run.status_line());
  const TimeProgress progress(start, last);
  const Interruptible stop_on_request;
  std::string said;  // by SENSORs, last
  const auto found = simulate(run.point, request, [&](const SimulationStep& at) {
    if (!at.text.empty()) said = at.text;
    line.show([&] { return progress.text(at); });
    const GoOn written = output.add(at);
    return interrupted() ? GoOn::no : written;
  });
  line.clear();
  const auto written = output.end();
  if (!found) return tl::unexpected(found.error());
  if (!written) return written;
  run.count(found->statistics);
  if (run.terminal) fmt::print(*run.terminal, "{}{}\n", summary_of(*found), ending_of(found->end, said));
  if (found->end == SimulationEnd::halted) run.halted = true;
  run.accept({found->point, found->remarks});
  run.show_where_it_ended();
  return {};
}

std::span<const CommandKind> simulate() { return {&simulate_kind, 1}; }

}  // namespace dynalin::commands
