// Which constraint rows hold a motion. Rows that depend on others at one instant alone, as where all links of a
// parallelogram lie in one line, hold it before and behind: they are told from redundant ones a little ahead.
#pragma once

#include "system/system.h"

namespace dynalin {

// 1 for rows that are independent at the point or, if more of them are, a little later on its way.
std::vector<bool> rows_of_motion(const System&, const OperatingPoint&);
// Says so where a motion begins at such an instant: there is less to tell by which way it goes on than elsewhere.
void warn_of_change_point(const System&, const OperatingPoint& start, Diagnostics&);

}  // namespace dynalin
