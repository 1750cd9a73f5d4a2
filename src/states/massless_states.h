// Freedoms without mass among the chosen coordinates (analysis/massless.h): of each direction one coordinate loses its
// rate, and where stiffness alone holds the direction its position as well.
#pragma once

#include "analysis/massless.h"
#include "states/state_choice.h"

namespace dynalin {

struct MasslessStates {
  MasslessLimit limit;
  bool at_rest = false;         // all coefficients are constant, so that balances may be differentiated
  std::size_t first_order = 0;  // coordinates that keep their position alone
  Diagnostics remarks;
};

// Takes the states away and lists the others anew.
Result<void> take_massless_states(const System&, const ConstraintRows&, StateChoice&, MasslessStates&);

}  // namespace dynalin
