// How axes of two markers lie as drawn. Rows that ask two axes to be perpendicular cannot be met from a
// drawing in which the axes are parallel: there every turn leaves them as they are, to first order.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "elements/families/markers.h"
#include "elements/families/pair_row.h"

namespace dynalin {

// Reports the first such row of an element between I and J; `hint` is what the element's axes stand for.
void check_drawn_axes(const Model&, const ElementLabel&, MarkerId i, MarkerId j, std::span<const PairRow>,
                      std::string_view hint, Diagnostics&);

// Warns where the z axes of a torque between I and J are not parallel as drawn: it acts about that of J all the same.
void warn_of_skew_axes(const Model&, const ElementLabel&, MarkerId i, MarkerId j, Diagnostics&);

// Warns where the markers of a force along the line between them are drawn at one point.
void warn_of_missing_line(const Model&, const ElementLabel&, MarkerId i, MarkerId j, Diagnostics&);
// Why such a force has no value there.
std::string text_without_direction(const ElementLabel&);

}  // namespace dynalin
