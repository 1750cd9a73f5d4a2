// What may stand next in a command that is being written: names of commands, their arguments, classes and ids.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dynalin {

struct Model;

// The words that the last one of `line`, which may be empty, can become, in the order of the manual; without a model
// there are no ids. A command that takes something has its slash.
std::vector<std::string> completions(std::string_view line, const Model*);

}  // namespace dynalin
