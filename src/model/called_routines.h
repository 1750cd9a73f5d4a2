// Calls of compiled routines by statements of a dataset: what the statement says to its routine, and the functions that
// its values are.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/routine_options.h"
#include "routine/compiled_routine.h"

namespace dynalin {

class CalledRoutines {
 public:
  // Loads the libraries; those that cannot be are errors.
  CalledRoutines(const Dataset&, Catalogue, const RoutineOptions&, Diagnostics&);

  bool has_libraries() const { return !libraries_.empty() || !folders_.empty(); }
  // The routine that the statement calls, null if no library has it (`wanted` says what was looked for) or after an
  // error.
  std::shared_ptr<const CompiledRoutine> find(const Statement&, const WrittenArgument& call, std::string& wanted);
  // Value by value of a routine, in the words of the statement: FX=3, FY=4 … by numbers of functions.
  std::string written(const Statement&, std::shared_ptr<const CompiledRoutine>, const Span& at);

  std::vector<Expression> functions;

 private:
  using Library = std::shared_ptr<const RoutineLibrary>;
  std::vector<Library> libraries_named(std::string_view name);
  std::string_view full_name(const Statement&, const WrittenArgument&) const;
  const WrittenArgument* argument(const Statement&, std::string_view name) const;
  int integer(const Statement&, std::string_view name) const;
  std::optional<std::size_t> size_of_list(std::string_view statement, std::int32_t id) const;
  std::optional<RoutineStatement> says(const Statement&, const WrittenArgument& call);

  const Dataset& dataset_;
  Catalogue catalogue_;
  RoutineDifferences differences_;
  Diagnostics& diagnostics_;
  std::vector<Library> libraries_;
  std::vector<std::string> folders_;
};

}  // namespace dynalin
