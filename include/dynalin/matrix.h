// Matrices of results: Eigen's in everything but where their numbers lie. Where Eigen::MatrixXd puts them, and how it
// frees them, depends on the options that a source is compiled with (-mavx, -march=native, sanitizers), and a matrix of
// the library may be freed by a program that was compiled with others. These come from malloc whatever the options are.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace dynalin {

using DenseMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;
using ComplexDenseMatrix = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;

}  // namespace dynalin
