// What a run is to do: the command file and the dataset it names, read and checked against each other.
#pragma once

#include <iosfwd>
#include <optional>

#include "command/commands.h"
#include "command/session.h"
#include "model/model.h"

namespace dynalin {

// Everything a run needs, read and checked.
struct Job {
  CommandFile commands;
  // The models of the run in order: that of the dataset, then one more for each group of commands that edit it.
  struct Stage {
    std::shared_ptr<const Dataset> dataset;
    std::shared_ptr<const Model> model;
    Restated restated;  // elements whose start the edits state
  };
  std::vector<Stage> stages;
  const Model& model() const { return *stages.front().model; }
  std::string prefix;
  int xrf_digits = 0;              // decimals of the results file, 0 for none
  bool from_command_line = false;  // the commands
  // Names are relative to where they are written: in a command file to its folder, on the command line to the current
  // one, which is empty here.
  std::string folder;
  Diagnostics warnings;            // of reading
  std::vector<SourceRef> sources;  // that were read
};

// Every problem found goes to `err`; then there is no job.
std::optional<Job> load_job(const SessionOptions&, std::ostream& err);

}  // namespace dynalin
