// Statements that set something: read by a table of arguments like any other; what nothing acts on is noted by name.
//
// A written statement E has, beside its table,
//
//     static constexpr std::array<std::string_view, n> acting;   // arguments that something acts on, or that need no
//     word void apply(Settings&) const;
//
// and, where a word may be wrong,
//
//     bool check(ElementReader&) const;   // false after a reported error
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

// "INTEGRATOR/HMAX" for each argument of the reader's statement that nothing acts on.
template <class E>
std::vector<std::string> arguments_passed_over(const ElementReader& reader) {
  std::vector<std::string> list;
  for (const ElementReader::Assignment& a : reader.assignments) {
    if (std::find(E::acting.begin(), E::acting.end(), a.name) == E::acting.end())
      list.push_back(std::string(reader.label().statement) + "/" + std::string(a.name));
  }
  return list;
}

// The arguments of a statement, and what tables cannot say of their values, where it has such rules.
template <class E>
bool read_setting_arguments(E& element, ElementReader& reader) {
  if (!read_arguments(element, reader)) return false;
  if constexpr (requires { element.check(reader); }) return element.check(reader);
  return true;
}

// False after a report: of words that exclude each other at most one may stand.
template <std::size_t n>
bool check_one_of(const std::array<std::string_view, n>& words, ElementReader& reader) {
  std::string_view first;
  for (const std::string_view word : words) {
    if (!reader.given(word)) continue;
    if (first.empty()) {
      first = word;
      continue;
    }
    reader.error("excluded-arguments", reader.at(word),
                 fmt::format("{} takes {} or {}, not both", reader.label().statement, first, word));
    return false;
  }
  return true;
}

template <class E>
class SettingSet final : public TypedSet<E> {
 public:
  using TypedSet<E>::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    if (!read_setting_arguments(this->elements[k], reader)) return;
    const auto list = arguments_passed_over<E>(reader);
    passed_over_.insert(passed_over_.end(), list.begin(), list.end());
  }
  void finish(Model& model, Diagnostics&) override {
    for (const E& e : this->elements) e.apply(model.settings);
    for (const std::string& name : passed_over_) model.settings.pass_over(name);
  }

 private:
  std::vector<std::string> passed_over_;
};

template <class E>
constexpr Kind setting(std::string_view statement, std::string_view summary) {
  return {statement,
          "",
          summary,
          Kind::Role::setting,
          detail::argument_infos<E>,
          [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<SettingSet<E>>(kind); }};
}

}  // namespace dynalin
