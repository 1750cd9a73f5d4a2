#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "analysis/assembly_weights.h"
#include "analysis/contradiction.h"
#include "analysis/displace.h"
#include "analysis/initial.h"
#include "analysis/row_sizes.h"
#include "analysis/row_violations.h"
#include "analysis/stated_shape.h"
#include "expression/parametric_curve.h"
#include "system/row_terms.h"
#include "system/undefined_rows.h"

namespace dynalin {

namespace {

constexpr std::int64_t position_iterations = 50;  // unless IC states MAXIT,
constexpr std::int64_t longest_way = 20000;       // with those that go as far as they may
constexpr double largest_turn = 0.5;              // of an iteration, unless IC states ALIMIT [rad]
constexpr double most_told = 1.5;                 // of two bodies against each other it makes less than half a turn

// Axes that should be perpendicular and are parallel: no turn changes their product to first order.
std::string_view stuck_axes(const System& system, const ConstraintRows& rows, std::int32_t k) {
  constexpr double parallel = 1e-3;
  if (static_cast<std::size_t>(k) >= system.layout().rows.size()) return {};
  if (!system.layout().rows[static_cast<std::size_t>(k)].perpendicular) return {};
  for (const auto& e : rows.row(k)) {
    if (std::abs(e.c.g) > parallel) return {};
  }
  return ", whose axes are parallel and must be perpendicular,";
}

std::string undefined_value_text(const System& system, const OperatingPoint& op, std::int32_t row) {
  const auto at = static_cast<std::size_t>(row);
  std::string reason;
  if (at < system.layout().rows.size()) {
    reason = undefined_value_of(system.undefined_values(system.motion(op)), *system.layout().rows[at].owner);
  }
  return reason.empty() ? system.row_text(row) + " has no finite value" : reason;
}

}  // namespace

Violation position_violation(const System& system, const ConstraintRows& rows) {
  Violation v;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (rows.level(k) != RowLevel::position) continue;
    const double relative = std::abs(rows.along_motion(k).value) / row_scale(system, rows.row(k));
    if (relative > v.relative || std::isnan(relative)) v = {relative, k};
    if (std::isnan(relative)) break;
  }
  return v;
}

