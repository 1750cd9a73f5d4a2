// How a routine is called, in the two ways of include/dynalin/user_routine.h.
#pragma once

#include "routine/compiled_routine.h"

namespace dynalin {

struct RoutineArgumentsNow {
  double time;
  int flag;  // dflag, or iord of a MOTION
  int iflag;
  int values;
};

void call_routine(const FoundRoutine&, const RoutineKind&, const RoutineStatement&, const RoutineArgumentsNow&,
                  double* values);

}  // namespace dynalin
