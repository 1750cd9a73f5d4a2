// One argument of a statement or a command as others than its reader see it: what the manual prints of it, what may be
// replaced by a number, whose ids a prompt offers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dynalin {

// The dimension of a number, as text for the manual. Where there is an angle in it a number may be in degrees.
struct Unit {
  constexpr Unit() = default;
  constexpr Unit(const char* dimension) : text(dimension) {}
  constexpr Unit(std::string_view dimension, bool angle) : text(dimension), has_angle(angle) {}

  constexpr bool empty() const { return text.empty(); }
  friend constexpr bool operator==(const Unit&, const Unit&) = default;

  std::string_view text{};
  bool has_angle = false;
};

// What the value of an argument is.
enum class ValueKind : std::uint8_t {
  none,  // it has none, or any that is passed over
  number,
  vector,  // three numbers
  numbers,
  lists,  // of numbers, one with every time it is written
  integer,
  word,
  words,
  text,
  marker,   // the id of one
  body,     // the id of one, of the statement that the argument is called like
  element,  // the id of one
  elements,
  ids,
  expression,
  vector_expression,
  routine_call,
};

// What an argument says of the start of the body, state or value that its statement defines.
enum class StatedStart : std::uint8_t {
  nothing,
  place,          // where all of it begins
  value,          // a value of a state
  velocity,       // one component of a velocity
  velocity_axes,  // the axes along which all components of that of the mass centre are stated
  angular_axes,   // the same of the angular velocity
  alone,          // a thing of its own
};

struct ArgumentInfo {
  std::string_view name;
  bool required = false;
  bool is_flag = false;  // a bare keyword without value
  ValueKind value = ValueKind::none;
  Unit unit{};
  std::string_view help{};
  bool repeats = false;         // may be written several times
  bool value_optional = false;  // a bare keyword, or one with a value
  bool elsewhere = false;       // an argument of another type of the statement, known here so that it keeps its name
  std::string_view ids_of{};    // the statement whose ids it takes
  std::string_view ends{};      // arguments that go where a command states this one, blanks between: "ZG XG"
  StatedStart start = StatedStart::nothing;
  std::size_t count = 0;  // of numbers that it takes; 0 where that is open, and where it takes none
  // What its numbers are where it is not stated; nothing where that depends on other arguments.
  std::optional<double> unstated() const { return of_new ? std::optional(of_new()) : of_list; }
  double (*of_new)() = nullptr;     // of a plain number: what its member is made with
  std::optional<double> of_list{};  // of a list or vector: what its table says

  // What the manual and messages call its value: "real", "marker", "variables" …; empty where it has none.
  std::string value_text() const;
};

// Whether the value is a number or several, and nothing else.
bool takes_numbers(const ArgumentInfo&);
// Whether it may be a function or a word as well, and is a number where it is written so: CRATIO of a FLEX_BODY.
bool may_be_number(const ArgumentInfo&);

}  // namespace dynalin
