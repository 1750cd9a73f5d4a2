// Balancing of state matrices: rows and columns scaled by powers of two to like sizes, so that entries of different
// units compare.
#pragma once

#include <Eigen/Core>

namespace dynalin {

struct Balanced {
  Eigen::MatrixXd matrix;  // D⁻¹ A D
  Eigen::VectorXd scale;   // diagonal of D

  // What something of the units of A is in those of the balanced matrix.
  Eigen::MatrixXd of(const Eigen::MatrixXd& like) const {
    return scale.cwiseInverse().asDiagonal() * like * scale.asDiagonal();
  }
};
Balanced balanced(Eigen::MatrixXd A);

}  // namespace dynalin
