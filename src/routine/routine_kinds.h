// The routines that a statement calls, as the Kind of its element says: default names, how many values they give, which
// arguments they take, and what they are told of the statement.
#pragma once

#include <array>
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

// An argument that takes a value, or a constant in the place of one: so many numbers, or so many zeros.
struct ValueArgument {
  std::string_view name;
  std::size_t numbers = 1;
  bool zero = false;
};
// Of most statements.
inline constexpr std::array<ValueArgument, 1> value_of_function = {{{"FUNCTION"}}};

class StatementWords;
struct ToldToRoutine;

struct RoutineKind {
  std::string_view routine;  // its default name
  std::size_t values;        // 0: the statement says how many
  RoutineArguments arguments;
  ToldToRoutine (*told)(const StatementWords&) = nullptr;  // statement_words.h; null where a class of its own tells it
  std::string_view argument = "FUNCTION", names_routine = "ROUTINE";  // that call it, that name it
  std::span<const ValueArgument> components{};  // that take its values one by one; none: the argument itself has all
  std::span<const ValueArgument> constants{};   // that a constant can take the place of
  bool sampled = false;                         // called once in a while: nobody asks for its derivatives
};

// The order of the routines of a GSE among those of its Kind: x′, outputs, discrete states behind a sample, the time
// between samples, and x′ with outputs in one.
enum class StateRoutine : std::uint8_t { derivatives, outputs, update, sample, system };

}  // namespace dynalin
