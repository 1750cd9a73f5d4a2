// The inertia of a body that moves as a whole and by N modal coordinates q, by its nine invariants.
//
// With p the mass points of the body, s their places in the BCS, φ and ψ the translation and rotation of each by a unit
// of each coordinate, J their own inertia, and v^ the matrix of the cross product by v:
//
//     I1 = Σ m              I4_j = Σ m s×φ_j + J ψ_j       I7 = Σ m (s^)ᵀ s^ + J
//     I2 = Σ m s            I5_jk = Σ m φ_j×φ_k            I8_j = Σ m s^ φ_j^
//     I3_j = Σ m φ_j        I6_jk = Σ m φ_j·φ_k + ψ_j·J ψ_k     I9_jk = Σ m φ_j^ φ_k^
//
// The kinetic energy, with the velocity u of the BCS and its angular velocity w along its own axes, is
//
//     T = ½ I1 u·u + u·(w × c) + u·Σ I3_k q_k′ + ½ w·J w + w·Σ G_k q_k′ + ½ q′·I6 q′
//     c = I2 + Σ I3_j q_j,  G_k = I4_k + Σ I5_jk q_j,  J = I7 − Σ (I8_j + I8_jᵀ) q_j − Σ I9_jk q_j q_k
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/vec3.h"

namespace dynalin {

// Masses in units of mass, lengths and modal coordinates as the body has them.
struct ModalInertia {
  double mass = 0;                                 // I1
  Vector first;                                    // I2
  std::vector<Vector> of_modes;                    // I3
  std::vector<Vector> turning;                     // I4
  std::array<Eigen::MatrixXd, 3> turning_by_mode;  // I5, a matrix (j, k) for each axis, skew in (j, k)
  Eigen::MatrixXd modal;                           // I6
  Matrix3 tensor;                                  // I7
  std::vector<Matrix3> tensor_by_mode;             // −(I8_j + I8_jᵀ): how J changes with q_j at q = 0
  // −(I9_jk + I9_kj): how that changes with q_k. Components xx, yy, zz, xy, xz, yz, each symmetric in (j, k).
  std::array<Eigen::MatrixXd, 6> tensor_by_modes;

  std::size_t modes() const { return of_modes.size(); }

  // Which of the nine count, those that do not become zero.
  void keep(const std::array<bool, 9>& which);

  // c, J and G at modal coordinates; the matrix of T in (u, w, q′), BCS axes.
  Vector moment(const Eigen::VectorXd& q) const;
  Matrix3 tensor_at(const Eigen::VectorXd& q) const;
  std::vector<Vector> turning_at(const Eigen::VectorXd& q) const;
  Eigen::MatrixXd matrix(const Eigen::VectorXd& q) const;
};

inline constexpr std::array<std::array<std::size_t, 2>, 6> tensor_components = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

// All nine without modes of their own yet.
ModalInertia empty_inertia(std::size_t modes);

// Mass points of a body and how they follow the modal coordinates.
struct MassPoints {
  std::vector<double> mass;
  std::vector<Vector> at;
  std::vector<Matrix3> own;               // inertia of each about itself
  Eigen::MatrixXd translation, rotation;  // x, y, z of each point in turn, a column for each coordinate
};
ModalInertia inertia_of(const MassPoints&);

}  // namespace dynalin
