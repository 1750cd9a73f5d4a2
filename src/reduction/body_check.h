// Whether a FLEX_BODY takes a reduced body: what reads its file is asked.
#pragma once

#include <string>

#include "base/diagnostics.h"
#include "reduction/body_file.h"
#include "reduction/craig_bampton.h"

namespace dynalin::reduction {

// False after an error, which has the reason in the words of the reader of `file` and, where the matrices are the
// cause, the way out.
bool check_body(const BodyFile&, const Reduction&, const std::string& file, Diagnostics&);

}  // namespace dynalin::reduction
