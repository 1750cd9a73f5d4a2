// Which compiled routines the statements of a dataset may call.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"

namespace dynalin {

struct RoutineOptions {
  std::vector<std::string> libraries{};  // shared libraries, or folders with those that ROUTINE= names
  bool differences = false;              // also in linear models, of routines that give no derivatives
  std::shared_ptr<RoutineData> data{};   // to be told of a model that calls none
};

// build_model of model.h calls none.
Parsed<std::unique_ptr<Model>> build_model(std::shared_ptr<const Dataset>, Catalogue, const BuildOptions&,
                                           const RoutineOptions&);

}  // namespace dynalin
