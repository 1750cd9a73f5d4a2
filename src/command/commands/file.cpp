// FILE/MODEL=, OUTPUT_PREFIX=: names the dataset, while the commands are read.
#include <fmt/format.h>

#include "command/commands.h"

namespace dynalin::commands {

namespace {

struct Written {
  std::string command, model, prefix;

  using W = Written;
  static constexpr std::array<Argument<W>, 3> arguments = {{
      {.name = "COMMAND", .slot = &W::command, .help = "another command file: not available yet"},
      {.name = "MODEL", .slot = &W::model, .help = "the dataset, .adm unless it says otherwise"},
      {.name = "OUTPUT_PREFIX",
       .slot = &W::prefix,
       .help = "how the names of output files begin; else the model's name"},
  }};
};

std::shared_ptr<const CommandAction> read(CommandReader& reader) {
  Written w;
  if (!read_arguments(w, reader)) return nullptr;
  if (!w.command.empty()) {
    reader.error("command-not-built", reader.at("COMMAND"), "command files within command files are not available yet");
  }
  if (w.model.empty()) return nullptr;
  CommandFile& file = reader.file();
  if (!file.model.empty()) {
    reader.error("second-model", reader.at("MODEL"),
                 fmt::format("the model {} is already loaded, a run has one model", file.model),
                 "run the commands for the other model from a command file of its own");
  } else if (!file.commands.empty()) {
    reader.error("second-model", reader.at("MODEL"), "commands that need the model stand before it is named",
                 "name the model first");
  } else {
    file.model = w.model, file.model_at = reader.at("MODEL"), file.output_prefix = w.prefix;
  }
  return nullptr;
}

constexpr CommandKind kind = {.name = "FILE",
                              .use = CommandUse::run,
                              .summary = "names the dataset",
                              .example = "FILE/MODEL=car, OUTPUT_PREFIX=car_loaded",
                              .arguments = detail::argument_infos<Written>,
                              .read = read,
                              .runs = false};

}  // namespace

std::span<const CommandKind> file() { return {&kind, 1}; }

}  // namespace dynalin::commands
