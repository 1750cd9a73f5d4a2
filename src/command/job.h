// What a run is to do: the command file and the dataset it names, read and checked against each other.
#pragma once

#include <iosfwd>

#include "command/commands.h"
#include "command/session.h"
#include "model/model.h"

namespace dynalin {

// Everything a run needs, read and checked.
struct Job {
  CommandFile commands;
  std::shared_ptr<const Dataset> dataset;
  std::shared_ptr<const Model> model;
  std::string prefix;
  int xrf_digits = 0;  // decimals of the results file, 0 for none
  std::string folder;  // of the command file; files named in commands are relative to it
};

// Every problem found goes to `err`; then there is no job.
std::optional<Job> load_job(const SessionOptions&, std::ostream& err);

}  // namespace dynalin
