// Motions of the bodies weighed by the root of their mass: products of weighed columns are those of the mass matrix.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "elements/bodies/fe_part.h"
#include "elements/bodies/flex_body.h"
#include "system/system.h"

namespace dynalin {

// Columns of coordinates become columns of √mass · motion: six rows for each body that has mass, the displacement of
// its mass centre and its rotation in principal axes; one more for each mode of a flexible body, whose rows are the
// parts of its mass matrix, and those of each element of a beam. User units: no factor of consistency.
class MassRoot {
 public:
  MassRoot(const System&, const OperatingPoint&);

  std::size_t bodies() const { return items_.size(); }
  std::size_t body(std::size_t k) const { return items_[k].body; }
  Eigen::Index first_row(std::size_t k) const { return items_[k].first_row; }
  Eigen::Index rows(std::size_t k) const { return 6 + items_[k].modes; }

  Eigen::MatrixXd of(const Eigen::MatrixXd& columns) const;
  // What `of` would give if nothing cancelled, column by column: its rounding is measured against this.
  Eigen::RowVectorXd size_of(const Eigen::MatrixXd& columns) const;
  // The model moved along and turned about three axes at a point.
  Eigen::MatrixXd of_rigid_motion(const Vector& origin, const Matrix3& axes) const;

 private:
  struct Item {
    std::size_t body;
    std::int32_t offset;
    bool turns;
    double mass_root;
    Vector arm, centre{};
    Eigen::Matrix3d inertia_root{};
    Eigen::Index first_row = 0;
    // Of a flexible body: its modes, where they stand among the coordinates, and the root of its mass matrix for
    // motions along global axes.
    Eigen::Index modes = 0;
    std::int32_t first_mode = 0;
    Eigen::MatrixXd root{};
    // Of a beam: its elements, which weigh its nodes and what it has beside them.
    struct Element {
      BeamColumns columns;
      BeamMatrix root;
      BeamMotion motion;
      std::array<Vector, 2> places;
    };
    std::vector<Element> elements{};
  };
  void add_beam(const System&, const Motion&, const BeamBody&, Item&);
  static void weigh_rigid_motion(const Item&, const Vector& origin, const Matrix3& axes, Eigen::MatrixXd& out);
  void add_flexible(const System&, const OperatingPoint&, const FlexibleBody&, Item&);
  Eigen::Index row_count() const { return items_.empty() ? 0 : items_.back().first_row + rows(items_.size() - 1); }

  double length_;
  std::vector<Item> items_;
};

}  // namespace dynalin
