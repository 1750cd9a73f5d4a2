// INFO/{DISPLACEMENT | VELOCITY | ACCELERATION | FORCE}, I=, J=, RM=: six components of I relative to J along the axes
// of RM, by the functions of expressions that measure them.
#include <fmt/format.h>

#include "command/run_state.h"
#include "command/stages.h"
#include "study/measured.h"

namespace dynalin::commands {

namespace {

struct InfoArguments {
  bool displacement = false, velocity = false, acceleration = false, force = false;
  std::optional<std::int64_t> i, j, rm;

  using W = InfoArguments;
  static constexpr std::array<Argument<W>, 7> arguments = {{
      {.name = "DISPLACEMENT", .slot = &W::displacement, .help = "the place, and angles psi, theta, phi [rad]"},
      {.name = "VELOCITY", .slot = &W::velocity, .help = "velocity and angular velocity"},
      {.name = "ACCELERATION", .slot = &W::acceleration, .help = "acceleration and angular acceleration"},
      {.name = "FORCE", .slot = &W::force, .help = "force and torque on I of all elements between I and J"},
      {.name = "I",
       .slot = &W::i,
       .required = true,
       .minimum = 0,
       .help = "a marker; 0, but for FORCE, is the ground",
       .ids_of = MarkerClass::statement},
      {.name = "J",
       .slot = &W::j,
       .minimum = 0,
       .help = "the marker that it is relative to; the ground",
       .ids_of = MarkerClass::statement},
      {.name = "RM",
       .slot = &W::rm,
       .minimum = 0,
       .help = "the marker along whose axes; the global ones",
       .ids_of = MarkerClass::statement},
  }};
};

struct Quantity {
  std::string_view title;
  std::array<std::string_view, 6> functions, labels;
  bool angles = false;  // the last three take no axes
};
constexpr std::array<Quantity, 4> quantities = {{
    {"Displacement", {"DX", "DY", "DZ", "PSI", "THETA", "PHI"}, {"X", "Y", "Z", "PSI", "THETA", "PHI"}, true},
    {"Velocity", {"VX", "VY", "VZ", "WX", "WY", "WZ"}, {"VX", "VY", "VZ", "WX", "WY", "WZ"}},
    {"Acceleration",
     {"ACCX", "ACCY", "ACCZ", "WDTX", "WDTY", "WDTZ"},
     {"ACCX", "ACCY", "ACCZ", "WDTX", "WDTY", "WDTZ"}},
    {"Force", {"FX", "FY", "FZ", "TX", "TY", "TZ"}, {"FX", "FY", "FZ", "TX", "TY", "TZ"}},
}};

class Info final : public CommandAction {
 public:
  Info(const Quantity& quantity, std::int64_t i, std::int64_t j, std::int64_t rm)
      : quantity_(&quantity), i_(i), j_(j), rm_(rm) {}

  bool reads_statements() const override { return true; }
  void check(const Model& model, const CommandPlace& place, Diagnostics& diagnostics) const override {
    for (const auto& [id, name] : {std::pair{i_, "I"}, std::pair{j_, "J"}, std::pair{rm_, "RM"}}) {
      if (!model.find_marker(id))
        diagnostics.error("unknown-element", place.value(name),
                          fmt::format("the command refers to MARKER/{}, which does not exist", id));
    }
  }
  StudyResult<void> run(RunState& run) const override {
    std::vector<std::string> functions;
    for (std::size_t k = 0; k < 6; ++k)
      functions.push_back(quantity_->angles && k >= 3
                              ? fmt::format("{}({}, {})", quantity_->functions[k], i_, j_)
                              : fmt::format("{}({}, {}, {})", quantity_->functions[k], i_, j_, rm_));
    const auto values = measured(run.point, run.system().model().dataset, functions, model_options(run.options));
    if (!values) return tl::unexpected(values.error());
    const auto name = [](std::int64_t id) { return id == 0 ? std::string("ground") : fmt::format("MARKER/{}", id); };
    std::string text = fmt::format("\n  {} of {} relative to {} along the axes of {} at time {:.5E}\n",
                                   quantity_->title, name(i_), name(j_), name(rm_), run.time());
    for (std::size_t k = 0; k < 6; ++k)
      text += fmt::format("    {:<6}= {:15.7E}\n", quantity_->labels[k], (*values)[k] + 0.0);
    run.print(text);
    return {};
  }

 private:
  const Quantity* quantity_;
  std::int64_t i_, j_, rm_;
};

std::shared_ptr<const CommandAction> read_info(CommandReader& reader) {
  InfoArguments w;
  if (!read_arguments(w, reader)) return nullptr;
  const std::array<bool, 4> asked = {w.displacement, w.velocity, w.acceleration, w.force};
  if (std::count(asked.begin(), asked.end(), true) != 1) {
    reader.error("missing-option", reader.statement().at,
                 "INFO takes exactly one of DISPLACEMENT, VELOCITY, ACCELERATION, FORCE");
    return nullptr;
  }
  if (w.force && *w.i == 0) {
    reader.error("value-out-of-range", reader.at("I"),
                 "I of INFO/FORCE is a marker, and nothing acts on the global frame");
    return nullptr;
  }
  const auto which = static_cast<std::size_t>(std::find(asked.begin(), asked.end(), true) - asked.begin());
  return std::make_shared<Info>(quantities[which], *w.i, w.j.value_or(0), w.rm.value_or(0));
}

constexpr CommandKind info_kind = {.name = "INFO",
                                   .use = CommandUse::information,
                                   .summary = "prints how a marker stands, moves or is loaded",
                                   .example = "INFO/DISPLACEMENT, I=20, J=10, RM=10",
                                   .arguments = detail::argument_infos<InfoArguments>,
                                   .read = read_info};

}  // namespace

std::span<const CommandKind> info() { return {&info_kind, 1}; }

}  // namespace dynalin::commands
