// Statements of a dataset as values, to build a model without text.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

#include "dynalin/element_id.h"

namespace dynalin {

// NAME, or NAME=value: numbers, ids, or the text of an expression, a file name or a word.
struct StatedArgument {
  using Numbers = std::vector<double>;
  using Ids = std::vector<std::int64_t>;

  std::string name;
  std::variant<std::monostate, Numbers, Ids, std::string> value{};

  StatedArgument(const char* word) : name(word) {}
  StatedArgument(std::string word) : name(std::move(word)) {}
  StatedArgument(std::string of, double number) : name(std::move(of)), value(Numbers{number}) {}
  StatedArgument(std::string of, int id) : name(std::move(of)), value(Ids{id}) {}
  StatedArgument(std::string of, std::int64_t id) : name(std::move(of)), value(Ids{id}) {}
  StatedArgument(std::string of, std::initializer_list<double> numbers)
      : name(std::move(of)), value(Numbers(numbers)) {}
  StatedArgument(std::string of, std::initializer_list<int> ids)
      : name(std::move(of)), value(Ids(ids.begin(), ids.end())) {}
  StatedArgument(std::string of, Numbers numbers) : name(std::move(of)), value(std::move(numbers)) {}
  StatedArgument(std::string of, Ids ids) : name(std::move(of)), value(std::move(ids)) {}
  StatedArgument(std::string of, std::string text) : name(std::move(of)), value(std::move(text)) {}
  StatedArgument(std::string of, const char* text) : name(std::move(of)), value(std::string(text)) {}
};

struct StatedElement {
  ElementId element;  // {"PART", 2}; id 0 for a statement without one, UNITS or ACCGRAV
  std::vector<StatedArgument> arguments{};
  std::string name{};  // view name, which results show beside the id
};

}  // namespace dynalin
