// CLOSEDBOX: the linear model of a point as one mass, damping and stiffness matrix on scalar points.
//
//     M x″ + C x′ + K x + Z z = f        x the chosen coordinates, z differential states
//     z′ − … = 0
//
// M, C and K are those of the mechanism along its coordinates (linear/physical_matrices.h), not those of the state
// matrix with its unit mass: a force on a grid that follows the coordinates by u = Φ x reaches them as Φᵀ f, which is
// what acts along coordinates, while the state matrix would have M⁻¹ of it. They are symmetric where the forces are,
// and freedoms without mass stay in them as rows without mass, which the state matrix has condensed. The finite roots
// are the eigenvalues of the state matrix at any point, at rest or moving.
//
// Velocity constraints leave some coordinates d without a rate of their own, x_d′ = R x′ + S x. Their rows hold these
// relations by multipliers μ, on scalar points of their own, so that forces along d reach the others by Rᵀ:
//
//     M x″ + … − Rᵀ μ = f,   μ = f_d,   x_d′ − R x′ − S x = 0
#pragma once

#include "nastran/deck.h"
#include "nastran/export_options.h"
#include "study/linearization.h"

namespace dynalin::nastran {

// Damping is that of the options, whatever the linearization has of it. Refuses a point without degrees of freedom.
StudyResult<Deck> closed_box(const Linearization&, const ExportOptions&, Diagnostics& remarks);

}  // namespace dynalin::nastran
