// The text file of modal tables: COORDS, KINETIC, STRAIN and DISSIPAT with their header, in the layout other programs
// read.
#pragma once

#include <functional>
#include <iosfwd>

#include "linear/modal_distribution.h"
#include "linear/modal_sums.h"

namespace dynalin {

struct ModalTableFormat {
  int precision = 2;  // 2: the old format with two decimals; otherwise exponents with this many digits behind the point
  bool names = false;  // view names behind each row; the old format has none
};

void write_modal_title(std::ostream&, double time);
void write_mode_header(std::ostream&, std::size_t number, const ModeHeader&);
// Magnitudes and phases, of the bodies and states or of chosen markers.
enum class ShapeTable : bool { coordinates, markers };
void write_shape(std::ostream&, const ModalTableFormat&, ShapeTable,
                 const std::vector<ModalRow<std::complex<double>>>&);
void write_kinetic(std::ostream&, const ModalTableFormat&, const std::vector<ModalRow<double>>&);
enum class ForceTable : bool { strain, dissipation };
void write_forces(std::ostream&, const ModalTableFormat&, ForceTable, const std::vector<ModalRow<double>>&);

// One row a wanted mode, with shares in percent of what the wanted modes hold together, and the totals.
using WantedMode = std::function<bool(std::size_t)>;
void write_energies(std::ostream&, const ModalTableFormat&, const EnergyPerMode&, const WantedMode&);
// `rm` is the marker of MODAL_RM, 0 for the global frame.
void write_masses(std::ostream&, const ModalTableFormat&, const ModalMasses&, std::int64_t rm, const WantedMode&);

}  // namespace dynalin
