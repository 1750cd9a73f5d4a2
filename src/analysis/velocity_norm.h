// How velocities compare: those of mass centres, and angular ones by the length of the model.
#pragma once

#include <vector>

#include "analysis/velocity_conditions.h"

namespace dynalin {

// ½ Σ |v_C|² + L² |ω|² over all bodies, times `weight`.
void add_velocity_norm(const System&, const Motion&, double weight, std::vector<Triplet>&);

// The fastest coordinate, displacements in lengths of the model and rotations alike.
double fastest_of(const System&, const Eigen::VectorXd& velocity);

// In what unit a condition counts beside others: turns by the length, or the unit of length would decide which of them
// gives way.
double unit_of(const System&, const VelocityCondition&);

}  // namespace dynalin
