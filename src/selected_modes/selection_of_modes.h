// Which of all modes a selection takes: the rules that any other way to them has to keep.
#pragma once

#include "eigenvalues/eigen.h"

namespace dynalin {

// The modes of a selection out of all, where they are known: as eigensolve_selected() finds them.
EigenSolution selected_of(const EigenSolution& all, const ModeSelection&);
// Those that are no structural zeros.
std::size_t modes_in(const EigenSolution&);
// Of what selects the nearest modes: without those that are farther than as many as are asked for. Values that bounds
// have made one, as a double one on the real axis that looked like a pair, are as many as they are.
EigenSolution without_farther_ones(EigenSolution selected);

}  // namespace dynalin
