// Coordinates that follow bodies, in a model that goes on after edits or from a saved point. One whose element stands
// as it stood stays, to the last digit. One whose element is new here, or whose bodies, markers or curve have changed
// place or shape, is found again at the present poses: from its old value an assembly would move the bodies, too.
#pragma once

#include <optional>
#include <vector>

#include "system/operating_point.h"
#include "system/system.h"

namespace dynalin {

// By rows of the system: what each was where the coordinates come from, nothing for a row that was not there.
using RowsBefore = std::vector<std::optional<double>>;

bool has_followers(const Layout&);
void find_followers(const System&, const RowsBefore&, OperatingPoint&);

}  // namespace dynalin
