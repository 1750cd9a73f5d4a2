// All finite eigenvalues of λ² M + λ B + K.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace dynalin::nastran_reader {

struct QuadraticEigenvalues {
  std::vector<std::complex<double>> values;  // both of each pair, by size
  Eigen::Index zeros = 0;                    // exact ones among them, for the structure of the matrices gives them
};

// M may be singular. The error is a reason: "the matrices are singular for every frequency".
tl::expected<QuadraticEigenvalues, std::string> finite_eigenvalues(Eigen::MatrixXd M, Eigen::MatrixXd B,
                                                                   Eigen::MatrixXd K);

// The eigenvector of one of them, its largest component 1.
Eigen::VectorXcd eigenvector(const Eigen::MatrixXd& M, const Eigen::MatrixXd& B, const Eigen::MatrixXd& K,
                             std::complex<double> value);

}  // namespace dynalin::nastran_reader
