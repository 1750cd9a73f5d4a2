// A run that is under way: it takes the commands of a plan one at a time, and each has done its work when the next one
// comes. Runs from files and prompts differ in nothing else than when their commands are planned.
#pragma once

#include <chrono>
#include <ctime>
#include <iosfwd>

#include "command/planner.h"
#include "command/run_state.h"
#include "output/message_file.h"

namespace dynalin {

class LiveSession {
 public:
  // The plan goes on to grow where commands come one by one.
  LiveSession(const SessionOptions&, Planner&, std::ostream* terminal, std::ostream& out, std::ostream& err);

  RunPreferences preferences;  // of the next model

  // Runs what is planned and has not run yet; false when the run is over, after STOP or a failure.
  bool advance();
  // The same of a prompt, where a failure takes what was planned behind it along and the session goes on. Files that
  // are named appear at once.
  bool advance_at_prompt();
  // Puts all files under their names, tells of them, and has the exit status.
  int finish();
  // The model and point that a command would meet now, nothing before the first model.
  const RunState* state() const { return run_ ? &*run_ : nullptr; }

 private:
  // What reading has to say goes into the message file of the model that it is about, once there is one.
  void take_remarks_of_reading();
  void write_remarks_of_reading();
  bool begin_job();
  void close_job();
  RunFiles::Result add_growing_files();
  bool execute(std::size_t command);
  bool prepare(std::size_t command);
  bool enter_stage_of(std::size_t command);
  bool refuse(const char* why);
  bool goes_on_after_failure() const;
  void tell_of_files(const std::vector<std::string>&) const;

  const SessionOptions& options_;
  Planner& plan_;
  std::ostream* terminal_;
  std::ostream& out_;
  std::ostream& err_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const std::clock_t cpu_start_ = std::clock();
  JsonResults json_;
  RunFiles files_{plan_.inputs};
  std::unique_ptr<OutputFile> message_;  // the message file of run_
  std::optional<RunState> run_;
  std::size_t job_ = 0, next_ = 0;  // the job that run_ is of, and its next command
  RunEnding ending_ = RunEnding::finished;
  int status_ = done;
  bool written_ = true;
  std::vector<std::string> saved_;     // files of SAVE
  std::vector<Diagnostic> unwritten_;  // remarks of reading whose message file is not there yet
  Settings settings_;                  // of the job that was closed last
  OutputSettings output_;
  std::vector<Command> settings_done_;
  std::size_t told_ = 0;  // files that a prompt has told of
};

}  // namespace dynalin
