// How a routine is called, in the two ways of include/dynalin/user_routine.h.
#pragma once

#include "routine/compiled_routine.h"

namespace dynalin {

struct RoutineArgumentsNow {
  double time;
  int flag;  // dflag, or iord of a MOTION
  int iflag;
  int values;
  std::span<const double> states = {}, inputs = {};  // of a whole GSE, whose values are x′ and behind it y
  // Of a FIELD: six numbers each, and 6 × 6 derivatives of the force by them, column by column.
  const double *displacement = nullptr, *velocity = nullptr;
  double *by_displacement = nullptr, *by_velocity = nullptr;
  const double* given = nullptr;  // of a CONTACT: given_inputs.h
  // Of an MFORCE, whose values here are a load of its own.
  double* scale = nullptr;
  int* load_case = nullptr;
};

void call_routine(const FoundRoutine&, const RoutineKind&, const RoutineStatement&, const RoutineArgumentsNow&,
                  double* values);
// One of those with partial derivatives of a GSE: a matrix column by column.
void call_state_partials(const FoundRoutine&, const RoutineStatement&, const RoutineArgumentsNow&, double* matrix);

}  // namespace dynalin
