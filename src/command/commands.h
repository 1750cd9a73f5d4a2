// The commands of a command file, read and checked before anything runs.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "dynalin/modal_table.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin {

struct SimulateCommand {
  enum class Kind { initial_conditions, statics } kind = Kind::initial_conditions;
};

enum class LinearOption { eigensol, statemat, mkb, nastran_export };

// LINEAR with all its arguments (LINEAR command, section 4).
struct LinearCommand {
  LinearOption option = LinearOption::eigensol;
  std::optional<std::int64_t> rm, pstate, pinput, poutput;
  bool without_damping = false, without_vectors = false, original = false, names = false;
  std::string file, format = "MATRIXX", type, config;
  ModalTableRequest tables;
  int table_precision = 2;
};

// ENVIRONMENT: an environment variable for the rest of the run.
struct EnvironmentCommand {
  std::string name;
};

// A command that changes the model: the statement in CommandFile::written (edits.h).
struct EditCommand {
  const Statement* statement = nullptr;
};

// A command that sets what the analyses after it work with.
struct SettingCommand {
  std::optional<WrittenEquilibrium> equilibrium;
  std::optional<WrittenInitialConditions> initial_conditions;
  std::vector<std::string> passed_over;  // "INTEGRATOR/HMAX"
  Diagnostics remarks;
};

// A command that is known and has no effect on a linear model.
struct PassiveCommand {
  std::string name;
};
struct StopCommand {};

struct Command {
  std::string text;  // as written, on one line
  Span at;
  std::variant<SimulateCommand, LinearCommand, EnvironmentCommand, EditCommand, SettingCommand, PassiveCommand,
               StopCommand>
      what;
  std::size_t stage = 0;  // which of the models of the run it works with, itself an edit included
};

struct CommandFile {
  std::string model;  // path of the dataset, relative to the command file, with its extension
  Span model_at;
  std::string output_prefix;  // empty: the model's name
  std::vector<Command> commands;
  std::shared_ptr<const Dataset> written;  // the statements of the file
  SourceRef source;
};

// A whole .acf in either shape: model and prefix on two lines, or FILE/MODEL= among the commands.
Parsed<CommandFile> parse_command_file(SourceRef);
// Commands given one by one on the command line.
Parsed<CommandFile> parse_commands(SourceRef);

}  // namespace dynalin
