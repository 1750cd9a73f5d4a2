// METHOD=ORIGINAL: Newton's method on all equations of rest at once,
//
//     (K + s (M + C)) δ = −r,
//
// with the multiple s = STABILITY of masses and dampings, which holds what is free, a Jacobian that is evaluated anew
// where PATTERN says so, and steps within ALIMIT and TLIMIT. It ends where the relative correction is within ERROR and
// every imbalance within IMBALANCE, after MAXIT iterations at most; saddles attract it as well as minima.
#pragma once

#include "analysis/static_equations.h"
#include "analysis/static_history.h"
#include "analysis/statics.h"

namespace dynalin {

// Moves the point; whether ERROR and IMBALANCE were met. What is met goes on until steps are small.
bool iterate_by_newton(StaticEquations&, OperatingPoint&, const OriginalMethod&, StaticHistory&);

}  // namespace dynalin
