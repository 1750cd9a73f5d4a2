// How far off the equations of rest may be because numbers are rounded.
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/static_equations.h"
#include "analysis/values_in_order.h"

namespace dynalin {

void StaticEquations::measure_rounding(const OperatingPoint& op) {
  const Layout& layout = system_.layout();
  Eigen::VectorXd size = Eigen::VectorXd::Ones(augmented_.size());
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    for (std::int32_t k = 0; k < std::min(block.count, 3); ++k) size(block.offset + k) = norm(op.poses[b].r);
  }
  const auto sizes = [&](const std::vector<double>& x, std::int32_t offset) {
    for (std::size_t k = 0; k < x.size(); ++k) size(offset + static_cast<Eigen::Index>(k)) = std::abs(x[k]);
  };
  sizes(op.extra, layout.body_coordinate_count);
  // Slopes and turns of nodes are parts of directions, whose other components are one.
  for (const ExtraBlock& e : layout.extras) {
    if (e.kind.role == ExtraRole::nodal)
      size.segment(e.offset, e.count) = size.segment(e.offset, e.count).cwiseMax(1.0);
  }
  sizes(op.lambda, augmented_.lambda(0));
  sizes(op.algebraic, augmented_.algebraic(0));
  sizes(op.state, augmented_.state(0));
  rounding_of_terms_ = magnitude_;
  Eigen::VectorXd by_place = Eigen::VectorXd::Zero(augmented_.size()), terms = by_place;
  const auto take = [&](PartialBy family, std::int32_t offset, Eigen::VectorXd& sum) {
    for_each_entry(eq_.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
      sum(augmented_.equation(r)) += std::abs(v) * size(offset + c);
      terms(augmented_.equation(r)) += 1;
    });
  };
  take(PartialBy::position, 0, by_place);
  take(PartialBy::state, augmented_.state(0), by_place);
  if (motion_) {
    Eigen::VectorXd speed = Eigen::VectorXd::Zero(augmented_.size());
    for (std::size_t k = 0; k < op.velocity.size(); ++k) speed(static_cast<Eigen::Index>(k)) = std::abs(op.velocity[k]);
    for (const BodyBlock& block : layout.bodies) {
      if (block.count >= 3) speed.segment(block.offset, 3).setConstant(speed.segment(block.offset, 3).maxCoeff());
    }
    for (const PartialBy family : {PartialBy::velocity, PartialBy::damping}) {
      for_each_entry(eq_.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
        rounding_of_terms_(augmented_.equation(r)) += std::abs(v) * speed(c);
      });
    }
  }
  take(PartialBy::lambda, augmented_.lambda(0), rounding_of_terms_);
  take(PartialBy::algebraic, augmented_.algebraic(0), rounding_of_terms_);
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (!part_.active[static_cast<std::size_t>(k)]) continue;
    for (const auto& e : rows_.row(k)) {
      by_place(augmented_.lambda(k)) += std::abs(e.c.g) * size(e.column);
      rounding_of_terms_(e.column) += std::abs(e.c.g) * size(augmented_.lambda(k));
    }
  }
  // Each partial sum of many terms is rounded; of a few, that is less than what estimates allow for.
  constexpr double epsilon = std::numeric_limits<double>::epsilon(), few = 50;
  rounding_of_terms_ = epsilon * rounding_of_terms_.cwiseProduct((terms / few).cwiseMax(1.0));
  rounding_ = rounding_of_terms_ + epsilon * by_place;
  carry_rounding_of_values();
  rounding_of_unknowns_ = epsilon * size;
}

// A value is off by what its equation is; so is what reads it.
void StaticEquations::carry_rounding_of_values() {
  const auto count = static_cast<std::int32_t>(system_.layout().algebraic.size());
  const ColumnMatrix& partials = eq_.matrix(PartialBy::algebraic);
  const auto is_value = [&](std::int32_t r) { return r >= coordinates_ && r < coordinates_ + count; };
  ValuesInOrder values(count);
  for_each_entry(partials, [&](std::int32_t r, std::int32_t c, double v) {
    if (is_value(r) && r - coordinates_ != c && v != 0) values.reads(r - coordinates_, c, v);
  });
  const std::int32_t first = augmented_.algebraic(0);
  values.for_each_reading([&](std::int32_t reader, std::int32_t read, double slope) {
    rounding_(first + reader) += std::abs(slope) * rounding_(first + read);
  });
  for_each_entry(partials, [&](std::int32_t r, std::int32_t c, double v) {
    if (!is_value(r)) rounding_(augmented_.equation(r)) += std::abs(v) * rounding_(first + c);
  });
}

double StaticEquations::excess() const {
  double worst = 0;
  for (Eigen::Index k = 0; k < residual_.size(); ++k) {
    if (residual_(k) != 0) worst = std::max(worst, std::abs(residual_(k)) / rounding_(k));
  }
  return worst;
}

bool StaticEquations::is_moved_by_rounding_alone() const {
  double most = 0;
  for (std::int32_t k = 0; k < coordinates_; ++k) most = std::max(most, rounding_(k) * force_unit(k));
  return imbalance() <= most;
}

}  // namespace dynalin
