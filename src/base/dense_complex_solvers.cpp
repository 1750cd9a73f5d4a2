#include "base/dense_solvers.h"

namespace Eigen {

template void PartialPivLU<MatrixXcd>::compute();
template void PartialPivLU<Matrix<std::complex<long double>, Dynamic, Dynamic>>::compute();
template void FullPivLU<MatrixXcd>::computeInPlace();
template void FullPivLU<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
template void FullPivLU<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;
template void HouseholderQR<MatrixXcd>::computeInPlace();
template void ColPivHouseholderQR<MatrixXcd>::computeInPlace();
template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;
template void CompleteOrthogonalDecomposition<MatrixXcd>::computeInPlace();
template JacobiSVD<MatrixXcd>& JacobiSVD<MatrixXcd>::compute(const MatrixXcd&, unsigned int);
template ComplexEigenSolver<MatrixXcd>& ComplexEigenSolver<MatrixXcd>::compute(const EigenBase<MatrixXcd>&, bool);

namespace internal {
template double rcond_estimate_helper(double, const PartialPivLU<MatrixXcd>&);
}  // namespace internal

}  // namespace Eigen

namespace dynalin {

Eigen::MatrixXcd columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXcd>& qr, Eigen::Index count) {
  return qr.householderQ() * Eigen::MatrixXcd::Identity(qr.rows(), count);
}

}  // namespace dynalin
