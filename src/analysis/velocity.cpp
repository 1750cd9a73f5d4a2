#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "analysis/amplified_velocity.h"
#include "analysis/contradiction.h"
#include "analysis/initial.h"
#include "analysis/stated_shape.h"
#include "analysis/velocity_conditions.h"
#include "analysis/velocity_norm.h"
#include "analysis/velocity_room.h"

namespace dynalin {

namespace {

// Redundant rows are combinations of the others to 1e-9 of themselves, and so is what they ask of velocities.
constexpr double contradicting_velocity = 1e-8;
// Of the fastest of all: what solving may leave of it elsewhere.
constexpr double solution_rounding = 1e-12;

// Whether velocities meet a condition as far as it follows from others, in the size of its own terms: those that axes
// turned otherwise would show count as well. `tolerance` is relative, `rounding` is that of velocities, in lengths of
// the model and radians.
bool follows(const System& system, const VelocityCondition& c, const Eigen::VectorXd& velocity, double tolerance,
             double rounding) {
  const Miss off = miss(c, velocity);
  double size = off.size, noise = 0;
  for (std::size_t i = 0; i < c.column.size(); ++i) {
    const Eigen::Index k = c.column[i];
    const bool of_body = k < system.layout().body_coordinate_count;
    const double along = of_body ? velocity.segment<3>(k - k % 3).cwiseAbs().maxCoeff() : std::abs(velocity(k));
    size = std::max(size, std::abs(c.coefficient[i]) * along);
    noise = std::max(noise, std::abs(c.coefficient[i]) * system.coordinate_scale(c.column[i]));
  }
  return std::abs(off.value) <= tolerance * size + rounding * noise;
}

// min ½ (u − u₀)ᵀ W (u − u₀) under the conditions that are independent; dependent ones must agree to `tolerance`.
struct LeastChange {
  Eigen::VectorXd velocity;
  std::vector<std::size_t> contradicted;
  std::vector<bool> independent{};  // conditions
  Eigen::VectorXd multipliers{};    // of conditions: what their part in the change is
};
std::vector<SparseRow> scaled_conditions(const System& system, const std::vector<VelocityCondition>& conditions) {
  std::vector<SparseRow> scaled(conditions.size());
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    scaled[k].column = conditions[k].column;
    for (std::size_t i = 0; i < conditions[k].column.size(); ++i) {
      scaled[k].value.push_back(conditions[k].coefficient[i] * system.coordinate_scale(conditions[k].column[i]));
    }
  }
  return scaled;
}
Result<LeastChange> least_change(const System& system, const Motion& motion,
                                 const std::vector<VelocityCondition>& conditions, const Eigen::VectorXd& start,
                                 double tolerance) {
  const auto n = static_cast<Eigen::Index>(system.coordinates());
  const auto m = static_cast<Eigen::Index>(conditions.size());
  const std::vector<std::int32_t> order(system.preference().rbegin(), system.preference().rend());
  const Elimination e = eliminate(scaled_conditions(system, conditions), static_cast<std::int32_t>(n), order);

  std::vector<Triplet> entries;
  add_velocity_norm(system, motion, 1.0, entries);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n + m, 1);
  for (const Triplet& t : entries) x(t.row, 0) += t.value * start(t.column);
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    const auto at = static_cast<std::int32_t>(n + static_cast<Eigen::Index>(k));
    if (e.pivot_column[k] < 0) {
      entries.push_back({at, at, 1.0});
      continue;
    }
    x(at, 0) = conditions[k].value;
    for (std::size_t i = 0; i < conditions[k].column.size(); ++i) {
      entries.push_back({at, conditions[k].column[i], conditions[k].coefficient[i]});
      entries.push_back({conditions[k].column[i], at, conditions[k].coefficient[i]});
    }
  }
  SparseLu lu;
  if (!lu.factor(compressed(static_cast<std::int32_t>(n + m), static_cast<std::int32_t>(n + m), entries))) {
    return tl::unexpected(
        Failure{"velocity initial conditions", "the velocity conditions are singular", {}, "singular-constraints"});
  }
  lu.solve(x);
  LeastChange result{x.col(0).head(n), {}, {}, x.col(0).tail(m)};
  const double rounding = solution_rounding * fastest_of(system, result.velocity);
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    result.independent.push_back(e.pivot_column[k] >= 0);
    if (e.pivot_column[k] < 0 && !follows(system, conditions[k], result.velocity, tolerance, rounding)) {
      result.contradicted.push_back(k);
    }
  }
  return result;
}

