#include "command/completion.h"

#include <algorithm>
#include <cctype>

#include "command/command_catalogue.h"
#include "dataset/characters.h"
#include "elements/catalogue.h"
#include "model/model.h"

namespace dynalin {

namespace {

bool is_part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class Completion {
 public:
  Completion(std::string_view begun, const Model* model) : begun_(upper_case(begun)), model_(model) {}

  void offer(std::string_view word) {
    if (!word.starts_with(begun_) || std::find(list_.begin(), list_.end(), word) != list_.end()) return;
    list_.emplace_back(word);
  }
  void offer_ids(std::string_view statement) {
    if (!model_) return;
    std::vector<std::int32_t> ids;
    const auto add = [&](std::int32_t id, const auto&) { ids.push_back(id); };
    const auto kinds = catalogue();
    const auto kind = std::ranges::find(kinds, statement, &Kind::statement);
    if (kind != kinds.end() && (*kind)->role == Kind::Role::marker) {
      model_->marker_ids.for_each(add);
    } else if (const auto bodies = model_->body_ids.find(statement); bodies != model_->body_ids.end()) {
      bodies->second.for_each(add);
    } else if (const auto elements = model_->ids.find(statement); elements != model_->ids.end()) {
      elements->second.for_each(add);
    }
    std::sort(ids.begin(), ids.end());
    for (const std::int32_t id : ids) offer(std::to_string(id));
  }
  std::vector<std::string> finish() && { return std::move(list_); }

 private:
  std::string begun_;
  const Model* model_;
  std::vector<std::string> list_;
};

}  // namespace

std::vector<std::string> completions(std::string_view line, const Model* model) {
  std::size_t start = line.size();
  while (start > 0 && is_part_of_word(line[start - 1])) --start;
  Completion found(line.substr(start), model);
  std::size_t sign = start;
  while (sign > 0 && is_blank(line[sign - 1])) --sign;

  const std::size_t slash = line.find_first_of("/, =");
  if (slash == std::string_view::npos || slash >= start) {
    for (const CommandKind& kind : command_catalogue()) {
      const bool goes_on = !kind.arguments.empty() || kind.use == CommandUse::model;
      found.offer(std::string(kind.name) + (goes_on ? "/" : ""));
    }
    return std::move(found).finish();
  }
  const auto k = find_keyword(line.substr(0, slash), command_names());
  if (!k) return {};
  const CommandKind& kind = *find_command(command_names()[*k]);
  std::vector<ArgumentInfo> arguments(kind.arguments.begin(), kind.arguments.end());
  std::vector<std::string_view> words;
  const bool redefines = kind.use == CommandUse::model && kind.summary.empty();
  for (const Kind* element : catalogue()) {
    if (!redefines || element->statement != kind.name) continue;
    arguments.insert(arguments.end(), element->arguments.begin(), element->arguments.end());
    if (!element->variant.empty()) words.push_back(element->variant);
  }
  const char before = sign > 0 ? line[sign - 1] : ' ';
  if (redefines && before == '/') {
    found.offer_ids(kind.name);
    return std::move(found).finish();
  }
  if (before == '=' || (before == ',' && line.substr(0, sign).rfind('=') != std::string_view::npos &&
                        std::isdigit(static_cast<unsigned char>(line.substr(start).empty() ? ' ' : line[start])))) {
    const std::size_t equals = line.substr(0, sign).rfind('=');
    std::size_t end = equals;
    while (end > 0 && is_blank(line[end - 1])) --end;
    std::size_t begin = end;
    while (begin > 0 && is_part_of_word(line[begin - 1])) --begin;
    std::vector<std::string_view> names;
    for (const ArgumentInfo& a : arguments) names.push_back(a.name);
    const auto which = find_keyword(line.substr(begin, end - begin), names);
    if (!which) return {};
    if (kind.classes.empty()) {
      found.offer_ids(arguments[*which].ids_of);
    } else {  // ids of the class
      const std::size_t comma = line.find(',');
      const std::string_view word = line.substr(slash + 1, comma == std::string_view::npos ? 0 : comma - slash - 1);
      found.offer_ids(statement_name(word));
    }
    return std::move(found).finish();
  }
  for (const std::string_view name : kind.classes) found.offer(name);
  for (const std::string_view name : words) found.offer(name);
  for (const ArgumentInfo& a : arguments) {
    if (!a.name.empty() && std::isupper(static_cast<unsigned char>(a.name.front())) && !a.elsewhere)
      found.offer(a.name);
  }
  return std::move(found).finish();
}

}  // namespace dynalin
