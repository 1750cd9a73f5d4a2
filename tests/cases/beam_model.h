// Bending of a beam in one plane, derived by hand: what datasets of PARTs and BEAMs are compared with. Nothing here
// uses the program's formulas; element matrices are integrals over the static solution of Timoshenko's equations.
//
// Node k has the deflection w and the rotation θ, in this order; w″ > 0 where θ grows.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <vector>

namespace dynalin::cases {

struct Section {
  double EI = 1;     // [force·length²]
  double shear = 0;  // EI/(κ G A) [length²], 0: no shear deflection
  double rho_A = 1;  // [mass/length]
  double rho_I = 0;  // rotary inertia about a diameter [mass·length]
};

// Of (w, θ) at the near end J and the far end I.
struct ElementMatrices {
  Eigen::Matrix4d K, M, P;  // stiffness, consistent mass with rotary inertia, ∫ 2ρI θ² (polar, for gyroscopic terms)
};

// Without load the deflection is a cubic w and the rotation is θ = w′ + shear·w‴, since EI θ″ = −κGA (w′ − θ).
inline ElementMatrices element_matrices(const Section& s, double h) {
  const auto w = [](double x) { return Eigen::RowVector4d(1, x, x * x, x * x * x); };
  const auto theta = [&](double x) { return Eigen::RowVector4d(0, 1, 2 * x, 3 * x * x + 6 * s.shear); };
  Eigen::Matrix4d ends;
  ends << w(0), theta(0), w(h), theta(h);
  const Eigen::Matrix4d shape = ends.inverse();
  ElementMatrices e{Eigen::Matrix4d::Zero(), Eigen::Matrix4d::Zero(), Eigen::Matrix4d::Zero()};
  // Gauss's rule of four points is exact for the sextic w².
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)),
               outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double heavy = (18 + std::sqrt(30.0)) / 36, light = (18 - std::sqrt(30.0)) / 36;
  for (const auto& [at, weight] : {std::pair{-outer, light}, {-inner, heavy}, {inner, heavy}, {outer, light}}) {
    const double x = h / 2 * (1 + at), dx = h / 2 * weight;
    const Eigen::RowVector4d W = w(x) * shape, T = theta(x) * shape, bend = Eigen::RowVector4d(0, 0, 2, 6 * x) * shape,
                             slip = Eigen::RowVector4d(0, 0, 0, -6) * shape;  // (w′ − θ)/shear
    e.K += dx * s.EI * (bend.transpose() * bend + s.shear * slip.transpose() * slip);
    e.M += dx * (s.rho_A * W.transpose() * W + s.rho_I * T.transpose() * T);
    e.P += dx * 2 * s.rho_I * T.transpose() * T;
  }
  return e;
}

// The tangent of an element whose force is linear in the axes of J and acts at I, the opposite on J's body at the same
// point, while N pushes I away from J and both are `arm` apart. With y = w_I − w_J − arm θ_J and φ = θ_I − θ_J
//
//     f_I = N θ_J − k22 y − k26 φ,   m_I = −k26 y − k66 φ,   f_J = −f_I,   m_J = −m_I − arm f_I + N (w_I − w_J)
//
// The first term turns N with J, the last is the moment of N about J. Returned is −∂(f_J, m_J, f_I, m_I)/∂(w_J … θ_I).
inline Eigen::Matrix4d loaded_stiffness(const Eigen::Matrix4d& K, double N, double arm) {
  const Eigen::RowVector4d y(-1, -arm, 1, 0), phi(0, -1, 0, 1), turn(0, 1, 0, 0), offset(-1, 0, 1, 0);
  const Eigen::RowVector4d f = N * turn - K(2, 2) * y - K(2, 3) * phi, m = -K(3, 2) * y - K(3, 3) * phi;
  Eigen::Matrix4d tangent;
  tangent << -f, -m - arm * f + N * offset, f, m;
  return -tangent;
}

inline void add(Eigen::MatrixXd& sum, const Eigen::Matrix4d& element, int near_node) {
  sum.block<4, 4>(2 * near_node, 2 * near_node) += element;
}

// λ² of M q″ + K q = 0 without the first node, which is clamped; sorted by −Re λ².
inline std::vector<std::complex<double>> clamped_squares(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const auto n = K.rows() - 2;
  const Eigen::MatrixXd A = -M.bottomRightCorner(n, n).partialPivLu().solve(K.bottomRightCorner(n, n));
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  std::vector<std::complex<double>> list(values.begin(), values.end());
  std::sort(list.begin(), list.end(), [](auto a, auto b) { return a.real() > b.real(); });
  return list;
}

// Limit of values at h, h/2, h/4 … whose error is a series in h², h⁴, h⁶ …, or in h², h³, h⁴ …
enum class Powers { even, all };
inline double extrapolated(std::vector<double> values, Powers powers = Powers::even) {
  double factor = 4;
  for (std::size_t left = values.size() - 1; left > 0; --left, factor *= powers == Powers::even ? 4 : 2) {
    for (std::size_t k = 0; k < left; ++k) values[k] = (factor * values[k + 1] - values[k]) / (factor - 1);
  }
  return values[0];
}

}  // namespace dynalin::cases
