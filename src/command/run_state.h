// The state of a run that commands work on, and where what they find goes.
#pragma once

#include <iosfwd>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "command/environment.h"
#include "command/job.h"
#include "command/remarks.h"
#include "command/run_files.h"
#include "command/step_files.h"
#include "dynalin/operating_state.h"
#include "simulation/simulation_step.h"

namespace dynalin {

// What goes on from one model of a run to the next, and from command to command.
struct RunPreferences {
  Environment environment = read_environment();
  bool ends_after_failure = false;  // SIMEXIT: whatever else is asked
  bool status_messages = true;      // the line that shows how far a command is
  bool iterations = false;          // EPRINT: in the message file
  bool at_prompt = false;
};

class RunState {
 public:
  // At the first model of the job, as drawn; nothing goes to the terminal of a quiet run.
  RunState(const SessionOptions&, const Job&, std::ostream* terminal, std::ostream& err, JsonResults&, RunFiles&);

  // What the dataset prints of the work of a solver.
  void take_printing() { preferences.iterations = settings.prints_iterations.value_or(preferences.iterations); }

  const SessionOptions& options;
  const Job& job;

  // Where the run is.
  std::string command;    // that which runs, as written
  std::string folder;     // that names of files in it are relative to
  std::size_t stage = 0;  // of the job
  StudyPoint point;       // with the system of its stage
  Settings settings;
  std::vector<Command> settings_done;  // since the dataset
  RunPreferences preferences;
  Environment& environment = preferences.environment;
  std::set<std::string> inactive;                        // elements that are out of the model, and have been said to be
  std::optional<IntegrationStatistics> last_simulation;  // and all of the job together
  IntegrationStatistics all_simulations;

  // Where what it finds goes.
  std::ostream* terminal;  // nothing in a quiet run
  std::ostream& err;
  std::ostream message{nullptr};  // into the message file, which grows as the run goes on
  std::ostringstream tables;      // of the file of modal tables
  JsonResults& json;
  Remarks remarks;
  StepFiles steps;  // that get every point that is shown
  ResultsFile* results() { return steps.results(); }
  RunFiles& files;
  std::vector<std::string> saved_files;  // that are under their names already

  // Where a line may show how far a command is, nothing where none is wanted.
  std::ostream* status_line() const { return preferences.status_messages ? terminal : nullptr; }
  const System& system() const { return *point.system; }
  const Units& units() const { return job.model().units; }
  double time() const { return point.values.time; }

  // A point whose levels agree up to the last one, unless it is one already.
  StudyResult<void> make_consistent(Level last = Level::acceleration);
  // A point that an analysis has found; it is not shown yet.
  void accept(FoundPoint);
  // What a simulation over time has cost.
  void count(const IntegrationStatistics&);
  // Lines for whoever asked: in the message file, on the terminal and in the JSON file.
  void print(const std::string& text);
  // A point in all files that have it, and on the terminal as far as it is wanted there; `values` is that of the state.
  void show(StepKind, const OperatingState&, const OperatingPoint& values);
  // Requests without a finite value are named once a run.
  void say_undefined_requests(const System&, const OperatingPoint&, const PointRequests&);
  // The point that a simulation has ended at; the files of steps have it already.
  void show_where_it_ended();
  bool halted = false;                     // by a SENSOR: no further command is run
  bool shown = false;                      // the point, where points are shown
  std::optional<std::size_t> inactive_of;  // the stage whose inactive elements have been said

 private:
  std::set<RequestName> undefined_requests_;
};

}  // namespace dynalin
