#include "analysis/assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "analysis/assembly_weights.h"
#include "analysis/contradiction.h"
#include "analysis/displace.h"
#include "analysis/row_sizes.h"
#include "analysis/row_violations.h"
#include "analysis/stated_limit.h"
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
  constexpr double cosine_left = 1e-3;
  if (static_cast<std::size_t>(k) >= system.layout().rows.size()) return {};
  if (!system.layout().rows[static_cast<std::size_t>(k)].perpendicular) return {};
  for (const auto& e : rows.row(k)) {
    if (std::abs(e.c.g) > cosine_left) return {};
  }
  return ", two axes that are parallel and must be perpendicular,";
}

std::string undefined_value_text(const System& system, const OperatingPoint& op, std::int32_t row) {
  const auto at = static_cast<std::size_t>(row);
  std::string reason;
  if (at < system.layout().rows.size()) {
    reason = undefined_value_of(system.undefined_values(system.motion(op)), *system.layout().rows[at].owner);
  }
  return reason.empty() ? system.row_text(row) + " has no finite value" : reason;
}

double end_of(double u) { return std::copysign(1.0, u); }

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

// The rows at the point that an assembly has come to, and what it remembers of those before.
class Assembly {
 public:
  struct Ways {
    const HeldStarts& starts;
    Ends ends;
    const std::vector<bool>& held;
    const Progress& progress;
  };
  Assembly(const System& system, OperatingPoint from, const Ways& ways)
      : system_(system),
        layout_(system.layout()),
        starts_(ways.starts),
        ends_(ways.ends),
        held_(ways.held),
        progress_(ways.progress),
        op_(std::move(from)),
        first_memory_(op_.memory),
        drawn_shape_(op_.extra),
        limits_{std::min(stated_limit(settings().rotation_limit, largest_turn), most_told),
                stated_limit(settings().translation_limit, std::numeric_limits<double>::infinity())},
        most_(settings().iteration_limit.value_or(position_iterations)) {
    rows_.resize(layout_, layout_.row_count() + starts_.size());
  }

  Result<OperatingPoint> run() {
    progress_.tell("assembly");
    // The last point is looked at as well.
    for (std::int64_t iteration = 0; iteration <= most_; ++iteration) {
      evaluate();
      const Violation v = position_violation(system_, rows_);
      note(iteration, v);
      if (std::isnan(v.relative)) return failure(undefined_value_text(system_, op_, v.row), "undefined-value");
      if (v.relative <= position_tolerance) {
        if (goes_on_as_drawn()) continue;
        return finished();
      }
      if (const auto reason = undefined_row(system_, system_.motion(op_), rows_))
        return failure(*reason, "undefined-value");
      const Partition part = system_.partition(rows_, RowLevel::position);
      const Remainder left = remainder(part);
      if (left.is_rounding(before_)) {
        if (!left.contradicted.empty()) return contradicting(part, left);
        if (goes_on_as_drawn()) continue;
        return finished();
      }
      allow_for_turns(left);
      before_ = left.largest;
      if (iteration == most_) break;
      if (!move(part)) return failure("the constraints are singular at this position", "singular-constraints");
    }
    return not_assembled();
  }

 private:
  // What is left of the rows that can be met, and the redundant rows that do not follow from them.
  struct Remainder {
    double largest = 0, above_rounding = 0;
    std::vector<std::string> contradicted;
    std::string_view stuck;  // of the first
    std::int32_t first = -1;

    // Rounding sets the floor: stop there rather than wander.
    bool is_rounding(double before) const {
      constexpr double near_the_floor = 1e-11, hardly_less = 0.5;
      return above_rounding <= 0 || (largest <= near_the_floor && largest >= hardly_less * before);
    }
  };

  const InitialConditionSettings& settings() const { return op_.initial_conditions; }

  void evaluate_here() {
    const Motion motion = system_.motion(op_);
    system_.constraints(motion, rows_);
    if (starts_.empty()) return;
    const auto first = static_cast<std::int32_t>(layout_.row_count());
    system_.start_rows(motion, first, rows_);
    for (std::size_t k = 0; k < starts_.size(); ++k) {
      if (!starts_[k]) rows_.drop(first + static_cast<std::int32_t>(k));
    }
  }

  void evaluate() {
    system_.count_turns(system_.motion(op_),
                        op_.memory);  // from one iteration to the next: all may be more than half a turn
    evaluate_here();
  }

