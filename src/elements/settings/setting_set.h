// Statements that set something: read by a table of arguments like any other; what nothing acts on is noted by name.
//
// A written statement E has, beside its table,
//
//     static constexpr std::array<std::string_view, n> acting;   // arguments that something acts on, or that need no
//     word void apply(Settings&) const;
//
// and, where words exclude each other, where a word may be wrong, and where something is to be said of all of them,
//
//     static constexpr std::array<std::string_view, n> alternatives;   // "REQSAVE NOREQSAVE": one of them at most
//
//     bool check(ElementReader&) const;   // false after a reported error
//
//     static void remark(std::span<const E>, std::span<const ElementLabel>, Diagnostics&);
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string_view>

#include "dataset/word_list.h"
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

// What an argument sets: itself, or what it and others are alternatives of.
template <class E>
std::string_view what_is_set(std::string_view argument) {
  if constexpr (requires { E::alternatives; }) {
    for (const std::string_view words : E::alternatives) {
      if (lists_word(words, argument)) return words;
    }
  }
  return argument;
}

// False after a report: of words that exclude each other at most one may stand.
template <class E>
bool check_alternatives(ElementReader& reader) {
  const auto& given = reader.assignments;
  for (std::size_t second = 1; second < given.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      if (what_is_set<E>(given[first].name) != what_is_set<E>(given[second].name)) continue;
      reader.error(
          "excluded-arguments", given[second].at,
          fmt::format("{} takes {} or {}, not both", reader.label().statement, given[first].name, given[second].name));
      return false;
    }
  }
  return true;
}

// The arguments of a statement, and what tables cannot say of their values, where it has such rules.
template <class E>
bool read_setting_arguments(E& element, ElementReader& reader) {
  if (!read_arguments(element, reader) || !check_alternatives<E>(reader)) return false;
  if constexpr (requires { element.check(reader); }) return element.check(reader);
  return true;
}

// What the statements of one kind have set so far: a second value of one thing takes the place of the first, with a
// word. Statements with ids set things of their own.
class StatedOnce {
 public:
  void note(std::string_view what, const ElementReader::Assignment& argument, ElementReader& reader) {
    const auto value = [](const WrittenArgument& w) {
      return w.has_value ? w.value_span().text() : std::string_view();
    };
    const auto& written = reader.statement().arguments;
    const auto w = std::find_if(written.begin(), written.end(), [&](const WrittenArgument& a) {
      return a.name.source == argument.at.source && a.name.offset == argument.at.offset;
    });
    if (w == written.end()) return;
    const auto [it, fresh] =
        first_.try_emplace({reader.label().id, what}, Stated{argument.name, value(*w), argument.at});
    if (fresh || (it->second.argument == argument.name && it->second.value == value(*w))) return;
    const std::string_view statement = reader.label().statement;
    reader.diagnostics()
        .warning("duplicate-argument", argument.at,
                 it->second.argument == argument.name
                     ? fmt::format("{} of {} is given a second value, which takes the place of the first",
                                   argument.name, statement)
                     : fmt::format("{} of {} takes the place of {}, which was given before", argument.name, statement,
                                   it->second.argument))
        .notes.push_back({it->second.at, "the first one is here"});
    it->second = {argument.name, value(*w), argument.at};
  }
  void forget() { first_.clear(); }

 private:
  struct Stated {
    std::string_view argument, value;
    Span at;
  };
  std::map<std::pair<std::int64_t, std::string_view>, Stated> first_;
};

template <class E>
class SettingSet final : public TypedSet<E> {
 public:
  using TypedSet<E>::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    if (!read_setting_arguments(this->elements[k], reader)) return;
    const auto list = arguments_passed_over<E>(reader);
    passed_over_.insert(passed_over_.end(), list.begin(), list.end());
    if (reader.given("DEFAULT")) stated_.forget();
    for (const ElementReader::Assignment& a : reader.assignments) stated_.note(what_is_set<E>(a.name), a, reader);
  }
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (const E& e : this->elements) e.apply(model.settings);
    if constexpr (requires { E::remark(this->elements, this->labels, diagnostics); })
      E::remark(this->elements, this->labels, diagnostics);
    for (const std::string& name : passed_over_) model.settings.pass_over(name);
  }

 private:
  std::vector<std::string> passed_over_;
  StatedOnce stated_;
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
