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
  // Eigenvectors of A that span all there are, one for each zero: where there are fewer, some are the last link of the
  // chain to which the zero belongs.
  Eigen::MatrixXd vectors() const;
  bool defective() const { return !block.topLeftCorner(count, count).isZero(0); }
};

// A column for each unit vector, of which a strictly upper triangular N makes nothing: the vector itself, combined with
// earlier ones, if that is null, else the last one that N makes of it before it makes nothing. They span all that is
// null.
Eigen::MatrixXd last_links(const Eigen::MatrixXd& N);

// `rounding` holds what each entry of A may carry.
ZeroModes split_zero_modes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& rounding, const StructuralZeros* motions);

}  // namespace dynalin
