// How coordinates outside bodies weigh in the least change of positions and velocities, beside 1 for those of bodies.
#pragma once

#include "analysis/initial.h"

namespace dynalin {

// A body moves as a whole before it deforms, which costs energy. What a beam has beside its nodes counts as they do.
// All others follow.
constexpr double deformation_weight = 1e8;
constexpr double outside_weight(StateType of) {
  return of == StateType::flex_body ? deformation_weight : of == StateType::fe_part ? 1.0 : follower_weight;
}

}  // namespace dynalin
