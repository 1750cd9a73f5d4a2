#include "command/settings_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>

#include "command/command_catalogue.h"
#include "command/run_state.h"
#include "command/statement_text.h"
#include "dataset/word_list.h"

namespace dynalin {

namespace {

// The arguments that were stated, those of the dataset first, by their full names.
class Stated {
 public:
  Stated(const CommandKind& command, const RunState& run) : command_(command) {
    for (const ArgumentInfo& a : command.arguments) names_.push_back(a.name);
    for (const Statement& s : run.system().model().dataset->statements) take(s);
    for (const Command& c : run.settings_done) take(*c.statement);
  }
  // Of the words of a row that which was stated last; nothing if none was.
  const WrittenArgument* last(std::string_view words, std::string_view& word) const {
    const WrittenArgument* found = nullptr;
    for (const auto& [name, argument] : list_) {
      if (lists_word(words, name)) found = argument, word = name;
    }
    return found;
  }
  // In the order in which they came, the last of each.
  const std::vector<std::pair<std::string_view, const WrittenArgument*>>& all() const { return list_; }

 private:
  void take(const Statement& s) {
    const auto shorthands = command_.list.shorthands;
    if (std::ranges::find(shorthands, s.name) != shorthands.end()) {
      shorthands_.emplace_back().name = s.keyword();
      add(s.name, shorthands_.back());
    } else if (s.name != command_.name) {
      return;
    }
    // DEFAULT goes before what stands beside it.
    const auto is = [&](const WrittenArgument& w, std::string_view name) {
      const auto k = find_keyword(w.name.text(), names_);
      return k && names_[*k] == name;
    };
    if (std::ranges::any_of(s.arguments, [&](const WrittenArgument& w) { return is(w, "DEFAULT"); })) list_.clear();
    for (const WrittenArgument& w : s.arguments) {
      const auto k = find_keyword(w.name.text(), names_);
      if (k && names_[*k] != "LIST" && names_[*k] != "DEFAULT") add(names_[*k], w);
    }
  }
  void add(std::string_view name, const WrittenArgument& w) {
    std::erase_if(list_, [&](const auto& known) { return known.first == name; });
    list_.emplace_back(name, &w);
  }

  const CommandKind& command_;
  std::vector<std::string_view> names_;
  std::vector<std::pair<std::string_view, const WrittenArgument*>> list_;
  std::deque<WrittenArgument> shorthands_;  // as arguments of what they are short for
};

std::string value_text(const WrittenArgument& w, Shown shown) {
  std::string text = argument_text(w);
  if (shown == Shown::pattern) {
    std::erase_if(text, [](char c) { return c == ':' || c == ' '; });
    return text;
  }
  if (shown == Shown::text) return text;
  Diagnostics unused;
  const auto number = read_real(w, *w.name.source, unused);
  return number ? shown_number(*number, shown) : text;
}

bool is_zero(const WrittenArgument& w) {
  Diagnostics unused;
  const auto number = read_real(w, *w.name.source, unused);
  return number && *number == 0;
}

}  // namespace

std::string shown_number(double number, Shown shown) {
  if (shown == Shown::angle) return fmt::format("{:.6f} (rad)", number);
  const bool plain = number == 0 || (std::abs(number) >= 1e-4 && std::abs(number) < 1e12);
  return shown == Shown::exponent || !plain ? fmt::format("{:15.6e}", number) : fmt::format("{:.6f}", number);
}

std::string settings_list(std::string_view command, const RunState& run) {
  const CommandKind& kind = *find_command(command);
  const SettingList& list = kind.list;
  const Stated stated(kind, run);
  SettingLines lines;
  for (const SettingRow& row : list.rows) {
    std::string_view word;
    const WrittenArgument* w = stated.last(row.words, word);
    std::string value(row.unstated);
    if (w && w->has_value && !(row.is_limit && is_zero(*w))) value = value_text(*w, row.shown);
    if (w && !w->has_value) value = row.words == word ? "ON" : word;
    const auto in_force = list.held ? list.held(row.label, w != nullptr, run.settings) : std::nullopt;
    if (in_force) value = *in_force;
    lines.emplace_back(row.label, std::move(value));
  }
  if (list.more) std::ranges::move(list.more(run.settings), std::back_inserter(lines));
  if (list.rows.empty()) {
    for (const auto& [name, w] : stated.all()) lines.emplace_back(name, w->has_value ? argument_text(*w) : "ON");
  }
  std::size_t width = 0;
  for (const auto& [label, value] : lines) width = std::max(width, label.size());
  std::string text = fmt::format("\nCurrent {} settings are:\n", command);
  for (const auto& [label, value] : lines) text += fmt::format("   {:<{}} = {}\n", label, width, value);
  if (lines.empty()) text += "   none is stated\n";
  return text + "\n";
}

}  // namespace dynalin
