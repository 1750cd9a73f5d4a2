// The GRAPHICS that a CONTACT names: its lists, the shapes behind them and where these stand, and whether all of one
// side can touch all of the other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "elements/families/contact_force.h"
#include "model/schema.h"

namespace dynalin {

// A GRAPHICS of one side, and where the CONTACT names it.
struct ListedShape {
  std::int64_t id;
  ElementHandle graphics;
  Span at;
  bool reversed = false;
};
using ContactSides = std::array<std::vector<ListedShape>, 2>;  // of I and of J

// IGEOM and JGEOM with what is turned inside out of them; a side is empty after an error.
ContactSides read_sides(ElementReader&);
// All shapes of both sides, each in the axes of the marker of the first one of its side; false after an error, here or
// where they stand.
bool place_sides(const Model&, const ElementLabel& contact, const ContactSides&, ContactForce&, Diagnostics&);

}  // namespace dynalin
