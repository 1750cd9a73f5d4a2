#include "command/help_pages.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <span>
#include <utility>

#include "command/command_catalogue.h"
#include "elements/catalogue.h"
#include "expression/function_manual.h"

namespace dynalin {

namespace {

std::vector<const Kind*> kinds_of(std::string_view statement) {
  std::vector<const Kind*> kinds;
  for (const Kind* kind : catalogue()) {
    if (kind->statement == statement) kinds.push_back(kind);
  }
  return kinds;
}

// "K=real" with what is known of it; names of one meaning share a line.
void print_arguments(std::ostream& out, const std::vector<ArgumentInfo>& arguments) {
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const ArgumentInfo& a = arguments[k];
    std::string name(a.name);
    const std::string value = a.value_text();
    if (!value.empty()) name += a.value_optional ? fmt::format("[={}]", value) : fmt::format("={}", value);
    const auto alike = [&](const ArgumentInfo& b) {
      return !a.help.empty() && b.help == a.help && b.value_text() == value && b.unit == a.unit && !b.required;
    };
    std::size_t last = k;
    while (last + 1 < arguments.size() && alike(arguments[last + 1]))
      name += fmt::format(", {}", arguments[++last].name);
    std::string text(a.help);
    if (!a.unit.empty()) text += fmt::format("{}[{}]", text.empty() ? "" : " ", a.unit.text);
    if (a.repeats) text += text.empty() ? "may be repeated" : ", may be repeated";
    if (a.required) text += text.empty() ? "required" : ", required";
    constexpr std::size_t width = 24, longest = 100;
    if (name.size() <= width) {
      fmt::print(out, "{}\n", text.empty() ? "    " + name : fmt::format("    {:<{}}  {}", name, width, text));
    } else {
      for (std::size_t begin = 0; begin < name.size();) {  // many names, broken behind a comma
        std::size_t end = name.size();
        if (end - begin > longest) end = name.rfind(", ", begin + longest) + 1;
        fmt::print(out, "    {}\n", name.substr(begin, end - begin));
        begin = end + (end < name.size() ? 1 : 0);
      }
      if (!text.empty()) fmt::print(out, "    {:<{}}  {}\n", "", width, text);
    }
    k = last;
  }
}

bool same(const ArgumentInfo& a, const ArgumentInfo& b) {
  return a.name == b.name && a.value_text() == b.value_text() && a.help == b.help && a.required == b.required &&
         a.unit == b.unit;
}
bool contains(std::span<const ArgumentInfo> list, const ArgumentInfo& a) {
  return std::any_of(list.begin(), list.end(), [&](const ArgumentInfo& b) { return same(a, b); });
}

// What all types share once, then what each has of its own.
void print_statement(std::ostream& out, const std::vector<const Kind*>& kinds) {
  const Kind& first = *kinds.front();
  const bool has_id = first.role != Kind::Role::singleton && !is_beside_model(first);
  const bool has_types = kinds.size() > 1;
  const std::string_view type = has_types ? "type" : first.variant;
  fmt::print(out, "{}/{}{}{}{}\n", first.statement, has_id ? "id" : "", has_id && !type.empty() ? ", " : "", type,
             first.arguments.empty()   ? ""
             : has_id || !type.empty() ? ", arguments"
                                       : "arguments");
  std::vector<ArgumentInfo> shared;
  for (const ArgumentInfo& a : first.arguments) {
    const bool everywhere =
        std::all_of(kinds.begin(), kinds.end(), [&](const Kind* k) { return contains(k->arguments, a); });
    if (!a.elsewhere && everywhere) shared.push_back(a);
  }
  if (!has_types) fmt::print(out, "  {}\n", first.summary);
  if (has_types) fmt::print(out, "  types\n");
  for (const Kind* kind : kinds) {
    if (has_types) fmt::print(out, "    {:<24}  {}\n", kind->variant, kind->summary);
  }
  if (!shared.empty())
    fmt::print(out, "  arguments{}\n",
               kinds.size() > 1 && shared.size() < first.arguments.size() ? " of every type" : "");
  print_arguments(out, shared);
  for (const Kind* kind : kinds) {
    std::vector<ArgumentInfo> own;
    for (const ArgumentInfo& a : kind->arguments) {
      if (!a.elsewhere && !contains(shared, a)) own.push_back(a);
    }
    if (own.empty()) continue;
    fmt::print(out, "  arguments of {}\n", kind->variant);
    print_arguments(out, own);
  }
}

void print_command(std::ostream& out, const CommandKind& row, bool is_statement) {
  if (is_statement && row.summary.empty()) {
    fmt::print(out, "As a command it defines arguments of such a statement anew, the others stay.\n");
    if (!row.example.empty()) fmt::print(out, "    {}\n", row.example);
    return;
  }
  fmt::print(out, "{} (command)\n", row.name);
  if (row.summary.empty())
    fmt::print(out, "  such a statement is not available yet\n");
  else
    fmt::print(out, "  {}{}\n", row.summary, row.use == CommandUse::refused ? ", and is refused" : "");
  if (!row.arguments.empty()) fmt::print(out, "  arguments\n");
  print_arguments(out, {row.arguments.begin(), row.arguments.end()});
  if (!row.classes.empty())
    fmt::print(out, "  classes\n"), print_names(out, {row.classes.begin(), row.classes.end()}, "    ");
  if (!row.example.empty()) fmt::print(out, "  example\n    {}\n", row.example);
}

// A setting is a statement and a command alike.
void print_setting(std::ostream& out, const CommandKind& row) {
  const bool is_statement = !statement_name(row.name).empty();
  fmt::print(out, "{}/ ({})\n  {}\n", row.name, is_statement ? "statement and command" : "command", row.summary);
  std::vector<ArgumentInfo> acting;
  std::vector<std::string_view> passed_over;
  for (const ArgumentInfo& a : row.arguments) {
    const bool acts = std::find(row.acting.begin(), row.acting.end(), a.name) != row.acting.end();
    // LIST, and words for what is the case anyway, are read in silence.
    if (acts && !a.help.empty()) acting.push_back(a);
    if (!acts) passed_over.push_back(a.name);
  }
  if (!acting.empty()) fmt::print(out, "  arguments that act\n");
  print_arguments(out, acting);
  if (!passed_over.empty()) fmt::print(out, "  arguments that are checked and passed over with a warning\n");
  print_names(out, passed_over, "    ");
  fmt::print(out, "  example\n    {}\n", row.example);
}

void print_function(std::ostream& out, const FunctionEntry& f) {
  const FunctionText& t = f.text;
  fmt::print(out, "{} in expressions\n",
             t.arguments.empty() ? std::string(f.name) : fmt::format("{}({})", f.name, t.arguments));
  if (!f.built) fmt::print(out, "  not available yet{}\n", t.meaning.empty() ? "" : ":");
  if (!t.meaning.empty()) fmt::print(out, "  {}{}\n", t.meaning, t.unit.empty() ? "" : fmt::format(" [{}]", t.unit));
  for (std::string_view rest = t.details; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    fmt::print(out, "    {}\n", rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

// What takes arguments of this name, with what each says of it.
bool print_owners(std::ostream& out, std::string_view name) {
  struct Owner {
    std::string name;
    ArgumentInfo argument;
  };
  std::vector<Owner> owners;
  const auto take = [&](std::string owner, std::span<const ArgumentInfo> arguments) {
    const auto a = std::ranges::find(arguments, name, &ArgumentInfo::name);
    const bool known = std::ranges::find(owners, owner, &Owner::name) != owners.end();
    if (a != arguments.end() && !known) owners.push_back({std::move(owner), *a});
  };
  for (const Kind* kind : catalogue()) take(std::string(kind->statement), kind->arguments);
  for (const CommandKind& row : command_catalogue()) take(fmt::format("{} (command)", row.name), row.arguments);
  if (owners.empty()) return false;
  fmt::print(out, "{} is an argument of\n", name);
  for (const Owner& owner : owners) {
    fmt::print(out, "  {}\n", owner.name);
    print_arguments(out, {owner.argument});
  }
  return true;
}

}  // namespace

void print_names(std::ostream& out, const std::vector<std::string_view>& names, std::string_view indent) {
  constexpr std::size_t columns = 100;
  std::string line;
  for (const std::string_view name : names) {
    if (!line.empty() && indent.size() + line.size() + 1 + name.size() > columns)
      fmt::print(out, "{}{}\n", indent, std::exchange(line, {}));
    line += (line.empty() ? "" : " ") + std::string(name);
  }
  if (!line.empty()) fmt::print(out, "{}{}\n", indent, line);
}

std::vector<std::string_view> types_of(std::string_view statement) {
  std::vector<std::string_view> types;
  for (const Kind* kind : kinds_of(statement)) {
    if (!kind->variant.empty()) types.push_back(kind->variant);
  }
  return types;
}

void print_type(std::string_view statement, std::string_view type, std::ostream& out) {
  for (const Kind* kind : kinds_of(statement)) {
    if (kind->variant == type) print_statement(out, {kind});
  }
}

std::vector<std::string_view> names_within(const std::string& name) {
  std::vector<std::string_view> names;
  const auto take = [&](std::span<const ArgumentInfo> arguments) {
    for (const ArgumentInfo& a : arguments) names.push_back(a.name);
  };
  for (const Kind* kind : kinds_of(statement_name(name))) {
    if (!kind->variant.empty()) names.push_back(kind->variant);
    take(kind->arguments);
  }
  if (const auto k = find_keyword(name, command_names())) {
    const CommandKind& command = *find_command(command_names()[*k]);
    take(command.arguments);
    names.push_back("LIST");
    names.insert(names.end(), command.classes.begin(), command.classes.end());
  }
  std::ranges::sort(names);  // one of several types is no tie
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

bool print_pages(const std::string& name, std::ostream& out) {
  bool any = false;
  const auto next = [&] {
    if (any) fmt::print(out, "\n");
    any = true;
  };
  const auto& functions = function_manual();
  const auto function = std::find_if(functions.begin(), functions.end(), [&](const auto& f) { return f.name == name; });
  // A whole name of one class is no abbreviation in another: STEP is a function and no beginning of anything.
  const auto is_whole = [&](std::span<const std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool whole = function != functions.end() || is_whole(statement_names()) || is_whole(command_names());
  const auto found = [&](std::span<const std::string_view> names) -> std::string_view {
    if (whole) return is_whole(names) ? std::string_view(name) : std::string_view{};
    const auto k = find_keyword(name, names);
    return k ? names[*k] : std::string_view{};
  };

  const std::string_view statement = found(statement_names());
  const auto kinds = kinds_of(statement);
  const std::string_view command = found(command_names());
  const bool setting = !command.empty() && find_command(command)->use == CommandUse::setting;
  if (!kinds.empty() && !(setting && command == statement)) next(), print_statement(out, kinds);
  if (setting)
    next(), print_setting(out, *find_command(command));
  else if (!command.empty())
    next(), print_command(out, *find_command(command), !kinds.empty() && command == statement);
  if (!statement.empty() && kinds.empty() && command != statement) {
    next();
    fmt::print(out, "{} {}\n", statement,
               statement == "END" ? "ends a dataset" : "is a statement that is not available yet");
  }
  if (function != functions.end()) next(), print_function(out, *function);
  if (any) return true;
  // REVOLUTE alone: the statements that it is a type of.
  for (const Kind* kind : catalogue()) {
    if (kind->variant == name) next(), print_statement(out, {kind});
  }
  return any || print_owners(out, name);
}

}  // namespace dynalin
