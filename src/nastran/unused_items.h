// remove_unused_items: what a deck has and nothing needs.
#pragma once

#include <string>
#include <vector>

#include "nastran/deck.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

// Takes out bushes without stiffness and damping, and grids that nothing but a rigid element has, as far as it is asked
// for. A line of
// `details` for each kind.
void remove_unused(Deck&, const ExportOptions&, std::vector<std::string>& details);

}  // namespace dynalin::nastran
