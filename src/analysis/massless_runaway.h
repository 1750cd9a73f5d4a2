// Whether the fast motion that the limit of vanishing mass leaves out would grow. That depends on how the mass
// vanishes; it is judged for the same small mass in all freedoms without mass, inertia as of that mass at the length of
// the model: its matrix is M = Yᵀ S⁻² N with the coordinates' scales S. Velocities of damped freedoms follow M v′ = −C
// v, where C is regular, and condensed ones WᵀMZ z″ = −K z. Other than by signs of C and K in some coordinates, it is
// judged alike however the model and its parts are turned, and whether or not the matrices are symmetric.
#pragma once

#include "analysis/massless.h"

namespace dynalin {

// What grows, as combinations of the directions; without columns where nothing does.
Eigen::MatrixXd runaway_by_damping(const System&, const MasslessLimit&);
Eigen::MatrixXd runaway_by_stiffness(const System&, const MasslessLimit&);

}  // namespace dynalin
