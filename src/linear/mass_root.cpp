#include "linear/mass_root.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace dynalin {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

MassRoot::MassRoot(const System& system, const OperatingPoint& op) : length_(system.length()) {
  const Layout& layout = system.layout();
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    const Body& body = system.model().bodies[b];
    if (block.count == 0 || body.user_mass == 0) continue;
    Item item{b, block.offset, block.turns(), std::sqrt(body.user_mass), op.poses[b].R * body.p_BC};
    item.centre = op.poses[b].r + item.arm;
    const Matrix3 J = op.poses[b].R * body.J_BC * transpose(op.poses[b].R);
    const double factor = body.user_mass / body.mass;
    Eigen::Matrix3d inertia;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) inertia(r, c) = factor * J(static_cast<std::size_t>(r), static_cast<std::size_t>(c));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia);
    item.inertia_root =
        principal.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * principal.eigenvectors().transpose();
    items_.push_back(item);
  }
}

Matrix MassRoot::of(const Matrix& columns) const {
  Matrix out = Matrix::Zero(6 * static_cast<Index>(items_.size()), columns.cols());
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    Matrix move = columns.middleRows(item.offset, 3);
    if (item.turns) {
      const Matrix turn = columns.middleRows(item.offset + 3, 3);
      for (Index c = 0; c < columns.cols(); ++c) {
        const Vector v = cross(Vector{turn(0, c), turn(1, c), turn(2, c)}, item.arm);
        for (std::size_t i = 0; i < 3; ++i) move(static_cast<Index>(i), c) += v[i];
      }
      out.middleRows(6 * static_cast<Index>(k) + 3, 3) = item.inertia_root * turn;
    }
    out.middleRows(6 * static_cast<Index>(k), 3) = item.mass_root * move;
  }
  return out;
}

Eigen::RowVectorXd MassRoot::size_of(const Matrix& columns) const {
  double heaviest = 0;
  for (const Item& item : items_) heaviest = std::max(heaviest, item.mass_root);
  return heaviest * std::max(length_, 1.0) * columns.cwiseAbs().colwise().maxCoeff();
}

Matrix MassRoot::of_rigid_motion(const Vector& origin, const Matrix3& axes) const {
  Matrix out = Matrix::Zero(6 * static_cast<Index>(items_.size()), 6);
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const auto at = 6 * static_cast<Index>(k);
    for (std::size_t d = 0; d < 3; ++d) {
      const Vector e{axes(0, d), axes(1, d), axes(2, d)};
      const Vector by_turn = cross(e, items_[k].centre - origin);
      const Eigen::Vector3d axis(e[0], e[1], e[2]);
      out.block(at, static_cast<Index>(d), 3, 1) = items_[k].mass_root * axis;
      out.block(at, static_cast<Index>(d) + 3, 3, 1) =
          items_[k].mass_root * Eigen::Vector3d(by_turn[0], by_turn[1], by_turn[2]);
      if (items_[k].turns) out.block(at + 3, static_cast<Index>(d) + 3, 3, 1) = items_[k].inertia_root * axis;
    }
  }
  return out;
}

}  // namespace dynalin
