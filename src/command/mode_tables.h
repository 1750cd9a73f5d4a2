// The tables that LINEAR/EIGENSOL asks for, mode by mode, into the text file of the run.
#pragma once

#include <iosfwd>

#include "command/commands.h"
#include "linear/linear_system.h"

namespace dynalin {

// What cannot be computed is a failure that says why; nothing of it is written then.
Result<std::string> mode_tables(const LinearCommand&, const System&, const OperatingPoint&, const LinearSystem&,
                                const EigenSolution&);

}  // namespace dynalin
