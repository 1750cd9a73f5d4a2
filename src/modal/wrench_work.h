// What the force of an element works in a mode (LINEAR command, 5.1.5): strain energy and dissipated power.
//
//     −½ Re (δF · ū)         u: motion of I against the point of J's body that takes the reaction, global axes
//     −½ Re (δT · θ̄)         θ: rotation of I against J's body
//
// with δF and δT what displacements (or velocities) alone make of the wrench, through the algebraic unknowns as well.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "mechanics/wrench_source.h"

namespace dynalin {

using ComplexVector3 = std::array<std::complex<double>, 3>;

inline ComplexVector3 three(const Eigen::VectorXcd& x, std::int32_t at) { return {x(at), x(at + 1), x(at + 2)}; }
ComplexVector3 times(const Matrix3&, const ComplexVector3&);
void add(ComplexVector3& a, const ComplexVector3& b, std::complex<double> factor = 1.0);

class WrenchWork {
 public:
  // `family`: position with displacements u of all coordinates, damping with velocities u. `dw`: what they make of the
  // algebraic unknowns, `dw_size` that if nothing cancelled.
  WrenchWork(const Layout&, PartialBy family, const Eigen::VectorXcd& u, Eigen::VectorXcd dw, Eigen::VectorXd dw_size);

  struct Done {
    std::array<double, 6> along{};    // X Y Z of the force and of the torque
    double without_cancellation = 0;  // the sum of all if no motions cancelled
    double rounding = 0;              // what roundings of motion and coefficients make of the sum, or of each
  };
  Done of(const MarkerWrench&) const;

 private:
  const Layout& layout_;
  PartialBy family_;
  const Eigen::VectorXcd& u_;
  Eigen::VectorXcd dw_;
  Eigen::VectorXd dw_size_;
};

}  // namespace dynalin
