// Eigen's dense decompositions of double and complex matrices are compiled once (dense_solvers.cpp) where this is
// included, as it is by precompiled headers: it makes builds quicker and nothing else.
#pragma once

#include <Eigen/Dense>

namespace Eigen {

extern template class PartialPivLU<MatrixXd>;
extern template class PartialPivLU<MatrixXcd>;
extern template class FullPivLU<MatrixXd>;
extern template class FullPivLU<MatrixXcd>;
extern template class LLT<MatrixXd>;
extern template class HouseholderQR<MatrixXd>;
extern template class HouseholderQR<MatrixXcd>;
extern template class ColPivHouseholderQR<MatrixXd>;
extern template class ColPivHouseholderQR<MatrixXcd>;
extern template class CompleteOrthogonalDecomposition<MatrixXd>;
extern template class JacobiSVD<MatrixXd>;
extern template class JacobiSVD<MatrixXcd>;
extern template class SelfAdjointEigenSolver<Matrix3d>;
extern template class SelfAdjointEigenSolver<MatrixXd>;
extern template class GeneralizedSelfAdjointEigenSolver<MatrixXd>;
extern template class EigenSolver<MatrixXd>;
extern template class ComplexEigenSolver<MatrixXcd>;
extern template class GeneralizedEigenSolver<MatrixXd>;

}  // namespace Eigen
