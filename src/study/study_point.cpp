#include "study/study_point.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cautions/stability.h"
#include "study/model_source.h"
#include "system/entry_keys.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

FoundPoint found(StudyPoint before, OperatingPoint values, Findings findings) {
  std::vector<std::string> rows;
  for (const std::int32_t r : findings.redundant_rows) rows.push_back(before.system->row_text(r));
  return {{std::move(before.system), std::move(values), true, true, {}, std::nullopt, std::move(rows)},
          std::move(findings.warnings)};
}

// The shapes of bodies that have none of as many coordinates in the model before: these begin as they are stated.
Restated begun_shapes(const Layout& before, const Layout& now) {
  std::vector<bool> goes_on(now.extras.size(), false);
  for (const auto& [a, b] : matches(extra_keys(before), extra_keys(now)))
    goes_on[b] = before.extras[a].count == now.extras[b].count;
  Restated begun;
  for (std::size_t k = 0; k < now.extras.size(); ++k) {
    const ExtraBlock& e = now.extras[k];
    if (goes_on[k] || !e.is_shape()) continue;
    const Restated::Element body(e.label.statement, e.label.id);
    for (const std::string_view start : {e.kind.starts.displacement, e.kind.starts.velocity}) begun.state(body, start);
  }
  return begun;
}

}  // namespace

Diagnostics passed_over(const std::vector<std::string>& settings) {
  Diagnostics remarks;
  if (!settings.empty())
    remarks.warning("passed-over", {},
                    fmt::format("nothing here acts on {}, which {} passed over", fmt::join(settings, ", "),
                                settings.size() == 1 ? "is" : "are"));
  return remarks;
}

Diagnostics remarks_on(const System& system) {
  Diagnostics remarks;
  const Settings& settings = system.model().settings;
  if (!system.model().units.stated)
    remarks.warning("no-units", {}, "the dataset states no UNITS: the units consistency factor is taken as 1");
  remarks.append(system.layout().remarks);
  remarks.append(settings.remarks);
  remarks.append(passed_over(settings.passed_over));
  return remarks;
}

Diagnostics new_remarks(const Diagnostics& now, const Diagnostics& before) {
  Diagnostics fresh;
  for (const Diagnostic& d : now.items()) {
    const bool said = std::ranges::any_of(
        before.items(), [&](const Diagnostic& b) { return b.code == d.code && b.message == d.message; });
    if (!said) repeat(d, d.at, fresh);
  }
  return fresh;
}

StudyPoint as_drawn(std::shared_ptr<const System> system) {
  OperatingPoint values = system->drawn();
  StudyPoint point;
  point.system = std::move(system), point.values = std::move(values);
  return point;
}

StudyPoint continued(const StudyPoint& before, std::shared_ptr<const System> edited, const Restated& restated) {
  if (edited == before.system && restated.empty()) return before;
  StudyPoint point = as_drawn(std::move(edited));
  point.redundant_rows = before.redundant_rows;
  if (!before.started) {
    point.values.redundancy_tolerance = before.values.redundancy_tolerance;
    point.values.initial_conditions = before.values.initial_conditions;
    return point;
  }
  point.values = carried_over(*before.system, before.values, *point.system, restated);
  point.started = true;
  point.restated = before.restated;
  point.restated.append(restated);
  point.restated.append(begun_shapes(before.system->layout(), point.system->layout()));
  return point;
}

MarkerState marker_state(const System& system, const OperatingPoint& point, MarkerId id) {
  const auto plain = [](const Vector& v) { return Triple{v.x + 0.0, v.y + 0.0, v.z + 0.0}; };
  const MarkerPlace& place = system.model().marker(id).place;
  const Motion motion = system.motion(point);
  const Frame<Taylor> frame = motion.frame(place);
  const Matrix3 axes = value(frame.axes);
  const BodyMotion& body = motion.body(place.body);
  return {plain(value(frame.origin)),        {plain(axes.x), plain(axes.y), plain(axes.z)},
          plain(rate(frame.origin)),         plain(body.w),
          plain(acceleration(frame.origin)), plain(body.wdot)};
}

StudyResult<FoundPoint> initial_conditions(StudyPoint from, const LevelWatch& watch, Level last) {
  if (from.consistent) {
    from.statics.reset();
    return FoundPoint{std::move(from), {}};
  }
  // An edited model goes on as it was but for what the edits state.
  const Restated stated = from.started ? from.restated : Restated::all();
  Findings findings;
  auto op = initial_conditions(*from.system, from.values, stated, findings, watch, last);
  if (!op) return tl::unexpected(StudyFailure(op.error()));
  if (last != Level::acceleration) {
    from.values = std::move(*op);
    from.statics.reset();
    return FoundPoint{std::move(from), std::move(findings.warnings)};
  }
  return found(std::move(from), std::move(*op), std::move(findings));
}

StudyResult<FoundPoint> static_equilibrium(StudyPoint from, const StaticsOptions& options) {
  Findings findings;
  StaticsReport report;
  auto op = static_operating_point(*from.system, from.values, options, report, findings);
  if (!op) return tl::unexpected(StudyFailure(op.error()));
  FoundPoint result = found(std::move(from), std::move(*op), std::move(findings));
  result.point.statics = StaticSolution{report.iterations, report.imbalance, std::move(report.at_rest)};
  return result;
}

StaticResult static_result(const StudyPoint& point) {
  const StaticSolution& found = point.statics.value();
  return {found.iterations, found.imbalance, stability_of(*point.system, found.at_rest),
          operating_state(*point.system, found.at_rest)};
}

}  // namespace dynalin
