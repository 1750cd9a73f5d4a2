// The files a run will write, known before anything is computed.
#pragma once

#include <string>
#include <vector>

#include "command/job.h"

namespace dynalin {

// The path of a file that LINEAR names, `-` for standard output.
std::string linear_path(const Job&, const std::string& file);
// What is behind the base name of a MATLAB file: one matrix each.
std::vector<std::string_view> matlab_suffixes(const LinearCommand&);

// Reports files of the run that are among those it reads, that are not files, and that are two results at once.
void check_outputs(const Job&, const SessionOptions&, const std::vector<SourceRef>& inputs, Diagnostics&);
// Reports those that must not be written; nothing is.
void check_permissions(const Job&, const SessionOptions&, Diagnostics&);

}  // namespace dynalin
