// HELP [name] and MENU, at a prompt: the pages of `dynalin help`, and the commands that there are.
#include "command/help.h"

#include <fmt/format.h>

#include <sstream>

#include "command/help_pages.h"
#include "command/run_state.h"

namespace dynalin::commands {

namespace {

class Help final : public CommandAction {
 public:
  Help(std::string name, bool menu) : name_(std::move(name)), menu_(menu) {}
  bool needs_model() const override { return false; }
  StudyResult<void> run(RunState& run) const override {
    if (!run.preferences.at_prompt) {
      run.remarks.say("passed-over",
                      fmt::format("{} is for a session at a prompt and is passed over", menu_ ? "MENU" : "HELP"));
      run.json.add_plain(run.command, run.time());
      return {};
    }
    std::ostringstream out;
    if (menu_)
      print_commands(out);
    else
      print_help(name_, out, out);
    if (run.terminal) *run.terminal << out.view();
    run.json.add_plain(run.command, run.time());
    return {};
  }

 private:
  std::string name_;
  bool menu_;
};

std::shared_ptr<const CommandAction> read_help(CommandReader& reader) {
  const auto& arguments = reader.statement().arguments;
  const bool menu = reader.statement().name == "MENU";
  const std::size_t most = menu ? 0 : 2;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    if (k < most && !arguments[k].has_value) continue;
    reader.error("unknown-argument", arguments[k].name,
                 menu ? "MENU takes no arguments" : "HELP takes a name, or one and a type of it");
    return nullptr;
  }
  return std::make_shared<Help>(help_name(reader.statement()), menu);
}

constexpr std::array<ArgumentInfo, 1> help_arguments = {
    {{.name = "name",
      .is_flag = true,
      .help = "a statement, command or function, or one and a type of it; without one the list of all"}}};

constexpr std::array help_kinds = {
    CommandKind{.name = "HELP",
                .use = CommandUse::information,
                .summary = "at a prompt: what a statement, command or function takes",
                .example = "HELP LINEAR",
                .arguments = help_arguments,
                .read = read_help},
    CommandKind{.name = "MENU",
                .use = CommandUse::information,
                .summary = "at a prompt: the commands that there are",
                .example = "MENU",
                .read = read_help},
};

}  // namespace

std::span<const CommandKind> help() { return help_kinds; }

}  // namespace dynalin::commands
