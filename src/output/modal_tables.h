// The text file of modal tables: COORDS, KINETIC, STRAIN and DISSIPAT with their header, in the layout other programs
// read.
#pragma once

#include <functional>
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

// One row a wanted mode, with shares in percent of what the wanted modes hold together, and the totals.
using WantedMode = std::function<bool(std::size_t)>;
void write_energies(std::ostream&, const ModalTableFormat&, const EnergyPerMode&, const WantedMode&);
// `rm` is the marker of MODAL_RM, 0 for the global frame.
void write_masses(std::ostream&, const ModalTableFormat&, const ModalMasses&, std::int64_t rm, const WantedMode&);

}  // namespace dynalin