namespace {

// Where the parameters of open curves may go: on along the tangents there, or not beyond the ends.
enum class Ends : bool { passed, kept };

double end_of(double u) { return std::copysign(1.0, u); }

bool beyond_an_end(const Layout& layout, const OperatingPoint& op) {
  return std::any_of(layout.curve_points.begin(), layout.curve_points.end(), [&](const CurvePoint& c) {
    return !c.curve->reaches(op.extra[layout.extra_index(c.coordinate)]);
  });
}

// The step of least change that meets the active rows to first order; some coordinates may have to stay.
std::optional<Eigen::VectorXd> least_step(const ConstraintRows& rows, const Partition& part,
                                          const AssemblyWeights& weights, const std::vector<bool>& fixed,
                                          SparseLu& lu) {
  const std::vector<double>& weight = weights.of_coordinates;
  const auto n = static_cast<std::int32_t>(weight.size()), m = rows.size();
  std::vector<Triplet> entries = weights.coupled;
  for (std::int32_t k = 0; k < n; ++k) entries.push_back({k, k, weight[static_cast<std::size_t>(k)]});
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(n + m, 1);
  for (std::int32_t k = 0; k < m; ++k) {
    const std::int32_t at = n + k;
    if (!part.active[static_cast<std::size_t>(k)]) {
      entries.push_back({at, at, 1.0});
      continue;
    }
    step(at, 0) = -rows.along_motion(k).value;
    for (const auto& e : rows.row(k)) {
      if (fixed[static_cast<std::size_t>(e.column)]) continue;
      entries.push_back({at, e.column, e.c.g});
      entries.push_back({e.column, at, e.c.g});
    }
  }
  if (!lu.factor(compressed(n + m, n + m, entries))) return std::nullopt;
  lu.solve(step);
  return Eigen::VectorXd(step.col(0).head(n));
}

double largest_step(const Layout& layout, std::int32_t coordinate) {
  for (const ExtraBlock& e : layout.extras) {
    if (coordinate < e.offset + e.count) {
      return e.coordinates[static_cast<std::size_t>(coordinate - e.offset)].largest_step;
    }
  }
  return std::numeric_limits<double>::infinity();
}

// Parameters that a step would take beyond the end of an open curve: those on their way are put there, those that stand
// there have to stay.
struct Stopped {
  bool moved = false, held = false;
};
Stopped stop_at_ends(const Layout& layout, OperatingPoint& op, const Eigen::VectorXd& step, std::vector<bool>& fixed) {
  Stopped s;
  std::int32_t last = -1;
  for (const CurvePoint& c : layout.curve_points) {
    if (std::exchange(last, c.coordinate) == c.coordinate) continue;  // of two markers at one point of contact
    double& u = op.extra[layout.extra_index(c.coordinate)];
    const double most = largest_step(layout, c.coordinate);
    const double next = u + std::clamp(step(c.coordinate), -most, most);
    if (c.curve->reaches(next)) continue;
    if (u != end_of(next)) {
      u = end_of(next), s.moved = true;
    } else {
      fixed[static_cast<std::size_t>(c.coordinate)] = true, s.held = true;
    }
  }
  return s;
}

// Which displacements that elements ask of the start hold, in their order; empty where none does.
using Held = std::vector<bool>;
Held held_starts(const System& system, const Restated& restated) {
  Held held;
  bool any = false;
  for (const StartCondition& s : system.starts()) {
    held.push_back(s.displacement && restated.holds(*s.owner, s.arguments.displacement));
    any = any || held.back();
  }
  return any ? held : Held();
}

// `held` coordinates stay; where it is empty none has to.
Result<OperatingPoint> assemble(const System& system, OperatingPoint op, const Held& starts, Ends ends,
                                const std::vector<bool>& held = {}) {
  const Layout& layout = system.layout();
  ConstraintRows rows;
  rows.resize(layout, layout.row_count() + starts.size());
  const auto evaluate_here = [&] {
    const Motion motion = system.motion(op);
    system.constraints(motion, rows);
    if (starts.empty()) return;
    const auto first = static_cast<std::int32_t>(layout.row_count());
    system.start_rows(motion, first, rows);
    for (std::size_t k = 0; k < starts.size(); ++k) {
      if (!starts[k]) rows.drop(first + static_cast<std::int32_t>(k));
    }
  };
  const auto evaluate = [&] {
    system.count_turns(system.motion(op),
                       op.memory);  // from one iteration to the next: all may be more than half a turn
    evaluate_here();
  };
  const Memory first_memory = op.memory;
  // Where no row asks for the turns that were made on the way, angles stay next to what they were: a way on which no
  // constraint holds says nothing of them.
  const auto take_back_turns = [&] {
    std::vector<double> asked;
    for (std::int32_t k = 0; k < rows.size(); ++k) asked.push_back(rows.along_motion(k).value);
    Memory counted = std::exchange(op.memory, first_memory);
    evaluate_here();
    for (std::int32_t k = 0; k < rows.size(); ++k) {
      if (rows.along_motion(k).value == asked[static_cast<std::size_t>(k)]) continue;
      op.memory = std::move(counted);
      return;
    }
  };
  std::optional<AssemblyWeights> weights;
  SparseLu lu;
  std::vector<std::string> history;
  double before = std::numeric_limits<double>::infinity(), part_gone = 1;
  const std::vector<double> drawn_shape = op.extra;
  bool looked_at_shape = false;

  const InitialConditionSettings& ic = op.initial_conditions;
  std::int64_t most = ic.iteration_limit.value_or(position_iterations);
  const StepLimits limits{std::min(ic.rotation_limit.value_or(largest_turn), most_told),
                          ic.translation_limit.value_or(std::numeric_limits<double>::infinity())};
  // The last point is looked at as well.
  for (std::int64_t iteration = 0; iteration <= most; ++iteration) {
    evaluate();
    const Violation v = position_violation(system, rows);
    history.push_back(std::isfinite(v.relative)
                          ? fmt::format("iteration {}: largest violation {:.3e}", iteration, v.relative)
                          : fmt::format("iteration {}: a constraint is no finite number", iteration));
    if (std::isnan(v.relative)) {
      return tl::unexpected(
          Failure{"initial conditions", undefined_value_text(system, op, v.row), history, "undefined-value"});
    }
    const auto finished = [&] {
      take_back_turns();
      put_back_shape(system, drawn_shape, 1, op.extra, left_by_rounding);
      system.remember(op);
      return op;
    };
    const auto goes_on = [&] {
      if (std::exchange(looked_at_shape, true) || !put_back_shape(system, drawn_shape, 1, op.extra)) return false;
      before = std::numeric_limits<double>::infinity();
      return true;
    };
    if (v.relative <= position_tolerance) {
      if (goes_on()) continue;
      return finished();
    }
    if (const auto reason = undefined_row(system, system.motion(op), rows)) {
      return tl::unexpected(Failure{"initial conditions", *reason, history, "undefined-value"});
    }
    const Partition part = system.partition(rows, false);
    // What is left of the rows that can be met, and the redundant rows that do not follow from them.
    const std::vector<double> sizes = coordinate_sizes(layout, op);
    std::vector<RowTerms> terms = row_terms(system, system.motion(op));
    terms.resize(static_cast<std::size_t>(rows.size()));  // what starts ask for has none
    double left = 0, above_rounding = 0;
    std::vector<std::string> contradicted;
    std::string_view stuck;  // of the first
    std::int32_t first = -1;
    for (std::int32_t k = 0; k < rows.size(); ++k) {
      if (rows.level(k) != RowLevel::position) continue;
      const auto at = static_cast<std::size_t>(k);
      const double scale = row_scale(system, rows.row(k)),
                   rounding = row_rounding(sizes, rows.row(k), terms[at]) / scale;
      const double relative = std::abs(rows.along_motion(k).value) / scale;
      if (part.active[at]) {
        left = std::max(left, relative);
        above_rounding = std::max(above_rounding, relative - std::max(position_tolerance, rounding));
      } else if (contradicts(relative, rounding, op.redundancy_tolerance)) {
        if (contradicted.empty()) stuck = stuck_axes(system, rows, k), first = k;
        contradicted.push_back(system.row_text(k));
      }
    }
    // Rounding sets the floor: stop there rather than wander.
    if (above_rounding <= 0 || (left <= 1e-11 && left >= 0.5 * before)) {
      if (contradicted.empty() && goes_on()) continue;
      if (contradicted.empty()) return finished();
      history.insert(history.begin(), contradicted.begin(), contradicted.end());
      const std::string who =
          stuck.empty() ? contradiction(system, scaled_gradients(system, rows), part.active, first)
                        : fmt::format("{}{} cannot hold together with the others", contradicted.front(), stuck);
      return tl::unexpected(
          Failure{"initial conditions",
                  fmt::format("the constraints contradict each other: {} (IC/ERROR is {:g} of a row's scale)", who,
                              op.redundancy_tolerance),
                  history, "contradicting-constraints"});
    }
    // Many turns take many steps, each as good as its part of the way promises.
    if (!ic.iteration_limit && part_gone < 1 && left <= (1 - 0.5 * part_gone) * before)
      most = std::min(most + 1, longest_way);
    before = left;
    if (iteration == most) break;

    if (!weights) weights = assembly_weights(system, op);
    std::vector<bool> fixed = held.empty() ? std::vector<bool>(system.coordinates(), false) : held;
    std::optional<Eigen::VectorXd> step = least_step(rows, part, *weights, fixed, lu);
    if (step && ends == Ends::kept) {
      const Stopped stopped = stop_at_ends(layout, op, *step, fixed);
      if (stopped.moved) continue;
      if (stopped.held) step = least_step(rows, part, *weights, fixed, lu);
    }
    if (!step) {
      return tl::unexpected(Failure{"initial conditions", "the constraints are singular at this position", history,
                                    "singular-constraints"});
    }
    part_gone = displace(system, op, *step, limits);
  }
  evaluate();
  const Violation v = position_violation(system, rows);
  if (ic.iteration_limit) history.insert(history.begin(), fmt::format("IC allows {} iterations (MAXIT)", most));
  history.insert(history.begin(),
                 "the parts of that constraint may be drawn too far from where they fit, or be too short to reach");
  return tl::unexpected(Failure{"initial conditions",
                                fmt::format("the model could not be assembled: {} is violated by {:.3e} of its scale",
                                            system.row_text(v.row), v.relative),
                                history, "not-assembled"});
}

// How far bodies have been moved, squared: radians and lengths of the model.
double change(const System& system, const OperatingPoint& from, const OperatingPoint& to) {
  double sum = 0;
  for (std::size_t b = 0; b < from.poses.size(); ++b) {
    const Vector r = (to.poses[b].r - from.poses[b].r) / system.length();
    const Matrix3 turn = to.poses[b].R - from.poses[b].R;
    sum += dot(r, r);
    for (std::size_t k = 0; k < 3; ++k) sum += 0.5 * dot(turn[k], turn[k]);
  }
  return sum;
}

// From the drawn place and, if that fails, from places all over the curves. The least change counts.
std::optional<OperatingPoint> assemble_inside(const System& system, const OperatingPoint& drawn, const Held& starts) {
  constexpr std::size_t places = 12;
  const Layout& layout = system.layout();
  std::optional<OperatingPoint> best;
  const auto consider = [&](OperatingPoint from) {
    auto found = assemble(system, std::move(from), starts, Ends::kept);
    if (!found || beyond_an_end(layout, *found)) return;
    if (!best || change(system, drawn, *found) < change(system, drawn, *best)) best = std::move(*found);
  };
  consider(drawn);
  if (best) return best;
  for (std::size_t k = 0; k < places; ++k) {
    OperatingPoint from = drawn;
    for (const CurvePoint& c : layout.curve_points) {
      const std::vector<double> all = c.curve->samples(places);
      from.extra[layout.extra_index(c.coordinate)] = all[k * (all.size() - 1) / (places - 1)];
    }
    consider(std::move(from));
  }
  return best;
}

// Coordinates of bodies that deform which EXACT asks to keep, angles where it names all three; empty if there are none.
std::vector<bool> exact_where_bodies_deform(const System& system) {
  const Layout& layout = system.layout();
  std::vector<bool> held;
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const Body& body = system.model().bodies[b];
    if (body.modal.empty()) continue;
    const std::array<bool, 6>& exact = body.exact;
    const bool all_angles = exact[3] && exact[4] && exact[5];
    for (std::int32_t k = 0; k < layout.bodies[b].count; ++k) {
      if (k < 3 ? !exact[static_cast<std::size_t>(k)] : !all_angles) continue;
      held.resize(system.coordinates());
      held[static_cast<std::size_t>(layout.bodies[b].offset + k)] = true;
    }
  }
  return held;
}

}  // namespace

Result<OperatingPoint> assemble_position(const System& system, OperatingPoint op, Findings&, const Restated& restated) {
  const Layout& layout = system.layout();
  const Held starts = held_starts(system, restated);
  const bool searches = restated.is_all() && !layout.curve_points.empty();
  // A body deforms before a coordinate leaves where EXACT holds it, if that is enough.
  if (const std::vector<bool> held = exact_where_bodies_deform(system); !held.empty()) {
    auto bent = assemble(system, op, starts, Ends::passed, held);
    if (bent && !(searches && beyond_an_end(layout, *bent))) return bent;
  }
  const OperatingPoint drawn = searches ? op : OperatingPoint();
  auto found = assemble(system, std::move(op), starts, Ends::passed);
  if (searches && (!found || beyond_an_end(layout, *found))) {
    if (auto inside = assemble_inside(system, drawn, starts)) return *std::move(inside);
  }
  return found;
}

}  // namespace dynalin
