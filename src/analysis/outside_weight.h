// How coordinates outside bodies weigh in the least change of positions and velocities, beside 1 for those of bodies.
#pragma once

#include "analysis/initial.h"

namespace dynalin {

// A body moves as a whole before it deforms, which costs energy. What nodes have beside their poses counts as these do.
constexpr double deformation_weight = 1e8;
constexpr double outside_weight(const ExtraBlock& block) {
  switch (block.kind.role) {
    case ExtraRole::shape:
      return deformation_weight;
    case ExtraRole::nodal:
      return 1;
    case ExtraRole::follower:
      break;
  }
  return follower_weight;
}

}  // namespace dynalin
