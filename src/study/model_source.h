// Models made of datasets, and of edits of their statements, with the equations that show what is wrong with a model
// that can be read.
#pragma once

#include <memory>
#include <optional>

#include "model/dataset_edits.h"
#include "model/routine_options.h"
#include "system/system.h"

namespace dynalin {

// How statements are understood.
struct ModelOptions {
  std::optional<double> user_value{};  // what takes the place of compiled routines
  RoutineOptions routines{};
  bool pade = false;  // a DELAY as a Padé approximant with a state of its own
};

// Whether the statements of a dataset are needed when its model is made: for edits, for lists of them, for SAVE.
enum class Statements : bool { released, kept };

// A model and what it is made of.
struct MadeModel {
  std::shared_ptr<const Dataset> dataset{};
  std::shared_ptr<const Model> model{};    // there in any case: what is wrong with it points into its texts
  std::shared_ptr<const System> system{};  // none where something is wrong
  Restated restated{};                     // elements whose start an edit states
  // What reading its statements, and those of the models that it came out of, has warned of; texts of models that may
  // be gone by now stay for it.
  Diagnostics warned{};
  std::vector<SourceRef> warned_in{};
};

Parsed<MadeModel> made_model(Parsed<Dataset>, Statements, const ModelOptions&);
// Says what is wrong with the edit and with the model that comes out of it; of warnings those that are new. An edit
// that changes nothing leaves the model as it is.
Parsed<MadeModel> edited_model(const MadeModel& before, Parsed<EditedDataset>, const ModelOptions&);

// Says the same at another place.
Diagnostic& repeat(const Diagnostic&, const Span& at, Diagnostics& to);

}  // namespace dynalin
