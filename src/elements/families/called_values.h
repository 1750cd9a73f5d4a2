// All values of a compiled routine, where a statement takes it over from the first.
#pragma once

#include <vector>

#include "expression/program.h"

namespace dynalin {

// `called` is the first value of a routine, and nothing else.
inline std::vector<Expression> values_of_routine(const Expression& called, std::size_t count) {
  const RoutineUse& use = called.program().routines().front();
  const AtomList inputs = called.atoms();
  std::vector<Expression> values;
  for (std::size_t v = 0; v < count; ++v)
    values.push_back(routine_expression({inputs.begin(), inputs.end()}, use.routine, v, called.at()));
  return values;
}

}  // namespace dynalin
