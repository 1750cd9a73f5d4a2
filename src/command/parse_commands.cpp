#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "command/command_reader.h"
#include "command/command_table.h"
#include "command/commands.h"
#include "command/linear_command.h"
#include "command/written_commands.h"
#include "elements/settings/output_settings.h"
#include "elements/settings/setting_set.h"

namespace dynalin {

namespace {

std::optional<CommandUse> use_of(std::string_view name) {
  const CommandRow* row = find_command(name);
  return row ? std::optional(row->use) : std::nullopt;
}

std::optional<SimulateCommand> read_simulate(ElementReader& reader) {
  WrittenSimulate w;
  if (!read_arguments(w, reader)) return std::nullopt;
  const int kinds = w.initial + w.statics + w.kinematics + w.dynamics + w.transient;
  if (kinds != 1) {
    reader.error("missing-option", reader.statement().at,
                 "SIMULATE takes exactly one of INITIAL_CONDITIONS, STATICS, KINEMATICS, DYNAMICS, TRANSIENT");
    return std::nullopt;
  }
  for (const auto& [flag, name] : {std::pair{w.kinematics, "KINEMATICS"}, std::pair{w.dynamics, "DYNAMICS"},
                                   std::pair{w.transient, "TRANSIENT"}}) {
    if (!flag) continue;
    reader.error("command-not-built", reader.at(name), fmt::format("SIMULATE/{} is not available yet", name),
                 "SIMULATE/STATICS and SIMULATE/INITIAL_CONDITIONS find an operating point at time 0");
    return std::nullopt;
  }
  for (const auto name : {"END", "DURATION", "DTOUT", "STEPS"}) {
    if (!reader.given(name)) continue;
    reader.error("command-not-built", reader.at(name), "simulations over time are not available yet");
    return std::nullopt;
  }
  return SimulateCommand{w.statics ? SimulateCommand::Kind::statics : SimulateCommand::Kind::initial_conditions};
}

// A command that has the arguments of a statement of settings.
template <class E>
bool read_setting(SettingCommand& out, ElementReader& reader, E& written) {
  if (!read_arguments(written, reader)) return false;
  out.passed_over = arguments_passed_over<E>(reader);
  return true;
}

std::optional<SettingCommand> read_setting(std::string_view name, ElementReader& reader) {
  SettingCommand out;
  const auto passed_over_alone = [&]<class E>(E written) { return read_setting(out, reader, written); };
  bool ok = true;
  if (name == "EQUILIBRIUM") {
    ok = read_setting(out, reader, out.equilibrium.emplace());
  } else if (name == "IC") {
    ok = read_setting(out, reader, out.initial_conditions.emplace());
  } else if (name == "INTEGRATOR") {
    ok = passed_over_alone(WrittenIntegrator{});
  } else if (name == "KINEMATICS") {
    ok = passed_over_alone(WrittenKinematics{});
  } else if (name == "LSOLVER") {
    ok = passed_over_alone(WrittenLinearSolver{});
  } else if (name == "DEBUG") {
    ok = passed_over_alone(WrittenDebug{});
  } else if (name == "OUTPUT") {
    ok = passed_over_alone(WrittenOutput{});
  } else if (name == "PREFERENCES") {
    WrittenPreferences written;
    ok = read_setting(out, reader, written);
    written.note(out.remarks);
  } else if (name == "REQUEST") {
    WrittenRequest written;
    ok = read_arguments(written, reader);
    out.passed_over = {"REQUEST"};
  } else {
    return std::nullopt;
  }
  if (!ok) return SettingCommand{};
  return out;
}

std::string one_line(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

class FileParser {
 public:
  explicit FileParser(SourceRef source) { file_.source = std::move(source); }

  Parsed<CommandFile> parse(SourceRef commands) {
    Parsed<Dataset> parsed = parse_statements(commands, command_names());
    diagnostics_.append(std::move(parsed.diagnostics));
    keep_ = std::make_shared<Dataset>(std::move(parsed.value));
    for (const Statement& s : keep_->statements) {
      if (!s.name.empty()) read(s);
    }
    file_.written = keep_;
    return {std::move(file_), std::move(diagnostics_)};
  }
  void name_model(std::string model, Span at, std::string prefix) {
    file_.model = std::move(model), file_.model_at = at, file_.output_prefix = std::move(prefix);
  }

 private:
  void read(const Statement& s) {
    const ElementLabel label{s.name, s.id.value_or(0), "", s.at};
    CommandReader reader(s, *keep_->source, diagnostics_, label);
    Span whole = s.at;
    if (!s.arguments.empty()) {
      const WrittenArgument& last = s.arguments.back();
      whole = join(s.at, last.has_value && last.value_span().length > 0 ? last.value_span() : last.name);
    }
    Command command{one_line(whole.text()), s.at, StopCommand{}};
    if (s.name == "SIMULATE") {
      if (const auto c = read_simulate(reader)) command.what = *c;
    } else if (s.name == "LINEAR") {
      if (auto c = read_linear(reader)) command.what = std::move(*c);
    } else if (s.name == "ENVIRONMENT") {
      WrittenEnvironment w;
      if (read_arguments(w, reader)) command.what = EnvironmentCommand{w.name};
    } else if (s.name == "FILE") {
      WrittenFile w;
      if (!read_arguments(w, reader)) return;
      if (!w.command.empty()) {
        reader.error("command-not-built", reader.at("COMMAND"),
                     "command files within command files are not available yet");
      }
      if (w.model.empty()) return;
      if (!file_.model.empty()) {
        reader.error("second-model", reader.at("MODEL"),
                     fmt::format("the model {} is already loaded, a run has one model", file_.model),
                     "run the commands for the other model from a command file of its own");
      } else if (!file_.commands.empty()) {
        reader.error("second-model", reader.at("MODEL"), "commands that need the model stand before it is named",
                     "name the model first");
      } else {
        name_model(w.model, reader.at("MODEL"), w.prefix);
      }
      return;
    } else if (auto setting = read_setting(s.name, reader)) {
      command.what = std::move(*setting);
    } else if (use_of(s.name) == CommandUse::model) {
      command.what = EditCommand{&s};
    } else if (use_of(s.name) == CommandUse::without_effect) {
      command.what = PassiveCommand{std::string(s.name)};
    } else if (s.name != "STOP") {
      diagnostics_.error("command-not-built", s.keyword, fmt::format("the command {} is not available yet", s.name));
      return;
    }
    if (!stopped_) file_.commands.push_back(std::move(command));
    stopped_ = stopped_ || s.name == "STOP";
  }

  CommandFile file_;
  Diagnostics diagnostics_;
  std::shared_ptr<Dataset> keep_;
  bool stopped_ = false;
};

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
  return s;
}

bool is_command_line(std::string_view line) {
  if (line.empty()) return true;
  const std::size_t slash = line.find('/');
  const std::string_view word = trimmed(line.substr(0, slash));
  return (slash != std::string_view::npos && find_keyword(word, command_names()).has_value()) ||
         (word.size() >= 3 && find_keyword(word, std::array<std::string_view, 1>{"STOP"}));  // a model may be called s
}

// Whether a line is a SIMULATE or LINEAR that would run, and no path that merely looks like a command.
bool is_analysis(const std::string& line) {
  if (!is_command_line(line)) return false;
  const Parsed<CommandFile> parsed = parse_commands(std::make_shared<const SourceText>("", line));
  if (parsed.diagnostics.has_errors() || parsed.value.commands.empty()) return false;
  const auto& what = parsed.value.commands.front().what;
  return std::holds_alternative<SimulateCommand>(what) || std::holds_alternative<LinearCommand>(what);
}

}  // namespace

Parsed<CommandFile> parse_command_file(SourceRef source) {
  FileParser parser(source);
  const std::string_view first = trimmed(source->line(1));
  if (source->text().empty() || is_command_line(first) || first.starts_with("!")) return parser.parse(source);

  // Model and prefix stand on the first two lines; blank them out so that the rest keeps its places.
  std::string text(source->text());
  for (std::size_t n = 1; n <= std::min<std::size_t>(2, source->line_count()); ++n) {
    const std::string_view line = source->line(n);
    text.replace(static_cast<std::size_t>(line.data() - source->text().data()), line.size(), line.size(), ' ');
  }
  const auto offset = static_cast<std::uint32_t>(first.data() - source->text().data());
  const std::string prefix = source->line_count() > 1 ? std::string(trimmed(source->line(2))) : std::string();
  parser.name_model(std::string(first), {source.get(), offset, static_cast<std::uint32_t>(first.size())}, prefix);
  auto rest = std::make_shared<const SourceText>(source->name(), std::move(text));
  Parsed<CommandFile> file = parser.parse(rest);
  if (is_analysis(prefix)) {
    const std::string_view line = source->line(2);
    const auto at = static_cast<std::uint32_t>(line.data() - source->text().data() +
                                               static_cast<std::ptrdiff_t>(line.find(prefix)));
    file.diagnostics.error("missing-prefix", {source.get(), at, static_cast<std::uint32_t>(prefix.size())},
                           "the second line is the prefix of the output files, and here it is a command",
                           "put a prefix above it, or an empty line to take the name of the dataset");
  }
  file.value.source = rest;
  return file;
}

Parsed<CommandFile> parse_commands(SourceRef source) { return FileParser(source).parse(source); }

}  // namespace dynalin
