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
  auto start = initial_conditions(*system, findings);
  if (!start) throw std::runtime_error(start.error().message);
  const SimulationWatch watch = [&](const SimulationStep& at) {
    if (at.output) r.outputs.push_back(at.point.time);
    r.steps.push_back(at.point.time);
    r.said += at.text;
    return until == Until::warning && !findings.warnings.items().empty() ? GoOn::no : GoOn::yes;
  };
  IntegratorSettings settings;
  settings.error = error;
  auto found = advance_dynamics(*system, *start, settings, {OutputTimes(0, end, step), watch, r.statistics, findings});
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
// sin 2t has its maximum between outputs and steps, and comes within ERROR of what it is compared with.
// Nothing that moves reads the VARIABLEs: no step is looked at for what is between its ends.
TEST(DynamicsWithEvents, sensors_read_variables_as_exactly_as_what_these_are) {
  const std::string free =
      "PART/2, MASS=1, CM=20, IP=1,1,1, VZ=1\nMARKER/20\nVARIABLE/1, FUNCTION=SIN(5*TIME)\n"
      "VARIABLE/2, FUNCTION=2*VARVAL(1)\nVARIABLE/3, FUNCTION=SIN(5*DZ(20))\n"
      "VARIABLE/4, FUNCTION=IF(TIME-1.777: 0, 1, 1)\nVARIABLE/5, "
      "FUNCTION=VARVAL(1)+0.1*SIN(VARVAL(5))-0.1*SIN(VARVAL(5))\n";
  struct Row {
    const char* sensor;
    double at;
  };
  const double first = std::asin(0.8) / 5;
  for (const Row& row : {Row{"VARVAL(1), VALUE=0.8, GE", first},
                         {"VARVAL(2), VALUE=1.6, GE", first},
                         {"VARVAL(3), VALUE=0.8, GE", first},
                         {"VARVAL(4), VALUE=0.5, GE", 1.777}}) {
    for (const double step : {4.0, 0.01}) {
      const Led r = lead(free + "SENSOR/1, HALT, FUNCTION=" + row.sensor + "\n", 4, step);
      EXPECT_EQ(r.end.end, SimulationEnd::halted) << row.sensor;
      EXPECT_NEAR(r.end.point.time, row.at, 1e-9) << row.sensor << " " << step;
    }
  }
}

TEST(DynamicsWithEvents, end_where_a_sensor_is_touched) {
  for (const std::string how : {"EQ", "GE"}) {
    const Led r = lead(decay + "SENSOR/1, FUNCTION=SIN(2*TIME), VALUE=1.0005, ERROR=1E-3, RETURN, " + how + "\n", 3, 3);
    EXPECT_THAT(r.said, HasSubstr("SENSOR/1 triggers at time 0.801")) << how;
  }
  const Led far = lead(decay + "SENSOR/1, FUNCTION=SIN(2*TIME), VALUE=1.0015, ERROR=1E-3, RETURN\n", 3, 3);
  EXPECT_EQ(far.said, "");
}

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

