#include "command/help.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cctype>

#include "base/diagnostics.h"
#include "base/enumeration.h"
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

using Names = std::vector<std::string_view>;

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

void add_once(Names& names, std::string_view name) {
  if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
}

// Names that have a page, class by class.
struct NamesOfHelp {
  Names statements{statement_names().begin(), statement_names().end()};
  Names commands{command_names().begin(), command_names().end()};
  Names functions, types, arguments;

  NamesOfHelp() {
    for (const FunctionEntry& f : function_manual()) functions.push_back(f.name);
    for (const Kind* kind : catalogue()) {
      add_once(types, kind->variant);
      for (const ArgumentInfo& a : kind->arguments) add_once(arguments, a.name);
    }
    for (const CommandKind& row : command_catalogue()) {
      for (const ArgumentInfo& a : row.arguments) add_once(arguments, a.name);
    }
  }
};

// What a beginning of a word may mean; arguments where it is nothing else.
Names names_that_begin(std::string_view word) {
  const NamesOfHelp all;
  Names found;
  const auto look = [&](const Names& names) {
    for (const std::string_view name : names) {
      if (begins_with_ignoring_case(name, word)) add_once(found, name);
    }
  };
  look(all.statements), look(all.commands), look(all.functions), look(all.types);
  if (found.empty()) look(all.arguments);
  return found;
}

// Of each class the nearest name, so that a slip finds what was meant wherever it stands.
Names nearest_names(std::string_view word) {
  const NamesOfHelp all;
  Names near;
  for (const Names* names : {&all.statements, &all.commands, &all.functions, &all.types})
    add_once(near, nearest_word(word, *names));
  if (near.empty()) add_once(near, nearest_word(word, nastran::directive_names()));
  if (near.empty()) add_once(near, nearest_word(word, all.arguments));
  return near;
}

// The words of a name as commands and statements are written, LINEAR/EIGENSOL, RM=5 or JOINT REVOLUTE, without ids and
// values.
Names words_of(std::string_view name) {
  Names words;
  if (name.starts_with('/')) return {name};
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("/, "), name.size());
    const std::string_view word = name.substr(0, end);
    if (!word.empty() && std::isdigit(static_cast<unsigned char>(word.front())) == 0)
      words.push_back(word.substr(0, word.find('=')));
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return words;
}

int unknown_name(std::string_view name, std::ostream& err) {
  constexpr std::size_t most = 12;
  std::vector<std::string> begin;
  for (const std::string_view n : names_that_begin(name)) begin.emplace_back(n);
  if (!begin.empty()) {
    fmt::print(err, "error: {} may be short for several names\n", name);
    if (begin.size() > most) {
      const std::size_t more = begin.size() - most;
      begin.resize(most), begin.push_back(fmt::format("{} more", more));
    }
    fmt::print(err, "hint: {}\n", enumeration(begin));
    return wrong_usage;
  }
  const Names near = nearest_names(name);
  fmt::print(err, "error: there is no statement, command or function {}\n", name);
  if (!near.empty()) fmt::print(err, "hint: {} {}\n", enumeration(near), near.size() == 1 ? "exists" : "exist");
  fmt::print(err, "hint: `dynalin help` lists all of them\n");
  return wrong_usage;
}

// JOINT/REVOLUTE: the page of one type; of an argument that of its statement or command.
int print_help_of(std::string_view name, std::string_view part, std::ostream& out, std::ostream& err) {
  const Names types = types_of(statement_name(name));
  if (const auto type = find_keyword(part, types)) {
    print_type(statement_name(name), types[*type], out);
    return done;
  }
  const Names parts = names_within(upper_case(name));
  Names tied;
  if (parts.empty() || find_keyword(part, parts, &tied) || !tied.empty()) return print_help(name, out, err);
  const std::string_view near = nearest_word(part, parts);
  const std::string_view statement = statement_name(name);
  fmt::print(err, "error: {} has no {} {}\n", statement.empty() ? upper_case(name) : std::string(statement),
             types.empty() ? "argument" : "type or argument", part);
  fmt::print(err, "hint: {}\n",
             !near.empty()    ? fmt::format("{} exists", near)
             : !types.empty() ? fmt::format("its types are {}", enumeration(types))
                              : fmt::format("`dynalin help {}` shows what it takes", name));
  return wrong_usage;
}

}  // namespace

int print_help(std::string_view name, std::ostream& out, std::ostream& err) {
  const Names words = words_of(name);
  if (words.size() > 1) return print_help_of(words[0], words[1], out, err);
  name = words.empty() ? std::string_view() : words.front();
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
  const Names meant = names_that_begin(name);
  if (meant.size() == 1 && print_pages(std::string(meant.front()), out)) return done;
  return unknown_name(name, err);
}

std::string help_name(const Statement& help) {
  std::string name;
  for (const WrittenArgument& w : help.arguments) name += (name.empty() ? "" : " ") + std::string(w.name.text());
  return name;
}

void print_commands(std::ostream& out) { list_commands(out); }

namespace {

void print_explanation(const Explanation& e, std::ostream& out) {
  fmt::print(out, "{}: {}\n\n{}\n", e.code, e.text, e.advice);
}

bool has_all(const std::string& text, std::string_view words) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (text.find(words.substr(0, end)) == std::string::npos) return false;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return true;
}

// Words of a message in the place of its code: those that have all of them in code and text, or else in their advice.
std::vector<const Explanation*> explanations_with(const std::string& words) {
  std::vector<const Explanation*> found, by_advice;
  for (const Explanation& e : explanations()) {
    if (has_all(lower_case(e.code) + " " + lower_case(e.text), words)) found.push_back(&e);
    if (has_all(lower_case(e.advice), words)) by_advice.push_back(&e);
  }
  return found.empty() ? by_advice : found;
}

}  // namespace

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
    print_explanation(*e, out);
    return done;
  }
  const auto with_word = explanations_with(word);
  if (with_word.size() == 1) {
    print_explanation(*with_word.front(), out);
    return done;
  }
  if (!with_word.empty()) {
    fmt::print(out, "messages about \"{}\":\n", word);
    for (const Explanation* e : with_word) fmt::print(out, "{:<26} {}\n", e->code, e->text);
    fmt::print(out, "\n`dynalin explain CODE` says what to do about one of them.\n");
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
