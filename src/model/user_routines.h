// FUNCTION=USER(…) calls a routine that the user compiled. Shared libraries that are named for it are called; where
// none has the routine each call is an error, or a constant takes its place where the user asks for one.
#pragma once

#include <memory>
#include <vector>

#include "model/routine_options.h"

namespace dynalin {

struct DatasetWithRoutines {
  // The dataset itself if it calls no routine; else one whose calls are replaced, or reported as errors.
  std::shared_ptr<const Dataset> dataset;
  // An argument whose value stands in this text is a number: that of one of the functions.
  SourceRef calls;
  std::vector<Expression> functions;
  std::vector<std::string> files;        // of the libraries
  std::shared_ptr<RoutineData> data;     // of the model that its routines read; null without libraries
  std::vector<SourceRef> further_texts;  // that its statements and messages point into
};
DatasetWithRoutines with_user_routines(std::shared_ptr<const Dataset>, Catalogue, const BuildOptions&,
                                       const RoutineOptions&, Diagnostics&);

}  // namespace dynalin
