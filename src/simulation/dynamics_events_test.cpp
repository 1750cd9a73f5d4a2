// Dynamics with events: sensors that act on it, values that jump, delays that read the past.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/dynamics.h"
#include "system/model_test_support.h"

namespace dynalin::system_test::dynamics_events_test {
namespace {

using ::testing::HasSubstr;

struct Led {
  AdvancedPoint end;
  std::vector<double> outputs, steps;  // times
  std::string said, warned;
  IntegrationStatistics statistics;
};

enum class Until : bool { end, warning };

Led lead(const std::string& text, double end, double step, double error = 1e-4, Until until = Until::end) {
  const auto system = system_of(text);
  Findings findings;
  Led r;
  auto start = solve_acceleration(*system, system->drawn(), findings);
  if (!start) throw std::runtime_error(start.error().message);
  const SimulationWatch watch = [&](const SimulationStep& at) {
    if (at.output) r.outputs.push_back(at.point.time);
    r.steps.push_back(at.point.time);
    r.said += at.text;
    return until == Until::warning && !findings.warnings.items().empty() ? GoOn::no : GoOn::yes;
  };
  IntegratorSettings settings;
  settings.error = error;
  auto found = advance_dynamics(*system, *start, OutputTimes(0, end, step), settings, r.statistics, watch, findings);
  if (!found) throw std::runtime_error(found.error().message);
  r.end = std::move(*found);
  for (const Diagnostic& d : findings.warnings.items()) r.warned += d.message + '\n';
  return r;
}

// x′ = −x passes 0.5 at t = ln 2.
const std::string decay = "DIFF/1, IC=1, FUNCTION=-DIF(1)\n";

TEST(DynamicsWithEvents, ends_where_a_sensor_says) {
  for (const auto& [word, end] : {std::pair{"RETURN", SimulationEnd::returned}, {"HALT", SimulationEnd::halted}}) {
    const Led r = lead(decay + "SENSOR/1, FUNCTION=DIF(1), VALUE=0.5, LE, " + word + "\n", 5, 1);
    EXPECT_EQ(r.end.end, end);
    EXPECT_NEAR(r.end.point.time, std::log(2), 1e-6);
    EXPECT_NEAR(r.end.point.state[0], 0.5, 1e-9);
    EXPECT_THAT(r.said, HasSubstr("SENSOR/1 triggers at time 0.693147"));
    ASSERT_EQ(r.outputs.size(), 2u);
    EXPECT_EQ(r.outputs[1], r.end.point.time);
  }
}

// Its function ends at t = 0.5, behind where it triggers.
TEST(DynamicsWithEvents, ends_where_a_sensor_says_before_its_function_does) {
  for (const double step : {1.0, 0.1}) {
    const Led r = lead(decay + "SENSOR/1, FUNCTION=SQRT(0.5-TIME), VALUE=0.1, LE, RETURN\n", 1, step);
    EXPECT_EQ(r.end.end, SimulationEnd::returned);
    EXPECT_NEAR(r.end.point.time, 0.49, 1e-9);
  }
}

TEST(DynamicsWithEvents, writes_where_a_sensor_says_and_changes_the_time_between_outputs) {
  const Led r = lead(
      decay + "SENSOR/1, FUNCTION=DIF(1), VALUE=0.5, LE, PRINT\nSENSOR/2, FUNCTION=TIME, VALUE=2, GE, DT=0.5\n", 3, 1);
  const std::vector<double> expected = {0, std::log(2), 1, 2, 2.5, 3};
  ASSERT_EQ(r.outputs.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(r.outputs[k], expected[k], 1e-6);
  EXPECT_EQ(r.end.end, SimulationEnd::reached);
}

TEST(DynamicsWithEvents, a_sensor_whose_condition_holds_ends_it_at_once) {
  const Led r = lead(decay + "SENSOR/1, FUNCTION=DIF(1), VALUE=0.5, GE, RETURN\n", 5, 1);
  EXPECT_EQ(r.end.point.time, 0);
  EXPECT_EQ(r.end.end, SimulationEnd::returned);
}

// x′ = −1 until x meets 0.25, then x′ = 2: what SENVAL reads jumps there.
TEST(DynamicsWithEvents, what_reads_senval_jumps_where_the_sensor_triggers) {
  const Led r =
      lead("DIFF/1, IC=1, FUNCTION=3*SENVAL(1)-1\nSENSOR/1, FUNCTION=DIF(1), VALUE=0.25, LE, EVALUATE=1\n", 2, 0.1);
  EXPECT_NEAR(r.end.point.state[0], 0.25 + 2 * (2 - 0.75), 1e-9);
}

TEST(DynamicsWithEvents, a_jump_is_located) {
  const Led r = lead("DIFF/1, IC=0, FUNCTION=IF(TIME-0.3701: 1, 1, -3)\n", 1, 0.1);
  EXPECT_THAT(r.steps, ::testing::Contains(::testing::DoubleNear(0.3701, 1e-10)));
  EXPECT_NEAR(r.end.point.state[0], 0.3701 - 3 * (1 - 0.3701), 1e-6);
}

// x′ = −x(t − 1) with x = 1 before the start: 1 − t up to t = 1, then 1 − t + (t − 1)²/2, at t = 2 a cubic more.
// x comes to rest at t = 0.2, where the jump holds it.
TEST(DynamicsWithEvents, what_jumps_to_and_fro_is_named_where_there_is_no_end_to_it) {
  const Led r = lead(decay + "DIFF/2, IC=1, FUNCTION=-5*SIGN(1,DIF(2))\n", 1, 0.1, 1e-4, Until::warning);
  EXPECT_THAT(r.warned, HasSubstr("at time 0.2 functions switch without end"));
  EXPECT_THAT(r.warned, HasSubstr("what jumps to and fro is DIFF/2\n"));
  EXPECT_THAT(lead(decay, 0.1, 0.1).warned, "");
}

TEST(DynamicsWithEvents, late_feedback_follows_the_method_of_steps) {
  const std::string text = "DIFF/1, IC=1, FUNCTION=-DELAY(DIF(1),1,1)\n";
  EXPECT_NEAR(lead(text, 1, 0.1).end.point.state[0], 0, 1e-7);
  EXPECT_NEAR(lead(text, 2, 0.1).end.point.state[0], -0.5, 1e-6);
  EXPECT_NEAR(lead(text, 3, 0.1).end.point.state[0], 1 - 3 + 2 - 1.0 / 6, 1e-6);
}

// A force that is there for 0.4 s of every second; an elastic ceiling that is met for a hundredth of a long flight,
// from below and at less than two metres per second.
TEST(DynamicsWithEvents, steps_over_nothing_that_comes_and_goes) {
  const double on = 2 * (std::asin(1.0) - std::asin(0.3)) / (2 * std::numbers::pi);
  EXPECT_NEAR(lead("DIFF/1, IC=0, FUNCTION=IF(SIN(2*PI*TIME)-0.3:0,0,1)\n", 5, 5, 1e-3).end.point.state[0], 5 * on,
              1e-5);
  const double v = std::sqrt(2.0), w = std::sqrt(1e5), touch = 2 * std::atan(v * w / 10) / w;
  const Led r = lead("DIFF/1, IC=0, FUNCTION=DIF(2)\nDIFF/2, IC=10, FUNCTION=-10-1E5*MAX(0,DIF(1)-4.9)\n", 2, 2, 1e-6);
  const double falling = 2 - touch - (10 - v) / 10;
  EXPECT_NEAR(r.end.point.state[0], 4.9 - v * falling - 5 * falling * falling, 1e-5);
  EXPECT_NEAR(r.end.point.state[1], -v - 10 * falling, 1e-5);
}

// x′ = −x(t − τ) with a delay far below the steps: x = exp(−λ t) with λ = exp(λ τ), from the history of that course.
TEST(DynamicsWithEvents, a_delay_shorter_than_the_steps_converges) {
  const double tau = 0.01;
  double lambda = 1;
  for (int k = 0; k < 60; ++k) lambda = std::exp(lambda * tau);
  char text[200];
  std::snprintf(text, sizeof text, "DIFF/1, IC=1, FUNCTION=-DELAY(DIF(1),0.01,EXP(-%.17g*TIME))\n", lambda);
  const double exact = std::exp(-2 * lambda);
  const double coarse = std::abs(lead(text, 2, 0.5, 1e-2).end.point.state[0] - exact),
               fine = std::abs(lead(text, 2, 0.5, 1e-5).end.point.state[0] - exact);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(fine, 1e-6);
  EXPECT_LT(lead(text, 2, 0.5, 1e-2).statistics.steps, 150);
}

}  // namespace
}  // namespace dynalin::system_test::dynamics_events_test
