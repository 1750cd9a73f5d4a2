// Data points of a SPLINE, for AKISPL, CUBSPL and INTERP.
#pragma once

#include <memory>

#include "expression/spline.h"

namespace dynalin {

struct Model;

struct Spline {
  std::shared_ptr<const SplineData> data;
};

// Gives a call the data of its SPLINE or CURVE.
void attach_data(const Model&, SplineUse&);

}  // namespace dynalin
