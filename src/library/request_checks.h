// What requests may ask for, as commands do by the ranges of their arguments: throws what is out of range.
#pragma once

#include "dynalin/study.h"

namespace dynalin::library {

void check(const InitialConditionRequest&);
void check(const StaticRequest&);
void check(const SimulationRequest&, double present_time);
void check(const ModeSelection&);
// Whether these may be modes of the linear model, with shapes.
void check(const EigenSolution&, const LinearModel::Inside&);

}  // namespace dynalin::library
