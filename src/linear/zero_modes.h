// Eigenvalues that are zero by the structure of the model - rigid-body motion, ignorable coordinates, integrators -
// found before the QR iteration and taken out of it.
//
// A direction v is a null direction when every entry of A v is within the rounding of its own sum. Null directions are
// split off with an orthonormal basis, and again from what is left, until nothing is singular: zero chains of any
// length appear as the strictly upper triangular block N of
//
//     A = T ⎡ N  C ⎤ T⁻¹        T = D Q,  D a balancing of A,  Q orthonormal.
//           ⎣ 0  B ⎦
#pragma once

#include <Eigen/Core>

namespace dynalin {

struct ZeroModes {
  Eigen::Index count = 0;  // multiplicity of the eigenvalue zero, size of N
  Eigen::MatrixXd block;   // [N C; 0 B]
  Eigen::VectorXd scale;   // diagonal of D
  Eigen::MatrixXd basis;   // Q

  Eigen::MatrixXd right() const { return scale.asDiagonal() * basis; }                // T
  Eigen::MatrixXd left() const { return scale.cwiseInverse().asDiagonal() * basis; }  // T⁻ᵀ
  // Eigenvectors of A, one for each zero, the last link of the chain it belongs to.
  Eigen::MatrixXd vectors() const;
  bool defective() const { return !block.topLeftCorner(count, count).isZero(0); }
};

// `rounding` holds what each entry of A may carry.
ZeroModes split_zero_modes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& rounding);

}  // namespace dynalin
