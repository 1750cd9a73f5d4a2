// Coordinates of the original implementation of LINEAR (LINEAR command, 5.1.12): the position of the mass centre and
// the 3-1-3 angles of the principal axes of inertia, both against the global axes. The frame of a body that they belong
// to is its principal body coordinate system, PBCS.
#pragma once

#include "states/candidates.h"

namespace dynalin {

// Principal axes of inertia in the BCS, right-handed. Of all such frames the one turned least from the axes along which
// the dataset gives the inertia; where inertias are equal, axes are free and come as close to those as they can.
Matrix3 principal_axes(const Body&);

// Whether 3-1-3 angles of a frame are (nearly) singular: its z axis is vertical, sin θ = 0.
bool euler_singular(const Vector& z_axis);

// Appends all bodies by id, each with X, Y, Z, ψ, θ, φ (a point mass with X, Y, Z). The gradient rows start at `row`;
// returns the row behind them.
std::int32_t add_principal_candidates(const System&, const Motion&, std::int32_t row, CandidateSet&);

}  // namespace dynalin
