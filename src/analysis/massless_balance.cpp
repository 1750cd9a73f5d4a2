#include "analysis/massless_balance.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "analysis/balance.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;

// A condensed freedom stands where its forces balance if it is no farther off than this part of the model's length (or
// of a radian), or if they miss it by no more than force_balance of themselves.
constexpr double pose_tolerance = 1e-8;

bool states_velocity(const Body& body) {
  const auto stated = [](const auto& values) {
    return std::any_of(values.begin(), values.end(), [](const auto& v) { return v.has_value(); });
  };
  return stated(body.velocity->of_cm) || stated(body.velocity->angular);
}

}  // namespace

MasslessBalance::MasslessBalance(const System& system, const OperatingPoint& op, const std::vector<bool>& active)
    : system_(system), active_(active) {
  if (!lacks_mass(system)) return;
  const Motion motion = system.motion(op);
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(motion, rows);
  directions_ = massless_directions(system, motion, rows, active);
}

Result<void> MasslessBalance::look(const Motion& motion, const ConstraintRows& rows, const Equations& eq) {
  auto limit = massless_limit(system_, motion, rows, eq, {active_, {}, false});
  if (!limit) {
    Failure f = limit.error();
    f.analysis = "acceleration initial conditions";
    return tl::unexpected(std::move(f));
  }
  const Index before = limit_ ? limit_->condensed() : -1;
  limit_ = std::move(*limit);
  if (limit_ && (limit_->condensed() != before || !lacking_.allFinite()))
    lacking_ = Eigen::VectorXd::Zero(limit_->condensed());
  return {};
}

ColumnMatrix MasslessBalance::bordered(const ColumnMatrix& m) const {
  if (!limit_) return m;
  const MasslessDirections& d = limit_->directions;
  std::vector<Triplet> entries;
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
  std::int32_t at = m.rows;
  for (const Index k : limit_->damping.pivot_column) {
    for (Index r = 0; r < limit_->residual_on_rates.rows(); ++r) {
      if (const double v = limit_->residual_on_rates(r, k); v != 0.0)
        entries.push_back({static_cast<std::int32_t>(r), at, v});
    }
    ++at;
  }
  for (const Index k : limit_->damping.other_row)
    entries.push_back({d.coordinate[static_cast<std::size_t>(k)], at++, 1.0});
  at = m.rows;
  for (const std::int32_t c : d.coordinate) entries.push_back({at++, c, 1.0});
  return compressed(at, at, entries);
}

Eigen::VectorXd MasslessBalance::bordered(Eigen::VectorXd residual) const {
  if (!limit_) return residual;
  const Index rows = residual.size();
  residual.conservativeResize(rows + size());
  residual.tail(size()).setZero();
  for (Index k = 0; k < limit_->condensed(); ++k) {
    const Index row = limit_->damping.other_row[static_cast<std::size_t>(k)];
    residual(limit_->directions.coordinate[static_cast<std::size_t>(row)]) -= lacking_(k);
  }
  return residual;
}

Eigen::VectorXd MasslessBalance::values(const OperatingPoint& op) const {
  Eigen::VectorXd all(size());
  Index at = 0;
  if (!limit_) return all;
  for (const Index k : limit_->damping.pivot_column)
    all(at++) = op.velocity[static_cast<std::size_t>(limit_->directions.coordinate[static_cast<std::size_t>(k)])];
  all.tail(limit_->condensed()) = lacking_;
  return all;
}

void MasslessBalance::update(OperatingPoint& op, const Eigen::Ref<const Eigen::VectorXd>& step) {
  if (!limit_) return;
  const Index damped = limit_->damped();
  const Eigen::VectorXd change = limit_->damped_directions() * step.tail(size()).head(damped);
  for (std::size_t k = 0; k < op.velocity.size(); ++k) op.velocity[k] += change(static_cast<Index>(k));
  lacking_ += step.tail(limit_->condensed());
}

