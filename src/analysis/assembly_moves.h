// What assembly changes of a model as drawn, where that is worth a word: a misprinted marker moves parts, too.
#pragma once

#include "system/system.h"

namespace dynalin {

// Warns of constraints that do not hold as drawn, but for prescribed motions, and of coordinates that EXACT asks to
// keep and that are not kept. `assembled` is what was found from `drawn`.
void warn_of_moves(const System&, const OperatingPoint& drawn, const OperatingPoint& assembled, Diagnostics&);

}  // namespace dynalin
