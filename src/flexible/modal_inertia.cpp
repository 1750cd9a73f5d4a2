#include "flexible/modal_inertia.h"

namespace dynalin {

using Index = Eigen::Index;

ModalInertia empty_inertia(std::size_t modes) {
  ModalInertia I;
  const auto n = static_cast<Index>(modes);
  I.of_modes.assign(modes, Vector{});
  I.turning.assign(modes, Vector{});
  I.tensor = Matrix3{};
  I.tensor_by_mode.assign(modes, Matrix3{});
  for (Eigen::MatrixXd& m : I.turning_by_mode) m = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::MatrixXd& m : I.tensor_by_modes) m = Eigen::MatrixXd::Zero(n, n);
  I.modal = Eigen::MatrixXd::Zero(n, n);
  return I;
}

void ModalInertia::keep(const std::array<bool, 9>& which) {
  const ModalInertia none = empty_inertia(modes());
  if (!which[0]) mass = 0;
  if (!which[1]) first = Vector{};
  if (!which[2]) of_modes = none.of_modes;
  if (!which[3]) turning = none.turning;
  if (!which[4]) turning_by_mode = none.turning_by_mode;
  if (!which[5]) modal = none.modal;
  if (!which[6]) tensor = Matrix3{};
  if (!which[7]) tensor_by_mode = none.tensor_by_mode;
  if (!which[8]) tensor_by_modes = none.tensor_by_modes;
}

Vector ModalInertia::moment(const Eigen::VectorXd& q) const {
  Vector c = first;
  for (std::size_t k = 0; k < modes(); ++k) c += q(static_cast<Index>(k)) * of_modes[k];
  return c;
}

Matrix3 ModalInertia::tensor_at(const Eigen::VectorXd& q) const {
  Matrix3 J = tensor;
  for (std::size_t k = 0; k < modes(); ++k) J += q(static_cast<Index>(k)) * tensor_by_mode[k];
  for (std::size_t c = 0; c < tensor_components.size(); ++c) {
    const auto [i, k] = tensor_components[c];
    const double x = 0.5 * q.dot(tensor_by_modes[c] * q);
    J(i, k) += x;
    if (i != k) J(k, i) += x;
  }
  return J;
}

std::vector<Vector> ModalInertia::turning_at(const Eigen::VectorXd& q) const {
  std::vector<Vector> G = turning;
  for (std::size_t c = 0; c < 3; ++c) {
    const Eigen::VectorXd x = turning_by_mode[c].transpose() * q;
    for (std::size_t k = 0; k < modes(); ++k) G[k][c] += x(static_cast<Index>(k));
  }
  return G;
}

Eigen::MatrixXd ModalInertia::matrix(const Eigen::VectorXd& q) const {
  const auto n = static_cast<Index>(modes());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6 + n, 6 + n);
  const Matrix3 c = skew(moment(q)), J = tensor_at(q);
  const std::vector<Vector> G = turning_at(q);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto r = static_cast<Index>(i);
    M(r, r) = mass;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto col = static_cast<Index>(k);
      M(r, 3 + col) = -c(i, k), M(3 + col, r) = -c(i, k);
      M(3 + r, 3 + col) = J(i, k);
    }
    for (std::size_t k = 0; k < modes(); ++k) {
      const auto col = 6 + static_cast<Index>(k);
      M(r, col) = M(col, r) = of_modes[k][i];
      M(3 + r, col) = M(col, 3 + r) = G[k][i];
    }
  }
  M.bottomRightCorner(n, n) = modal;
  return M;
}

ModalInertia inertia_of(const MassPoints& points) {
  const Index n = points.translation.cols(), count = static_cast<Index>(points.mass.size());
  ModalInertia I = empty_inertia(static_cast<std::size_t>(n));
  for (Index p = 0; p < count; ++p) {
    const auto at = static_cast<std::size_t>(p);
    const double m = points.mass[at];
    const Matrix3 s = skew(points.at[at]);
    const Matrix3& own = points.own[at];
    I.mass += m;
    I.first += m * points.at[at];
    I.tensor += m * (transpose(s) * s) + own;
    const auto phi = points.translation.middleRows(3 * p, 3), psi = points.rotation.middleRows(3 * p, 3);
    for (Index k = 0; k < n; ++k) {
      const auto mode = static_cast<std::size_t>(k);
      const Vector moves{phi(0, k), phi(1, k), phi(2, k)}, turns{psi(0, k), psi(1, k), psi(2, k)};
      I.of_modes[mode] += m * moves;
      I.turning[mode] += m * cross(points.at[at], moves) + own * turns;
      const Matrix3 product = m * (s * skew(moves));
      I.tensor_by_mode[mode] += -(product + transpose(product));
    }
    Eigen::Matrix3d J;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) J(static_cast<Index>(r), static_cast<Index>(c)) = own(r, c);
    }
    if (!J.isZero(0)) I.modal.noalias() += psi.transpose() * J * psi;
  }
  // Σ m φ_ja φ_kb of all pairs of modes, from which all that is quadratic follows.
  const Eigen::VectorXd mass = Eigen::Map<const Eigen::VectorXd>(points.mass.data(), count);
  std::array<Eigen::MatrixXd, 3> along;
  for (std::size_t a = 0; a < 3; ++a)
    along[a] = points.translation(Eigen::seqN(static_cast<Index>(a), count, Eigen::fix<3>), Eigen::all);
  std::array<std::array<Eigen::MatrixXd, 3>, 3> product;
  for (std::size_t a = 0; a < 3; ++a) {
    const Eigen::MatrixXd weighed = mass.asDiagonal() * along[a];
    for (std::size_t b = 0; b < 3; ++b) product[a][b] = weighed.transpose() * along[b];
    I.modal += product[a][a];
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t a = (c + 1) % 3, b = (c + 2) % 3;
    I.turning_by_mode[c] = product[a][b] - product[a][b].transpose();
  }
  // φ_j^ φ_k^ = φ_k φ_jᵀ − (φ_j·φ_k) 1
  for (std::size_t c = 0; c < tensor_components.size(); ++c) {
    const auto [a, b] = tensor_components[c];
    I.tensor_by_modes[c] =
        a != b ? Eigen::MatrixXd(-product[a][b] - product[a][b].transpose())
               : Eigen::MatrixXd(2 * (product[(a + 1) % 3][(a + 1) % 3] + product[(a + 2) % 3][(a + 2) % 3]));
  }
  return I;
}

}  // namespace dynalin
