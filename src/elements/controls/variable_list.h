// PINPUT, POUTPUT and PSTATE: an ordered list of VARIABLEs.
#pragma once

#include <memory>
#include <vector>

#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"

namespace dynalin {

struct VariableList {
  std::vector<VariableRef> variables;

  static constexpr std::array<Argument<VariableList>, 1> arguments = {{
      {.name = "VARIABLES", .slot = &VariableList::variables, .required = true, .help = "the VARIABLEs in order"},
  }};
};

class VariableListSet final : public TypedSet<VariableList> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    if (read_arguments(elements[k], reader)) warn_of_repeated(elements[k], reader);
  }

 private:
  static void warn_of_repeated(const VariableList&, ElementReader&);
};

inline constexpr ToldBeforehand told_of_variable_list = {
    .size = [](const StatementWords& s) { return known_size(s.integers("VARIABLES").size()); }};

constexpr Kind variable_list(std::string_view statement, std::string_view summary) {
  return Kind{statement,
              "",
              summary,
              Kind::Role::element,
              detail::argument_infos<VariableList>,
              [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<VariableListSet>(kind); }}
      .telling(told_of_variable_list);
}

}  // namespace dynalin
