// Writes a flexible body as a modal text file, in records 1, 2, 5 to 10, 12 and 14 to 18.
#pragma once

#include <iosfwd>

#include "reduction/body_file.h"

namespace dynalin::reduction {

// Seventeen digits, so that what is read is what was written.
void write_body_file(std::ostream&, const BodyFile&);

}  // namespace dynalin::reduction
