// Curves c(u), -1 <= u <= 1, of CURVE statements: splines of order k as polynomials plus truncated powers at the knots.
#pragma once

#include <cmath>
#include <vector>

#include "jet.h"
#include "mechanism.h"
#include "small_algebra.h"

namespace dynalin::oracle {

class CurveShape {
 public:
  CurveShape(const Curve& curve, const NumberMatrix& points);

  // Derivative by u. A closed curve has the period 2; an open one goes on along its tangent.
  [[nodiscard]] Vec at(Real u, int derivative = 0) const;
  [[nodiscard]] Vector3<Jet> at(const Jet& u, int derivative = 0) const;
  // How far the next knot is, or the next end.
  [[nodiscard]] Real clearance(Real u) const;

 private:
  void take_open(const std::vector<Vec>& points, bool controls);
  void take_closed(const std::vector<Vec>& points, bool controls);
  // Coefficients for values at parameters; a closed curve also repeats its derivatives.
  void interpolate(const std::vector<Real>& parameters, const std::vector<Vec>& values);
  [[nodiscard]] Real basis(std::size_t k, Real u, int derivative) const;

  bool closed_ = false;
  std::size_t order_ = 4;
  Real first_ = -1;
  std::vector<Real> knots_;       // inside
  std::vector<Vec> coefficient_;  // of the powers of u - first, then of those of u - knot
};

}  // namespace dynalin::oracle
