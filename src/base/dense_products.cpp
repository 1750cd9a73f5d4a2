#include "base/dense_products.h"

#include <cblas.h>

#include <complex>
#include <utility>
#include <vector>

namespace dynalin {

namespace {

void gemm(CBLAS_TRANSPOSE transpose, int rows, int columns, int inner, const double* a, int a_rows, const double* b,
          double* c) {
  cblas_dgemm(CblasColMajor, transpose, CblasNoTrans, rows, columns, inner, 1.0, a, a_rows, b, inner, 0.0, c, rows);
}
void gemm(CBLAS_TRANSPOSE transpose, int rows, int columns, int inner, const std::complex<double>* a, int a_rows,
          const std::complex<double>* b, std::complex<double>* c) {
  const std::complex<double> one = 1, zero = 0;
  cblas_zgemm(CblasColMajor, transpose, CblasNoTrans, rows, columns, inner, &one, a, a_rows, b, inner, &zero, c, rows);
}

template <class Matrix>
Matrix multiply(CBLAS_TRANSPOSE transpose, const Matrix& a, const Matrix& b) {
  const bool plain = transpose == CblasNoTrans;
  const Eigen::Index rows = plain ? a.rows() : a.cols(), inner = plain ? a.cols() : a.rows();
  eigen_assert(inner == b.rows());
  Matrix c = Matrix::Zero(rows, b.cols());
  if (c.size() == 0 || inner == 0) return c;
  gemm(transpose, static_cast<int>(rows), static_cast<int>(b.cols()), static_cast<int>(inner), a.data(),
       static_cast<int>(a.rows()), b.data(), c.data());
  return c;
}

}  // namespace

Eigen::MatrixXcd real_product(const Eigen::MatrixXd& a, const Eigen::MatrixXcd& b) {
  return by_parts(b, [&](const Eigen::MatrixXd& parts) { return multiply(CblasNoTrans, a, parts); });
}
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return multiply(CblasTrans, a, b);
}
// A sparse product takes about as much time an entry as the BLAS takes for ten.
TransposedFactor::TransposedFactor(Eigen::MatrixXd a) : sparse_(16 * (a.array() != 0).count() < a.size()) {
  if (sparse_) {
    entries_ = a.sparseView();
  } else {
    dense_ = std::move(a);
  }
}
Eigen::MatrixXd TransposedFactor::operator*(const Eigen::MatrixXd& b) const {
  if (sparse_) return entries_.transpose() * b;
  return transposed_product(dense_, b);
}
Eigen::MatrixXcd product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) { return multiply(CblasNoTrans, a, b); }
Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return multiply(CblasConjTrans, a, b);
}
Eigen::VectorXcd take_out(const Eigen::MatrixXcd& V, Eigen::Index columns, Eigen::VectorXcd& w) {
  eigen_assert(V.rows() == w.size() && columns <= V.cols());
  Eigen::VectorXcd along = Eigen::VectorXcd::Zero(columns);
  if (columns == 0 || w.size() == 0) return along;
  const std::complex<double> one = 1, minus_one = -1, zero = 0;
  const auto rows = static_cast<int>(V.rows()), count = static_cast<int>(columns);
  cblas_zgemv(CblasColMajor, CblasConjTrans, rows, count, &one, V.data(), rows, w.data(), 1, &zero, along.data(), 1);
  cblas_zgemv(CblasColMajor, CblasNoTrans, rows, count, &minus_one, V.data(), rows, along.data(), 1, &one, w.data(), 1);
  return along;
}
// Sums over rows by blocks of them, in their order.
Eigen::MatrixXd take_out(const Eigen::MatrixXd& V, Eigen::Index columns, const Eigen::MatrixXd& F, Eigen::MatrixXd& W) {
  eigen_assert(V.rows() == F.rows() && V.rows() == W.rows() && F.cols() == W.cols() && columns <= V.cols());
  Eigen::MatrixXd along = Eigen::MatrixXd::Zero(columns, F.cols());
  if (along.size() == 0 || F.rows() == 0) return along;
  const auto rows = static_cast<int>(V.rows()), count = static_cast<int>(columns), at_once = static_cast<int>(F.cols());
  std::vector<Eigen::MatrixXd> share(static_cast<std::size_t>(row_blocks(V.rows())), along);
  for_row_blocks(V.rows(), [&](Eigen::Index first, Eigen::Index size) {
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, count, at_once, static_cast<int>(size), 1.0, V.data() + first,
                rows, F.data() + first, rows, 0.0, share[static_cast<std::size_t>(first / rows_of_block)].data(),
                count);
  });
  for (const Eigen::MatrixXd& s : share) along += s;
  for_row_blocks(V.rows(), [&](Eigen::Index first, Eigen::Index size) {
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(size), at_once, count, -1.0,
                V.data() + first, rows, along.data(), count, 1.0, W.data() + first, rows);
  });
  return along;
}
void combine_columns(Eigen::MatrixXd& V, Eigen::Index first, const Eigen::MatrixXd& U) {
  for_row_blocks(V.rows(), [&](Eigen::Index row, Eigen::Index size) {
    const Eigen::MatrixXd combined = V.block(row, first, size, U.rows()) * U;
    V.block(row, first, size, U.cols()) = combined;
  });
}
BothProducts both_products(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  const Eigen::Index rows = a.cols(), columns = b.cols();
  Eigen::MatrixXd left(a.rows(), 2 * rows), right(b.rows(), 2 * columns);
  left << a.real(), a.imag();
  right << b.real(), b.imag();
  const Eigen::MatrixXd parts = multiply(CblasTrans, left, right);
  const auto rr = parts.topLeftCorner(rows, columns), ri = parts.topRightCorner(rows, columns),
             ir = parts.bottomLeftCorner(rows, columns), ii = parts.bottomRightCorner(rows, columns);
  BothProducts out{Eigen::MatrixXcd(rows, columns), Eigen::MatrixXcd(rows, columns)};
  out.adjoint.real() = rr + ii, out.adjoint.imag() = ri - ir;
  out.transposed.real() = rr - ii, out.transposed.imag() = ri + ir;
  return out;
}

}  // namespace dynalin
