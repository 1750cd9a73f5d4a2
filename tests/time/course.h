// A dataset led through time in dynamics, and what its VARIABLEs say at every output.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "elements/catalogue.h"
#include "study/simulation.h"

namespace dynalin::in_time {

struct Course {
  std::vector<double> times;
  std::map<std::int64_t, std::vector<double>> variables;  // by id
  // Of points between outputs, which nothing has put onto their constraints: how far rows are from being met, by the
  // model's length, and their rates, by the largest velocity so far as well.
  double position_drift = 0, velocity_drift = 0;
  StudyPoint end;
  SimulatedPoint simulated;
  std::string failure;  // empty if there is none
  Diagnostics remarks;

  bool ok() const { return failure.empty(); }
  double last(std::int64_t variable) const { return variables.at(variable).back(); }
  // The largest size of a VARIABLE.
  double largest(std::int64_t variable) const {
    double value = 0;
    for (const double v : variables.at(variable)) value = std::max(value, std::abs(v));
    return value;
  }
  // The largest distance of a VARIABLE from its value at the start.
  double drift(std::int64_t variable) const {
    double largest = 0;
    for (const double v : variables.at(variable)) largest = std::max(largest, std::abs(v - variables.at(variable)[0]));
    return largest;
  }
};

inline StudyPoint drawn_point(std::string text) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>("model.adm", std::move(text)));
  EXPECT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics);
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  auto system = System::make(std::move(model.value));
  EXPECT_TRUE(system) << render(system.error());
  return as_drawn(std::move(system.value()));
}

struct Run {
  double end = 1;
  std::int64_t steps = 1;
  std::optional<double> error{};
};

namespace detail {

inline void note_drift(const SimulationStep& step, Course& c, double& fastest) {
  const System& system = step.system;
  for (std::size_t k = 0; k < step.point.velocity.size(); ++k) {
    fastest =
        std::max(fastest, std::abs(step.point.velocity[k]) / system.coordinate_scale(static_cast<std::int32_t>(k)));
  }
  if (step.output) return;
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(system.motion(step.point), rows);
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    double scale = 0;
    for (const auto& e : rows.row(k)) scale = std::max(scale, std::abs(e.c.g) * system.coordinate_scale(e.column));
    if (scale == 0) continue;
    const Taylor& along = rows.along_motion(k);
    const bool position = rows.level(k) == RowLevel::position;
    if (position) c.position_drift = std::max(c.position_drift, std::abs(along.value) / scale);
    if (fastest == 0) continue;
    c.velocity_drift = std::max(c.velocity_drift, std::abs(position ? along.rate : along.value) / (scale * fastest));
  }
}

}  // namespace detail

inline Course led_through_time(StudyPoint from, const Run& run) {
  Course c;
  const System& system = *from.system;
  SimulationRequest request{.times = OutputTimes::of_count(from.values.time, run.end, run.steps)};
  request.integrator = system.model().settings.integrator;
  if (run.error) request.integrator.error = run.error;
  double fastest = 0;
  const auto watch = [&](const SimulationStep& step) {
    detail::note_drift(step, c, fastest);
    if (!step.output) return GoOn::yes;
    c.times.push_back(step.point.time);
    const Layout& layout = step.system.layout();
    for (std::size_t k = 0; k < layout.algebraic.size(); ++k) {
      const ElementId of = layout.algebraic[k].owner->element();
      if (of.statement == "VARIABLE") c.variables[of.id].push_back(step.point.algebraic[k]);
    }
    return GoOn::yes;
  };
  auto found = simulate(std::move(from), request, watch);
  if (!found) {
    c.failure = found.error().message;
    for (const std::string& d : found.error().details) c.failure += "\n  " + d;
    c.remarks = found.error().remarks;
    return c;
  }
  c.remarks = found->remarks;
  c.end = found->point;
  c.simulated = std::move(*found);
  return c;
}

inline Course led_through_time(const std::string& dataset, const Run& run) {
  return led_through_time(drawn_point(dataset), run);
}

}  // namespace dynalin::in_time
