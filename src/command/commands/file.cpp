// FILE/{COMMAND= | MODEL=, OUTPUT_PREFIX=}: commands of another file in this place, or a model for those that follow.
#include "command/commands/file.h"

#include "command/commands.h"

namespace dynalin::commands {

namespace {

struct FileArguments {
  std::string command, model, prefix;

  using W = FileArguments;
  static constexpr std::array<Argument<W>, 3> arguments = {{
      {.name = "COMMAND",
       .slot = &W::command,
       .help = "a command file whose commands run here, .acf unless it says otherwise"},
      {.name = "MODEL", .slot = &W::model, .help = "the dataset for what follows, .adm unless it says otherwise"},
      {.name = "OUTPUT_PREFIX",
       .slot = &W::prefix,
       .help = "how the names of the model's output files begin; else its name"},
  }};
};

std::shared_ptr<const CommandAction> read_file(CommandReader& reader) {
  FileArguments w;
  if (!read_arguments(w, reader)) return nullptr;
  const bool names_none = w.command.empty() && w.model.empty();
  if (names_none || (w.model.empty() && !w.prefix.empty())) {
    reader.error("missing-option", reader.statement().at,
                 names_none ? "FILE needs COMMAND= or MODEL=" : "OUTPUT_PREFIX of FILE needs MODEL=",
                 "FILE/MODEL=car, OUTPUT_PREFIX=run_1");
    return nullptr;
  }
  auto action = std::make_shared<File>();
  action->command_at = reader.at("COMMAND"), action->model_at = reader.at("MODEL");
  action->command = std::move(w.command), action->model = std::move(w.model), action->prefix = std::move(w.prefix);
  return action;
}

constexpr CommandKind file_kind = {.name = "FILE",
                                   .use = CommandUse::run,
                                   .summary = "names the dataset, or a further command file",
                                   .example = "FILE/MODEL=car, OUTPUT_PREFIX=car_loaded",
                                   .arguments = detail::argument_infos<FileArguments>,
                                   .read = read_file};

}  // namespace

std::span<const CommandKind> file() { return {&file_kind, 1}; }

}  // namespace dynalin::commands
