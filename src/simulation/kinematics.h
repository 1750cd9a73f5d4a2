// Kinematics over time: a model without degrees of freedom is led along what drives it.
//
// From one instant to the next the poses are predicted from velocities and accelerations and found by Newton's method
// to rounding; velocities, accelerations and reactions follow. A step is halved where the iteration does not converge,
// and where the new point is not on the branch of the old one: where displacements do not agree with the velocities at
// both ends, or the rows have changed their orientation. A change point is passed so along the branch that continues
// the motion, with a remark; what an output time that meets it hands out lies between the points on both sides. At a
// dead point, beyond which there is no position, the analysis ends with an error.
#pragma once

#include "simulation/dynamics.h"

namespace dynalin {

// Whether something follows from what happened before, or on the way: differential states but for the courses of
// motions, constraints on velocities, DELAYs, SENSORs. Kinematics is dynamics then, without a degree of freedom.
bool needs_integration(const System&);

// From a consistent point to the end of `times`, or to where the watch does not go on. The watch is called with the
// first point as well. Every point that is handed out is consistent on all levels.
Result<AdvancedPoint> advance_kinematics(const System&, OperatingPoint from, const KinematicsSettings&, const Course&);

}  // namespace dynalin
