// Motions of the bodies weighed by the root of their mass: products of weighed columns are those of the mass matrix.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "system/system.h"

namespace dynalin {

// Columns of coordinates become columns of √mass · motion, with the rows that each body that has mass says
// (BodySource::weighed_parts). User units: no factor of consistency.
class MassRoot {
 public:
  MassRoot(const System&, const OperatingPoint&);

  std::size_t bodies() const { return items_.size(); }
  std::size_t body(std::size_t k) const { return items_[k].body; }
  Eigen::Index first_row(std::size_t k) const { return items_[k].first_row; }
  Eigen::Index rows(std::size_t k) const { return items_[k].rows; }

  Eigen::MatrixXd of(const Eigen::MatrixXd& columns) const;
  // What `of` would give if nothing cancelled, column by column: its rounding is measured against this.
  Eigen::RowVectorXd size_of(const Eigen::MatrixXd& columns) const;
  // The model moved along and turned about three axes at a point.
  Eigen::MatrixXd of_rigid_motion(const Vector& origin, const Matrix3& axes) const;

 private:
  struct Item {
    std::size_t body;
    Eigen::Index first_row, rows;
    std::vector<WeighedPart> parts;
  };
  Eigen::Index row_count() const { return items_.empty() ? 0 : items_.back().first_row + items_.back().rows; }

  const System& system_;
  const Motion motion_;
  double heaviest_ = 0;  // root of the mass
  std::vector<Item> items_;
};

}  // namespace dynalin
