// How the inertia of a body depends on its deformation: the sums over its mass that a body file holds.
#pragma once

#include <string>

#include "reduction/body_file.h"
#include "reduction/craig_bampton.h"

namespace dynalin::reduction {

enum class InertiaOrder { undeformed, follows_deformation };

// The body with these nodes. A double sum over the mass matrix takes the place of each sum over mass points: with G_k
// the cross product of the unit vector k with the vector of every node,
//     I5_jl,k = (G_k φ_j)ᵀ M φ_l,   (I8_j)_kl = −(G_k s)ᵀ M (G_l φ_j),   (I9_jm)_kl = −(G_k φ_j)ᵀ M (G_l φ_m),
// exact for translations, an approximation for rotations of nodes. Of matrices that were condensed before, which have
// coordinates without a place, only the undeformed inertia is known.
BodyFile body_of(const FiniteElementModel&, const Reduction&, const std::vector<NodeLabel>& nodes, InertiaOrder,
                 std::string title);

}  // namespace dynalin::reduction
