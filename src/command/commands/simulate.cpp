// SIMULATE/{INITIAL_CONDITIONS | STATICS}: finds an operating point at time 0. Simulations over time are refused.
#include "command/commands/simulate.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>

#include "analysis/static_settings.h"
#include "command/progress_line.h"
#include "command/run_state.h"
#include "output/message_file.h"
#include "system/operating_state.h"

namespace dynalin::commands {

namespace {

struct Written {
  bool initial = false, statics = false, kinematics = false, dynamics = false, transient = false;
  bool displacement = false, velocity = false, acceleration = false;
  std::optional<double> end, duration, step;
  std::optional<std::int64_t> steps;

  using W = Written;
  static constexpr std::string_view over_time = "of simulations over time, which are not available yet";
  static constexpr std::string_view level = "with INITIAL_CONDITIONS; all three levels are always made";
  static constexpr std::array<Argument<W>, 12> arguments = {{
      {.name = "INITIAL_CONDITIONS",
       .slot = &W::initial,
       .help = "positions, velocities, accelerations and reactions that agree with constraints and forces"},
      {.name = "STATICS", .slot = &W::statics, .help = "a position of rest in which all forces balance"},
      {.name = "KINEMATICS", .slot = &W::kinematics, .help = "not available yet"},
      {.name = "DYNAMICS", .slot = &W::dynamics, .help = "not available yet"},
      {.name = "TRANSIENT", .slot = &W::transient, .help = "not available yet"},
      {.name = "DISPLACEMENT", .slot = &W::displacement, .help = level},
      {.name = "VELOCITY", .slot = &W::velocity, .help = level},
      {.name = "ACCELERATION", .slot = &W::acceleration, .help = level},
      {.name = "END", .slot = &W::end, .help = over_time},
      {.name = "DURATION", .slot = &W::duration, .help = over_time},
      {.name = "DTOUT", .slot = &W::step, .help = over_time},
      {.name = "STEPS", .slot = &W::steps, .minimum = 1, .help = over_time},
  }};
};

std::shared_ptr<const CommandAction> read(CommandReader& reader) {
  Written w;
  if (!read_arguments(w, reader)) return nullptr;
  const int kinds = w.initial + w.statics + w.kinematics + w.dynamics + w.transient;
  if (kinds != 1) {
    reader.error("missing-option", reader.statement().at,
                 "SIMULATE takes exactly one of INITIAL_CONDITIONS, STATICS, KINEMATICS, DYNAMICS, TRANSIENT");
    return nullptr;
  }
  for (const auto& [flag, name] : {std::pair{w.kinematics, "KINEMATICS"}, std::pair{w.dynamics, "DYNAMICS"},
                                   std::pair{w.transient, "TRANSIENT"}}) {
    if (!flag) continue;
    reader.error("command-not-built", reader.at(name), fmt::format("SIMULATE/{} is not available yet", name),
                 "SIMULATE/STATICS and SIMULATE/INITIAL_CONDITIONS find an operating point at time 0");
    return nullptr;
  }
  for (const auto name : {"END", "DURATION", "DTOUT", "STEPS"}) {
    if (!reader.given(name)) continue;
    reader.error("command-not-built", reader.at(name), "simulations over time are not available yet");
    return nullptr;
  }
  return std::make_shared<Simulate>(w.statics ? Simulate::Kind::statics : Simulate::Kind::initial_conditions);
}

StudyResult<void> find_start(RunState& run) {
  if (auto ready = run.make_consistent(); !ready) return ready;
  const OperatingState state = operating_state(run.system(), run.point.values);
  run.show(StepKind::initial_conditions, state);
  run.json.add(run.command, state);
  return {};
}

StudyResult<void> find_rest(RunState& run) {
  write_begin(run.message, "Static Solution");
  StaticsOptions options = statics_options(run.settings.equilibrium);
  options.restore_velocities = !run.environment.statics_stay_at_rest;
  ProgressLine line(run.terminal);
  options.progress = [&](int iteration, double imbalance) {
    line.show([&] { return fmt::format("static equilibrium: iteration {}, imbalance {:.2e}", iteration, imbalance); });
  };
  auto found = static_equilibrium(run.point, options);
  line.clear();
  if (!found) return tl::unexpected(found.error());
  write_static_result(run.message, found->point.statics->iterations, found->point.statics->imbalance);
  write_end(run.message, "Static Solution");
  run.accept(std::move(*found));
  const StaticResult result = static_result(run.point);
  fmt::print(run.message, "  Stability: {}\n", result.stability.text());
  if (run.terminal)
    fmt::print(*run.terminal, "static equilibrium after {} iterations, imbalance {:.3e}, {}\n", result.iterations,
               result.imbalance, result.stability.text());
  run.show(StepKind::statics, result.at_rest);
  // Velocities of the dataset that have come back make another point of it.
  const std::vector<double>& velocity = run.point.values.velocity;
  run.shown = std::all_of(velocity.begin(), velocity.end(), [](double v) { return v == 0; });
  run.json.add(run.command, result);
  return {};
}

constexpr CommandKind kind = {.name = "SIMULATE",
                              .use = CommandUse::analysis,
                              .summary = "finds an operating point",
                              .example = "SIMULATE/STATICS",
                              .arguments = detail::argument_infos<Written>,
                              .read = read};

}  // namespace

StudyResult<void> Simulate::run(RunState& run) const {
  return kind == Kind::statics ? find_rest(run) : find_start(run);
}

std::span<const CommandKind> simulate() { return {&dynalin::commands::kind, 1}; }

}  // namespace dynalin::commands
