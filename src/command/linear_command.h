// LINEAR with all its arguments (LINEAR command, section 4), and the rules between them.
#pragma once

#include "command/command_reader.h"
#include "dynalin/modal_table.h"
#include "dynalin/mode_selection.h"

namespace dynalin {

enum class LinearOption { eigensol, statemat, mkb, nastran_export };

struct LinearCommand {
  LinearOption option = LinearOption::eigensol;
  std::optional<std::int64_t> rm, pstate, pinput, poutput;
  bool without_damping = false, without_vectors = false, original = false, names = false;
  std::string file, format = "MATRIXX", config;
  std::string_view type;  // of an export, "OPENBOX" or "CLOSEDBOX"
  ModalTableRequest tables;
  int table_precision = 2;
  std::optional<ModeSelection> selection;  // nothing: all modes
  bool descriptor = false;
};

// Reports every rule that is broken.
std::optional<LinearCommand> read_linear(ElementReader&);
// Those of its own, and one or two for each table of modes.
std::span<const ArgumentInfo> linear_arguments();

}  // namespace dynalin
