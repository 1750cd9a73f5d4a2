// What others ask of FE_PART statements. Each node is a body of the model with the label of its FE_PART: the first has
// the place that the statement has among bodies, the others stand behind those of all statements. Mass and inertia of
// these Bodies are what each node stands for, a scale for those who compare; the beam itself has the inertia and tells
// it to others (elements/families/nodal_body.h).
#pragma once

#include <vector>

#include "elements/families/beam_place.h"
#include "model/model.h"

namespace dynalin {

// All of the model, without the places of their coordinates outside poses.
std::vector<BeamBody> beam_bodies(const Model&);
// The same with them, when the layout has all coordinates.
std::vector<BeamBody> beam_bodies(const Model&, const Layout&);
}  // namespace dynalin
