// A whole run in the process: a dataset, behind a line `####` commands, behind another one a file `data` that the
// dataset may name. Whatever happens, the exit status is one of three, a failure says why, no temporary file stays, and
// results are numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <vector>

#include "command/commands.h"
#include "command/commands/file.h"
#include "command/commands/linear.h"
#include "command/commands/reload.h"
#include "command/commands/save.h"
#include "command/session.h"
#include "dataset/dataset.h"
#include "folder.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

constexpr std::size_t most_bytes = 16384, most_statements = 150, most_bodies = 12, most_commands = 8;

std::vector<std::string> sections(std::string_view text) {
  std::vector<std::string> list(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const std::string_view line = text.substr(0, end + 1);
    if (line == "####\n")
      list.emplace_back();
    else
      list.back() += line;
    text.remove_prefix(end + 1);
  }
  return list;
}

// Nothing outside of the folder is written or read, and no run is long because its input asks for it.
bool allowed(std::string_view file) { return file.find('/') == std::string_view::npos && file.size() < 40; }
bool allowed(const CommandFile& commands) {
  if (commands.commands.size() > most_commands || !allowed(commands.model) || !allowed(commands.output_prefix))
    return false;
  for (const Command& c : commands.commands) {
    const auto* linear = action_of<commands::Linear>(c);
    if (linear && !(allowed(linear->command.file) && allowed(linear->command.config))) return false;
    const auto* save = action_of<commands::Save>(c);
    if (save && !allowed(save->file)) return false;
    const auto* reload = action_of<commands::Reload>(c);
    if (reload && !(allowed(reload->file) && allowed(reload->prefix))) return false;
    const auto* file = action_of<commands::File>(c);
    if (file && !(allowed(file->command) && allowed(file->model) && allowed(file->prefix))) return false;
  }
  return true;
}
bool allowed(const Dataset& dataset) {
  if (dataset.statements.size() > most_statements) return false;
  const auto is_body = [](const Statement& s) { return s.name == "PART" || s.name == "POINT_MASS"; };
  if (std::ranges::count_if(dataset.statements, is_body) > static_cast<std::ptrdiff_t>(most_bodies)) return false;
  for (const Statement& s : dataset.statements) {
    for (const WrittenArgument& a : s.arguments) {
      const std::string_view name = a.name.text();
      const bool names_file = !name.empty() && (name.front() == 'F' || name.front() == 'f');
      if ((s.name == "MATRIX" || s.name == "SPLINE") && names_file && !allowed(a.value_span().text())) return false;
    }
  }
  return true;
}

// JSON has no sign for what is not a number: null takes its place. Elsewhere null is what nobody stated, and a bound
// that is infinite, and in a table of a mode a component that an element does not have: never what all its components
// make together, the first of them.
void demand_totals(const nlohmann::json& tables) {
  for (const auto& table : tables) {
    const std::string name = table.at("table");
    if (name != "STRAIN" && name != "DISSIPAT") continue;
    for (const auto& row : table.at("rows"))
      demand(!row.at("values").at(0).is_null(), "the energy of an element is not a number");
  }
}
void demand_numbers(const nlohmann::json& value) {
  constexpr std::array<std::string_view, 4> numbers = {"real_hz", "imag_hz", "backward_error", "time"};
  for (const auto& [name, inner] : value.items()) {
    if (name == "tables") {
      demand_totals(inner);
      continue;
    }
    const bool is_number = value.is_array() || std::ranges::find(numbers, name) != numbers.end();
    demand(!inner.is_null() || !is_number, "a result is not a number");
    if (inner.is_structured()) demand_numbers(inner);
  }
}

void run(const Folder& folder, const std::vector<std::string>& parts) {
  folder.write("model.adm", parts[0]);
  folder.write("model.acf", "model\nmodel\n" + parts[1]);
  if (parts.size() > 2) folder.write("data", parts[2]);
  SessionOptions options;
  options.file = folder.path("model.acf");
  options.json = folder.path("results.json");
  std::ostringstream out, err;
  const int status = run_session(options, out, err);
  demand(status == done || status == wrong_input || status == analysis_failed, "another exit status");
  demand(status == done || err.str().find("error: ") != std::string::npos, "a failure that says nothing");
  std::size_t inputs = parts.size() > 2 ? 3 : 2, files = 0;
  for (const auto& entry : folder.entries()) {
    ++files;
    demand(entry.path().extension() != ".part", "a temporary file is left");
  }
  demand(status != wrong_input || files == inputs, "wrong input, and yet something is written");
  demand(status != done || folder.has("results.json"), "no results");
  if (folder.has("results.json")) demand_numbers(nlohmann::json::parse(folder.read("results.json")).at("results"));
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  static const fuzz::Folder folder;
  if (count > fuzz::most_bytes) return -1;
  const std::vector<std::string> parts = fuzz::sections(fuzz::text_of(bytes, count));
  if (parts.size() < 2) return -1;
  const auto commands = parse_commands(std::make_shared<const SourceText>("model.acf", parts[1]));
  const auto dataset = parse_dataset(std::make_shared<const SourceText>("model.adm", parts[0]));
  if (!fuzz::allowed(commands.value) || !fuzz::allowed(dataset.value)) return -1;
  fuzz::run(folder, parts);
  folder.clear();
  return 0;
}
