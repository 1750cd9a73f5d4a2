// SIMULATE, FILE and ENVIRONMENT as written; LINEAR has a file of its own (linear_command.h).
#pragma once

#include "model/schema.h"

namespace dynalin {

struct WrittenSimulate {
  bool initial = false, statics = false, kinematics = false, dynamics = false, transient = false;
  bool displacement = false, velocity = false, acceleration = false;
  std::optional<double> end, duration, step;
  std::optional<std::int64_t> steps;

  using W = WrittenSimulate;
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

struct WrittenFile {
  std::string command, model, prefix;

  using W = WrittenFile;
  static constexpr std::array<Argument<W>, 3> arguments = {{
      {.name = "COMMAND", .slot = &W::command, .help = "another command file: not available yet"},
      {.name = "MODEL", .slot = &W::model, .help = "the dataset, .adm unless it says otherwise"},
      {.name = "OUTPUT_PREFIX",
       .slot = &W::prefix,
       .help = "how the names of output files begin; else the model's name"},
  }};
};

struct WrittenEnvironment {
  std::string name, value;

  using W = WrittenEnvironment;
  static constexpr std::array<Argument<W>, 2> arguments = {{
      {.name = "NAME", .slot = &W::name, .required = true, .help = "an environment variable, for the rest of the run"},
      {.name = "VALUE", .slot = &W::value, .help = "it counts as set whatever the value is"},
  }};
};

}  // namespace dynalin
