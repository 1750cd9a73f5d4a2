// Eigen's dense decompositions of double and complex matrices are compiled once (dense_solvers.cpp) where this is
// included, as it is by precompiled headers: it makes builds quicker and nothing else. What is given to them counts: a
// matrix of another kind (of fixed size, or an expression) brings a decomposition of its own to its source.
#pragma once

#include <Eigen/Dense>

namespace Eigen {

extern template class PartialPivLU<MatrixXd>;
extern template class PartialPivLU<MatrixXcd>;
extern template class PartialPivLU<Matrix<std::complex<long double>, Dynamic, Dynamic>>;
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

// Those members that are templates themselves.
extern template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template SelfAdjointEigenSolver<Matrix3d>& SelfAdjointEigenSolver<Matrix3d>::compute(const EigenBase<Matrix3d>&,
                                                                                            int);
extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&,
                                                                                            int);
extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
extern template ComplexEigenSolver<MatrixXcd>& ComplexEigenSolver<MatrixXcd>::compute(const EigenBase<MatrixXcd>&,
                                                                                      bool);
extern template void FullPivLU<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
extern template void FullPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
extern template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
extern template void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void FullPivLU<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
extern template void FullPivLU<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;
extern template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const VectorXcd&, VectorXcd&) const;
extern template void ColPivHouseholderQR<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;

// Their reciprocal condition numbers.
namespace internal {
extern template double rcond_estimate_helper(double, const PartialPivLU<MatrixXd>&);
extern template double rcond_estimate_helper(double, const PartialPivLU<MatrixXcd>&);
extern template double rcond_estimate_helper(double, const FullPivLU<MatrixXd>&);
}  // namespace internal

}  // namespace Eigen

namespace dynalin {

// The first columns of the orthogonal or unitary factor Q.
Eigen::MatrixXd columns_of_q(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count);
Eigen::MatrixXd columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count);
Eigen::MatrixXcd columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXcd>& qr, Eigen::Index count);

}  // namespace dynalin
