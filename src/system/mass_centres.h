// Where the mass centres of bodies are and how they move.
#pragma once

#include <vector>

#include "system/system.h"

namespace dynalin {

// Of each body by BodyId, from its origin along the axes of its BCS. That of a body with shapes moves in it as its
// modal coordinates do.
std::vector<Vec3<Taylor>> centres_in_bodies(const System&, const Motion&);
// The same places, global axes.
std::vector<Vec3<Taylor>> mass_centres(const System&, const Motion&);

}  // namespace dynalin
