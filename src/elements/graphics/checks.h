// What arguments of several types of GRAPHICS have in common.
#pragma once

#include <optional>

#include "elements/graphics/canvas.h"
#include "geometry/revolution.h"
#include "model/reader.h"

namespace dynalin::drawing {

// Errors at the argument, which is passed over where it is not given: that is reported already.
void demand_positive(ElementReader&, std::string_view name, double);
void demand_not_zero(ElementReader&, std::string_view name, double);
// RANGLE: not zero, at most one turn either way.
void demand_angle(ElementReader&, double);

// The markers that an argument lists, each with an error at its place where it does not exist.
std::vector<MarkerId> listed_markers(ElementReader&, std::string_view name);

inline std::size_t pieces(const std::optional<std::int64_t>& stated) {
  constexpr std::size_t unstated = 20;
  return stated ? static_cast<std::size_t>(*stated) : unstated;
}
inline Sweep sweep_of(double angle, const std::optional<std::int64_t>& segments) {
  return {.angle = angle, .start = 0, .segments = pieces(segments)};
}

}  // namespace dynalin::drawing
