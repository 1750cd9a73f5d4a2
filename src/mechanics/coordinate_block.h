// The coordinates by which marker frames are varied together: up to six that stand next to each other.
#pragma once

#include <algorithm>
#include <cstdint>

#include "mechanics/layout.h"
#include "mechanics/marker_frame.h"

namespace dynalin {

struct CoordinateBlock {
  enum class Kind : std::uint8_t {
    pose,             // δr, then δθ of a body, global axes
    modal,            // of a body that changes its shape
    curve_parameter,  // of a point of contact
  } kind = Kind::pose;
  BodyId body{};             // whose pose or modal coordinates
  std::int32_t column = -1;  // the first
  std::uint8_t count = 0;
  std::size_t first_shape = 0;  // of modal coordinates, among those of their body

  static constexpr std::size_t largest = 6;

  bool moves(const MarkerFrame& m) const {
    if (kind == Kind::curve_parameter) return m.curve && m.parameter == column;
    return m.place().body == body && (kind == Kind::pose || m.place().shapes);
  }
  friend bool operator==(const CoordinateBlock& a, const CoordinateBlock& b) { return a.column == b.column; }
};

// visit(const CoordinateBlock&): all that a marker depends on.
template <class Visit>
void for_each_coordinate_block(const MarkerFrame& m, const Layout& layout, Visit&& visit) {
  using Of = CoordinateBlock::Kind;
  const BodyBlock& body = layout.body(m.place().body);
  if (body.count > 0)
    visit(CoordinateBlock{Of::pose, m.place().body, body.offset, static_cast<std::uint8_t>(body.count)});
  if (const NodeShapes* shapes = m.place().shapes) {
    for (std::size_t first = 0; first < shapes->translation.size(); first += CoordinateBlock::largest) {
      const std::size_t count = std::min(CoordinateBlock::largest, shapes->translation.size() - first);
      visit(CoordinateBlock{Of::modal, m.place().body,
                            layout.body_coordinate_count + static_cast<std::int32_t>(shapes->first + first),
                            static_cast<std::uint8_t>(count), first});
    }
  }
  if (m.curve) visit(CoordinateBlock{Of::curve_parameter, m.place().body, m.parameter, 1});
}

}  // namespace dynalin
