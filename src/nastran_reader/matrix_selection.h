// Direct matrices that case control selects: K2PP = 2.0*KVVV, B2PP = 4. A number is a SET of names, which may stand
// behind the command that names it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "nastran_reader/case_command.h"
#include "nastran_reader/case_control.h"

namespace dynalin::nastran_reader {

class MatrixSelection {
 public:
  explicit MatrixSelection(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // A command that names matrices, above the subcases or the same in all of them.
  void take(const Command&, bool within_subcases);
  // With all sets there are.
  std::map<std::string, std::vector<MatrixUse>> uses(const std::map<int, NamedSet>&);

 private:
  std::optional<MatrixUse> use(std::string_view text, const Span& at);
  std::optional<double> factor(std::string_view text, const Span& at);

  std::map<std::string, std::vector<Piece>> values_;  // by command
  Diagnostics& diagnostics_;
};

}  // namespace dynalin::nastran_reader
