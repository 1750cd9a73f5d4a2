// Models from text, led through time, for the tests of this folder.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "simulation/kinematics.h"
#include "system/model_test_support.h"

namespace dynalin::simulation_test {

using system_test::system_of;

struct KinematicRun {
  std::shared_ptr<const System> system;
  IntegrationStatistics statistics{};
  Findings findings{};
  std::vector<OperatingPoint> outputs;
  std::vector<double> steps;  // times of all accepted points
  Result<OperatingPoint> end = tl::unexpected(Failure{});
  SimulationEnd how = SimulationEnd::reached;

  KinematicRun(const std::string& text, double until, std::int64_t count, const KinematicsSettings& settings = {})
      : system(system_of(text)) {
    auto start = initial_conditions(*system, findings);
    if (!start) throw std::runtime_error(start.error().message);
    const SimulationWatch watch = [&](const SimulationStep& s) {
      if (s.output) outputs.push_back(s.point);
      steps.push_back(s.point.time);
      return GoOn::yes;
    };
    auto advanced = advance_kinematics(*system, std::move(*start), settings,
                                       {OutputTimes::of_count(0, until, count), watch, statistics, findings});
    if (advanced) {
      end = std::move(advanced->point), how = advanced->end;
    } else {
      end = tl::unexpected(advanced.error());
    }
  }

  Frame<Taylor> frame(const OperatingPoint& op, std::int64_t marker) const {
    return system->motion(op).frame(system->layout().marker(*system->model().find_marker(marker)));
  }
  const BodyMotion& body(const Motion& motion, std::int64_t part) const {
    for (std::size_t b = 0; b < motion.bodies.size(); ++b) {
      if (system->layout().bodies[b].label.id == part && b > 0) return motion.bodies[b];
    }
    throw std::runtime_error("no such part");
  }
  // Multiplier of the only row of a MOTION, GEAR or COUPLER: the force or torque by which it drives.
  double lambda(const OperatingPoint& op, const std::string& element) const {
    for (std::size_t k = 0; k < system->layout().rows.size(); ++k) {
      if (system->layout().rows[k].owner->text() == element) return op.lambda[k];
    }
    throw std::runtime_error("no such row");
  }
  double variable(const OperatingPoint& op, std::int64_t id) const {
    for (std::size_t k = 0; k < system->layout().algebraic.size(); ++k) {
      if (system->layout().algebraic[k].owner->text() == "VARIABLE/" + std::to_string(id)) return op.algebraic[k];
    }
    throw std::runtime_error("no such variable");
  }
};

inline void expect_near(const Taylor& value, const Taylor& expected, double tolerance = 1e-9) {
  EXPECT_NEAR(value.value, expected.value, tolerance);
  EXPECT_NEAR(value.rate, expected.rate, tolerance * std::max(1.0, std::abs(expected.rate)));
  EXPECT_NEAR(value.acceleration, expected.acceleration, tolerance * std::max(1.0, std::abs(expected.acceleration)));
}
// Principal value, and its rates, of the rotation about z.
inline Taylor angle_about_z(const Frame<Taylor>& f) { return atan2(f.axes.x.y, f.axes.x.x); }
inline void expect_angle(Taylor value, const Taylor& expected, double tolerance = 1e-9) {
  value.value = expected.value + std::remainder(value.value - expected.value, 2 * std::numbers::pi);
  expect_near(value, expected, tolerance);
}
// The time, as a quantity along the motion.
inline Taylor at_time(const OperatingPoint& op) { return {op.time, 1, 0}; }

}  // namespace dynalin::simulation_test
