// What the message file says of flexible bodies before anything is computed: a wrong unit shows in mass or frequencies.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace dynalin {

// "FLEX_BODY/2: mass 4.2, 8 modes from 12.3 to 812 cycles/s", a line for each; frequencies with the BCS held.
std::vector<std::string> flexible_body_lines(const Model&);

}  // namespace dynalin
