// What the law of an element says in axes of its own, noted beside its partials (element_trace.h): turned into those of
// the ground a soft direction would be lost in the rounding of a stiff one.
#pragma once

#include <array>

#include "mechanics/pair.h"

namespace dynalin {

// The lengths that displacements of one marker from the other are differences of.
double lengths_of_places(const PairMotion&);
// Up to what a force is nothing: what rounding of displacements (`of_length` each, in sum) leaves of their stiffness
// times them, but for one that is stated to be something as small.
double rounding_of_force(double stiffness_times_lengths, double stated);

// Of the element that is being noted. Forces and torques up to `rounding` are nothing.
void note_law(const PairMotion&, const RelativeWrench&, const std::array<double, 6>& rounding, const Layout&,
              ElementTrace&);
// The same of a force along the line between the markers, along that and across.
void note_line(const PairMotion&, const LineMagnitude&, double rounding, const Layout&, ElementTrace&);

}  // namespace dynalin
