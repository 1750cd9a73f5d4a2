// The commands of a command file, read and checked before anything runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "command/command_kind.h"

namespace dynalin {

struct Command {
  std::string text;  // as written, on one line
  Span at;
  const CommandKind* kind = nullptr;
  std::shared_ptr<const CommandAction> action;  // nothing where the file is wrong
  std::size_t stage = 0;                        // which of the models of the run it works with, itself an edit included
};

struct CommandFile {
  std::string model;  // path of the dataset, relative to the command file, with its extension
  Span model_at;
  std::string output_prefix;  // empty: the model's name
  std::vector<Command> commands;
  bool stopped = false;                    // what follows is read, and does not run
  std::shared_ptr<const Dataset> written;  // the statements of the file
  SourceRef source;
};

// A whole .acf in either shape: model and prefix on two lines, or FILE/MODEL= among the commands.
Parsed<CommandFile> parse_command_file(SourceRef);
// Commands given one by one on the command line.
Parsed<CommandFile> parse_commands(SourceRef);

// What a command was read as, nullptr if it is another one.
template <class Action>
const Action* action_of(const Command& c) {
  return dynamic_cast<const Action*>(c.action.get());
}

}  // namespace dynalin
