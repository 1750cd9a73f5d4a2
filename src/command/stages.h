// Models made of datasets, of edits and of saved systems, with their equations. What is wrong is reported, and then
// there is none.
#pragma once

#include <span>

#include "command/job.h"
#include "output/saved_file.h"

namespace dynalin {

// Whether the statements of a dataset are needed when its model is made: for edits, for lists of them, for SAVE.
enum class Statements : bool { released, kept };

std::optional<Job::Stage> stage_of_dataset(SourceRef, const SessionOptions&, Statements, Diagnostics&);
// Neighbouring commands make one model together, whose statements point into theirs: the commands have to outlive it.
std::optional<Job::Stage> edited_stage(const Job::Stage& from, std::span<const Command> edits, const SessionOptions&,
                                       Diagnostics&);
// `name` is that of the file, for messages; they point into the texts that are added.
std::optional<Job::Stage> saved_stage(const SavedFile::Model&, const std::string& name, const SessionOptions&,
                                      std::vector<SourceRef>& texts, Diagnostics&);

}  // namespace dynalin
