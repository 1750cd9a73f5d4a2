// Data points of a SPLINE, for AKISPL, CUBSPL and INTERP.
#pragma once

#include <memory>

#include "expression/spline.h"

namespace dynalin {

struct Spline {
  std::shared_ptr<const SplineData> data;
};

}  // namespace dynalin