Result<void> MasslessBalance::accept(const std::vector<double>& start, const OperatingPoint& found, const Equations& eq,
                                     Findings& findings) const {
  if (!limit_) return {};
  const MasslessDirections& d = limit_->directions;
  const Layout& layout = system_.layout();
  const auto name = [&](Index k) { return layout.coordinate_text(d.coordinate[static_cast<std::size_t>(k)]); };
  // Poses of condensed freedoms.
  if (limit_->condensed() > 0) {
    const Eigen::VectorXd off = limit_->stiffness.partialPivLu().solve(lacking_);
    const Eigen::VectorXd moved = limit_->condensed_directions() * off;
    double farthest = 0;
    for (Index c = 0; c < moved.size(); ++c)
      farthest = std::max(farthest, std::abs(moved(c)) / system_.coordinate_scale(static_cast<std::int32_t>(c)));
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(limit_->left.rows());
    const AugmentedSystem augmented(system_);
    for (std::int32_t r = 0; r < eq.size(); ++r)
      forces(augmented.equation(r)) = eq.magnitude()[static_cast<std::size_t>(r)];
    const Eigen::VectorXd size =
        limit_->damping.left_null.cwiseAbs().transpose() * (limit_->left.cwiseAbs().transpose() * forces);
    if (farthest > pose_tolerance && (lacking_.array().abs() > force_balance * size.array()).any()) {
      Index worst = 0;
      lacking_.cwiseAbs().maxCoeff(&worst);
      const Index column = limit_->damping.other_column[static_cast<std::size_t>(worst)];
      return tl::unexpected(Failure{
          "acceleration initial conditions",
          fmt::format("{} has neither mass nor damping, so its forces must balance where it stands, and they miss by "
                      "{:.5g}: a pose nearer to balance or SIMULATE/STATIC is needed, and velocities that load it must "
                      "agree with its pose",
                      name(column), std::abs(lacking_(worst))),
          {fmt::format("it would balance about {:.5g} away", std::abs(off(worst)))},
          "massless-motion"});
    }
  }
  // Accelerations along the freedoms are not known where the model moves; nothing else may depend on them.
  if (!at_rest(system_, found, d)) {
    Eigen::MatrixXd along = limit_->right;
    along.topRows(d.basis.rows()) -= d.basis;
    for (Index k = 0; k < along.cols(); ++k) {
      const double reach = limit_->right.col(k).head(d.basis.rows()).cwiseAbs().maxCoeff();
      if (along.col(k).cwiseAbs().maxCoeff() <= 1e-9 * reach) continue;
      return tl::unexpected(
          Failure{"acceleration initial conditions",
                  fmt::format("the acceleration of {}, which has no mass, is read by a force or a VARIABLE: that is "
                              "possible at rest only",
                              name(k)),
                  {},
                  "massless-motion"});
    }
  }
  const Eigen::VectorXd velocity = Eigen::Map<const Eigen::VectorXd>(found.velocity.data(), d.basis.rows());
  double fastest = velocity.cwiseAbs().maxCoeff();
  for (const double v : start) fastest = std::max(fastest, std::abs(v));
  for (const Index k : limit_->damping.pivot_column) {
    const auto c = static_cast<std::size_t>(d.coordinate[static_cast<std::size_t>(k)]);
    if (std::abs(found.velocity[c] - start[c]) <= 1e-9 * fastest) continue;
    for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
      const BodyBlock& block = layout.bodies[b];
      const auto at = static_cast<std::int32_t>(c);
      if (at < block.offset || at >= block.offset + block.count || !states_velocity(system_.model().bodies[b]))
        continue;
      findings.warnings.warning(
          "changed-velocity", block.label.at,
          fmt::format("the initial velocity of {} is changed from {:g} to {:g}: it has no mass, and its velocity "
                      "follows from the balance of its forces",
                      name(k), start[c], std::abs(found.velocity[c]) > 1e-12 * fastest ? found.velocity[c] : 0.0));
    }
  }
  return {};
}

}  // namespace dynalin
