// POUTPUT/id, VARIABLES=
//
// The outputs y of a linear model, in order. They may read displacements, velocities, accelerations, reactions, states
// and inputs.
#include "elements/controls/variable_list.h"

namespace dynalin {

extern constinit const Kind poutput =
    variable_list("POUTPUT", "Plant outputs: rows of C and D.").giving(Kind::Gives::plant_outputs);

}  // namespace dynalin
