#include "modal/mass_root.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

namespace {

// The coordinates that belong to a part, moved to the point that it weighs.
Matrix own_rows(const WeighedPart& part, const Matrix& columns) {
  Matrix own = Matrix::Zero(static_cast<Index>(part.columns.size()), columns.cols());
  for (std::size_t k = 0; k < part.columns.size(); ++k) {
    if (part.columns[k] >= 0) own.row(static_cast<Index>(k)) = columns.row(part.columns[k]);
  }
  if (own.rows() < 6 || dot(part.arm, part.arm) == 0) return own;
  for (Index c = 0; c < own.cols(); ++c) {
    const Vector v = cross(Vector{own(3, c), own(4, c), own(5, c)}, part.arm);
    for (std::size_t i = 0; i < 3; ++i) own(static_cast<Index>(i), c) += v[i];
  }
  return own;
}

}  // namespace

MassRoot::MassRoot(const System& system, const OperatingPoint& op) : system_(system), motion_(system.motion(op)) {
  Index next = 0;
  for (const BodySource* body : system.bodies()) {
    Item item{static_cast<std::size_t>(body->bodies().front().index), next, 0, body->weighed_parts(motion_)};
    if (item.parts.empty()) continue;
    for (const WeighedPart& part : item.parts) item.rows += part.root.rows();
    next += item.rows;
    heaviest_ = std::max(heaviest_, std::sqrt(body->mass()));
    items_.push_back(std::move(item));
  }
}

Matrix MassRoot::of(const Matrix& columns) const {
  Matrix out = Matrix::Zero(row_count(), columns.cols());
  Index next = 0;
  for (const Item& item : items_) {
    for (const WeighedPart& part : item.parts) {
      out.middleRows(next, part.root.rows()) = part.root * own_rows(part, columns);
      next += part.root.rows();
    }
  }
  return out;
}

Eigen::RowVectorXd MassRoot::size_of(const Matrix& columns) const {
  return heaviest_ * std::max(system_.length(), 1.0) * columns.cwiseAbs().colwise().maxCoeff();
}

Matrix MassRoot::of_rigid_motion(const Vector& origin, const Matrix3& axes) const {
  const Layout& layout = system_.layout();
  Matrix motion = Matrix::Zero(layout.coordinate_count, 6);
  for (std::size_t d = 0; d < 3; ++d) {
    const Vector& axis = axes[d];
    const auto moved = static_cast<Index>(d), turned = moved + 3;
    const auto put = [&](std::int32_t row, Index column, const Vector& v) {
      for (std::size_t i = 0; i < 3; ++i) motion(row + static_cast<Index>(i), column) = v[i];
    };
    for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
      const BodyBlock& block = layout.bodies[b];
      if (block.count == 0) continue;
      put(block.offset, moved, axis);
      put(block.offset, turned, cross(axis, motion_.bodies[b].r - origin));
      if (block.turns()) put(block.offset + 3, turned, axis);
    }
    for (const TurningWhole& whole : layout.turning_wholes) {
      for (const std::size_t k : whole.vectors) {
        const Vector v{motion_.extra[k], motion_.extra[k + 1], motion_.extra[k + 2]};
        put(layout.body_coordinate_count + static_cast<std::int32_t>(k), turned, cross(axis, v));
      }
    }
  }
  return of(motion);
}

}  // namespace dynalin
