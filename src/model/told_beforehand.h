// What compiled routines can be told of a model before it is read, as an element says of its statement: routines are
// asked what they read by then, and lists that they read must have a length.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "routine/statement_words.h"

namespace dynalin {

struct RoutineData;

// A list of another statement whose numbers this one gives.
struct FilledList {
  std::string_view statement;
  int id = 0;
  std::optional<std::size_t> size{};
  bool is_constant = false;  // in a linear model
};

// Of a list whose length is not known, or that has nothing in it, nothing.
inline std::optional<std::size_t> known_size(std::size_t size) { return size > 0 ? std::optional(size) : std::nullopt; }

struct ToldBeforehand {
  // How many numbers its list has, unless another statement fills it.
  std::optional<std::size_t> (*size)(const StatementWords&) = nullptr;
  std::vector<FilledList> (*fills)(const StatementWords&) = nullptr;
  bool (*is_constant)(const StatementWords&) = nullptr;  // its list, in a linear model
  // Makes known that there is such data; what it holds follows when the model is read, texts at once.
  void (*data)(const StatementWords&, RoutineData&) = nullptr;
  // Its list are modes, which take reading it by itself, with all statements that modes are made of.
  bool has_modes = false, makes_modes = false;
  std::span<const std::string_view> not_for_modes{};  // arguments that change no mode, and may refer to anything
};

}  // namespace dynalin
