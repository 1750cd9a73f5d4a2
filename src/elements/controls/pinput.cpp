// PINPUT/id, VARIABLES=
//
// The inputs u of a linear model, in order. While a state matrix is computed each VARIABLE keeps its value and what its
// own expression sees of the states is cut; a dependence that is cut is warned of.
#include "elements/controls/variable_list.h"

namespace dynalin {

extern constinit const Kind pinput =
    variable_list("PINPUT", "Plant inputs: columns of B and D.").giving(Kind::Gives::plant_inputs);

}  // namespace dynalin
