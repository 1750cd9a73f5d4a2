// The mathematical and general functions of the language: SIN, STEP, IMPACT …
//
// Each function is one formula, written once over the scalar type; its derivatives come from the
// scalar.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/dual.h"
#include "base/time_taylor.h"
#include "expression/function_text.h"
#include "expression/switch_list.h"

namespace dynalin {

// Arguments differentiated in one pass. Functions with more variable arguments take several passes.
inline constexpr std::size_t seeds_per_pass = 4;
using Seeded = Dual<seeds_per_pass>;

// What an exactly zero partial derivative means. With `flat` the function does not depend on that
// argument anywhere near (STEP before its start), so that even an infinite outer derivative
// contributes nothing. With `stationary` it may be a mere coincidence (COS at 0), and infinity
// times zero stays undefined.
enum class ZeroPartial : std::uint8_t { stationary, flat };

struct Function {
  std::string_view name;
  std::uint8_t minimum_arguments;
  std::uint8_t maximum_arguments;
  ZeroPartial zero_partial;
  FunctionText text;

  // The formula on each scalar in use.
  double (*on_double)(std::span<const double>);
  TimeTaylor<double> (*on_taylor)(std::span<const TimeTaylor<double>>);
  Seeded (*on_seeded)(std::span<const Seeded>);
  TimeTaylor<Seeded> (*on_seeded_taylor)(std::span<const TimeTaylor<Seeded>>);

  // Says why there is no finite value at these arguments, "SQRT of -3"; empty if that is not known.
  // An argument that is NaN is not known yet and never a reason.
  std::string (*domain)(std::span<const double>);

  // Adds what changes sign where the function has a kink or a jump, a number of functions that the number of arguments
  // decides; null where it is smooth.
  void (*switches)(std::span<const double>, SwitchList&) = nullptr;

  bool kinked = false;            // has kinks or jumps, whatever its arguments
  bool flat_at_kinks = false;     // of one of them: it is continuous there, and its slope counts as zero
  double growth_at_infinity = 0;  // the order in which it grows where its slope is infinite, 0 if that is not known
  bool of_vector = false;         // its arguments are components; messages show the call as it is written
  // The size of a vector: where that is zero it grows in every direction. Its slope counts as zero there, which is the
  // mean over all of them, but along a motion, as constraints need it, it is not defined.
  bool is_size = false;

  double operator()(std::span<const double> a) const { return on_double(a); }
  TimeTaylor<double> operator()(std::span<const TimeTaylor<double>> a) const { return on_taylor(a); }
  Seeded operator()(std::span<const Seeded> a) const { return on_seeded(a); }
  TimeTaylor<Seeded> operator()(std::span<const TimeTaylor<Seeded>> a) const { return on_seeded_taylor(a); }
};

// The longest argument list: FORCOS(x, x0, w, a0, …, a30).
inline constexpr std::size_t most_arguments = 34;

std::span<const Function> elementary_functions();  // ABS … SIGN
std::span<const Function> contact_functions();     // STEP, IMPACT and what else is made of pieces
std::span<const Function> series_functions();      // POLY … SWEEP

struct NamedConstant {
  std::string_view name;
  double value;
  FunctionText text;
};
std::span<const NamedConstant> named_constants();

// The one of that upper-case name, nullptr if there is none.
const Function* find_function(std::string_view name);
// Whether the function of that name has kinks or jumps, whatever its arguments: IF and those marked so.
bool has_kinks(std::string_view name);
// The operator ** with an exponent that varies.
const Function& variable_power();
// MAG of a vector of three components, and the first component of its UV.
const Function& vector_size();
const Function& vector_direction();

// Upper-case names that the language knows and this program does not evaluate yet.
std::span<const std::string_view> functions_not_built();
// Those of them that stand without parentheses.
std::span<const std::string_view> names_not_built();

}  // namespace dynalin
