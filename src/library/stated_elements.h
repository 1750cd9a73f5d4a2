// Statements given as values: written out as a dataset, so that they are read by the same tables, and messages show
// them.
#pragma once

#include "base/diagnostics.h"
#include "dataset/dataset.h"
#include "dynalin/statement.h"

namespace dynalin::library {

// Every value is one value of its argument, whatever its text holds: what would be read as more is reported.
Parsed<Dataset> dataset_of(const std::string& title, const std::vector<StatedElement>&);

}  // namespace dynalin::library
