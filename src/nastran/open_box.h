// OPENBOX: the linear model element by element. A GRID and CONM2 at the mass centre of each body, joints as RJOINT or
// MPC (open_constraints.h), forces as CBUSH and DMIG (open_forces.h), differential states on scalar points; VARIABLEs
// and FUNCTIONs are put into what reads them (algebraic_forms.h).
//
// Exact at rest. What velocities and accelerations do beside forces, gyroscopic moments and the change of inertia
// forces with the pose, is not in the deck.
#pragma once

#include "nastran/deck.h"
#include "nastran/export_options.h"
#include "study/linearization.h"

namespace dynalin::nastran {

// Damping is that of the options, whatever the linearization has of it.
StudyResult<Deck> open_box(const Linearization&, const ExportOptions&, Diagnostics& remarks);

}  // namespace dynalin::nastran
