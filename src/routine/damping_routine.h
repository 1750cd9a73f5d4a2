// DMPSUB: how much of the critical damping the modes of a flexible body have.
#pragma once

#include <span>
#include <string>

#include "routine/routine_constants.h"
#include "routine/routine_library.h"

namespace dynalin {

class DampingRoutine {
 public:
  // `of` is the body, `parameters` are the constants of its USER(…).
  DampingRoutine(FoundRoutine, const ElementId& of, int id, const RoutineConstants& parameters);

  // By the frequencies of the modes in cycles per second, ascending. Says why there are no ratios: the routine's own
  // words, or that they change with time, as the damping of a body here does not.
  std::string ratios(std::span<const double> frequencies, std::span<double> out) const;
  const std::string& what() const { return what_; }  // "dmpsub of damping.so, called for FLEX_BODY/2"

 private:
  std::string call(double time, double step, std::span<const double> frequencies, std::span<double> out) const;

  FoundRoutine found_;
  std::string what_;
  int id_;
  RoutineConstants parameters_;
};

}  // namespace dynalin
