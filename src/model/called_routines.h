// Calls of compiled routines by statements of a dataset: what the statement says to its routine, and the functions that
// its values are.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/kind_finder.h"
#include "model/routine_options.h"
#include "routine/compiled_routine.h"
#include "routine/curve_routine.h"
#include "routine/routine_data.h"
#include "routine/state_equations.h"

namespace dynalin {

// USER(…) and nothing else, or the beginning of it.
bool calls_routine(const WrittenArgument&);

// Those that a statement calls, none if it calls none.
std::span<const RoutineKind> routines_of(Catalogue, std::string_view statement);

// In which words it names code, of which so many letters are written at least.
inline constexpr std::size_t fewest_letters_of_code = 4;
std::vector<std::string_view> names_of_code(std::span<const RoutineKind>);

// What stands behind the parenthesis that closes USER(…), null if nothing does.
const Token* behind_call(const WrittenArgument&);

class CalledRoutines {
 public:
  // Loads the libraries; those that cannot be are errors.
  CalledRoutines(const Dataset&, Catalogue, const RoutineOptions&, Diagnostics&);

  // To be filled when the model is read; null without libraries.
  std::shared_ptr<RoutineData> data() const { return data_; }
  bool has_libraries() const { return !libraries_.empty() || !folders_.empty(); }
  // Whether one that was named cannot be loaded, which is reported: what it should have is not missing as well.
  bool lacks_library() const { return lacks_library_; }
  // The routine that the statement calls, null if no library has it (`wanted` says what was looked for) or after an
  // error.
  std::shared_ptr<const CompiledRoutine> find(const Statement&, const WrittenArgument& call, std::string& wanted);
  // The same of CRATIO of a FLEX_BODY and FUNCTION of a CURVE; it is kept with the data, for whoever reads the
  // statement. Whether there is one.
  bool keep_apart(const Statement&, const WrittenArgument& call, std::string& wanted);
  // Whether an argument calls one of those.
  bool is_kept_apart(const Statement&, const WrittenArgument&) const;
  // The routines of a GSE, null after an error. `call` is null where INTERFACE stands without USER(…).
  std::shared_ptr<const StateEquations> find_state_equations(const Statement&, const WrittenArgument* call);
  // Its functions in the words of the statement.
  std::string written(std::shared_ptr<const StateEquations>, const Span& at);
  // Value by value of a routine, in the words of the statement: FX=3, FY=4 … by numbers of functions.
  std::string written(const Statement&, const WrittenArgument& call, std::shared_ptr<const CompiledRoutine>);
  // Of an argument that may be abbreviated.
  std::string_view full_name(const Statement&, const WrittenArgument&) const;
  // Whether an argument names code: a routine, the library that has it.
  bool names_code(const Statement&, const WrittenArgument&) const;
  // Of the argument that calls it, null if the statement calls none; most have one such argument alone.
  const RoutineKind* kind_for(const Statement&, std::string_view argument) const;
  // The written argument of that full name, null if there is none.
  const WrittenArgument* argument(const Statement&, std::string_view name) const;

  std::vector<Expression> functions;
  std::vector<std::string> files;  // the libraries that were loaded

 private:
  using Library = std::shared_ptr<const RoutineLibrary>;
  std::vector<Library> libraries_named(std::string_view name);
  int integer(const Statement&, std::string_view name) const;
  std::vector<int> integers(const Statement&, std::string_view name) const;
  // Those of the dataset by statement and id; null where there is none.
  const Statement* statement(std::string_view name, std::int64_t id) const;
  // The kind of such statements, where it says something of them before they are read.
  const Kind* kind_told_of(std::string_view statement) const;
  template <class Tell>
  void for_each_told(const Tell&) const;
  std::optional<std::size_t> size_of_list(std::string_view statement, std::int32_t id) const;
  // Null where there is no such flexible body, or something is wrong with one.
  const RoutineData::Modes* modes_of(std::int64_t flex_body) const;
  std::shared_ptr<const std::vector<int>> constant_arrays() const;
  std::shared_ptr<RoutineData> ids_of_data() const;
  std::optional<RoutineStatement> says(const Statement&, const WrittenArgument* call, const RoutineKind&);
  std::optional<std::vector<double>> constants_of(const WrittenArgument& call, const ElementId&);

  FoundRoutine called_by(const Statement&, const RoutineKind&, std::string& wanted, StatePartialRoutines&);
  // "friction::slip", "slip", "friction::" or "" (the default name) in what libraries it may stand in.
  FoundRoutine find_named(std::string_view written, std::span<const std::string_view> default_names);
  StatePartialRoutines routines_beside(std::string& text);
  class Words;
  std::vector<double> reals(const Statement&, std::string_view name) const;
  double real(const Statement&, std::string_view name) const;  // the first; 0 where there is none
  std::string text(const Statement&, std::string_view name) const;
  std::shared_ptr<const RoutineStatement::ModalLoad> modal_load_of(const Statement&, bool scaled) const;
  CurveStatement curve_of(const Statement&, const RoutineStatement&) const;
  std::shared_ptr<const CompiledRoutine> made(const Statement&, const Span& at, FoundRoutine, const RoutineKind&,
                                              std::size_t values, RoutineStatement, StatePartialRoutines = {});
  class StateCalls;

  // What is looked up by statement and id, made when something is.
  struct Index {
    using Key = std::pair<std::string_view, std::int64_t>;
    std::map<Key, const Statement*> statements;
    std::map<Key, std::optional<std::size_t>> filled;  // lists that other statements give, and how long they are
  };
  const Index& index() const;

  const Dataset& dataset_;
  Catalogue catalogue_;
  KindFinder finder_;
  std::map<std::string_view, const Kind*> told_;
  RoutineDifferences differences_;
  Diagnostics& diagnostics_;
  std::vector<Library> libraries_;
  bool lacks_library_ = false;
  std::vector<std::string> folders_;
  std::shared_ptr<const std::vector<int>> constant_arrays_;
  std::shared_ptr<RoutineData> data_;
  mutable std::unique_ptr<Index> index_;
  mutable std::shared_ptr<RoutineData> bodies_;  // what is known of modes beforehand, once that was asked for
};

}  // namespace dynalin
