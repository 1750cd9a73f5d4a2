// FUNCTION=USER(…) calls a routine that the user compiled into another program. None can be called here: each call is
// an error, or a constant takes its place where the user asks for one.
#pragma once

#include <memory>
#include <optional>

#include "model/kind.h"

namespace dynalin {

// The dataset itself if it calls no routine; else one whose calls are replaced by `value`, each with a warning, or
// reported as errors.
std::shared_ptr<const Dataset> without_user_routines(std::shared_ptr<const Dataset>, Catalogue,
                                                     const std::optional<double>& value, Diagnostics&);

}  // namespace dynalin
