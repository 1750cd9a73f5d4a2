// What a run is to do: its commands with the files that they name, each checked against the model that it will meet.
//
// A run from files is planned whole before anything happens. At a prompt each command is planned when it is given. What
// comes behind the RELOAD of a system that the run itself has yet to SAVE is checked as far as its grammar goes, and
// planned to the end (`resolve`) when its turn has come.
#pragma once

#include <deque>
#include <iosfwd>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "command/stages.h"
#include "output/destination.h"

namespace dynalin {

// The path of a file that may be named without its extension. A dot may be part of the name: car_0.2 is car_0.2.adm
// where there is no other.
std::string with_extension(const std::string& path, std::string_view extension);

class Planner {
 public:
  Planner(const SessionOptions& options, Statements statements) : options_(options), statements_(statements) {
    for (const std::string& library : options.user_libraries) inputs.add(library);
  }

  // Commands with those of the files that FILE/COMMAND names in their places, up to STOP; nothing of them is planned.
  std::vector<Command> expanded(CommandFile, const std::string& folder);

  // A model for what follows, whatever names it.
  struct Opening {
    std::string path, prefix;  // as files are opened; the prefix may be empty
    Span at;                   // nothing for the command line
    std::string folder, echo;  // of the command that names it, and the command itself
  };
  void open(const Opening&);
  void add(Command);
  // Edits wait for their neighbours; no more will come.
  void finish_edits();

  // Every file that SAVE was to write is there by now.
  void await_nothing();

  // The commands of a job from this one on whose model was not known, with the stage that it is at now.
  bool resolve(Job&, std::size_t first, std::optional<std::size_t> stage);

  std::deque<Job> jobs;
  Diagnostics diagnostics;
  std::vector<SourceRef> texts;  // that diagnostics point into
  InputFiles inputs;             // all that was read
  bool only_a_dataset = false;   // is named for the run, and no command file

  // The model of a stage that was let go, of the stage before and the edits from this command on.
  bool make_again(Job&, std::size_t first);

  // To take back what a command at a prompt has led to when it turns out to be wrong.
  struct Mark {
    std::size_t jobs, stages, commands;
  };
  Mark mark();
  void back_to(const Mark&);

 private:
  void expand(CommandFile&&, const std::string& folder, std::vector<std::string>& chain, std::vector<Command>& into);
  SourceRef read(const std::string& path, std::string& why);
  void add_reload(Command);
  bool load(Command&);  // what RELOAD names
  void begin_job(std::string prefix, std::string folder);
  bool finish_stage(Job&, std::optional<Job::Stage>);
  void let_go_of_one_before_last(Job&) const;
  void read_inputs(Command&);
  bool known() const { return known_ && !jobs.empty() && !jobs.back().stages.empty(); }
  Job& job() { return jobs.back(); }

  const SessionOptions& options_;
  Statements statements_;
  bool known_ = true;                  // the model that the next command meets
  bool sound_ = true;                  // and no error has kept it from being made
  bool missed_ = false;                // that no model is named has been said
  bool takes_back_ = false;            // what follows may turn out to be wrong, and then the models before it count
  std::vector<Command> edits_;         // that wait
  std::vector<Command> early_;         // that wait for a model
  std::vector<std::string> opening_;   // commands before one
  std::set<std::string> saved_files_;  // by commands so far
  std::set<std::string> own_files_;    // the same, and what was saved at a prompt before
};

// The whole run; every problem found goes to `err`, and then there is none.
std::optional<Planner> planned(const SessionOptions&, std::ostream& err);

}  // namespace dynalin
