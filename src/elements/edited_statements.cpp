// What commands may do with which statements, as their Kinds say it.
#include <algorithm>

#include "elements/catalogue.h"

namespace dynalin {

namespace {

template <class Wanted>
std::vector<std::string_view> names_of(const Wanted& wanted) {
  std::vector<std::string_view> names;
  for (const Kind* kind : catalogue()) {
    if (wanted(*kind)) names.push_back(kind->statement);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

std::span<const std::string_view> redefinable_statements() {
  static const auto names = names_of(can_be_redefined);
  return names;
}

std::span<const std::string_view> deactivatable_statements() {
  // What is inert is taken in silence: it is never in the model.
  static const auto names =
      names_of([](const Kind& kind) { return kind.can_be_deactivated && !is_beside_model(kind); });
  return names;
}

std::span<const std::string_view> setting_statements() {
  static const auto names = names_of([](const Kind& kind) { return kind.role == Kind::Role::setting; });
  return names;
}

}  // namespace dynalin
