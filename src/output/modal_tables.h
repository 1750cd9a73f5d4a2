// The text file of modal tables: those of a mode with their header, in the layout other programs read, and those
// of all modes.
#pragma once

#include <iosfwd>

#include "study/modal_tables.h"

namespace dynalin {

struct ModalTableFormat {
  int precision = 2;  // 2: the old format with two decimals; otherwise exponents with this many digits behind the point
  bool names = false;  // view names behind each row; the old format has none
};

void write_modal_title(std::ostream&, double time);
// One of a mode, what stands above them included.
void write_modal_table(std::ostream&, const ModalTableFormat&, const ModalTable&);

// One of all modes.
void write_sums(std::ostream&, const ModalTableFormat&, const SumsOverModes&);

}  // namespace dynalin
