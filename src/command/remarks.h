// What a run has to say beside its results: on the terminal, in the message file and in the JSON file.
#pragma once

#include <iosfwd>
#include <set>
#include <string>
#include <vector>

#include "analysis/initial.h"
#include "output/json.h"

namespace dynalin {

class Remarks {
 public:
  // A failure that is long on the terminal refers to the message file.
  Remarks(std::ostream& err, std::ostream& message, JsonResults& json, std::string message_file)
      : err_(err), message_(message), json_(json), message_file_(std::move(message_file)) {}

  // What is said from now on belongs to this command.
  void begin(std::string command) { command_ = std::move(command); }
  void say(const Diagnostic&);
  void say(const Diagnostics&);
  void say(std::string_view code, std::string text);
  // Settings that nothing acts on are named once a run.
  void pass_over(const std::vector<std::string>& settings);
  void passed_over_already(const std::vector<std::string>& settings) {
    passed_over_.insert(settings.begin(), settings.end());
  }
  void report(const Failure&);

 private:
  std::ostream& err_;
  std::ostream& message_;
  JsonResults& json_;
  std::string message_file_, command_;
  std::set<std::string> passed_over_;
};

}  // namespace dynalin
