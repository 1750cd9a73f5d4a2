// Commands that change the model: NAME/id, ARG=… defines arguments of a statement anew, ACTIVATE and DEACTIVATE take
// elements into the model and out of it. They change the statements, and a new model is made of these.
#pragma once

#include <span>

#include "model/kind.h"
#include "system/carry_over.h"

namespace dynalin {

// Classes of elements that ACTIVATE and DEACTIVATE take.
std::span<const std::string_view> switchable_classes();

struct EditedDataset {
  std::shared_ptr<const Dataset> dataset;
  Restated restated;  // elements whose start the commands state
};

// The dataset after the commands, which are statements of `written`. Everything that is wrong with the commands
// themselves is reported at its place; what their values lead to is found when the model is made.
EditedDataset edited(std::shared_ptr<const Dataset> base, std::shared_ptr<const Dataset> written,
                     std::span<const Statement* const> commands, Catalogue, Diagnostics&);

}  // namespace dynalin
