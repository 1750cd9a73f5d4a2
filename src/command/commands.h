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
  Span whole;  // with its arguments
  const Statement* statement = nullptr;
  const CommandKind* kind = nullptr;
  std::shared_ptr<const CommandAction> action;  // nothing where the file is wrong
  std::size_t stage = known_when_run;           // which of the models of its job it works with, an edit included
  std::string folder;                           // that names of files in it are relative to
  std::shared_ptr<const Dataset> written;       // the statements among which it stands

  CommandPlace place() const { return {at, statement, kind ? kind->arguments : std::span<const ArgumentInfo>()}; }

  static constexpr std::size_t known_when_run = static_cast<std::size_t>(-1);
};

struct CommandFile {
  std::string model;  // path of the dataset, relative to the command file, with its extension
  Span model_at;
  std::string output_prefix;  // empty: the model's name
  std::vector<Command> commands;
  std::shared_ptr<const Dataset> written;  // the statements of the file
  SourceRef source;
};

// A whole .acf in either shape: model and prefix on two lines, or commands alone, FILE/MODEL= among them.
Parsed<CommandFile> parse_command_file(SourceRef);
// Commands given one by one on the command line.
Parsed<CommandFile> parse_commands(SourceRef);

// What a command was read as, nullptr if it is another one.
template <class Action>
const Action* action_of(const Command& c) {
  return dynamic_cast<const Action*>(c.action.get());
}

}  // namespace dynalin
