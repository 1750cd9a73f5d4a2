#include "base/dense_solvers.h"

namespace Eigen {

template class PartialPivLU<MatrixXd>;
template class PartialPivLU<MatrixXcd>;
template class FullPivLU<MatrixXd>;
template class FullPivLU<MatrixXcd>;
template class LLT<MatrixXd>;
template class HouseholderQR<MatrixXd>;
template class HouseholderQR<MatrixXcd>;
template class ColPivHouseholderQR<MatrixXd>;
template class ColPivHouseholderQR<MatrixXcd>;
template class CompleteOrthogonalDecomposition<MatrixXd>;
template class JacobiSVD<MatrixXd>;
template class JacobiSVD<MatrixXcd>;
template class SelfAdjointEigenSolver<Matrix3d>;
template class SelfAdjointEigenSolver<MatrixXd>;
template class GeneralizedSelfAdjointEigenSolver<MatrixXd>;
template class EigenSolver<MatrixXd>;
template class ComplexEigenSolver<MatrixXcd>;
template class GeneralizedEigenSolver<MatrixXd>;

}  // namespace Eigen
