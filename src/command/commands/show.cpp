// SHOW STATISTICS=SIMULATION: what simulations over time have cost.
#include <fmt/format.h>

#include "command/run_state.h"

namespace dynalin::commands {

namespace {

struct ShowArguments {
  std::string statistics;
  static constexpr std::array<Argument<ShowArguments>, 1> arguments = {{
      {.name = "STATISTICS", .slot = &ShowArguments::statistics, .required = true, .help = "SIMULATION"},
  }};
};

std::string row(std::string_view name, const std::string& value) {
  return fmt::format("          {:<35}----   {}\n", name, value);
}

std::string counters(const IntegrationStatistics& s) {
  return row("Steps taken", std::to_string(s.steps)) + row("Function evaluations", std::to_string(s.evaluations)) +
         row("Jacobian evaluations", std::to_string(s.jacobians)) + row("Iterations", std::to_string(s.iterations)) +
         row("Failed error tests", std::to_string(s.failed_error_tests)) +
         row("Failed iterations", std::to_string(s.failed_iterations)) + row("Restarts", std::to_string(s.restarts)) +
         row("Last step size", fmt::format("{:.5E}", s.step_size)) + row("Last order", std::to_string(s.order));
}

class Show final : public CommandAction {
 public:
  StudyResult<void> run(RunState& run) const override {
    std::string text = "\n          Simulation Statistics\n          ========== ==========\n";
    text += row("Present time", fmt::format("{:.5E}", run.time()));
    if (run.last_simulation) {
      text += "\n          Of the last simulation\n" + counters(*run.last_simulation);
      text += "\n          Of all simulations\n" + counters(run.all_simulations);
    } else {
      text += row("Simulations over time", "none");
    }
    run.print(text + "\n");
    return {};
  }
};

std::shared_ptr<const CommandAction> read_show(CommandReader& reader) {
  ShowArguments w;
  if (!read_arguments(w, reader)) return nullptr;
  constexpr std::array<std::string_view, 1> known = {"SIMULATION"};
  if (!find_keyword(w.statistics, known)) {
    reader.error("unknown-word", reader.at("STATISTICS"), fmt::format("SHOW has no statistics of {}", w.statistics),
                 "SHOW STATISTICS=SIMULATION");
    return nullptr;
  }
  return std::make_shared<Show>();
}

constexpr CommandKind show_kind = {.name = "SHOW",
                                   .use = CommandUse::information,
                                   .summary = "prints what simulations have cost",
                                   .example = "SHOW STATISTICS=SIMULATION",
                                   .arguments = detail::argument_infos<ShowArguments>,
                                   .read = read_show};

}  // namespace

std::span<const CommandKind> show() { return {&show_kind, 1}; }

}  // namespace dynalin::commands
