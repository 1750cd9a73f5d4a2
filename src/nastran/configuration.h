// A configuration file read and checked: what it decides, and where.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/model.h"
#include "nastran/directives.h"

namespace dynalin::nastran {

struct Configuration {
  ExportOptions options;
  SourceRef source;  // nothing without a file
  // Places of what refers to the model: of each of the options' items, of channels by name.
  std::vector<Span> export_markers_by_id, export_markers_by_name, force_editable, flexbody_editable;
  std::map<std::string, Span> output_channels, input_channels;
  std::vector<std::string> echo;  // of `debug`: each directive, what it means and whether it acts
};

// Every problem of the file is reported, with `ignore_errors` as a warning; what has no effect on this export is left
// out, with one remark. Usable only without errors.
Parsed<Configuration> read_configuration(SourceRef, Box);
// Reports what refers to markers and forces that the model does not have, unless errors are to be ignored: then the
// export leaves them out with a remark.
void check_references(const Configuration&, const Model&, Diagnostics&);

}  // namespace dynalin::nastran