  // Where no row asks for the turns that were made on the way, angles stay next to what they were: a way on which no
  // constraint holds says nothing of them.
  void take_back_turns() {
    std::vector<double> asked;
    for (std::int32_t k = 0; k < rows_.size(); ++k) asked.push_back(rows_.along_motion(k).value);
    Memory counted = std::exchange(op_.memory, first_memory_);
    evaluate_here();
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (rows_.along_motion(k).value == asked[static_cast<std::size_t>(k)]) continue;
      op_.memory = std::move(counted);
      return;
    }
  }

  Remainder remainder(const Partition& part) const {
    const std::vector<double> sizes = coordinate_sizes(layout_, op_);
    std::vector<RowTerms> terms = row_terms(system_, system_.motion(op_));
    terms.resize(static_cast<std::size_t>(rows_.size()));  // what starts ask for has none
    Remainder left;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (rows_.level(k) != RowLevel::position) continue;
      const auto at = static_cast<std::size_t>(k);
      const double scale = row_scale(system_, rows_.row(k)),
                   rounding = row_rounding(sizes, rows_.row(k), terms[at]) / scale;
      const double relative = std::abs(rows_.along_motion(k).value) / scale;
      if (part.active[at]) {
        left.largest = std::max(left.largest, relative);
        left.above_rounding = std::max(left.above_rounding, relative - std::max(position_tolerance, rounding));
      } else if (contradicts(relative, rounding, op_.redundancy_tolerance)) {
        if (left.contradicted.empty()) left.stuck = stuck_axes(system_, rows_, k), left.first = k;
        left.contradicted.push_back(system_.row_text(k));
      }
    }
    return left;
  }

  // Many turns take many steps, each as good as its part of the way promises.
  void allow_for_turns(const Remainder& left) {
    if (!settings().iteration_limit && part_gone_ < 1 && left.largest <= (1 - 0.5 * part_gone_) * before_)
      most_ = std::min(most_ + 1, longest_way);
  }

  // False where no step meets the rows.
  bool move(const Partition& part) {
    if (!weights_) weights_ = assembly_weights(system_, op_);
    std::vector<bool> fixed = held_.empty() ? std::vector<bool>(system_.coordinates(), false) : held_;
    std::optional<Eigen::VectorXd> step = least_step(rows_, part, *weights_, fixed, lu_);
    if (step && ends_ == Ends::kept) {
      const Stopped stopped = stop_at_ends(layout_, op_, *step, fixed);
      if (stopped.moved) return true;
      if (stopped.held) step = least_step(rows_, part, *weights_, fixed, lu_);
    }
    if (!step) return false;
    part_gone_ = displace(system_, op_, *step, limits_);
    return true;
  }

  // Once, where weights alone have taken a body from the shape that it was drawn in.
  bool goes_on_as_drawn() {
    if (std::exchange(looked_at_shape_, true) || !put_back_shape(system_, drawn_shape_, 1, op_.extra)) return false;
    before_ = std::numeric_limits<double>::infinity();
    return true;
  }

  OperatingPoint finished() {
    take_back_turns();
    put_back_shape(system_, drawn_shape_, 1, op_.extra, left_by_rounding);
    system_.remember(op_);
    return std::move(op_);
  }

  void note(std::int64_t iteration, const Violation& v) {
    history_.push_back(std::isfinite(v.relative)
                           ? fmt::format("iteration {}: largest violation {:.3e}", iteration, v.relative)
                           : fmt::format("iteration {}: a constraint is no finite number", iteration));
    progress_.tell([&] { return "assembly: " + history_.back(); });
  }

  tl::unexpected<Failure> failure(std::string message, std::string_view code) const {
    return tl::unexpected(Failure{"initial conditions", std::move(message), history_, code});
  }

  tl::unexpected<Failure> contradicting(const Partition& part, const Remainder& left) {
    history_.insert(history_.begin(), left.contradicted.begin(), left.contradicted.end());
    const std::string who =
        left.stuck.empty()
            ? contradiction(system_, scaled_gradients(system_, rows_), part.active, left.first)
            : fmt::format("{}{} cannot hold together with the others", left.contradicted.front(), left.stuck);
    return failure(fmt::format("the constraints contradict each other: {} (IC/ERROR is {:g} of a row's scale)", who,
                               op_.redundancy_tolerance),
                   "contradicting-constraints");
  }

  tl::unexpected<Failure> not_assembled() {
    evaluate();
    const Violation v = position_violation(system_, rows_);
    if (settings().iteration_limit)
      history_.insert(history_.begin(), fmt::format("IC allows {} iterations (MAXIT)", most_));
    history_.insert(history_.begin(),
                    "the parts of that constraint may be drawn too far from where they fit, or be too short to reach");
    return failure(fmt::format("the model could not be assembled: {} is violated by {:.3e} of its scale",
                               system_.row_text(v.row), v.relative),
                   "not-assembled");
  }

  const System& system_;
  const Layout& layout_;
  const HeldStarts& starts_;
  const Ends ends_;
  const std::vector<bool>& held_;
  const Progress& progress_;
  OperatingPoint op_;
  ConstraintRows rows_;
  const Memory first_memory_;
  const std::vector<double> drawn_shape_;
  bool looked_at_shape_ = false;
  const StepLimits limits_;
  std::int64_t most_;                                        // iterations
  double before_ = std::numeric_limits<double>::infinity();  // what the last point has left
  double part_gone_ = 1;                                     // of the last step
  std::optional<AssemblyWeights> weights_;
  SparseLu lu_;
  std::vector<std::string> history_;
};

}  // namespace

Result<OperatingPoint> assemble(const System& system, OperatingPoint from, const HeldStarts& starts, Ends ends,
                                const Progress& progress, const std::vector<bool>& held) {
  return Assembly(system, std::move(from), {starts, ends, held, progress}).run();
}

}  // namespace dynalin
