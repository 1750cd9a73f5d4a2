// Words of a statement for those who tell them to its routine.
#pragma once

#include "model/called_routines.h"
#include "routine/statement_words.h"

namespace dynalin {

class CalledRoutines::Words final : public StatementWords {
 public:
  Words(const CalledRoutines& routines, const Statement& s, const RoutineConstants& constants)
      : routines_(routines), statement_(s), constants_(constants) {}

  int id() const override { return static_cast<int>(statement_.id.value_or(0)); }
  const RoutineConstants& constants() const override { return constants_; }
  bool has(std::string_view argument) const override { return routines_.argument(statement_, argument) != nullptr; }
  int integer(std::string_view argument) const override { return routines_.integer(statement_, argument); }
  std::vector<int> integers(std::string_view argument) const override {
    return routines_.integers(statement_, argument);
  }
  double real(std::string_view argument, std::size_t which) const override {
    const std::vector<double> all = reals(argument);
    return which < all.size() ? all[which] : 0;
  }
  std::vector<double> reals(std::string_view argument) const override { return routines_.reals(statement_, argument); }
  std::string text(std::string_view argument) const override { return routines_.text(statement_, argument); }
  std::string_view written(std::string_view argument) const override;
  std::optional<std::size_t> word_among(std::span<const std::string_view>) const override;
  int integer_of(std::string_view statement, int id, std::string_view argument) const override;
  bool slides(int joint) const override;

 private:
  const CalledRoutines& routines_;
  const Statement& statement_;
  const RoutineConstants& constants_;
};

}  // namespace dynalin
