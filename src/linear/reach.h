// Coordinates that move out of all proportion to the chosen ones.
#pragma once

#include <optional>

#include "linear/linear_system.h"

namespace dynalin {

// The chosen coordinate a unit of which, as it compares with the length of the model or a radian, moves some other one
// so many such units.
struct Disproportion {
  double times = 0;
  std::size_t state = 0;
  std::int32_t coordinate = -1;
};

// The largest above `least`. Without the reach of all states (LinearSystem::reach) it is searched for, by rows and
// columns in turn, and may be missed.
std::optional<Disproportion> largest_disproportion(const System&, const LinearSystem&, double least);

// A motion of the chosen coordinates in different shares, none of which any symmetry takes away: how far it moves all
// coordinates, the furthest by about the length of the model or a radian.
Eigen::VectorXd uneven_motion(const System&, const LinearSystem&);

}  // namespace dynalin
