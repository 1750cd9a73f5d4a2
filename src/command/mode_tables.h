// The tables that LINEAR/EIGENSOL asks for, mode by mode, into the text file of the run.
#pragma once

#include <iosfwd>

#include "command/commands.h"
#include "study/linearization.h"

namespace dynalin {

// What cannot be computed is a failure that says why; nothing of it is written then.
StudyResult<std::string> mode_tables(const LinearCommand&, const Linearization&, const EigenSolution&);

}  // namespace dynalin