// Stated values of single coordinates that come out but for rounding are exactly what is stated, if the constraints,
// which come first, are still met: near singular configurations a unit in the last place decides accelerations.
void keep_as_stated(const std::vector<VelocityCondition>& conditions, std::size_t constraints,
                    Eigen::VectorXd& velocity) {
  Eigen::VectorXd kept = velocity;
  for (std::size_t k = constraints; k < conditions.size(); ++k) {
    const VelocityCondition& c = conditions[k];
    std::size_t at = 0, terms = 0;
    for (std::size_t i = 0; i < c.column.size(); ++i) {
      if (c.coefficient[i] != 0) at = i, ++terms;
    }
    if (terms == 1 && met_to_rounding(c, velocity)) kept(c.column[at]) = c.value / c.coefficient[at];
  }
  const auto first = conditions.begin(), last = first + static_cast<std::ptrdiff_t>(constraints);
  if (std::all_of(first, last, [&](const VelocityCondition& c) { return met_to_rounding(c, kept); }))
    velocity = std::move(kept);
}

// The velocities that meet the constraints, which come first, and the other conditions in the sense of least squares;
// what these leave open changes least from `start`.
Result<Eigen::VectorXd> nearest(const System& system, const Motion& motion, const ConstraintRows& rows,
                                const std::vector<VelocityCondition>& conditions, const Eigen::VectorXd& start) {
  const auto n = static_cast<Eigen::Index>(system.coordinates());
  const std::vector<bool> active = system.partition(rows, RowLevel::velocity).active;
  std::vector<Triplet> entries;
  add_velocity_norm(system, motion, 1e-10, entries);
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(n + static_cast<Eigen::Index>(active.size()), 1);
  for (std::size_t k = active.size(); k < conditions.size(); ++k) {
    const VelocityCondition& c = conditions[k];
    const double off = miss(c, start).value, unit = unit_of(system, c), weight = unit * unit;
    for (std::size_t i = 0; i < c.column.size(); ++i) {
      change(c.column[i], 0) -= weight * c.coefficient[i] * off;
      for (std::size_t j = 0; j < c.column.size(); ++j) {
        entries.push_back({c.column[i], c.column[j], weight * c.coefficient[i] * c.coefficient[j]});
      }
    }
  }
  for (std::size_t k = 0; k < active.size(); ++k) {
    const auto at = static_cast<std::int32_t>(n + static_cast<Eigen::Index>(k));
    if (!active[k]) {
      entries.push_back({at, at, 1.0});
      continue;
    }
    change(at, 0) = -miss(conditions[k], start).value;
    for (std::size_t i = 0; i < conditions[k].column.size(); ++i) {
      entries.push_back({at, conditions[k].column[i], conditions[k].coefficient[i]});
      entries.push_back({conditions[k].column[i], at, conditions[k].coefficient[i]});
    }
  }
  SparseLu lu;
  const auto size = static_cast<std::int32_t>(change.rows());
  if (!lu.factor(compressed(size, size, entries)))
    return tl::unexpected(
        Failure{"velocity initial conditions", "the velocity conditions are singular", {}, "singular-constraints"});
  lu.solve(change);
  return start + change.col(0).head(n);
}

