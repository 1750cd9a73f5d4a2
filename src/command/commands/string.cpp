// STRING/id, STRING=text: text for compiled routines, which have no utility here that reads it. Read and passed over,
// with a word. LIST prints that of the dataset.
#include <fmt/format.h>

#include "command/commands/list_statement.h"
#include "command/run_state.h"

namespace dynalin::commands {

namespace {

struct Written {
  Obsolete text;
  bool list = false;

  using W = Written;
  static constexpr std::array<Argument<W>, 2> arguments = {{
      {.name = "STRING", .slot = &W::text, .help = "any text up to the end of the command"},
      {.name = "LIST", .slot = &W::list, .help = "prints that of the dataset, and sets nothing"},
  }};
};

class PassOver final : public CommandAction {
 public:
  StudyResult<void> run(RunState& run) const override {
    run.remarks.say("passed-over",
                    "nothing here acts on STRING, a text that compiled routines cannot read yet; it is passed over");
    run.json.add_plain(run.command, run.time());
    return {};
  }
};

constexpr CommandKind kind = {.name = "STRING",
                              .use = CommandUse::without_effect,
                              .summary = "text for compiled routines",
                              .example = "STRING/1, STRING=text",
                              .arguments = detail::argument_infos<Written>,
                              .read = [](CommandReader& reader) -> std::shared_ptr<const CommandAction> {
                                Written w;
                                if (!read_arguments(w, reader)) return nullptr;
                                if (w.list) return list_of_statement(reader.statement());
                                return std::make_shared<PassOver>();
                              }};

}  // namespace

std::span<const CommandKind> string() { return {&kind, 1}; }

}  // namespace dynalin::commands
