#include "analysis/velocity_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "system/undefined_rows.h"

namespace dynalin {

namespace {

constexpr double affine = 1e-12;  // rounding of gradients

}  // namespace

Miss miss(const VelocityCondition& c, const Eigen::VectorXd& velocity) {
  Miss m{-c.value, std::abs(c.value)};
  for (std::size_t i = 0; i < c.column.size(); ++i) {
    const double term = c.coefficient[i] * velocity(c.column[i]);
    m.value += term;
    m.size = std::max(m.size, std::abs(term));
  }
  return m;
}

bool met_to_rounding(const VelocityCondition& c, const Eigen::VectorXd& velocity) {
  const Miss off = miss(c, velocity);
  return std::abs(off.value) <= 4 * std::numeric_limits<double>::epsilon() * off.size;
}

std::vector<VelocityCondition> stated_velocities(const System& system, const Motion& motion, const Restated& restated) {
  constexpr auto &cm_names = StatedVelocity::cm_names, &angular_names = StatedVelocity::angular_names;
  std::vector<VelocityCondition> conditions;
  const Model& model = system.model();
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    const BodyBlock& block = system.layout().bodies[b];
    const Vector c = motion.bodies[b].R * body.p_BC;
    for (std::size_t k = 0; k < 3; ++k) {
      if (body.velocity->of_cm[k] && restated.holds(body.label, cm_names[k])) {
        const Vector a = motion.axes(system.layout().marker(body.velocity->cm_axes))[k];
        const Vector turn = cross(c, a);
        VelocityCondition s{{},
                            {},
                            *body.velocity->of_cm[k],
                            fmt::format("{} of {}", cm_names[k], body.label.full_text()),
                            body.label.at};
        for (std::int32_t i = 0; i < block.count; ++i) {
          const auto at = static_cast<std::size_t>(i);
          s.column.push_back(block.offset + i);
          s.coefficient.push_back(i < 3 ? a[at] : turn[at - 3]);
        }
        conditions.push_back(std::move(s));
      }
      if (body.velocity->angular[k] && block.turns() && restated.holds(body.label, angular_names[k])) {
        const MarkerId axes = body.velocity->angular_axes;  // those of the BCS, where no marker has them
        const Vector a = (axes.valid() ? motion.axes(system.layout().marker(axes)) : motion.bodies[b].R)[k];
        VelocityCondition s{{},
                            {},
                            *body.velocity->angular[k],
                            fmt::format("{} of {}", angular_names[k], body.label.full_text()),
                            body.label.at};
        for (std::int32_t i = 0; i < 3; ++i) {
          s.column.push_back(block.offset + 3 + i);
          s.coefficient.push_back(a[static_cast<std::size_t>(i)]);
        }
        conditions.push_back(std::move(s));
      }
    }
  }
  // What elements ask: the rate of their row.
  const std::vector<StartCondition>& starts = system.starts();
  ConstraintRows rows;
  rows.resize(system.layout(), starts.size());
  rows.begin();
  system.start_rows(motion, 0, rows);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    if (!starts[k].velocity || !restated.holds(*starts[k].owner, starts[k].arguments.velocity)) continue;
    VelocityCondition s{{},
                        {},
                        *starts[k].velocity,
                        fmt::format("of the {} of {}", starts[k].name, starts[k].owner->full_text()),
                        starts[k].owner->at};
    for (const auto& e : rows.row(static_cast<std::int32_t>(k))) {
      s.column.push_back(e.column);
      s.coefficient.push_back(e.c.g);
    }
    conditions.push_back(std::move(s));
  }
  return conditions;
}

AffineRows::AffineRows(const System& system, const OperatingPoint& op) : system_(system), op_(op) {
  linearize_about(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(system.coordinates())));
}

void AffineRows::linearize_about(Eigen::VectorXd about) {
  about_ = std::move(about);
  op_.velocity.assign(about_.data(), about_.data() + about_.size());
  std::fill(op_.acceleration.begin(), op_.acceleration.end(), 0.0);
  rows_.resize(system_.layout());
  system_.constraints(system_.motion(op_), rows_);
}

std::string AffineRows::undefined() const { return undefined_row(system_, system_.motion(op_), rows_, 1).value_or(""); }

bool AffineRows::are_curved() const {
  const auto on_velocities = [&](std::int32_t k) { return rows_.level(k) == RowLevel::velocity; };
  std::vector<std::int32_t> list;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (on_velocities(k)) list.push_back(k);
  }
  if (list.empty()) return false;
  AffineRows other(*this);
  Eigen::VectorXd probe(about_.size());
  for (Eigen::Index k = 0; k < probe.size(); ++k) {
    const auto at = static_cast<std::int32_t>(k);
    probe(k) = about_(k) + system_.coordinate_scale(at) * (1 + std::sin(static_cast<double>(k) + 1) / 2);
  }
  other.linearize_about(std::move(probe));
  return std::any_of(list.begin(), list.end(), [&](std::int32_t k) {
    const auto here = rows_.row(k), there = other.rows_.row(k);
    return !std::equal(here.begin(), here.end(), there.begin(), there.end(), [](const auto& a, const auto& b) {
      return a.column == b.column && std::abs(a.c.g - b.c.g) <= affine * std::max(std::abs(a.c.g), std::abs(b.c.g));
    });
  });
}

void AffineRows::set(std::int32_t k, VelocityCondition& c) const {
  const bool position = rows_.level(k) == RowLevel::position;
  c.value = position ? -rows_.along_motion(k).rate : -rows_.along_motion(k).value;
  c.column.clear(), c.coefficient.clear();
  for (const auto& e : rows_.row(k)) {
    c.column.push_back(e.column);
    c.coefficient.push_back(e.c.g);
    if (about_(e.column) != 0) c.value += e.c.g * about_(e.column);
  }
}

std::vector<VelocityCondition> AffineRows::conditions() const {
  std::vector<VelocityCondition> list(static_cast<std::size_t>(rows_.size()));
  for (std::int32_t k = 0; k < rows_.size(); ++k) set(k, list[static_cast<std::size_t>(k)]);
  return list;
}

bool AffineRows::are_met(const Eigen::VectorXd& velocity) const {
  VelocityCondition c;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    set(k, c);
    if (!met_to_rounding(c, velocity)) return false;
  }
  return true;
}

}  // namespace dynalin
