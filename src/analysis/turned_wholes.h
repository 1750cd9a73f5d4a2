// Steps of a search for rest turn flexible bodies of large rotations as wholes.
#pragma once

#include <Eigen/Core>

#include "system/system.h"

namespace dynalin {

// Moves what belongs to the wholes of the layout (TurningWhole) from one point to `to` along a displacement δq: as a
// rigid body by what is nearest to δq, which turns it by a finite rotation, and what is left of δq along with it. To
// first order that is δq; node by node a bar that turns would grow longer by half the square of the angle, against
// stiffness that is all but infinite beside what bends it.
void turn_wholes(const Layout&, const OperatingPoint& from, const Eigen::VectorXd& step, OperatingPoint& to);

}  // namespace dynalin
