// Functions of the language that yield or take vectors, and those that name a spline: the parser takes them apart into
// scalar nodes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "expression/function_text.h"

namespace dynalin {

// A vector of three atoms with the same arguments: DXYZ(i, j, k) is [DX, DY, DZ].
struct VectorAtom {
  std::string_view name;
  std::array<std::string_view, 3> components;
  FunctionText text;
  // The function that is its size, "" if that is constant, and which arguments that has.
  std::string_view size{};
  enum class SizeArguments : std::uint8_t { i_j, i_j_l } size_arguments = SizeArguments::i_j;
};
std::span<const VectorAtom> vector_atoms();
const VectorAtom* find_vector_atom(std::string_view upper_case_name);
// The one with that first component, nullptr if there is none.
const VectorAtom* vector_atom_of(std::string_view first_component);

struct SpecialFunction {
  enum class Kind : std::uint8_t {
    unit,         // UV(v)
    magnitude,    // MAG(v)
    transform,    // TRANS(v, i [, j])
    akispl,       // AKISPL(x, z, id [, derivative])
    cubspl,       // CUBSPL(x, z, id [, derivative])
    interp,       // INTERP(x, method, id [, derivative])
    curve,        // CURVE(parameter, derivative, component, id)
    spectrum,     // INVPSD(x, id, f0, f1, n, log, seed)
    orientation,  // ORIENT(system, component, i [, j])
  };
  std::string_view name;
  Kind kind;
  std::uint8_t minimum_arguments, maximum_arguments;
  FunctionText text;
  bool takes_vector() const { return kind == Kind::unit || kind == Kind::magnitude || kind == Kind::transform; }
};
std::span<const SpecialFunction> special_functions();
const SpecialFunction* find_special_function(std::string_view upper_case_name);

}  // namespace dynalin
