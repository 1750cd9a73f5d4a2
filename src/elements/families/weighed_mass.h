// What bodies of all kinds need to be weighed: roots of mass matrices and kinetic energies term by term.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "base/vec3.h"

namespace dynalin {

using ComplexVector = Vec3<std::complex<double>>;

inline ComplexVector complex_vector(const Eigen::VectorXcd& x, std::int32_t at) {
  return {x(at), x(at + 1), x(at + 2)};
}

Eigen::Matrix3d eigen_matrix(const Matrix3&);

// A root of a mass matrix, rootᵀ root = M, in coordinates that have a unit each on its diagonal. Rounding below zero is
// zero.
Eigen::MatrixXd root_of_mass(const Eigen::MatrixXd& mass);

// ½ m |v|² by X Y Z and ½ wᴴ J w by XX YY ZZ XY XZ YZ, with the tensor J along global axes.
std::array<double, 9> kinetic_terms(double mass, const ComplexVector& v, const Matrix3& J, const ComplexVector& w);

}  // namespace dynalin
