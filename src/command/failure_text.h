// What is said of a command that failed.
#pragma once

#include <string>

#include "system/operating_point.h"

namespace dynalin {

// All there is to say, a line for each detail.
std::string failure_text(const Failure&);
// The same with long accounts cut in the middle; they are whole in the file of that name.
std::string short_failure_text(const Failure&, const std::string& file);

}  // namespace dynalin
