// Points of studies in files of SAVE (saved_file.h): what is written of one, and the point that comes of it in a model.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "output/saved_file.h"
#include "study/study_point.h"

namespace dynalin {

// The files that a model is made of besides its dataset, with fingerprints of what they hold now.
std::vector<SavedFile::Model::Further> files_of(const Model&);
// Of the text of a dataset, what has changed the model since, and these files.
std::string fingerprint_of(const Model&, std::string_view dataset, std::vector<std::string> changes);

// All that the file has of a point; TITLE, and the model with its settings, are for others to add.
SavedFile saved_study(const StudyPoint&, std::string fingerprint);

struct ReloadedPoint {
  StudyPoint point;     // consistent only in the model that was saved
  Diagnostics remarks;  // on what is not in both of them
};
// In the system of a model with that fingerprint; `name` is that of the file, for remarks.
ReloadedPoint reloaded(const SavedFile&, std::shared_ptr<const System>, std::string_view fingerprint,
                       std::string_view name);

}  // namespace dynalin
