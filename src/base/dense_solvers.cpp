#include "base/dense_solvers.h"

namespace Eigen {

template void PartialPivLU<MatrixXd>::compute();
template void FullPivLU<MatrixXd>::computeInPlace();
template void FullPivLU<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
template void FullPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
template void HouseholderQR<MatrixXd>::computeInPlace();
template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template void CompleteOrthogonalDecomposition<MatrixXd>::computeInPlace();
template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template JacobiSVD<MatrixXd>& JacobiSVD<MatrixXd>::compute(const MatrixXd&, unsigned int);
template SelfAdjointEigenSolver<Matrix3d>& SelfAdjointEigenSolver<Matrix3d>::compute(const EigenBase<Matrix3d>&, int);
template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, int);
template GeneralizedSelfAdjointEigenSolver<MatrixXd>& GeneralizedSelfAdjointEigenSolver<MatrixXd>::compute(
    const MatrixXd&, const MatrixXd&, int);
template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
template EigenSolver<MatrixXd>::EigenvectorsType EigenSolver<MatrixXd>::eigenvectors() const;

namespace internal {
template double rcond_estimate_helper(double, const PartialPivLU<MatrixXd>&);
template double rcond_estimate_helper(double, const FullPivLU<MatrixXd>&);
}  // namespace internal

}  // namespace Eigen

namespace dynalin {

Eigen::MatrixXd columns_of_q(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count) {
  return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), count);
}

Eigen::MatrixXd columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count) {
  return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), count);
}

}  // namespace dynalin
