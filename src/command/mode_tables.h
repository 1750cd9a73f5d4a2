// The tables that LINEAR/EIGENSOL asks for, mode by mode, as the text file of the run has them.
#pragma once

#include <string>

#include "command/linear_command.h"
#include "study/modal_tables.h"

namespace dynalin {

std::string mode_tables_text(const LinearCommand&, const EigenSolution&, const TablesFound&);

}  // namespace dynalin
