#pragma once

#include <array>

#include "base/vec3.h"

namespace dynalin {

// Yaw, pitch and roll [rad] of an orientation, as the functions YAW, PITCH and ROLL count them: yaw about z, pitch
// about the −y that it leads to, roll about the x of both. Where x is vertical only yaw ± roll is determined: it is all
// yaw.
std::array<double, 3> yaw_pitch_roll(const Matrix3& R);

}  // namespace dynalin
