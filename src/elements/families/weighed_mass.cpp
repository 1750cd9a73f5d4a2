#include "elements/families/weighed_mass.h"

#include <Eigen/Dense>

namespace dynalin {

Eigen::Matrix3d eigen_matrix(const Matrix3& m) {
  Eigen::Matrix3d out;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = m(r, c);
  }
  return out;
}

Eigen::MatrixXd root_of_mass(const Eigen::MatrixXd& mass) {
  // Coordinates without mass have no unit of their own.
  const Eigen::VectorXd unit = mass.diagonal().cwiseSqrt().unaryExpr([](double x) { return x > 0 ? x : 1.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(
      Eigen::MatrixXd(unit.cwiseInverse().asDiagonal() * mass * unit.cwiseInverse().asDiagonal()));
  return parts.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * parts.eigenvectors().transpose() *
         unit.asDiagonal();
}

std::array<double, 9> kinetic_terms(double mass, const ComplexVector& v, const Matrix3& J, const ComplexVector& w) {
  std::array<double, 9> terms{};
  for (std::size_t k = 0; k < 3; ++k) terms[k] = 0.5 * mass * std::norm(v[k]);
  for (std::size_t k = 0; k < 3; ++k) terms[3 + k] = 0.5 * J(k, k) * std::norm(w[k]);
  const auto product = [&](std::size_t i, std::size_t j) { return J(i, j) * std::real(w[i] * std::conj(w[j])); };
  terms[6] = product(0, 1), terms[7] = product(0, 2), terms[8] = product(1, 2);
  return terms;
}

}  // namespace dynalin
