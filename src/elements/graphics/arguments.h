// Rows of the tables of arguments that several types of GRAPHICS have.
#pragma once

#include <optional>
#include <string_view>

#include "model/schema.h"

namespace dynalin::drawing {

inline constexpr double most_segments = 3600;  // a tenth of a degree

template <class T, class V>
constexpr Argument<T> needed(std::string_view name, V T::*slot, std::string_view help) {
  return {.name = name, .slot = slot, .required = true, .help = help};
}
template <class T>
constexpr Argument<T> extent_of(std::string_view name, double T::*slot, std::string_view help) {
  return {.name = name, .slot = slot, .required = true, .unit = unit::length, .help = help};
}
template <class T>
constexpr Argument<T> unless_stated_zero(std::string_view name, double T::*slot, std::string_view help) {
  return {.name = name, .slot = slot, .unit = unit::length, .minimum = 0, .help = help};
}
template <class T>
constexpr Argument<T> turn_by(double T::*slot) {
  return {.name = "RANGLE", .slot = slot, .unit = unit::angle, .help = "angle from x on about z, a turn unless stated"};
}
template <class T>
constexpr Argument<T> segments_of(std::optional<std::int64_t> T::*slot) {
  return {.name = "SEG",
          .slot = slot,
          .minimum = 1,
          .help = "straight pieces around or along it, 20 unless stated",
          .maximum = most_segments};
}
template <class T>
constexpr Argument<T> lines_of_sides(std::optional<std::int64_t> T::*slot) {
  return {.name = "SIDES", .slot = slot, .minimum = 0, .help = "lines along the side: read, not drawn"};
}

}  // namespace dynalin::drawing
