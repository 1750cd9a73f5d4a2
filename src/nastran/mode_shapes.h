// Mode shapes on the points that the punch file has: mass centres of bodies and differential states.
#pragma once

#include "nastran/deck.h"
#include "nastran/open_points.h"
#include "study/linearization.h"

namespace dynalin::nastran {

// The component of each mode that is largest by modulus is 1.
StudyResult<void> add_modes(const Linearization&, const OpenPoints&, Deck&);

}  // namespace dynalin::nastran
