// PSTATE/id, VARIABLES=
//
// Coordinates wanted as states of the linear model, tried in order before the default ones. Each VARIABLE must be a
// smooth function of positions and time; constant and dependent ones are passed over and the list is completed by
// default coordinates.
#include "elements/controls/variable_list.h"

namespace dynalin {

extern constinit const Kind pstate = variable_list("PSTATE", "Coordinates of one's own for the linear model.");

}  // namespace dynalin
