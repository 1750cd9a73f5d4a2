// Eigenvalues that are zero by the structure of the model - rigid-body motion, ignorable coordinates, integrators -
// taken out before the QR iteration.
//
// What counts: a state that nothing holds, alone on the diagonal of a triangular form of the state matrix that follows
// from which entries are there at all, and motions along which every element's own contribution vanishes
// (structural_zeros.h). An eigenvalue that is merely small is none of these. Directions v of zeros are split off, and
// again from what is left: zero chains of any length appear as the strictly upper triangular block N of
//
//     A = T ⎡ N  C ⎤ T⁻¹        T = D L,  D a balancing of A,  L a product of eliminations.
//           ⎣ 0  B ⎦
//
// L takes p directions V = [1; W] with their largest entries first: B = A₂₂ − W A₁₂ mixes no rows but those that
// take part, so that soft equations beside stiff ones keep their digits; an orthonormal basis would mix them all.
#pragma once

#include <Eigen/Core>

namespace dynalin {

class StructuralZeros;

struct ZeroModes {
  Eigen::Index count = 0;  // multiplicity of the eigenvalue zero, size of N
  Eigen::MatrixXd block;   // [N C; 0 B]
  Eigen::VectorXd scale;   // diagonal of D
  Eigen::MatrixXd basis;   // L
  Eigen::MatrixXd dual;    // L⁻ᵀ

  Eigen::MatrixXd right() const { return scale.asDiagonal() * basis; }               // T
  Eigen::MatrixXd left() const { return scale.cwiseInverse().asDiagonal() * dual; }  // T⁻ᵀ
  // Eigenvectors of A, one for each zero, the last link of the chain it belongs to.
  Eigen::MatrixXd vectors() const;
  bool defective() const { return !block.topLeftCorner(count, count).isZero(0); }
};

// Of unit vectors, the last vector that a strictly upper triangular N makes of each before it makes nothing.
Eigen::MatrixXd last_links(const Eigen::MatrixXd& N);

// `rounding` holds what each entry of A may carry.
ZeroModes split_zero_modes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& rounding, const StructuralZeros* motions);

}  // namespace dynalin
