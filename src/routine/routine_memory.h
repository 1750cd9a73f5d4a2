// The last call of a compiled routine in this thread, which the sources of CompiledRoutine share.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "routine/compiled_routine.h"
#include "routine/routine_findings.h"

namespace dynalin {

inline constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();
inline constexpr double linear_mode = 7;  // of the function MODE

// Components of a force follow each other, and each asks for all values again: the last call is remembered.
struct CompiledRoutine::Memory {
  std::uint64_t serial = 0;
  bool has_partials = false;
  RoutineFindings findings;                      // of its partial derivatives
  std::vector<double> inputs, values, partials;  // partials: [value * inputs + input]
  std::vector<char> given;
};

// The same along the motion.
struct CompiledRoutine::CourseMemory {
  std::uint64_t serial = 0;
  RoutineFindings findings;    // of its partial derivatives
  std::vector<double> inputs;  // [3 input + derivative]
  std::vector<Taylor> values, partials;
};

}  // namespace dynalin
