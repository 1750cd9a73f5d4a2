// Products of large dense matrices by the BLAS, which knows the processor better than templates that are
// compiled for every x86-64.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <complex>
#include <utility>

#include "base/parallel.h"

namespace dynalin {

Eigen::MatrixXcd product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);          // A B
Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);  // Aᴴ B

// Aᴴ B and Aᵀ B at once, out of the same products of their parts.
struct BothProducts {
  Eigen::MatrixXcd adjoint, transposed;
};
BothProducts both_products(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

// w −= V Vᴴ w for the first columns of V; Vᴴ w.
Eigen::VectorXcd take_out(const Eigen::MatrixXcd& V, Eigen::Index columns, Eigen::VectorXcd& w);
// W −= V VᵀF for the first columns of V; VᵀF.
Eigen::MatrixXd take_out(const Eigen::MatrixXd& V, Eigen::Index columns, const Eigen::MatrixXd& F, Eigen::MatrixXd& W);
// As many columns of V as U has rows become V U, from the first of them on.
void combine_columns(Eigen::MatrixXd& V, Eigen::Index first, const Eigen::MatrixXd& U);

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// Aᵀ times block after block of columns. Where most of A is zero, as the inverse of a block-diagonal mass matrix is,
// its zeros are left out.
class TransposedFactor {
 public:
  explicit TransposedFactor(Eigen::MatrixXd a);
  Eigen::MatrixXd operator*(const Eigen::MatrixXd& b) const;

 private:
  bool sparse_;
  Eigen::MatrixXd dense_;
  Eigen::SparseMatrix<double> entries_;  // by columns of A
};

// visit(first, count) for all columns, so many at a time, by all threads: a visit may write what belongs to its columns
// and nothing else.
template <Eigen::Index at_a_time, class Function>
void for_columns(Eigen::Index columns, Function&& visit) {
  in_parallel(static_cast<std::size_t>((columns + at_a_time - 1) / at_a_time), [&](std::size_t block) {
    const Eigen::Index first = at_a_time * static_cast<Eigen::Index>(block);
    visit(first, std::min(at_a_time, columns - first));
  });
}
// As many as make good use of a matrix product while what belongs to them stays small.
template <class Function>
void for_column_blocks(Eigen::Index columns, Function&& visit) {
  for_columns<64>(columns, visit);
}
// Of all unknowns of a large model, which are many even for a few modes. KLU solves for four real ones at a time; of
// very large models even two complex columns, with all that is made of them, are a tenth of the memory.
template <class Scalar = std::complex<double>, class Function>
void for_few_columns(Eigen::Index rows, Eigen::Index columns, Function&& visit) {
  constexpr Eigen::Index very_large = 1000000, one = sizeof(std::complex<double>) / sizeof(Scalar);
  if (rows > very_large) return for_columns<one>(columns, visit);
  for_columns<2 * one>(columns, visit);
}

// visit(first, count) for all rows, so many at a time, by all threads: of few columns of very large models.
constexpr Eigen::Index rows_of_block = 65536;
constexpr Eigen::Index row_blocks(Eigen::Index rows) { return (rows + rows_of_block - 1) / rows_of_block; }
template <class Function>
void for_row_blocks(Eigen::Index rows, Function&& visit) {
  for_columns<rows_of_block>(rows, visit);
}

// A real linear map of real matrices, applied to a complex one; it may take its argument for its own.
template <class Function>
Eigen::MatrixXcd by_parts(const Eigen::MatrixXcd& m, Function&& real_map) {
  Eigen::MatrixXd both(m.rows(), 2 * m.cols());
  both << m.real(), m.imag();
  const Eigen::MatrixXd image = real_map(std::move(both));
  Eigen::MatrixXcd out(image.rows(), m.cols());
  out.real() = image.leftCols(m.cols());
  out.imag() = image.rightCols(m.cols());
  return out;
}
Eigen::MatrixXcd real_product(const Eigen::MatrixXd& a, const Eigen::MatrixXcd& b);

}  // namespace dynalin
