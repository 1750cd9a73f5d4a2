// Diagnostics as plain values, with the places that their spans point at.
#pragma once

#include "base/diagnostics.h"
#include "dynalin/remark.h"

namespace dynalin {

Remark remark_of(const Diagnostic&);
std::vector<Remark> remarks_of(const Diagnostics&);

}  // namespace dynalin
