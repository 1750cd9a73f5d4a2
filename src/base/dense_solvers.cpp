#include "base/dense_solvers.h"

namespace Eigen {

template class PartialPivLU<MatrixXd>;
template class PartialPivLU<MatrixXcd>;
template class PartialPivLU<Matrix<std::complex<long double>, Dynamic, Dynamic>>;
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

template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
template SelfAdjointEigenSolver<Matrix3d>& SelfAdjointEigenSolver<Matrix3d>::compute(const EigenBase<Matrix3d>&, int);
template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, int);
template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
template ComplexEigenSolver<MatrixXcd>& ComplexEigenSolver<MatrixXcd>::compute(const EigenBase<MatrixXcd>&, bool);
template void FullPivLU<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
template void FullPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template void FullPivLU<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
template void FullPivLU<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;
template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;

// Their reciprocal condition numbers.
namespace internal {
template double rcond_estimate_helper(double, const PartialPivLU<MatrixXd>&);
template double rcond_estimate_helper(double, const PartialPivLU<MatrixXcd>&);
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

Eigen::MatrixXcd columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXcd>& qr, Eigen::Index count) {
  return qr.householderQ() * Eigen::MatrixXcd::Identity(qr.rows(), count);
}

}  // namespace dynalin
