// One run of the program: reads and checks everything, runs the commands, writes the files.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace dynalin {

struct SessionOptions {
  std::string file;                   // .acf, or .adm together with `commands`; - for `standard_input`
  std::vector<std::string> commands;  // of -c
  std::string json;                   // path of --json, empty for none
  std::string output_prefix;          // of --output, empty for the name in the file
  bool keep_going = false;
  bool bounds = false;  // of eigenvalues, in the table on the terminal
  bool quiet = false;
  bool state = false;                         // every operating point in full on the terminal
  std::optional<double> user_value;           // in the place of compiled routines
  std::vector<std::string> user_libraries;    // with compiled routines
  bool difference_user_routines = false;      // in linear models too
  bool pade = false;                          // a DELAY as a Padé approximant with a state of its own
  std::optional<std::int64_t> modes;          // NMODES of every EIGENSOL that selects none itself
  std::optional<std::size_t> dense_up_to;     // states (LinearRequest)
  std::optional<std::string> standard_input;  // its text, where that is the command file or has the commands for `file`
};

enum ExitStatus : int { done = 0, wrong_input = 1, analysis_failed = 2, wrong_usage = 3 };

// 0 done, 1 the input is wrong and nothing was run or written, 2 an analysis failed.
int run_session(const SessionOptions&, std::ostream& out, std::ostream& err);
// Reads and checks a dataset (with its command file) and says what is wrong.
int check_file(const SessionOptions&, std::ostream& out, std::ostream& err);

}  // namespace dynalin
