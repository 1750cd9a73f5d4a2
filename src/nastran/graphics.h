// The shapes of a model in a deck: shells and lines between grids that ride on the bodies, without mass, and without
// strain, so that no eigenvalue knows of them.
#pragma once

#include <span>

#include "base/diagnostics.h"
#include "mechanics/motion.h"
#include "nastran/deck.h"
#include "nastran/export_options.h"
#include "nastran/ids.h"

namespace dynalin {
struct Model;
}

namespace dynalin::nastran {

// Adds shape_grids, shape_ties, shells, lines and shape_properties, with the bodies at `poses` (by BodyId).
// Deck::bodies must be there already: those of the model but ground, in its order, with their grids. What is left out
// is remarked.
//
// Every shape has grids of its own, tied to the grid of its body by one RBE2 a body, or fixed where it is on ground.
// Its faces are CQUAD4 and CTRIA3, its lines CROD, or PLOTEL with use_plotel; with use_wireframe each edge is one
// PLOTEL and nothing else is there. A line from body to body is always a PLOTEL, which is not stiff, and is left out
// where each body has a file of its own (style C). A spring and damper (SPDP) is a rigid half on either body, so that
// no joint is needed between its ends; style C has none of them.
void add_graphics(const Model&, std::span<const Pose> poses, const ExportOptions&, Ids&, Deck&, Diagnostics& remarks);

}  // namespace dynalin::nastran
