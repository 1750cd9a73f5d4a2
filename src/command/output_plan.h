// The files a run will write, known before anything is computed.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "command/job.h"
#include "output/destination.h"

namespace dynalin {

// The path of a file that a command names, `-` for standard output. The folder is that of the command.
std::string command_path(const std::string& folder, const std::string& file);

// Reports files of the run that are among those it reads, that are not files, and that are two results at once.
void check_outputs(const std::deque<Job>&, const SessionOptions&, const InputFiles& inputs, Diagnostics&);
// Reports those that must not be written; nothing is.
void check_permissions(const std::deque<Job>&, const SessionOptions&, Diagnostics&);

}  // namespace dynalin
