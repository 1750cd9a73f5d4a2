// The compiled routines of one GSE, as its element takes them over: a function for each number that they give.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "expression/expression.h"
#include "expression/routine.h"

namespace dynalin {

struct StateEquations {
  std::vector<Expression> derivatives;  // x′, or with IMPLICIT what is zero
  std::vector<Expression> outputs;
  std::vector<Expression> update;        // discrete states behind a sample
  std::optional<Expression> period;      // time to the next sample, where a routine says so
  std::string update_name, period_name;  // "the routine gse_update of control.so"

  // What FUNCTION of the GSE is written as: an expression that reads all that the functions read, and that hands them
  // to the element. It is never evaluated.
  static Expression written(std::shared_ptr<const StateEquations>, const Span& at);
  // Null if the expression is none of those.
  static std::shared_ptr<const StateEquations> of(const Expression&);
};

}  // namespace dynalin