// Velocities that meet the conditions, with the rates of flexible bodies as at the start as far as these allow.
void keep_shape(const System& system, const Motion& motion, const std::vector<VelocityCondition>& conditions,
                const Eigen::VectorXd& start, double tolerance, Eigen::VectorXd& velocity) {
  constexpr double close = 1e-10;  // where stated velocities contradict each other, the nearest are far from them
  const auto met = [&](const Eigen::VectorXd& u) {
    return std::all_of(conditions.begin(), conditions.end(), [&](const VelocityCondition& c) {
      const Miss off = miss(c, u);
      return std::abs(off.value) <= close * off.size;
    });
  };
  if (conditions.empty() || !met(velocity)) return;
  Eigen::VectorXd from = velocity;
  const auto behind_bodies = [&](auto& u) {
    return std::span(u.data(), static_cast<std::size_t>(u.size()))
        .subspan(static_cast<std::size_t>(system.layout().body_coordinate_count));
  };
  if (!put_back_shape(system, behind_bodies(start), fastest_of(system, velocity), behind_bodies(from))) return;
  auto kept = least_change(system, motion, conditions, from, tolerance);
  if (kept && kept->contradicted.empty() && met(kept->velocity)) velocity = std::move(kept->velocity);
}

// With the rows as they are about one velocity; `motion`: at rest.
Result<Eigen::VectorXd> solve_affine(const System& system, const OperatingPoint& op, const Motion& motion,
                                     const AffineRows& rows, const std::vector<VelocityCondition>& stated,
                                     const Eigen::VectorXd& start, Diagnostics& warnings) {
  Eigen::VectorXd velocity = start;
  const auto met = [&](const VelocityCondition& c) { return met_to_rounding(c, velocity); };
  const bool holds = rows.are_met(start);
  const bool as_stated = std::all_of(stated.begin(), stated.end(), met);
  std::vector<VelocityCondition> conditions;
  if (!holds || !as_stated) conditions = rows.conditions();
  const std::size_t constraints = conditions.size();
  const double tolerance =
      std::max(contradicting_velocity, op.initial_conditions.velocity_error.value_or(100 * op.redundancy_tolerance));
  if (!holds) {
    auto hard = least_change(system, motion, conditions, start, tolerance);
    if (!hard) return tl::unexpected(hard.error());
    if (!hard->contradicted.empty()) {
      Failure f{"velocity initial conditions",
                "the constraints contradict each other on velocities: " +
                    contradiction(system, scaled_conditions(system, conditions), hard->independent,
                                  static_cast<std::int32_t>(hard->contradicted.front())),
                {},
                "contradicting-constraints"};
      for (const std::size_t k : hard->contradicted) f.details.push_back(system.row_text(static_cast<std::int32_t>(k)));
      return tl::unexpected(f);
    }
    velocity = std::move(hard->velocity);
  }
  if (!stated.empty() && !(holds && as_stated)) {
    const Eigen::VectorXd before = velocity;
    conditions.insert(conditions.end(), stated.begin(), stated.end());
    auto kept = least_change(system, motion, conditions, start, tolerance);
    if (!kept) return tl::unexpected(kept.error());
    // What the constraints leave no room for is given up whole; of a trace of room, the sense of least squares would
    // make a part of it.
    std::vector<VelocityCondition> given_up;
    if (!kept->contradicted.empty()) {
      given_up = take_without_room(system, motion, rows.rows(), conditions);
      if (!given_up.empty()) kept = least_change(system, motion, conditions, start, tolerance);
      if (!kept) return tl::unexpected(kept.error());
    }
    // Where the stated values cannot all be kept, the point nearest to all of them is taken; a second pass undoes what
    // the least change has pulled it. Where some follow from others, but for a tolerance, all count alike.
    const bool contradicted = !kept->contradicted.empty();
    velocity = contradicted ? start : std::move(kept->velocity);
    for (int pass = 0; pass < (contradicted ? 2 : 1); ++pass) {
      if (std::all_of(conditions.begin(), conditions.end(), met)) break;
      auto found = nearest(system, motion, rows.rows(), conditions, velocity);
      if (!found) return tl::unexpected(found.error());
      velocity = std::move(*found);
    }
    if (!contradicted) keep_as_stated(conditions, constraints, velocity);
    const double unnoticed = contradicting_velocity * fastest_of(system, velocity);
    const auto tell_of_change = [&](const VelocityCondition& c) {
      if (follows(system, c, velocity, tolerance, unnoticed)) return;
      warnings.warning("changed-velocity", c.at,
                       fmt::format("the initial velocity {} = {:g} contradicts the constraints and was changed to {:g}",
                                   c.text, c.value, c.value + miss(c, velocity).value));
    };
    std::ranges::for_each(given_up, tell_of_change);
    for (std::size_t k = constraints; k < conditions.size() && contradicted; ++k) tell_of_change(conditions[k]);
    warn_of_amplified_velocity(system, motion, {before, velocity}, std::span(conditions).subspan(constraints),
                               kept->multipliers.tail(static_cast<Eigen::Index>(conditions.size() - constraints)),
                               warnings);
  }
  keep_shape(system, motion, conditions, start, tolerance, velocity);
  return velocity;
}

