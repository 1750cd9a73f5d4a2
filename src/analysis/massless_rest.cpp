// Whether freedoms without mass are looked at in a model at rest.
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/massless.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;

// Of the sums of the balance, what a unit in the last place of positions may make of stiff elements.
constexpr double cancelled_rounding = cancelled_units * std::numeric_limits<double>::epsilon();

}  // namespace

bool at_rest(const System& system, const OperatingPoint& op, const MasslessDirections& d) {
  const auto n = static_cast<Index>(op.velocity.size());
  Eigen::VectorXd velocity = Eigen::Map<const Eigen::VectorXd>(op.velocity.data(), n);
  const double fastest = n > 0 ? velocity.cwiseAbs().maxCoeff() : 0;
  for (Index k = 0; k < d.count(); ++k) {
    velocity -= op.velocity[static_cast<std::size_t>(d.coordinate[static_cast<std::size_t>(k)])] * d.basis.col(k);
  }
  if (n > 0 && velocity.cwiseAbs().maxCoeff() > 1e-12 * fastest) return false;

  OperatingPoint still = op;
  for (auto* x : {&still.velocity, &still.acceleration, &still.state_rate}) std::fill(x->begin(), x->end(), 0.0);
  const Layout& layout = system.layout();
  ConstraintRows rows;
  rows.resize(layout);
  Equations eq, later;
  eq.resize(layout), later.resize(layout);
  Motion motion = system.motion(still);
  system.constraints(motion, rows);
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const Taylor& phi = rows.along_motion(k);
    if (phi.rate != 0.0 || (rows.level(k) == RowLevel::position && phi.acceleration != 0.0)) return false;
  }
  system.equations(motion, rows, eq, {PartialBy::position, PartialBy::algebraic});
  // What a unit in the last place of positions makes of stiff elements is rest as well.
  std::vector<double> blurred(static_cast<std::size_t>(eq.size()), 0.0);
  std::vector<double> far(static_cast<std::size_t>(layout.coordinate_count));
  for (std::int32_t c = 0; c < layout.coordinate_count; ++c)
    far[static_cast<std::size_t>(c)] = system.coordinate_scale(c);
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    for (std::int32_t k = 0; k < std::min(layout.bodies[b].count, std::int32_t{3}); ++k)
      far[static_cast<std::size_t>(layout.bodies[b].offset + k)] += norm(op.poses[b].r);
  }
  for_each_entry(eq.matrix(PartialBy::position), [&](std::int32_t r, std::int32_t c, double v) {
    blurred[static_cast<std::size_t>(r)] += cancelled_rounding * std::abs(v) * far[static_cast<std::size_t>(c)];
  });
  // Forces that are functions pass on what their values are rounded by.
  const std::vector<double> direct = blurred;
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<double> next = direct;
    for_each_entry(eq.matrix(PartialBy::algebraic), [&](std::int32_t r, std::int32_t c, double v) {
      const auto own = static_cast<std::size_t>(eq.algebraic_row(c));
      if (r != eq.algebraic_row(c)) next[static_cast<std::size_t>(r)] += std::abs(v) * blurred[own];
    });
    blurred = std::move(next);
  }
  constexpr double static_imbalance = 1e-7;
  const auto balanced = [&](std::int32_t first, std::int32_t last) {
    double most = 0, size = 0;
    for (std::int32_t r = first; r < last; ++r) {
      const auto at = static_cast<std::size_t>(r);
      most = std::max(most, std::abs(eq.residual()[at]) - blurred[at]);
      size = std::max(size, eq.magnitude()[at]);
    }
    return most <= static_imbalance * size;
  };
  const std::int32_t coordinates = layout.coordinate_count;
  if (!balanced(0, coordinates) || !balanced(eq.state_row(0), eq.size())) return false;
  for (const double ahead : {0x1p-20, 0x1p-8}) {
    motion.time = op.time + ahead * std::max(1.0, std::abs(op.time));
    system.equations(motion, rows, later, {PartialBy::position, PartialBy::algebraic});
    if (!std::equal(eq.residual().begin(), eq.residual().end(), later.residual().begin())) return false;
  }
  return true;
}

}  // namespace dynalin
