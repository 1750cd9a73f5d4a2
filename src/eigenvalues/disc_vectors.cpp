#include "eigenvalues/disc_vectors.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include "base/dense_solvers.h"
#include "eigenvalues/clustered_schur.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;

}  // namespace

void add_vectors(const LongComplexMatrix& M, const Eigen::VectorXd& scale, bool onaxis, InclusionDisc& disc) {
  const Index n = M.rows(), k = disc.count;
  ComplexMatrix X = disc.basis, Y = disc.dual;
  if (onaxis && k > 1) {  // a real basis of a subspace that is its own conjugate
    const auto real_basis = [&](const ComplexMatrix& m) -> Matrix {
      Matrix both(n, 2 * k);
      both << m.real(), m.imag();
      return columns_of_q(Eigen::ColPivHouseholderQR<Matrix>(both), k);
    };
    const Matrix x = real_basis(X), y = real_basis(Y);
    X = x.cast<Complex>();
    Y = (y * (x.transpose() * y).inverse()).cast<Complex>();
  }
  ComplexMatrix v = ComplexMatrix::Ones(1, 1), u = v;
  if (k > 1) {
    const LongComplexMatrix MX = times(M, X.cast<LongComplex>());
    LongComplexMatrix D = times(Y.adjoint().cast<LongComplex>(), MX);
    D.diagonal().array() -= LongComplex(disc.centre);
    const Eigen::JacobiSVD<ComplexMatrix> svd(D.cast<Complex>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::VectorXd s = svd.singularValues().reverse();
    const bool all_equal = s(k - 1) <= std::max(equal_values * std::abs(disc.centre), disc.tau);
    v = u = ComplexMatrix::Identity(k, k);
    if (!all_equal) v = svd.matrixV().rowwise().reverse(), u = svd.matrixU().rowwise().reverse();
    // What the block is known to within has no directions: where all of it is rounding, one value may by chance be far
    // below the others.
    const double small = std::max(1e-10 * s(k - 1) + 10 * s(0), disc.tau);
    for (Index a = 1; a < k && !all_equal; ++a) {
      if (s(a) > small) v.col(a) = v.col(0), u.col(a) = u.col(0);
    }
  }
  disc.right = scale.asDiagonal() * ComplexMatrix(X * v);
  disc.left = scale.cwiseInverse().asDiagonal() * ComplexMatrix(Y * u);
  if (onaxis) {
    const auto make_real = [](ComplexMatrix& m) {
      for (Index a = 0; a < m.cols(); ++a) {
        Index row = 0;
        m.col(a).cwiseAbs().maxCoeff(&row);
        const Complex phase = m(row, a) / std::abs(m(row, a));
        m.col(a) /= phase;
        m.col(a).imag().setZero();
      }
    };
    make_real(disc.right), make_real(disc.left);
  }
  disc.right.colwise().normalize();
  disc.left.colwise().normalize();
}

}  // namespace dynalin
