// A CURVE as constraints, and the function CURVE, see it.
#pragma once

#include <memory>

#include "expression/parametric_curve.h"

namespace dynalin {

struct Curve {
  std::shared_ptr<const ParametricCurve> shape;  // nothing after an error
};

}  // namespace dynalin
