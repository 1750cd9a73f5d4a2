#include "command/prompt.h"

#include <fmt/ostream.h>

#include <filesystem>

#include "command/commands/file.h"
#include "command/help.h"
#include "command/interruption.h"
#include "command/live_session.h"
#include "dynalin/version.h"

namespace dynalin {

namespace {

// A line goes on where it ends in the mark of continuation.
bool goes_on(std::string& line) {
  while (!line.empty() && (line.back() == ' ' || line.back() == '\t' || line.back() == '\r')) line.pop_back();
  return !line.empty() && line.back() == '&';
}

class Prompt {
 public:
  Prompt(const SessionOptions& options, LineSource& lines, std::ostream& out, std::ostream& err)
      : options_(options),
        lines_(lines),
        out_(out),
        err_(err),
        plan_(options, Statements::kept),
        session_(options, plan_, options.quiet ? nullptr : &out, out, err) {
    session_.preferences.at_prompt = true;
  }

  int run() {
    fmt::print(out_, "dynalin {}: HELP shows what there is, STOP ends\n", version);
    bool ended = !options_.file.empty() && !begin();
    while (!ended) {
      const auto command = read();
      ended = !command || !take(*command);
    }
    return session_.finish();
  }

 private:
  // What the command line names, as FILE would; false if the session is over.
  bool begin() {
    const std::filesystem::path path(options_.file);
    const bool is_commands = path.extension() == ".acf";
    return take((is_commands ? "FILE/COMMAND=" : "FILE/MODEL=") + options_.file);
  }

  std::optional<std::string> read() {
    std::string command;
    for (;;) {
      const RunState* state = session_.state();
      auto line = lines_.next(command.empty() ? "dynalin> " : "       > ", state ? &state->system().model() : nullptr);
      if (!line) return command.empty() ? std::nullopt : std::optional(command);
      const bool more = goes_on(*line);
      command += *line + "\n";
      if (!more) return command;
    }
  }

  // One command, or several where it names a file of them; false if the session is over.
  bool take(const std::string& text) {
    const auto source = std::make_shared<const SourceText>("prompt", text);
    plan_.diagnostics = {};
    plan_.await_nothing();
    auto parsed = parse_commands(source);
    plan_.diagnostics.append(std::move(parsed.diagnostics));
    const Planner::Mark before = plan_.mark();
    std::vector<Command> commands = plan_.expanded(std::move(parsed.value), "");
    bool stops = false;
    for (Command& c : commands) {
      if (plan_.diagnostics.has_errors() || stops) break;
      stops = c.action->stops();
      if (plan_.jobs.empty() && !c.action->needs_model() && !action_of<commands::File>(c)) {
        without_model(c);
        continue;
      }
      plan_.add(std::move(c));
    }
    plan_.finish_edits();
    if (!plan_.diagnostics.items().empty()) err_ << render(plan_.diagnostics);
    if (plan_.diagnostics.has_errors()) {
      plan_.back_to(before);
      return true;
    }
    forget_interruption();
    return session_.advance_at_prompt() && !stops;
  }

  // What can be done before there is a model: help, and settings of the session, which the planner keeps for it.
  void without_model(Command& c) {
    if (c.kind->name != "HELP" && c.kind->name != "MENU") {
      if (!c.action->stops()) fmt::print(out_, "{} waits for a model: FILE/MODEL=name\n", c.text);
      return plan_.add(std::move(c));
    }
    if (c.kind->name == "MENU")
      print_commands(out_);
    else
      print_help(help_name(*c.statement), out_, err_);
  }

  const SessionOptions& options_;
  LineSource& lines_;
  std::ostream& out_;
  std::ostream& err_;
  Planner plan_;
  LiveSession session_;
};

}  // namespace

int run_prompt(const SessionOptions& options, LineSource& lines, std::ostream& out, std::ostream& err) {
  const Interruptible notes_interruptions;
  return Prompt(options, lines, out, err).run();
}

}  // namespace dynalin
