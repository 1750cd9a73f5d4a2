// Values of function expressions at a point, of which the model knows nothing.
#pragma once

#include <span>
#include <string>

#include "study/model_source.h"
#include "study/study_point.h"

namespace dynalin {

// `statements` are those of the model, with their arguments. Where the point is not consistent the values are those of
// the one that agrees with the constraints; the point itself stays.
StudyResult<std::vector<double>> measured(const StudyPoint&, const std::shared_ptr<const Dataset>& statements,
                                          std::span<const std::string> functions, const ModelOptions& = {});

}  // namespace dynalin
