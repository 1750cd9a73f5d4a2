// A configuration file as it is written: directives and data blocks with their places.
#pragma once

#include <string_view>
#include <vector>

#include "nastran/directives.h"

namespace dynalin::nastran {

// One of three: a directive, a block, or lines for case control.
struct WrittenItem {
  const Directive* directive = nullptr;
  const Block* block = nullptr;
  WrittenValue written;              // of a directive; the key alone of the others
  std::vector<WrittenValue> fields;  // of a block: names of the table, each once, the last one
  std::vector<std::string> lines;    // of verbatim
};

// In the order of the file. What is wrong is reported and left out.
std::vector<WrittenItem> parse_configuration(const SourceText&, Diagnostics&);

}  // namespace dynalin::nastran
