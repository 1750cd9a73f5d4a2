// Dense decompositions of Eigen, compiled once: what takes long of those of double and complex matrices is in
// dense_solvers.cpp and dense_complex_solvers.cpp for every source that includes this, as precompiled headers do. What
// is given to them counts: a matrix of another kind (of fixed size, or an expression) brings a decomposition of its own
// to its source. Results are the same either way.
#pragma once

#include <Eigen/Dense>

#include "base/product_kernels.h"

namespace Eigen {

extern template void PartialPivLU<MatrixXd>::compute();
extern template void FullPivLU<MatrixXd>::computeInPlace();
extern template void FullPivLU<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
extern template void FullPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template void HouseholderQR<MatrixXd>::computeInPlace();
extern template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
extern template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
extern template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void CompleteOrthogonalDecomposition<MatrixXd>::computeInPlace();
extern template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
extern template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template JacobiSVD<MatrixXd>& JacobiSVD<MatrixXd>::compute(const MatrixXd&, unsigned int);
extern template SelfAdjointEigenSolver<Matrix3d>& SelfAdjointEigenSolver<Matrix3d>::compute(const EigenBase<Matrix3d>&,
                                                                                            int);
extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&,
                                                                                            int);
extern template GeneralizedSelfAdjointEigenSolver<MatrixXd>& GeneralizedSelfAdjointEigenSolver<MatrixXd>::compute(
    const MatrixXd&, const MatrixXd&, int);
extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
extern template EigenSolver<MatrixXd>::EigenvectorsType EigenSolver<MatrixXd>::eigenvectors() const;

extern template void PartialPivLU<MatrixXcd>::compute();
extern template void PartialPivLU<Matrix<std::complex<long double>, Dynamic, Dynamic>>::compute();
extern template void FullPivLU<MatrixXcd>::computeInPlace();
extern template void FullPivLU<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
extern template void FullPivLU<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;
extern template void HouseholderQR<MatrixXcd>::computeInPlace();
extern template void ColPivHouseholderQR<MatrixXcd>::computeInPlace();
extern template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
extern template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;
extern template void CompleteOrthogonalDecomposition<MatrixXcd>::computeInPlace();
extern template JacobiSVD<MatrixXcd>& JacobiSVD<MatrixXcd>::compute(const MatrixXcd&, unsigned int);
extern template ComplexEigenSolver<MatrixXcd>& ComplexEigenSolver<MatrixXcd>::compute(const EigenBase<MatrixXcd>&,
                                                                                      bool);

// Behind rcond().
namespace internal {
extern template double rcond_estimate_helper(double, const PartialPivLU<MatrixXd>&);
extern template double rcond_estimate_helper(double, const FullPivLU<MatrixXd>&);
extern template double rcond_estimate_helper(double, const PartialPivLU<MatrixXcd>&);
}  // namespace internal

}  // namespace Eigen

namespace dynalin {

// The first columns of the orthogonal or unitary factor Q.
Eigen::MatrixXd columns_of_q(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count);
Eigen::MatrixXd columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count);
Eigen::MatrixXcd columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXcd>& qr, Eigen::Index count);

}  // namespace dynalin
