// Whether what elements do to bodies is merely carried along: rows that vanish for those directions along which every
// force W_e changes as one small motion of the axes takes it, δW_e = τ × W_e, reactions up to their own multipliers.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "structural_zeros/element_partials.h"

namespace dynalin {

// Of an element's own size: rounding of its partials and of the motion that they are multiplied with; and where motions
// are well conditioned, as most are.
constexpr double vanishing = 1e-13, surely_vanishing = 4e-15;

class CarriedForces {
 public:
  CarriedForces(const System&, const Motion&, const ConstraintRows&, const ElementPartials&);

  // Rows for all forces, each in units of its element's size.
  void add(const Directions&, std::vector<Eigen::RowVectorXd>& rows) const;

 private:
  struct OnBody;

  void see_from_fixed_points(const Directions&, std::int32_t body, OnBody&) const;
  OnBody of_law(const Directions&, const ElementTrace::Law&) const;
  void add_group(const std::vector<const OnBody*>&, const Eigen::Vector3d& origin, Eigen::Index directions,
                 std::vector<Eigen::RowVectorXd>& rows) const;
  Eigen::Vector3d place_of(std::int32_t body) const { return places_[static_cast<std::size_t>(body)]; }

  const std::vector<BodyBlock> bodies_;
  const double length_;
  const ConstraintRows& rows_;
  const ElementPartials& partials_;
  std::vector<Eigen::Vector3d> places_;  // of the BCS of bodies
  std::vector<std::int32_t> body_of_;    // rows of the balance, −1 outside bodies
};

}  // namespace dynalin
