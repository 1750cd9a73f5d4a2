#include "analysis/massless_runaway.h"

#include <Eigen/Dense>
#include <cmath>

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

// Of the largest eigenvalue, and of an eigenvalue's own size: what may be rounding, of double ones too.
constexpr double no_growth = 1e-9, no_flutter = 1e-6;

Matrix small_masses(const System& system, const MasslessLimit& limit) {
  Matrix weighted = limit.directions.basis;
  for (Index c = 0; c < weighted.rows(); ++c)
    weighted.row(c) /= std::pow(system.coordinate_scale(static_cast<std::int32_t>(c)), 2);
  return limit.left.topRows(weighted.rows()).transpose() * weighted;
}

// Real and imaginary parts of eigenvectors whose eigenvalue `grows` accepts.
template <class Grows>
Matrix growing(const Matrix& m, const Grows& grows) {
  if (m.size() == 0 || !m.allFinite()) return Matrix::Zero(m.rows(), 0);
  const Eigen::EigenSolver<Matrix> solver(m);
  if (solver.info() != Eigen::Success) return Matrix::Zero(m.rows(), 0);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  Matrix out(m.rows(), 0);
  for (Index k = 0; k < m.cols(); ++k) {
    if (!grows(solver.eigenvalues()(k), largest)) continue;
    out.conservativeResize(Eigen::NoChange, out.cols() + 2);
    out.rightCols(2) << vectors.col(k).real(), vectors.col(k).imag();
  }
  return out;
}

// Columns of which the largest component is one, in units that compare.
Matrix of_unit_size(const System& system, const MasslessDirections& d, Matrix combinations) {
  for (Index k = 0; k < combinations.cols(); ++k) {
    double largest = 0;
    for (Index j = 0; j < combinations.rows(); ++j) {
      double& x = combinations(j, k);
      x /= system.coordinate_scale(d.coordinate[static_cast<std::size_t>(j)]);
      largest = std::max(largest, std::abs(x));
    }
    if (largest > 0) combinations.col(k) /= largest;
  }
  return combinations;
}

}  // namespace

Matrix runaway_by_damping(const System& system, const MasslessLimit& limit) {
  // C of rank r is L R, and the eigenvalues of M⁻¹ L R that are not zero are those of R M⁻¹ L.
  const Matrix C = limit.on_rates * limit.directions.basis;
  const Index k = limit.count(), r = limit.damped();
  Matrix L(k, r), regular(r, r);
  for (Index j = 0; j < r; ++j) L.col(j) = C.col(limit.damping.pivot_column[static_cast<std::size_t>(j)]);
  for (Index i = 0; i < r; ++i) regular.row(i) = L.row(limit.damping.pivot_row[static_cast<std::size_t>(i)]);
  if (r == 0) return Matrix::Zero(k, 0);
  const Matrix R = regular.partialPivLu().solve(limit.damped_rows(C));
  const Matrix by_force = small_masses(system, limit).partialPivLu().solve(L);
  const Matrix grows = growing(R * by_force, [](auto v, double most) { return v.real() < -no_growth * most; });
  return of_unit_size(system, limit.directions, by_force * grows);
}

Matrix runaway_by_stiffness(const System& system, const MasslessLimit& limit) {
  if (limit.condensed() == 0) return Matrix::Zero(limit.count(), 0);
  const Matrix mass = limit.condensed_rows(small_masses(system, limit)) * limit.damping.right_null;
  const Matrix pencil = mass.partialPivLu().solve(limit.stiffness);
  const Matrix grows = growing(pencil, [](auto v, double most) {
    return v.real() < -no_growth * most || std::abs(v.imag()) > no_flutter * std::abs(v);
  });
  return of_unit_size(system, limit.directions, limit.damping.right_null * grows);
}

}  // namespace dynalin