// Newton's method for rows that are not affine in velocities, from those that are stated.
Result<Eigen::VectorXd> solve_curved(const System& system, const OperatingPoint& op, const Motion& motion,
                                     AffineRows& rows, const std::vector<VelocityCondition>& stated,
                                     const Eigen::VectorXd& start, Diagnostics& warnings) {
  constexpr int most = 50;
  constexpr double unchanged = 1e-13;  // of the fastest
  Eigen::VectorXd about = start;
  if (!stated.empty()) {
    if (auto from = least_change(system, motion, stated, start, contradicting_velocity))
      about = std::move(from->velocity);
  }
  for (int k = 0; k < most; ++k) {
    rows.linearize_about(about);
    if (const std::string reason = rows.undefined(); !reason.empty())
      return tl::unexpected(Failure{"velocity initial conditions", reason, {}, "undefined-value"});
    Diagnostics remarks;
    auto next = solve_affine(system, op, motion, rows, stated, start, remarks);
    if (!next) return next;
    if (!next->allFinite()) break;
    const bool same = fastest_of(system, *next - about) <= unchanged * fastest_of(system, *next);
    about = std::move(*next);
    if (!same) continue;
    warnings.append(std::move(remarks));
    return about;
  }
  Failure f{"velocity initial conditions",
            "no velocities were found that meet constraints which are not linear in them; stated velocities near them "
            "help",
            {},
            "curved-velocity-constraints"};
  return tl::unexpected(std::move(f));
}

Result<OperatingPoint> solve(const System& system, OperatingPoint op, const std::vector<VelocityCondition>& stated,
                             const Eigen::VectorXd& start, Findings& findings) {
  OperatingPoint rest = op;
  std::fill(rest.velocity.begin(), rest.velocity.end(), 0.0);
  std::fill(rest.acceleration.begin(), rest.acceleration.end(), 0.0);
  const Motion motion = system.motion(rest);
  AffineRows rows(system, rest);
  const bool curved = rows.are_curved();
  if (const std::string reason = rows.undefined(); !curved && !reason.empty())
    return tl::unexpected(Failure{"velocity initial conditions", reason, {}, "undefined-value"});
  const auto velocity = curved ? solve_curved(system, op, motion, rows, stated, start, findings.warnings)
                               : solve_affine(system, op, motion, rows, stated, start, findings.warnings);
  if (!velocity) return tl::unexpected(velocity.error());
  op.velocity.assign(velocity->data(), velocity->data() + velocity->size());
  return op;
}

}  // namespace

Result<OperatingPoint> initial_velocity(const System& system, OperatingPoint op, Findings& findings) {
  return reconcile_velocity(system, std::move(op), findings, Restated::all());
}

Result<OperatingPoint> reconcile_velocity(const System& system, OperatingPoint op, Findings& findings,
                                          const Restated& restated) {
  Eigen::VectorXd start =
      Eigen::Map<const Eigen::VectorXd>(op.velocity.data(), static_cast<Eigen::Index>(op.velocity.size()));
  if (restated.empty()) return solve(system, std::move(op), {}, start, findings);
  if (restated.is_all()) start.setZero();
  const Layout& layout = system.layout();
  const Motion motion = system.motion(op);
  const auto stated = stated_velocities(system, motion, restated);
  for (const BodySource* body : system.bodies()) {
    const ElementLabel& label = layout.body(body->bodies().front()).label;
    body->start_velocity(motion, [&](std::string_view argument) { return restated.holds(label, argument); },
                         {start.data(), static_cast<std::size_t>(start.size())});
  }
  return solve(system, std::move(op), stated, start, findings);
}

}  // namespace dynalin
