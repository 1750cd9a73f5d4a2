// The kernels of Eigen that products and triangular solutions of double and complex matrices end in, compiled once in
// product_kernels.cpp and product_complex_kernels.cpp for every source that includes this, as precompiled headers do.
// Results are the same either way.
#pragma once

#include <Eigen/Core>

// Each list is written once: with `extern` it says that the kernels are elsewhere, without it makes them.
#define DYNALIN_MATRIX_VECTOR(where, Left, left_order, left_conjugate, Right, right_order, right_conjugate) \
  where template struct general_matrix_vector_product<                                                      \
      Index, Left, const_blas_data_mapper<Left, Index, left_order>, left_order, left_conjugate, Right,      \
      const_blas_data_mapper<Right, Index, right_order>, right_conjugate>;

// Parts of matrices in the order in which the products of blocks read them.
#define DYNALIN_PACKED(where, Scalar, order)                                                                     \
  where template struct gemm_pack_lhs<Scalar, Index, const_blas_data_mapper<Scalar, Index, order>,               \
                                      gebp_traits<Scalar, Scalar>::mr, gebp_traits<Scalar, Scalar>::LhsProgress, \
                                      gebp_traits<Scalar, Scalar>::LhsPacket4Packing, order>;                    \
  where template struct gemm_pack_rhs<Scalar, Index, const_blas_data_mapper<Scalar, Index, order>,               \
                                      gebp_traits<Scalar, Scalar>::nr, order>;

#define DYNALIN_MATRIX_MATRIX(where, Left, Right, Result)                                          \
  where template struct gebp_kernel<Left, Right, Index, blas_data_mapper<Result, Index, ColMajor>, \
                                    gebp_traits<Left, Right>::mr, gebp_traits<Left, Right>::nr, false, false>;

#define DYNALIN_BLOCK_SIZES(where, Scalar, factor)                                                                 \
  where template void evaluateProductBlockingSizesHeuristic<Scalar, Scalar, factor, Index>(Index&, Index&, Index&, \
                                                                                           Index);

#define DYNALIN_TRIANGULAR_SOLUTION(where, Scalar, triangle) \
  where template struct triangular_solve_matrix<Scalar, Index, OnTheLeft, triangle, false, ColMajor, ColMajor, 1>;

#define DYNALIN_TRIANGULAR_PRODUCT(where, Scalar, triangle, order, conjugate)                                       \
  where template struct product_triangular_matrix_matrix<Scalar, Index, triangle, true, order, conjugate, ColMajor, \
                                                         false, ColMajor, 1>;

#define DYNALIN_KERNELS(where, Scalar)                                           \
  DYNALIN_MATRIX_VECTOR(where, Scalar, ColMajor, false, Scalar, ColMajor, false) \
  DYNALIN_MATRIX_VECTOR(where, Scalar, ColMajor, false, Scalar, RowMajor, false) \
  DYNALIN_MATRIX_VECTOR(where, Scalar, RowMajor, false, Scalar, ColMajor, false) \
  DYNALIN_MATRIX_VECTOR(where, Scalar, RowMajor, false, Scalar, RowMajor, false) \
  DYNALIN_PACKED(where, Scalar, ColMajor)                                        \
  DYNALIN_PACKED(where, Scalar, RowMajor)                                        \
  DYNALIN_MATRIX_MATRIX(where, Scalar, Scalar, Scalar)                           \
  DYNALIN_BLOCK_SIZES(where, Scalar, 1)                                          \
  DYNALIN_BLOCK_SIZES(where, Scalar, 4)                                          \
  DYNALIN_TRIANGULAR_SOLUTION(where, Scalar, Lower)                              \
  DYNALIN_TRIANGULAR_SOLUTION(where, Scalar, Upper)                              \
  DYNALIN_TRIANGULAR_SOLUTION(where, Scalar, UnitLower)

#define DYNALIN_REAL_KERNELS(where)                                     \
  DYNALIN_KERNELS(where, double)                                        \
  DYNALIN_TRIANGULAR_PRODUCT(where, double, Lower, ColMajor, false)     \
  DYNALIN_TRIANGULAR_PRODUCT(where, double, UnitLower, ColMajor, false) \
  DYNALIN_TRIANGULAR_PRODUCT(where, double, Upper, RowMajor, false)     \
  DYNALIN_TRIANGULAR_PRODUCT(where, double, UnitUpper, RowMajor, false)

#define DYNALIN_COMPLEX_KERNELS(where)                                                                      \
  DYNALIN_KERNELS(where, std::complex<double>)                                                              \
  DYNALIN_MATRIX_VECTOR(where, std::complex<double>, ColMajor, false, std::complex<double>, RowMajor, true) \
  DYNALIN_MATRIX_VECTOR(where, std::complex<double>, RowMajor, true, std::complex<double>, ColMajor, false) \
  DYNALIN_MATRIX_VECTOR(where, std::complex<double>, RowMajor, false, std::complex<double>, ColMajor, true) \
  DYNALIN_MATRIX_VECTOR(where, std::complex<double>, RowMajor, false, std::complex<double>, RowMajor, true) \
  DYNALIN_MATRIX_VECTOR(where, double, ColMajor, false, std::complex<double>, RowMajor, false)              \
  DYNALIN_MATRIX_VECTOR(where, double, RowMajor, false, std::complex<double>, ColMajor, false)              \
  DYNALIN_MATRIX_MATRIX(where, double, std::complex<double>, std::complex<double>)                          \
  DYNALIN_TRIANGULAR_PRODUCT(where, std::complex<double>, Lower, ColMajor, true)                            \
  DYNALIN_TRIANGULAR_PRODUCT(where, std::complex<double>, UnitLower, ColMajor, false)                       \
  DYNALIN_TRIANGULAR_PRODUCT(where, std::complex<double>, Upper, RowMajor, false)                           \
  DYNALIN_TRIANGULAR_PRODUCT(where, std::complex<double>, UnitUpper, RowMajor, true)

namespace Eigen::internal {

DYNALIN_REAL_KERNELS(extern)
DYNALIN_COMPLEX_KERNELS(extern)

}  // namespace Eigen::internal
