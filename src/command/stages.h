// Models made of datasets, of edits and of saved systems, with their equations. What is wrong is reported, and then
// there is none.
#pragma once

#include <span>

#include "command/job.h"
#include "output/saved_file.h"
#include "study/model_source.h"

namespace dynalin {

ModelOptions model_options(const SessionOptions&);

// `texts` keeps the files that were read for the model, which messages point into even where there is none.
std::optional<Job::Stage> stage_of_dataset(SourceRef, const SessionOptions&, Statements, std::vector<SourceRef>& texts,
                                           Diagnostics&);
// The files that the model of a stage has read, which messages may point into when it is gone.
void keep_texts(const Job::Stage&, std::vector<SourceRef>& texts);
// Neighbouring commands make one model together, whose statements point into theirs: the commands have to outlive it.
std::optional<Job::Stage> edited_stage(const Job::Stage& from, std::span<const Command> edits, const SessionOptions&,
                                       std::vector<SourceRef>& texts, Diagnostics&);
// Of the dataset, its edits and the files that it is made of besides.
std::string fingerprint_of(const Job::Stage&);
// `name` is that of the file, for messages; they point into the texts that are added.
std::optional<Job::Stage> saved_stage(const SavedFile::Model&, const std::string& name, const SessionOptions&,
                                      std::vector<SourceRef>& texts, Diagnostics&);

}  // namespace dynalin
