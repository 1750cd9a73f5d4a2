// Where two solids are nearest to each other, or deepest in each other: gap, direction and place as functions of how
// one stands to the other. Formulas are written once for plain numbers and for duals; where a place has to be searched
// for, the converged one is differentiated by the implicit function theorem: one step of Newton's method on duals.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "geometry/solid.h"
#include "mechanics/path.h"

namespace dynalin {

// One place where two sides may touch.
template <class T>
struct Touch {
  T gap{};         // along the normal from surface to surface, negative where they overlap [length]
  Vec3<T> normal;  // unit vector out of J towards I, in the axes of J
  Vec3<T> point;   // half-way between both surfaces, from the origin of J in its axes
  double inside = std::numeric_limits<double>::infinity();  // how far from the edge of a plane, negative beyond it
  bool defined = true;  // false: the place is not determined, a whole circle is as near
  double seam = std::numeric_limits<double>::infinity();  // how far from where a face ends in an edge
  T weight{1.0};  // of its force: less than 1 where places share what one has next to here, or count against others

  bool closed() const { return value_of(gap) < 0 && inside >= 0; }
};

// Most of all are those of the corners of a box with the walls of another that it is in; but facets may have more.
inline constexpr std::size_t most_touches_in_space = 48;

// As many as the two sides have, whatever their positions; 0 where contact between them has no formula here.
std::size_t touch_count(const solid::Side& I, const solid::Side& J);
// Both axes are those of the shapes. T is double or Dual<12>.
template <class T>
void find_touches(const solid::Side& I, const solid::Side& J, const RelativeFrame<T>& I_from_J, std::span<Touch<T>>);

extern template void find_touches(const solid::Side&, const solid::Side&, const RelativeFrame<double>&,
                                  std::span<Touch<double>>);
extern template void find_touches(const solid::Side&, const solid::Side&, const RelativeFrame<Dual<12>>&,
                                  std::span<Touch<Dual<12>>>);

}  // namespace dynalin
