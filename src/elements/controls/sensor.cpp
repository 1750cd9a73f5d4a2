// SENSOR/id, FUNCTION=, VALUE= [, ERROR=] [, EVALUATE=] …
//
// Watches an expression over time and stops or changes a simulation when it meets VALUE. SENVAL(id) reads what EVALUATE
// gave when the sensor last triggered, and 0 before that. No analysis here moves in time, so no sensor triggers: the
// statement is kept as text, and SENVAL is the constant 0 in every linear model.
#include "elements/families/kept_as_text.h"

namespace dynalin {

extern constinit const Kind sensor = kept_as_text(
    "SENSOR", "Stops or changes a simulation over time; never acts on a linear model.", Kind::Role::element);

}  // namespace dynalin
