// What LIST of a settings command prints: every setting with the value that holds now.
#pragma once

#include <string>
#include <string_view>

namespace dynalin {

class RunState;

// "Current EQUILIBRIUM settings are:" and a row for each.
std::string settings_list(std::string_view command, const RunState&);

}  // namespace dynalin
