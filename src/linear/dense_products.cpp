#include "linear/dense_products.h"

#include <cblas.h>

#include <complex>

namespace dynalin {

namespace {

Eigen::MatrixXcd multiply(CBLAS_TRANSPOSE transpose, const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  const bool plain = transpose == CblasNoTrans;
  const Eigen::Index rows = plain ? a.rows() : a.cols(), inner = plain ? a.cols() : a.rows();
  eigen_assert(inner == b.rows());
  Eigen::MatrixXcd c = Eigen::MatrixXcd::Zero(rows, b.cols());
  if (c.size() == 0 || inner == 0) return c;
  const std::complex<double> one = 1, zero = 0;
  cblas_zgemm(CblasColMajor, transpose, CblasNoTrans, static_cast<int>(rows), static_cast<int>(b.cols()),
              static_cast<int>(inner), &one, a.data(), static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()),
              &zero, c.data(), static_cast<int>(rows));
  return c;
}

}  // namespace

Eigen::MatrixXcd real_product(const Eigen::MatrixXd& a, const Eigen::MatrixXcd& b) {
  return by_parts(b, [&](const Eigen::MatrixXd& parts) {
    eigen_assert(a.cols() == parts.rows());
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), parts.cols());
    if (c.size() == 0 || a.cols() == 0) return c;
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(a.rows()), static_cast<int>(parts.cols()),
                static_cast<int>(a.cols()), 1.0, a.data(), static_cast<int>(a.rows()), parts.data(),
                static_cast<int>(parts.rows()), 0.0, c.data(), static_cast<int>(c.rows()));
    return c;
  });
}
Eigen::MatrixXcd product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) { return multiply(CblasNoTrans, a, b); }
Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return multiply(CblasConjTrans, a, b);
}
Eigen::MatrixXcd transposed_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return multiply(CblasTrans, a, b);
}

}  // namespace dynalin
