#include "command/help.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>

#include "base/diagnostics.h"
#include "command/command_catalogue.h"
#include "command/help_pages.h"
#include "command/session.h"
#include "dataset/characters.h"
#include "elements/catalogue.h"
#include "expression/function_manual.h"
#include "nastran/directive_manual.h"
#include "nastran/directives.h"

namespace dynalin {

namespace {

bool has_statement(std::string_view name) {
  return std::any_of(catalogue().begin(), catalogue().end(), [&](const Kind* kind) { return kind->statement == name; });
}

void list_statements(std::ostream& out) {
  fmt::print(out, "Statements of a dataset\n");
  std::string_view group, statement;
  std::vector<std::string_view> inert;
  for (const Kind* kind : catalogue()) {
    const bool among_settings = catalogue_group(*kind) == "settings and output";
    if (among_settings && (kind->role == Kind::Role::inert || kind->idle)) {
      inert.push_back(kind->statement);
      continue;
    }
    if (catalogue_group(*kind) != group) fmt::print(out, "  {}\n", group = catalogue_group(*kind));
    if (kind->statement == statement) continue;
    statement = kind->statement;
    const auto types = types_of(statement);
    if (types.empty()) {
      fmt::print(out, "    {:<14} {}\n", statement, kind->summary);
      continue;
    }
    fmt::print(out, "    {:<14} of the types\n", statement);
    print_names(out, types, "                     ");
  }
  std::vector<std::string_view> missing;
  for (const std::string_view name : statement_names()) {
    if (name != "END" && !has_statement(name)) missing.push_back(name);
  }
  fmt::print(out, "  read, without effect\n");
  print_names(out, inert, "    ");
  fmt::print(out, "  not available yet\n");
  print_names(out, missing, "    ");
}

void list_commands(std::ostream& out) {
  struct Group {
    CommandUse use;
    std::string_view title;
  };
  static constexpr std::array<Group, 6> groups = {{
      {CommandUse::run, "of a run"},
      {CommandUse::analysis, "analyses"},
      {CommandUse::model, "changes of the model"},
      {CommandUse::setting, "settings"},
      {CommandUse::information, "information"},
      {CommandUse::refused, "refused"},
  }};
  fmt::print(out, "Commands\n");
  for (const Group& group : groups) {
    fmt::print(out, "  {}\n", group.title);
    std::vector<std::string_view> bare;
    for (const CommandKind& row : command_catalogue()) {
      if (row.use != group.use) continue;
      if (row.summary.empty() && !has_statement(row.name)) continue;
      const bool plain = row.use == CommandUse::refused;
      if (row.summary.empty() || plain)
        bare.push_back(row.name);
      else
        fmt::print(out, "    {:<14} {}\n", row.name, row.summary);
    }
    if (group.use == CommandUse::model)
      fmt::print(out, "    and the statements, to define arguments of one anew: PART/2, MASS=3\n");
    print_names(out, bare, group.use == CommandUse::model ? "      " : "    ");
  }
}

void list_functions(std::ostream& out) {
  fmt::print(out, "\nFunctions of expressions\n");
  std::string_view group;
  std::vector<std::string_view> names;
  const auto flush = [&] {
    if (!names.empty()) fmt::print(out, "  {}\n", group);
    print_names(out, names, "    ");
    names.clear();
  };
  for (const FunctionEntry& f : function_manual()) {
    const std::string_view now = f.built ? f.group : "not available yet";
    if (now != group && f.built) {
      flush();
      group = now;
    }
    if (f.built) names.push_back(f.name);
  }
  flush();
  group = "not available yet";
  for (const FunctionEntry& f : function_manual()) {
    if (!f.built) names.push_back(f.name);
  }
  flush();
}

// Of each class the nearest name, so that a slip finds what was meant wherever it stands.
std::vector<std::string_view> nearest_names(std::string_view word) {
  std::vector<std::string_view> near;
  const auto look = [&](std::span<const std::string_view> names) {
    const std::string_view n = nearest_word(word, names);
    if (!n.empty() && std::find(near.begin(), near.end(), n) == near.end()) near.push_back(n);
  };
  std::vector<std::string_view> functions, types;
  for (const FunctionEntry& f : function_manual()) functions.push_back(f.name);
  for (const Kind* kind : catalogue()) {
    if (!kind->variant.empty()) types.push_back(kind->variant);
  }
  look(statement_names()), look(command_names()), look(functions), look(types);
  if (near.empty()) look(nastran::directive_names());
  return near;
}

}  // namespace

int print_help(std::string_view name, std::ostream& out, std::ostream& err) {
  if (name.find('/') != 0) name = name.substr(0, name.find('/'));  // as commands are written: LINEAR/EIGENSOL
  if (name.empty()) {
    list_statements(out);
    fmt::print(out, "\n");
    list_commands(out);
    list_functions(out);
    fmt::print(out,
               "\n`dynalin help NAME` shows what one of them takes; names may be shortened.\n"
               "`dynalin explain` lists the messages, `dynalin --help` the options of the program,\n"
               "`dynalin nastran --help` those for Nastran decks.\n");
    return done;
  }
  if (upper_case(name) == "EXPORT") {
    nastran::print_directives(out);
    return done;
  }
  const bool found = print_pages(upper_case(name), out);
  if (nastran::print_directive(name, out) || found) return done;
  const auto near = nearest_names(name);
  fmt::print(err, "error: there is no statement, command or function {}\n", name);
  if (!near.empty()) fmt::print(err, "hint: {} {}\n", fmt::join(near, ", "), near.size() == 1 ? "exists" : "exist");
  fmt::print(err, "hint: `dynalin help` lists all of them\n");
  return wrong_usage;
}

void print_commands(std::ostream& out) { list_commands(out); }

int print_explanation(std::string_view code, std::ostream& out, std::ostream& err) {
  if (code.empty()) {
    for (const Explanation& e : explanations()) fmt::print(out, "{:<26} {}\n", e.code, e.text);
    fmt::print(out, "\n`dynalin explain CODE` says what to do about one of them.\n");
    return done;
  }
  std::string word(code);  // with the brackets that it has in a message
  std::erase_if(word, [](char c) { return c == '[' || c == ']'; });
  word = lower_case(word);
  if (const Explanation* e = find_explanation(word)) {
    fmt::print(out, "{}: {}\n\n{}\n", e->code, e->text, e->advice);
    return done;
  }
  std::vector<std::string_view> codes;
  for (const Explanation& e : explanations()) codes.push_back(e.code);
  fmt::print(err, "error: there is no message of the code {}\n", code);
  const std::string_view near = nearest_word(word, codes);
  if (!near.empty()) fmt::print(err, "hint: {} exists\n", near);
  fmt::print(err, "hint: `dynalin explain` lists all of them\n");
  return wrong_usage;
}

}  // namespace dynalin
