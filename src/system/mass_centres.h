// Where the mass centres of bodies are and how they move.
#pragma once

#include <vector>

#include "system/system.h"

namespace dynalin {

// Of each body, by BodyId, global axes: of a rigid one CM, of a flexible one A c/I1 with c of flexible_body.h, which
// moves in the body as its modal coordinates do.
std::vector<Vec3<Taylor>> mass_centres(const System&, const Motion&);

}  // namespace dynalin
