#include "command/command_place.h"

#include <vector>

namespace dynalin {

const WrittenArgument* CommandPlace::find(std::string_view argument) const {
  if (!written_) return nullptr;
  std::vector<std::string_view> names;
  for (const ArgumentInfo& info : arguments_) names.push_back(info.name);
  for (const WrittenArgument& w : written_->arguments) {
    const auto k = find_keyword(w.name.text(), names);
    if (k && names[*k] == argument) return &w;
  }
  return nullptr;
}

Span CommandPlace::value(std::string_view argument) const {
  const WrittenArgument* w = find(argument);
  if (!w) return command_;
  return w->has_value && !w->value().empty() ? w->value_span() : w->name;
}

Span CommandPlace::number(std::string_view argument, std::size_t entry) const {
  const WrittenArgument* w = find(argument);
  if (!w) return command_;
  Diagnostics unused;
  const auto list = read_integers(*w, *w->name.source, unused);
  return list && entry < list->size() ? (*list)[entry].at : value(argument);
}

}  // namespace dynalin
