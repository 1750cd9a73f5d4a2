// A model of a run, the commands that work with it, and where their results go. A run has one of them, or several where
// FILE/MODEL names another model or RELOAD begins further output files.
#pragma once

#include <string>
#include <vector>

#include "base/shared_chain.h"
#include "command/commands.h"
#include "command/session.h"
#include "study/model_source.h"

namespace dynalin {

struct Job {
  std::vector<Command> commands;
  // The models of the job in order: that of the dataset, then one more for each group of commands that edit it, and
  // those that RELOAD/SYSTEM brings. Empty as long as the first of them is in a file that the run has yet to write.
  struct Stage : MadeModel {
    SharedChain<std::string> edits;  // all commands that have changed the dataset, as written
    bool anew = false;               // nothing of the stage before goes on in it

    // A model that was made to check commands against it, or that the run has left behind, is let go. Its commands make
    // it again of the stage before.
    bool is_there() const { return system != nullptr; }
    void let_go() { static_cast<MadeModel&>(*this) = {}; }
  };
  std::vector<Stage> stages;
  const Model& model() const { return *stages.front().model; }
  std::string title;  // of RELOAD; where it is empty that of the model counts
  const std::string& title_shown() const { return title.empty() ? model().title : title; }

  std::string prefix;                // of its output files
  int xrf_digits = 0;                // decimals of the results file, 0 for none
  std::vector<std::string> opening;  // commands that led to it, as written
  bool goes_on = false;              // with the settings of the job before: further files for its model
};

}  // namespace dynalin
