// Checks that every element between two markers needs.
#pragma once

#include <string>
#include <string_view>

#include "mechanics/path.h"
#include "model/model.h"

namespace dynalin {

struct PairRequirements {
  bool different_bodies = true;
  bool rotation_of_I = false;  // the element turns or holds the orientation of I's body
  bool rotation_of_J = false;
};

// Reports floating markers, markers on one body and torques on a POINT_MASS; false if anything was wrong.
bool check_pair(const Model&, const ElementLabel&, MarkerId i, MarkerId j, const PairRequirements&, Diagnostics&);

// Reports a floating marker as this argument of an element; false then.
bool check_fixed(const Model&, const ElementLabel&, MarkerId, std::string_view argument, Diagnostics&);
// The same of VM and WM of a body.
void check_velocity_axes(const Model&, const ElementLabel&, MarkerId vm, MarkerId wm, Diagnostics&);
// Reports that an element turns the body of a marker where that is a POINT_MASS; false then.
bool check_rotation(const Model&, const ElementLabel&, MarkerId, Diagnostics&);

// Where a marker stands in the BCS of its body as drawn: with the shape that a flexible body starts in.
Pose drawn_on_body(const Model&, MarkerId);
// I seen from J as drawn.
RelativeFrame<double> drawn_frame(const Model&, MarkerId i, MarkerId j);
// The same along a motion, without its rates.
inline RelativeFrame<double> pose_of(const RelativeFrame<Taylor>& I) {
  return {value(I.p), value(I.x), value(I.y), value(I.z)};
}

}  // namespace dynalin
