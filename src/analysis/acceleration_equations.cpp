#include "analysis/acceleration_equations.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

ConstraintRows rows_at(const System& system, const OperatingPoint& op) {
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(system.motion(op), rows);
  return rows;
}

}  // namespace

AccelerationEquations::AccelerationEquations(const System& system, const OperatingPoint& op)
    : system_(system),
      augmented_(system),
      rows_(rows_at(system, op)),
      partition_(system.partition(rows_, RowLevel::velocity)),
      massless_(system, op, partition_.active) {
  equations_.resize(system.layout());
  if (massless_.any()) equations_.keep_sizes();
  release();
}

Result<void> AccelerationEquations::look_at_massless(const OperatingPoint& op) {
  if (!massless_.any()) return {};
  evaluate(op, {PartialBy::position, PartialBy::velocity, PartialBy::damping, PartialBy::acceleration,
                PartialBy::lambda, PartialBy::algebraic, PartialBy::state, PartialBy::state_rate});
  const bool undefined = clear_undefined();
  const Motion motion = system_.motion(op);
  auto looked = massless_.look(motion, rows_, equations_);
  if (!looked && undefined) {
    if (std::string reason = system_.undefined_value(motion); !reason.empty())
      return tl::unexpected(Failure{"acceleration initial conditions", std::move(reason), {}, "undefined-value"});
  }
  return looked;
}

Eigen::VectorXd AccelerationEquations::evaluate(const OperatingPoint& op, std::initializer_list<PartialBy> wanted) {
  const Motion motion = system_.motion(op);
  system_.constraints(motion, rows_);
  system_.equations(motion, rows_, equations_, wanted);
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(augmented_.size());
  for (std::int32_t r = 0; r < equations_.size(); ++r) {
    missing(augmented_.equation(r)) = -equations_.residual()[static_cast<std::size_t>(r)];
  }
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (!partition_.active[static_cast<std::size_t>(k)]) continue;
    const Taylor& phi = rows_.along_motion(k);
    missing(augmented_.lambda(k)) = -(rows_.level(k) == RowLevel::position ? phi.acceleration : phi.rate);
  }
  return massless_.bordered(std::move(missing));
}

void AccelerationEquations::release() {
  cut_.assign(system_.layout().algebraic.size(), false);
  held_.assign(system_.layout().states.size(), false);
}

bool AccelerationEquations::hold(const std::vector<bool>& equations, Eigen::VectorXd& missing) {
  bool any = false;
  for (std::int32_t r = equations_.algebraic_row(0); r < equations_.size(); ++r) {
    if (!equations[static_cast<std::size_t>(r)]) continue;
    any = true;
    missing(augmented_.equation(r)) = 0;
    const std::int32_t state = r - equations_.state_row(0);
    if (state < 0) {
      cut_[static_cast<std::size_t>(r - equations_.algebraic_row(0))] = true;
    } else {
      held_[static_cast<std::size_t>(state)] = true;
    }
  }
  return any;
}

bool AccelerationEquations::hold_undefined(Eigen::VectorXd& missing) {
  std::vector<bool> undefined(static_cast<std::size_t>(equations_.size()), false);
  for (std::int32_t r = 0; r < equations_.size(); ++r) {
    undefined[static_cast<std::size_t>(r)] = !std::isfinite(missing(augmented_.equation(r)));
  }
  for (const PartialBy family : unknowns) {
    for_each_entry(equations_.matrix(family), [&](std::int32_t r, std::int32_t, double v) {
      if (!std::isfinite(v)) undefined[static_cast<std::size_t>(r)] = true;
    });
  }
  return hold(undefined, missing);
}

bool AccelerationEquations::hold_reactions(Eigen::VectorXd& missing) {
  std::vector<bool> follows(static_cast<std::size_t>(equations_.size()), false);
  for (const PartialBy family : {PartialBy::acceleration, PartialBy::lambda}) {
    for_each_entry(equations_.matrix(family),
                   [&](std::int32_t r, std::int32_t, double) { follows[static_cast<std::size_t>(r)] = true; });
  }
  return hold(follows, missing);
}

bool AccelerationEquations::linear() const {
  const Layout& layout = system_.layout();
  return !massless_.any() && layout.algebraic.empty() && layout.states.empty() &&
         equations_.matrix(PartialBy::lambda).value.empty();
}

ColumnMatrix AccelerationEquations::augmented_matrix() const {
  return augmented_.matrix(equations_, rows_, partition_.active, {}, cut_, held_);
}

Eigen::VectorXd AccelerationEquations::values(const OperatingPoint& op) const {
  Eigen::VectorXd x(augmented_.size() + massless_.size());
  Eigen::Index at = 0;
  for (const auto* part : {&op.acceleration, &op.lambda, &op.algebraic, &op.state_rate}) {
    for (const double v : *part) x(at++) = v;
  }
  if (massless_.size() > 0) x.tail(massless_.size()) = massless_.values(op);
  return x;
}

Eigen::VectorXd AccelerationEquations::magnitude() const {
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(augmented_.size() + massless_.size());
  for (std::int32_t r = 0; r < equations_.size(); ++r) {
    sizes(augmented_.equation(r)) = equations_.magnitude()[static_cast<std::size_t>(r)];
  }
  return sizes;
}

Eigen::VectorXd AccelerationEquations::terms(const ColumnMatrix& m, const OperatingPoint& op) const {
  Eigen::VectorXd terms = magnitude();
  const Eigen::VectorXd x = values(op);
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { terms(r) += std::abs(v * x(c)); });
  return terms;
}

void AccelerationEquations::move(OperatingPoint& op, const Eigen::Ref<const Eigen::VectorXd>& step) {
  Eigen::Index at = 0;
  for (auto* part : {&op.acceleration, &op.lambda, &op.algebraic, &op.state_rate}) {
    for (double& v : *part) v += step(at++);
  }
  massless_.update(op, step);
}

void AccelerationEquations::spread_over_axes(Eigen::VectorXd& of_unknowns) const {
  for (const BodyBlock& block : system_.layout().bodies) {
    for (std::int32_t k = 0; k < block.count; k += 3) {
      auto three = of_unknowns.segment<3>(block.offset + k);
      three.setConstant(three.maxCoeff());
    }
  }
}

}  // namespace dynalin
