// The rules between the arguments of LINEAR (LINEAR command, section 4, and those of Dynalin's own arguments).
#pragma once

#include "command/written_linear.h"

namespace dynalin {

constexpr std::array<std::string_view, 2> box_types = {"OPENBOX", "CLOSEDBOX"};

// ALL, or one or two mode numbers; empty if it is neither.
Integers modes_of_text(const std::string&);

// Reports every rule that is broken.
void check_linear(const WrittenLinear&, ElementReader&);

}  // namespace dynalin
