// The routines that statements call: default names, how many values they give, which arguments they take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace dynalin {

enum class RoutineArguments : std::uint8_t {
  function,  // dflag, iflag
  of_time,   // iord, iflag
  plain,     // iflag
  counted,   // dflag, iflag, how many values
  system,    // of a whole GSE: states and inputs come with it
  field,     // displacement, velocity, dflag, iflag, force, its derivatives by both
  pressure,  // of a CONTACT: places, normals, gap with two rates, area, dflag, iflag
  coupler,   // displacements of joints, how many, iflag
  modal,     // of an MFORCE: dflag, iflag, modal loads, how many modes and loads, scale, which load, a load
  curve,     // order of the derivative, iflag, and no time; curve_routine.h
  damping,   // of a FLEX_BODY: frequencies, how many modes, step; damping_routine.h
  friction,  // of a CONTACT: places, deformation, slip, normal force, area, dflag, iflag
};

struct RoutineKind {
  std::string_view statement, routine;
  std::size_t values;  // 0: the statement says how many
  RoutineArguments arguments;
  std::string_view argument = "FUNCTION", names_routine = "ROUTINE";  // that call it, that name it
};

std::span<const RoutineKind> routine_kinds();
// Of a GSE, which has several: x′, outputs, discrete states behind a sample, the time between samples, and x′ with
// outputs in one.
struct StateEquationKinds {
  RoutineKind derivatives, outputs, update, sample, system;
};
const StateEquationKinds& state_equation_kinds();

}  // namespace dynalin
