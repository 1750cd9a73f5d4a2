// Parts that accelerate or turn where the model is linearized: the linear model holds for this instant alone.
#pragma once

#include "linear/linear_system.h"

namespace dynalin {

// Adds one warning, at the part that moves most. A turn counts unless it is nothing beside the slowest mode that is not
// a structural zero; an acceleration of a body or of coordinates of its shape where the forces on them, those of its
// velocities among them, do not balance, within their own sizes or what their rounding explains, however stiff the
// model is, and only where a balance is farther away than coordinates are known: to the digits of a dataset, or to what
// an integration has left of its errors, as a part of the model's length. Of matrices alone there are no modes: a turn
// counts beside what gravity makes of the size of the model.
void motion_caution(const System&, const OperatingPoint&, const EigenSolution*, double left_by_integration,
                    Diagnostics&);

// A warning where the marker that coordinates are relative to moves or turns, in the same sizes: what comes out is seen
// from a moving frame.
void reference_caution(const System&, const OperatingPoint&, const EigenSolution*, MarkerId reference,
                       double left_by_integration, Diagnostics&);

}  // namespace dynalin
