// Structural zeros of models whose state matrix is not formed: the eigenvalues nearest to a shift next to zero.
#pragma once

#include <optional>

#include "selected_modes/eigenvalue_search.h"
#include "selected_modes/near_zero.h"

namespace dynalin {

// States of a model whose state matrix costs nothing, and of one whose full solution is worth its seconds where the
// search does not settle things: about a minute, and 2.5 GB.
inline constexpr Eigen::Index most_for_state_matrix = 300, most_for_full_solution = 3000;

// Whether so many were found of a model of that kind that the full solution is cheaper: each vector is held against all
// before it, and bounds of p modes together take p³.
bool costs_more_than_all(const ModeSearch& right, Eigen::Index states);

struct ZerosFound {
  NearZero zero;
  double near = 0;  // the modulus of what may be a zero
  bool all = true;  // nothing more came to light from other start vectors
};

// Leaves the operator at a shift that is small against all that is not zero, with its units, and in `right` what was
// found there; nothing if no such shift could be factored. It ends early where that costs more than all modes.
std::optional<ZerosFound> zeros_near(const System&, const Perturbation&, ShiftInverse& op, ModeSearch& right);

}  // namespace dynalin
