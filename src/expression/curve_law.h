// A curve in space that something else than points defines: a compiled routine of the user.
#pragma once

#include <string>

#include "base/vec3.h"

namespace dynalin {

class CurveLaw {
 public:
  virtual ~CurveLaw() = default;
  static constexpr int highest_order = 3;
  // Derivative 0 … 3 of the point by its parameter [length], not a number where nobody knows it.
  virtual Vec3<double> derivative(double u, int order) const = 0;
  // Why there is no point, or no third derivative, at u.
  virtual std::string reason_of_value(double u) const = 0;
  virtual std::string reason_of_derivatives(double u) const = 0;
};

}  // namespace dynalin
