#include "analysis/statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "analysis/assembly_moves.h"
#include "analysis/equilibrium_search.h"
#include "analysis/row_sizes.h"

namespace dynalin {

namespace {

// Whether rounding of positions is as large as the mechanism: then nothing can be told of forces. The spread is that of
// half of the markers, which a few that are far out do not change.
std::string too_far_out(const System& system, const OperatingPoint& op) {
  const Layout& layout = system.layout();
  std::array<std::vector<double>, 3> at;
  for (std::size_t m = 1; m < layout.markers.size(); ++m) {
    const MarkerPlace& place = *layout.markers[m];
    const Pose& pose = op.poses[static_cast<std::size_t>(place.body.index)];
    const Vector p = pose.r + pose.R * place.p_BM;
    for (std::size_t c = 0; c < 3; ++c) at[c].push_back(p[c]);
  }
  if (at[0].size() < 3) return {};
  const auto half = static_cast<std::ptrdiff_t>(at[0].size() / 2),
             most = static_cast<std::ptrdiff_t>(at[0].size() * 3 / 4);
  const auto middle = [&](std::vector<double>& x, std::ptrdiff_t k) {
    std::nth_element(x.begin(), x.begin() + k, x.end());
    return x[static_cast<std::size_t>(k)];
  };
  double spread = 0;
  for (std::vector<double>& x : at) {
    const double centre = middle(x, half);
    for (double& v : x) v = std::abs(v - centre);
    spread = std::max(spread, middle(x, most));
  }
  // Markers that are drawn in one place say nothing of the size.
  std::vector<double> distance;
  for (const Pose& pose : op.poses) distance.push_back(norm(pose.r));
  const double coincide =
      4 * std::numeric_limits<double>::epsilon() * middle(distance, static_cast<std::ptrdiff_t>(distance.size() / 2));
  for (std::size_t b = 1; b < op.poses.size(); ++b) {
    const double off = norm(op.poses[b].r) * std::numeric_limits<double>::epsilon();
    if (off <= 1e-6 * spread || spread <= coincide) continue;
    return fmt::format(
        "{} is so far out that its position is known to {:.1e} only, in a model most of which lies within "
        "{:.3g}",
        layout.bodies[b].label.full_text(), off, spread);
  }
  return {};
}

// Whose rows on velocities hold what is at rest, and whose ask for a velocity.
struct VelocityRowsAtRest {
  std::vector<const ElementLabel*> holding, moving;
};
VelocityRowsAtRest velocity_rows(const System& system, const OperatingPoint& at_rest) {
  constexpr double none = 1e-9;  // of the model's length in a unit of time
  VelocityRowsAtRest of;
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(system.motion(at_rest), rows);
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (rows.level(k) != RowLevel::velocity) continue;
    const ElementLabel* owner = system.layout().rows[static_cast<std::size_t>(k)].owner;
    const bool moves = std::abs(rows.along_motion(k).value) > none * row_scale(system, rows.row(k));
    (moves ? of.moving : of.holding).push_back(owner);
  }
  return of;
}

Failure contradicted_rest(std::span<const ElementLabel* const> moving) {
  Failure f{"static analysis",
            fmt::format("constraints that ask for a velocity contradict rest: DEACTIVATE/{}, ID={} takes one out",
                        moving.front()->statement, moving.front()->id),
            {},
            "motion-at-rest"};
  for (const ElementLabel* label : moving) f.details.push_back(label->full_text());
  return f;
}

void warn_of_rolling(std::span<const ElementLabel* const> holding, Diagnostics& warnings) {
  for (const ElementLabel* label : holding) {
    warnings.warning("rest-by-rolling", label->at,
                     fmt::format("{} holds velocities: where the model rests depends on where the search for it "
                                 "begins, as it does where a wheel rolls there",
                                 label->full_text()));
  }
}

}  // namespace

Result<OperatingPoint> find_equilibrium(const System& system, OperatingPoint op, const StaticsOptions& options,
                                        StaticsReport& report, Findings& findings) {
  if (const auto& driven = system.layout().velocity_driven; !driven.empty()) {
    Failure f{"static analysis",
              fmt::format("motions that prescribe a velocity or an acceleration contradict rest: for statics give each "
                          "a place, MOTION/{0}, DISPLACEMENT, FUNCTION=0, or take it out, DEACTIVATE/MOTION, ID={0}",
                          driven.front()->id),
              {},
              "motion-at-rest"};
    for (const ElementLabel* label : driven) f.details.push_back(label->full_text());
    return tl::unexpected(f);
  }
  if (const std::string far = too_far_out(system, op); !far.empty())
    return tl::unexpected(Failure{"static analysis", far, {}, "far-markers"});
  // An equilibrium in the course of a quasi-static simulation is one of those. Otherwise parts are put together first:
  // what assembly moves has not slipped.
  const bool in_course = op.mode == AnalysisMode::quasi_statics;
  if (!in_course) op.mode = AnalysisMode::initial_conditions;
  op.delays.reset();  // at rest the past is the present
  const std::vector<double> first_state = op.state;
  for (auto* x : {&op.velocity, &op.acceleration, &op.state_rate}) std::fill(x->begin(), x->end(), 0.0);
  const Progress told = options.told.of("static equilibrium");
  auto assembled = assemble_position(system, op, findings, {}, told);
  if (!assembled) return assembled;
  // Between points of a simulation nothing is drawn.
  if (!in_course) warn_of_moves(system, op, *assembled, findings.warnings);
  op = std::move(*assembled);
  const VelocityRowsAtRest on_velocities = velocity_rows(system, op);
  if (!on_velocities.moving.empty()) return tl::unexpected(contradicted_rest(on_velocities.moving));
  if (!in_course) warn_of_rolling(on_velocities.holding, findings.warnings);
  if (!in_course) op.mode = AnalysisMode::statics;

  EquilibriumSearch search(system, std::move(op), options, report, findings);
  // A simulation goes on where it is.
  return search.run(in_course ? AtSaddles::stay : AtSaddles::go_on, first_state);
}

Result<OperatingPoint> static_operating_point(const System& system, OperatingPoint start, const StaticsOptions& options,
                                              StaticsReport& report, Findings& findings) {
  auto op = find_equilibrium(system, std::move(start), options, report, findings);
  if (op) {
    // What statics alone evaluate keeps its value at rest where velocities come back.
    system.remember(*op);
    report.at_rest = *op;
    options.told.tell("static equilibrium: accelerations and reactions there");
  }
  if (op && op->time == 0 && options.restore_velocities) op = initial_velocity(system, std::move(*op), findings);
  if (op) op = reconcile_velocity(system, std::move(*op), findings);
  // Those of the dataset, and those that a MOTION prescribes.
  const bool moves = op && std::ranges::any_of(op->velocity, [](double v) { return v != 0; });
  if (moves) op->mode = AnalysisMode::initial_conditions;
  if (op) op = solve_acceleration(system, std::move(*op), findings);
  return op;
}

}  // namespace dynalin
