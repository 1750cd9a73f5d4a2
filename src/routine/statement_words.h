// What the statement that calls a routine says, for whoever makes the structure of include/dynalin/user_routine.h of it
// that the routine is told.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dynalin/user_routine.h"
#include "routine/routine_constants.h"

namespace dynalin {

// Arguments go by their full names. What is wrong with one is said by whoever reads the statement: here it counts as
// not written.
class StatementWords {
 public:
  virtual ~StatementWords() = default;
  virtual int id() const = 0;
  virtual const RoutineConstants& constants() const = 0;  // which stay where they are
  virtual bool has(std::string_view argument) const = 0;
  virtual int integer(std::string_view argument) const = 0;  // 0 where there is none
  virtual std::vector<int> integers(std::string_view argument) const = 0;
  virtual double real(std::string_view argument, std::size_t which = 0) const = 0;  // of a list; 0 where there is none
  virtual std::vector<double> reals(std::string_view argument) const = 0;
  virtual std::string text(std::string_view argument) const = 0;
  virtual std::string_view written(std::string_view argument) const = 0;  // the value as it stands there
  // Which of these stands in the statement for itself, nothing if none does.
  virtual std::optional<std::size_t> word_among(std::span<const std::string_view>) const = 0;
  // Of another statement; 0 where there is none.
  virtual int integer_of(std::string_view statement, int id, std::string_view argument) const = 0;
  virtual bool slides(int joint) const = 0;  // whether what its joint moves by is a length
};

struct ToldToRoutine {
  std::shared_ptr<const void> structure;  // one of those for C, with all that it points to
  std::size_t values = 0;                 // how many the routine gives, where its kind does not say so
  std::size_t displacements = 0;          // that the routine of a COUPLER gets
};

// A structure S that begins with id and constants, as most do, and goes on like this.
template <class S, class... More>
ToldToRoutine told(const StatementWords& s, More&&... more) {
  return {
      std::make_shared<const S>(S{s.id(), s.constants().count(), s.constants().data(), std::forward<More>(more)...})};
}

// A structure that points into something, together with it: `make` makes the structure of what is kept.
template <class Kept, class Make>
ToldToRoutine told_with(Kept kept, Make&& make) {
  struct Both {
    Kept kept;
    decltype(make(kept)) structure{};
  };
  auto both = std::make_shared<Both>(Both{std::move(kept)});
  both->structure = make(std::as_const(both->kept));
  return {std::shared_ptr<const void>(both, &both->structure)};
}

}  // namespace dynalin
