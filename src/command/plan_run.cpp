// A run from a command file, or from a dataset and commands besides it.
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>

#include "base/read_file.h"
#include "command/output_plan.h"
#include "command/planner.h"
#include "dataset/characters.h"

namespace dynalin {

namespace {

namespace fs = std::filesystem;

bool has_extension(const std::string& path, std::string_view extension) {
  return equal_ignoring_case(fs::path(path).extension().string(), extension);
}

// Where a name without its extension would have been right.
std::string existing_hint(const std::string& path) {
  for (const char* extension : {".acf", ".adm"}) {
    if (std::error_code ec; fs::path(path).extension().empty() && fs::is_regular_file(path + extension, ec))
      return path + extension + " exists";
  }
  return {};
}

// What shows that a text is a dataset: in a command file UNITS may stand by mistake.
enum class Sign : std::uint8_t { ground_part, ground_part_or_units };

// Whether a text has statements that only a dataset has: looked for at its beginning.
bool is_text_of_dataset(const std::string& name, std::string text, Sign sign) {
  constexpr std::size_t enough = 65536;
  if (text.size() > enough) text.resize(std::min(text.rfind('\n', enough), enough));
  const auto parsed = parse_dataset(std::make_shared<const SourceText>(name, std::move(text)));
  static constexpr std::array<std::string_view, 1> ground = {"GROUND"};
  return std::ranges::any_of(parsed.value.statements, [&](const Statement& s) {
    if (s.name == "UNITS") return sign == Sign::ground_part_or_units;
    return s.name == "PART" && std::ranges::any_of(s.arguments, [](const WrittenArgument& w) {
             return !w.has_value && find_keyword(w.name.text(), ground).has_value();
           });
  });
}

// Whether a text begins as a command file does: with a command, or the name of a dataset that is there.
bool begins_with_command_or_model(const std::string& path, const std::string& text) {
  const std::string model = parse_command_file(std::make_shared<const SourceText>(path, text)).value.model;
  if (model.empty()) return true;
  std::error_code ec;
  return fs::is_regular_file(with_extension((fs::path(path).parent_path() / model).string(), ".adm"), ec);
}

// A command file may define the ground part anew: its extension counts as long as it can be one.
bool holds_dataset(const std::string& path) {
  auto text = read_file(path);
  if (!text) return false;
  const bool commands = has_extension(path, ".acf");
  if (commands && begins_with_command_or_model(path, *text)) return false;
  return is_text_of_dataset(path, std::move(*text), commands ? Sign::ground_part : Sign::ground_part_or_units);
}

// What a run begins with: its commands, and the dataset that it names without one of them.
struct Start {
  std::vector<Command> commands;
  std::optional<Planner::Opening> model;
};

class Reader {
 public:
  Reader(const SessionOptions& options, std::ostream& err) : options_(options), err_(err) {}

  std::optional<Planner> read() {
    const std::string& file = options_.file;
    const bool has_commands = !options_.commands.empty(), piped = file == "-";
    if (piped && is_text_of_dataset("standard input", options_.standard_input.value_or(""), Sign::ground_part)) {
      fmt::print(err_,
                 "error: standard input holds a dataset, and only commands are taken from there\nhint: name the file "
                 "of the dataset: dynalin check model.adm, or dynalin run model.adm -c \"LINEAR/EIGENSOL\"\n");
      return std::nullopt;
    }
    // A dataset may be called anything, a command file as well.
    const bool named_dataset = !piped && (has_extension(file, ".adm") || holds_dataset(file));
    if (has_commands && has_extension(file, ".acf") && !named_dataset) {
      fmt::print(err_,
                 "error: -c gives commands for a dataset, and {} is a command file\nhint: run the dataset that it "
                 "names with -c, or write the commands into it\n",
                 file);
      return std::nullopt;
    }
    // A file that is run with commands of its own is a dataset whatever its name.
    const bool is_dataset = has_commands || named_dataset;
    Planner reading(options_, Statements::kept);
    const auto start = is_dataset ? std::optional(of_dataset(reading)) : of_command_file(reading);
    if (!start) return std::nullopt;
    const bool kept =
        std::ranges::any_of(start->commands, [](const Command& c) { return c.action && c.action->reads_statements(); });
    std::optional<Planner> plan(std::in_place, options_, kept ? Statements::kept : Statements::released);
    plan->diagnostics = std::move(reading.diagnostics), plan->texts = std::move(reading.texts);
    plan->inputs = std::move(reading.inputs);
    plan->only_a_dataset = is_dataset;
    if (start->model) plan->open(*start->model);
    for (const Command& c : start->commands) plan->add(c);
    plan->finish_edits();
    if (plan->jobs.empty() && !plan->diagnostics.has_errors())
      plan->diagnostics.error("missing-model", {source_.get(), 0, 0}, "the command file names no model",
                              "its first line is the name of the dataset");
    if (!plan->diagnostics.has_errors()) check_outputs(plan->jobs, options_, plan->inputs, plan->diagnostics);
    err_ << render(plan->diagnostics);
    if (plan->diagnostics.has_errors()) return std::nullopt;
    return plan;
  }

 private:
  Start of_dataset(Planner& reading) {
    std::string text = options_.standard_input.value_or("");
    const bool piped = options_.standard_input.has_value();
    for (const std::string& c : options_.commands) text += c + "\n";
    source_ = std::make_shared<const SourceText>(piped ? "standard input" : "command line", text);
    auto parsed = parse_commands(source_);
    reading.diagnostics.append(std::move(parsed.diagnostics));
    Start start{reading.expanded(std::move(parsed.value), ""), std::nullopt};
    start.model = Planner::Opening{options_.file, "", {}, "", ""};
    return start;
  }

  std::optional<Start> of_command_file(Planner& reading) {
    const bool piped = options_.file == "-";
    const std::string folder = piped ? std::string() : fs::path(options_.file).parent_path().string();
    if (piped) {
      source_ = std::make_shared<const SourceText>("standard input", options_.standard_input.value_or(""));
    } else {
      auto text = read_file(options_.file);
      if (!text) {
        const std::string hint = existing_hint(options_.file);
        fmt::print(err_, "error: {} cannot be read: {}\n{}", options_.file, text.error(),
                   hint.empty() ? hint : "hint: " + hint + "\n");
        return std::nullopt;
      }
      source_ = std::make_shared<const SourceText>(options_.file, std::move(*text));
    }
    if (!piped) reading.inputs.add(options_.file);
    auto parsed = parse_command_file(source_);
    reading.diagnostics.append(std::move(parsed.diagnostics));
    Start start;
    if (!parsed.value.model.empty()) {
      const std::string path = with_extension((fs::path(folder) / parsed.value.model).string(), ".adm");
      start.model = Planner::Opening{path, parsed.value.output_prefix, parsed.value.model_at, folder, ""};
    }
    start.commands = reading.expanded(std::move(parsed.value), folder);
    return start;
  }

  const SessionOptions& options_;
  std::ostream& err_;
  SourceRef source_;
};

}  // namespace

std::optional<Planner> planned(const SessionOptions& options, std::ostream& err) { return Reader(options, err).read(); }

}  // namespace dynalin