// Where a sensor triggers at an instant of output, which is one, unless what is put out jumps there.
TEST(DynamicsWithEvents, hands_out_once_what_is_due_for_two_reasons) {
  const auto times = [](const std::string& sensor, const std::string& value) {
    return lead(decay + "SENSOR/1, FUNCTION=TIME, GE, VALUE=" + value + ", " + sensor + "\n", 0.6, 0.6 / 6).outputs;
  };
  for (const std::string value : {"0.1", "0.2", "0.3", "0.4", "0.5"}) {
    const std::size_t before = std::stoul(value.substr(2)) + 1;
    EXPECT_EQ(times("RETURN", value).size(), before) << value;
    EXPECT_EQ(times("HALT", value).size(), before) << value;
    EXPECT_EQ(times("PRINT", value).size(), 7) << value;
    EXPECT_EQ(times("PRINT, EVALUATE=3", value).size(), 8) << value;
  }
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

// A value that jumps at an instant passes what lies between without a crossing of its own.
TEST(DynamicsWithEvents, sensors_see_what_jumps_at_an_event) {
  const std::string steps = "VARIABLE/1, FUNCTION=IF(TIME-0.13: 0, 2, 2)\n";
  for (const char* watched :
       {"VARVAL(1), VALUE=1, GE", "2-VARVAL(1), VALUE=1, LE", "VARVAL(1), VALUE=1, EQ", "VARVAL(1), VALUE=2, GE",
        "TIME+VARVAL(1), VALUE=1.5, GE", "DIF1(1)+DIF(1), VALUE=1, GE"}) {
    const Led r = lead(
        "DIFF/1, IC=1, FUNCTION=-DIF(1)+VARVAL(1)\n" + steps + "SENSOR/9, FUNCTION=" + watched + ", HALT\n", 0.4, 0.1);
    EXPECT_EQ(r.end.end, SimulationEnd::halted) << watched;
    EXPECT_NEAR(r.end.point.time, 0.13, 1e-9) << watched;
  }
  // What pushes from the touch on, at 0.5/2.1.
  const Led touch = lead(
      "PART/3, MASS=1, CM=3, IP=1,1,1, QG=0,0,1.5, VZ=-2.1\nMARKER/3\n"
      "GRAPHICS/1, PLANE, RM=1, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\nGRAPHICS/3, ELLIPSOID, CM=3, XSCALE=2, YSCALE=2, "
      "ZSCALE=2\nCONTACT/1, IGEOM=3, JGEOM=1, POISSON, PENALTY=1000, RESTITUTION_COEFFICIENT=.2\n"
      "SENSOR/9, FUNCTION=CONTACT(1,0,4,0), VALUE=20, GE, HALT\n",
      0.4, 0.1);
  EXPECT_EQ(touch.end.end, SimulationEnd::halted);
  EXPECT_NEAR(touch.end.point.time, 0.5 / 2.1, 1e-9);
  // It does not go so far.
  const Led passes = lead(decay + steps + "SENSOR/9, FUNCTION=VARVAL(1), VALUE=2.5, GE, HALT\n", 0.4, 0.1);
  EXPECT_EQ(passes.end.end, SimulationEnd::reached);
}

TEST(DynamicsWithEvents, sensors_see_what_others_set) {
  const std::string sets =
      decay + "SENSOR/5, FUNCTION=TIME, VALUE=0.13, GE, EVALUATE=2.5\nVARIABLE/1, FUNCTION=SENVAL(5)\n";
  for (const char* watched : {"SENVAL(5), VALUE=1, GE", "VARVAL(1), VALUE=1, GE", "SENVAL(5)+TIME, VALUE=2, GE"}) {
    const Led r = lead(sets + "SENSOR/9, FUNCTION=" + watched + ", HALT\n", 0.4, 0.1);
    EXPECT_EQ(r.end.end, SimulationEnd::halted) << watched;
    EXPECT_NEAR(r.end.point.time, 0.13, 1e-9) << watched;
  }
  // One after the other at one instant, each once; so do those that trigger where the run begins.
  const Led chain = lead(sets +
                             "SENSOR/6, FUNCTION=SENVAL(5), VALUE=1, GE, EVALUATE=SENVAL(5)+1\nSENSOR/7, "
                             "FUNCTION=SENVAL(6), VALUE=1, GE, EVALUATE=SENVAL(6)+1, PRINT\n",
                         0.4, 0.2);
  EXPECT_THAT(chain.said, HasSubstr("SENSOR/7 triggers at time 0.13: FUNCTION is 3.5, EVALUATE is 4.5\n"));
  EXPECT_EQ(chain.outputs.size(), 4u);
  const Led at_once = lead(decay +
                               "SENSOR/5, FUNCTION=DIF(1), VALUE=0.5, GE, EVALUATE=2.5\nSENSOR/9, "
                               "FUNCTION=SENVAL(5), VALUE=1, GE, HALT\n",
                           1, 0.5);
  EXPECT_EQ(at_once.end.end, SimulationEnd::halted);
  EXPECT_EQ(at_once.end.point.time, 0);
}

// Lateral and yaw velocity of a car on two axles that runs straight on decay to rounding, where each changes its sign
// without end and nothing follows from it.
TEST(DynamicsWithEvents, what_is_zero_but_for_rounding_stops_nothing) {
  const auto car = [](const std::string& front, const std::string& rear, const std::string& more = "") {
    return "PART/2, MASS=1500, CM=20, IP=2000,2000,2500, VX=30, VY=0.01\n"
           "MARKER/20\nMARKER/21, QP=1,0,0\nMARKER/22, QP=-1,0,0\nMARKER/91, PART=1, FLOATING\nMARKER/92, PART=1, "
           "FLOATING\nVFORCE/1, I=21, JFLOAT=91, RM=21, FY=" +
           front + "\nVFORCE/2, I=22, JFLOAT=92, RM=22, FY=" + rear + "\n" + more;
  };
  const std::string linear_front = "-2E3*VY(21,0,21)", linear_rear = "-2.5E3*VY(22,0,22)";
  for (const std::string& text :
       {car("-6E4*ATAN2(VY(21,0,21),VX(21,0,21))", "-8E4*ATAN2(VY(22,0,22),VX(22,0,22))"),
        car("IF(VX(21,0,21)-29: MAX(0,VY(21,0,21)), 0, " + linear_front + ")", linear_rear),
        car(linear_front, linear_rear, "VARIABLE/1, FUNCTION=ATAN2(VY(21,0,21),VX(21,0,21))\n"),
        car(linear_front, linear_rear, "SENSOR/1, FUNCTION=VY(21,0,21), VALUE=0, GE, EVALUATE=TIME\n")}) {
    const Led r = lead(text, 30, 10, 1e-3);
    EXPECT_EQ(r.end.end, SimulationEnd::reached);
    EXPECT_EQ(r.end.point.time, 30);
    EXPECT_NEAR(r.end.point.velocity[0], 30, 1e-4);
    EXPECT_NEAR(r.end.point.velocity[5], 0, 1e-4);
  }
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

std::string delay(const std::string& e) { return "DELAY(" + e + ",0.2,0)"; }
const std::string pulse = "100*(STEP(TIME,0.49,0,0.4901,1)-STEP(TIME,0.51,0,0.5101,1))";            // its integral: 2
const std::string bump = "SPLINE/1, X=0,0.1,0.425,0.475,0.525,0.575,0.9,1, Y=0,0,0,10,10,0,0,0\n";  // by AKISPL: 1

// Whatever e is at the instant itself, its course ends there and another one begins.
TEST(DynamicsWithEvents, a_delayed_jump_is_one_still) {
  for (const double error : {1e-3, 1e-6, 1e-9}) {
    for (const char* e : {"IF(TIME-0.3:0,0,1)", "IF(TIME-0.3:0,0.5,1)", "IF(TIME-0.3:0,1,1)", "SIGN(0.5,TIME-0.3)+0.5",
                          "0.5-SIGN(0.5,0.3-TIME)"}) {
      const Led r = lead("DIFF/1, FUNCTION=" + delay(e) + "\n", 1, 1, error);
      EXPECT_NEAR(r.end.point.state[0], 0.5, error) << e << ' ' << error;
      EXPECT_EQ(r.warned, "");
    }
  }
  EXPECT_NEAR(lead("DIFF/1, FUNCTION=" + delay("IF(TIME-0.3:0,100,IF(TIME-0.32:100,0,0))") + "\n", 1, 1, 1e-6)
                  .end.point.state[0],
              2, 1e-5);
}

TEST(DynamicsWithEvents, a_jump_of_what_a_variable_is_may_be_delayed) {
  const Led r = lead("VARIABLE/4, FUNCTION=IF(TIME-0.3:0,0,1)\nDIFF/1, FUNCTION=" + delay("VARVAL(4)") +
                         "\nDIFF/2, FUNCTION=VARVAL(4)\n",
                     1, 1, 1e-6);
  EXPECT_EQ(r.warned, "");
  EXPECT_NEAR(r.end.point.state[0], 0.5, 1e-6);
  EXPECT_NEAR(r.end.point.state[1], 0.7, 1e-6);
}

// x = 0.3 − t² until 0.2 after it is 0, at √0.3, then x″ = 2.
TEST(DynamicsWithEvents, a_relay_that_acts_late) {
  const double change = std::sqrt(0.3) + 0.2, left = 1 - change;
  for (const double error : {1e-4, 1e-7}) {
    const Led r =
        lead("DIFF/1, IC=0.3, FUNCTION=DIF(2)\nDIFF/2, FUNCTION=-2*DELAY(SIGN(1,DIF(1)),0.2,1)\n", 1, 0.2, error);
    EXPECT_NEAR(r.end.point.state[0], 0.3 - change * change - 2 * change * left + left * left, error);
    EXPECT_NEAR(r.end.point.state[1], -2 * change + 2 * left, 2 * error);
  }
}

TEST(DynamicsWithEvents, delayed_kinks_and_pulses) {
  for (const auto& [e, integral] : {std::pair<std::string, double>{"MAX(0,0.1-ABS(TIME-0.3))*100", 1},
                                    {"MAX(0,0.02-ABS(TIME-0.3))*1E4", 4},
                                    {"MAX(0,TIME-0.3)", 0.125},
                                    {pulse, 2},
                                    {"AKISPL(TIME,0,1)", 1}}) {
    for (const double error : {1e-3, 1e-6}) {
      EXPECT_NEAR(lead(bump + "DIFF/1, FUNCTION=" + delay(e) + "\n", 1, 1, error).end.point.state[0], integral,
                  2 * error * integral)
          << e << ' ' << error;
      EXPECT_NEAR(
          lead(bump + "VARIABLE/1, FUNCTION=" + e + "\nDIFF/1, FUNCTION=" + delay("VARVAL(1)") + "\n", 1, 1, error)
              .end.point.state[0],
          integral, 2 * error * integral)
          << e << " of a VARIABLE " << error;
    }
  }
}

// A bump that no step would meet by itself, whatever leads along the table.
TEST(DynamicsWithEvents, what_a_table_does_between_the_ends_of_steps) {
  for (const char* function : {"AKISPL(TIME,0,1)", "AKISPL(1-TIME,0,1)", "AKISPL(VARVAL(1),0,1)", "AKISPL(DIF(2),0,1)",
                               "0.5*AKISPL(0.5*TIME,0,1)", "IF(TIME-2:AKISPL(TIME,0,1),0,0)"}) {
    for (const double error : {1e-3, 1e-6}) {
      const bool slow = std::string(function).find("0.5*TIME") != std::string::npos;
      const Led r = lead(bump + "VARIABLE/1, FUNCTION=TIME\nDIFF/1, FUNCTION=" + function + "\nDIFF/2, FUNCTION=1\n",
                         slow ? 2 : 1, 2, error);
      EXPECT_NEAR(r.end.point.state[0], 1, error) << function << ' ' << error;
    }
  }
  for (const auto& [function, integral] : {std::pair{"CUBSPL(TIME,0,1)", 0.0}, {"INTERP(TIME,1,1)", 1.0}}) {
    const std::string text = bump + "DIFF/1, FUNCTION=" + function + "\n";
    const double fine = lead(text, 1, 0.01, 1e-8).end.point.state[0];
    if (integral != 0) {
      EXPECT_NEAR(fine, integral, 1e-6);
    }
    EXPECT_NEAR(lead(text, 1, 1, 1e-6).end.point.state[0], fine, 2e-6) << function;
  }
}

// A table that is denser than the steps costs none where it is smooth; a bump in it is not missed.
TEST(DynamicsWithEvents, tables_denser_than_the_steps) {
  const auto table = [](double (*f)(double)) {
    std::string x = "SPLINE/1, X=0", y = "\n, Y=0";
    for (int k = 1; k <= 5000; ++k) {
      x += (k % 10 == 0 ? "\n," : ",") + std::to_string(k * 0.002);
      char value[40];
      std::snprintf(value, sizeof value, k % 10 == 0 ? "\n,%.12g" : ",%.12g", f(k * 0.002));
      y += value;
    }
    return x + y + "\n";
  };
  const auto steps = [](const std::string& text, double error) { return lead(text, 10, 10, error).statistics.steps; };
  const std::string waves = table([](double t) { return std::sin(2 * t); });
  for (const double error : {1e-3, 1e-5}) {
    EXPECT_LT(steps(waves + "DIFF/1, FUNCTION=CUBSPL(TIME,0,1)\n", error),
              1.3 * static_cast<double>(steps("DIFF/1, FUNCTION=SIN(2*TIME)\n", error)));
  }
  const std::string bumped = table([](double t) { return t > 6.003 && t < 6.009 ? 100.0 : 0.0; });
  EXPECT_NEAR(lead(bumped + "DIFF/1, FUNCTION=INTERP(TIME,1,1)\n", 10, 10, 1e-6).end.point.state[0], 0.6, 1e-6);
  EXPECT_LT(steps(bumped + "DIFF/1, FUNCTION=INTERP(TIME,1,1)\n", 1e-3), 500);
}

}  // namespace
}  // namespace dynalin::system_test::dynamics_events_test
