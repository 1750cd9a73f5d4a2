// An equilibrium at every output time: closed forms, jumps, and what is not found.
#include "simulation/quasi_statics.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "system/model_test_support.h"

namespace dynalin::simulation_test::quasi_statics_test {
namespace {

using system_test::system_of;
using ::testing::HasSubstr;

struct QuasiStaticRun {
  std::shared_ptr<const System> system;
  IntegrationStatistics statistics{};
  Findings findings{};
  std::vector<OperatingPoint> outputs;
  Result<QuasiStaticEnd> end = tl::unexpected(Failure{});

  QuasiStaticRun(const std::string& text, double until, std::int64_t count) : system(system_of(text)) {
    const SimulationWatch watch = [&](const SimulationStep& s) {
      if (s.output) outputs.push_back(s.point);
      return GoOn::yes;
    };
    end = advance_quasi_statics(*system, system->drawn(), {},
                                {OutputTimes::of_count(0, until, count), watch, statistics, findings});
  }
  Vector place(const OperatingPoint& op, std::int64_t marker) const {
    return system->motion(op).point(system->layout().marker(*system->model().find_marker(marker)));
  }
};

TEST(QuasiStatics, stretch_a_chain_of_springs_by_a_force_that_grows) {
  // Three beads on a line, springs of stiffness 100, 50 and 25 between them; the last is pulled.
  std::string text;
  for (int k = 2; k <= 4; ++k) {
    const std::string n = std::to_string(k);
    text += "PART/" + n + ", MASS=1, CM=" + n + "0, IP=1,1,1, QG=0,0," + std::to_string(k - 1) + "\nMARKER/" + n +
            "0\nJOINT/" + n + ", TRANSLATIONAL, I=" + n + "0, J=1\n";
  }
  text +=
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\nSPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=50, "
      "LENGTH=1\nSPRINGDAMPER/3, TRANSLATIONAL, I=40, J=30, K=25, LENGTH=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=40, "
      "J=1, "
      "FUNCTION=4*TIME\nVARIABLE/1, FUNCTION=MODE\nVARIABLE/2, FUNCTION=DELAY(VARVAL(3), 0.1, 0)\nVARIABLE/3, "
      "FUNCTION=TIME\n";
  QuasiStaticRun r(text, 10, 20);
  ASSERT_TRUE(r.end) << r.end.error().message;
  ASSERT_EQ(r.outputs.size(), 21u);
  for (const OperatingPoint& op : r.outputs) {
    const double f = 4 * op.time;
    EXPECT_NEAR(r.place(op, 20).z, 1 + f / 100, 1e-12);
    EXPECT_NEAR(r.place(op, 30).z, 2 + f / 100 + f / 50, 1e-12);
    EXPECT_NEAR(r.place(op, 40).z, 3 + f / 100 + f / 50 + f / 25, 1e-12);
    EXPECT_TRUE(std::all_of(op.velocity.begin(), op.velocity.end(), [](double v) { return v == 0; }));
    const auto value = [&](std::int64_t id) {
      for (std::size_t k = 0; k < r.system->layout().algebraic.size(); ++k) {
        const ElementLabel& owner = *r.system->layout().algebraic[k].owner;
        if (owner.statement == "VARIABLE" && owner.id == id) return op.algebraic[k];
      }
      return -1.0;
    };
    EXPECT_EQ(value(1), 6);
    EXPECT_NEAR(value(2), op.time, 1e-14);  // at rest nothing is late
  }
  EXPECT_TRUE(r.findings.warnings.items().empty()) << render(r.findings.warnings);
  EXPECT_EQ(r.end->point.time, 10);
  EXPECT_EQ(r.end->statics.at_rest.time, 10);
}

TEST(QuasiStatics, hang_a_pendulum_along_a_force_that_turns) {
  const std::string text =
      "PART/2, MASS=2, CM=20, IP=1,1,1, QG=0,-1,0\nMARKER/20\nMARKER/21, QP=0,1,0\nMARKER/9, PART=1\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nVFORCE/1, I=20, JFLOAT=8, RM=9, FX=5*SIN(TIME)\\ FY=-5*COS(TIME)\\ FZ=0\n"
      "MARKER/8, PART=1, FLOATING\n";
  QuasiStaticRun r(text, 7, 35);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    EXPECT_NEAR(r.place(op, 20).x, std::sin(op.time), 1e-9) << op.time;
    EXPECT_NEAR(r.place(op, 20).y, -std::cos(op.time), 1e-9) << op.time;
  }
}

// Two springs in a flat roof: pushed down it snaps through at a load of K (l − w)^(3/2) …, with l the length of a
// spring and w half the span: f = 2 k y (l/√(w² + y²) − 1).
TEST(QuasiStatics, a_roof_that_snaps_through_is_followed_and_told) {
  const double w = 1, y0 = 0.2, l = std::sqrt(w * w + y0 * y0), k = 1000;
  const auto load = [&](double y) { return 2 * k * y * (l / std::sqrt(w * w + y * y) - 1); };
  const double y_limit = std::sqrt(std::pow(l * w * w, 2.0 / 3) - w * w), limit = load(y_limit);
  const std::string text =
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,0.2\nMARKER/20\nMARKER/10, PART=1, QP=1,0,0\nMARKER/11, PART=1, "
      "QP=-1,0,0\nJOINT/1, TRANSLATIONAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=10, K=1000, LENGTH=" +
      fmt::format("{:.17g}", l) +
      "\nSPRINGDAMPER/2, TRANSLATIONAL, I=20, J=11, K=1000, LENGTH=" + fmt::format("{:.17g}", l) +
      "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-TIME\n";
  QuasiStaticRun r(text, 10, 20);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    const double y = r.place(op, 20).z;
    EXPECT_NEAR(load(y), op.time, 1e-9);
    EXPECT_EQ(y > 0, op.time < limit) << op.time << " of " << limit;
  }
  ASSERT_EQ(r.findings.warnings.items().size(), 1u) << render(r.findings.warnings);
  EXPECT_EQ(r.findings.warnings.items()[0].code, "equilibrium-jump");
  EXPECT_THAT(r.findings.warnings.items()[0].message, HasSubstr("PART/2 by"));
}

TEST(QuasiStatics, a_model_driven_in_time_stands_still_at_every_output) {
  // An arm turned by a motion lifts a mass on a spring; nothing of its speed counts.
  const std::string text =
      "ACCGRAV/JGRAV=-10\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=2,0,0\nJOINT/1, REVOLUTE, I=20, "
      "J=1\n"
      "MOTION/1, JOINT=1, FUNCTION=3*TIME\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=2,-1,0\nMARKER/30\nJPRIM/1, "
      "ORIENTATION, I=30, J=1\n"
      "BUSHING/1, I=30, J=21, K=50,50,50\n";
  QuasiStaticRun r(text, 2, 10);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    EXPECT_NEAR(r.place(op, 30).x, 2 * std::cos(3 * op.time), 1e-11);
    EXPECT_NEAR(r.place(op, 30).y, 2 * std::sin(3 * op.time) - 10.0 / 50, 1e-11);
    EXPECT_TRUE(std::all_of(op.velocity.begin(), op.velocity.end(), [](double v) { return v == 0; }));
  }
  // Afterwards it moves as it is driven.
  EXPECT_NEAR(r.end->point.velocity[5], 3, 1e-12);
  EXPECT_EQ(r.end->statics.at_rest.velocity[5], 0);
}

TEST(QuasiStatics, a_model_without_degrees_of_freedom_has_positions_and_forces_at_rest) {
  const std::string text =
      "ACCGRAV/JGRAV=-10\nPART/2, MASS=3, CM=21, IP=1,1,1\nMARKER/20\nMARKER/21, QP=2,0,0\nJOINT/1, REVOLUTE, I=20, "
      "J=1\n"
      "MOTION/1, JOINT=1, FUNCTION=TIME\n";
  QuasiStaticRun r(text, 2, 10);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) EXPECT_NEAR(op.lambda.back(), 60 * std::cos(op.time), 1e-11);
}

TEST(QuasiStatics, what_is_not_found_is_told_with_the_time) {
  QuasiStaticRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, "
      "ACTIONONLY, I=20, J=1, FUNCTION=TIME-TANH(DZ(20,1))\n",
      2, 8);
  ASSERT_FALSE(r.end);
  EXPECT_THAT(r.end.error().message, HasSubstr("at time 1: "));
  EXPECT_EQ(r.end.error().analysis, "quasi-static simulation");
  EXPECT_GE(r.outputs.size(), 4u);
}

// A spring of 100 pulled by 4 t: 4 t/100 passes 0.1 at t = 2.5, between two outputs. From there on SENVAL pulls as
// well.
TEST(QuasiStatics, end_where_a_sensor_says_and_follow_what_it_evaluates) {
  const std::string text =
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=4*TIME+SENVAL(2)\n"
      "SENSOR/2, FUNCTION=DZ(20,1)**2, VALUE=1.21, GE, EVALUATE=7, PRINT\n"
      "SENSOR/1, FUNCTION=DZ(20,1), VALUE=1.25, GE, ";
  for (const auto& [word, how] : {std::pair{"RETURN", SimulationEnd::returned}, {"HALT", SimulationEnd::halted}}) {
    QuasiStaticRun r(text + word + "\n", 10, 10);
    ASSERT_TRUE(r.end) << r.end.error().message;
    EXPECT_EQ(r.end->end, how);
    // (4 t + 7)/100 = 0.25
    EXPECT_NEAR(r.end->point.time, 4.5, 1e-9);
    EXPECT_NEAR(r.place(r.end->point, 20).z, 1.25, 1e-9);
    ASSERT_EQ(r.outputs.size(), 7u);  // 0, 1, 2, 2.5, 3, 4, 4.5
    EXPECT_NEAR(r.outputs[3].time, 2.5, 1e-9);
    EXPECT_NEAR(r.place(r.outputs[3], 20).z, 1.17, 1e-9);
    EXPECT_NEAR(r.place(r.outputs[5], 20).z, 1.23, 1e-12);
  }
}

// z = 1 + sin(π t)/4 is 1 at all outputs: what it does between them is seen all the same, and so is where it comes
// within ERROR and turns back.
TEST(QuasiStatics, sensors_see_what_turns_back_between_outputs) {
  const std::string pulled =
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=25*SIN(PI*TIME)\n"
      "SENSOR/1, FUNCTION=DZ(20,1), ERROR=1E-3, RETURN, ";
  const double pi = std::numbers::pi;
  for (const auto& [how, time] : {std::pair{"VALUE=1.2, GE", std::asin(0.8) / pi},
                                  {"VALUE=1.2499, EQ", std::asin(0.9996) / pi},
                                  {"VALUE=1.2503, EQ", 1 - std::asin(0.9972) / pi},
                                  {"VALUE=0.7497, LE", 2 - std::asin(0.9972) / pi}}) {
    QuasiStaticRun r(pulled + how + "\n", 3, 3);
    ASSERT_TRUE(r.end) << r.end.error().message;
    EXPECT_EQ(r.end->end, SimulationEnd::returned) << how;
    EXPECT_NEAR(r.end->point.time, time, 1e-9) << how;
  }
  QuasiStaticRun far(pulled + "VALUE=1.252\n", 3, 3);
  ASSERT_TRUE(far.end);
  EXPECT_EQ(far.end->end, SimulationEnd::reached);
}

// From 1.1 to 1.17 at t = 2.5, where another sensor adds to the force.
TEST(QuasiStatics, sensors_see_what_jumps_where_others_act) {
  QuasiStaticRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=4*TIME+SENVAL(2)\n"
      "SENSOR/2, FUNCTION=DZ(20,1), VALUE=1.1, GE, EVALUATE=7\nSENSOR/1, FUNCTION=DZ(20,1), VALUE=1.15, GE, HALT\n",
      10, 10);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_EQ(r.end->end, SimulationEnd::halted);
  EXPECT_NEAR(r.end->point.time, 2.5, 1e-9);
  EXPECT_NEAR(r.place(r.end->point, 20).z, 1.17, 1e-9);
}

TEST(QuasiStatics, change_the_time_between_outputs_where_a_sensor_says) {
  QuasiStaticRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\n"
      "SENSOR/1, FUNCTION=TIME, VALUE=2, GE, DT=0.5\n",
      3, 3);
  ASSERT_TRUE(r.end) << r.end.error().message;
  std::vector<double> times;
  for (const OperatingPoint& op : r.outputs) times.push_back(op.time);
  ASSERT_EQ(times.size(), 5u);
  for (const double t : {0.0, 1.0, 2.0, 2.5, 3.0})
    EXPECT_THAT(times, ::testing::Contains(::testing::DoubleNear(t, 1e-9)));
}

// Ten turns of a drive in one output, and a second rotor that follows on torsion springs; a force that grows fast.
// Nothing jumps.
TEST(QuasiStatics, count_the_turns_of_a_drive) {
  for (const std::int64_t count : {1, 5, 40}) {
    QuasiStaticRun r(
        "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\n"
        "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=1\nMOTION/1, JOINT=1, FUNCTION=360D*TIME\n"
        "SFORCE/1, ROTATIONAL, I=30, J=20, FUNCTION=-5*AZ(30,20)\n"
        "SFORCE/2, ROTATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=-AZ(30,1)\n"
        "VARIABLE/1, FUNCTION=AZ(20,1)\nVARIABLE/2, FUNCTION=AZ(30,1)\n",
        10, count);
    ASSERT_TRUE(r.end) << r.end.error().message;
    const double turned = 20 * std::numbers::pi;
    const std::vector<double>& values = r.end->point.algebraic;  // of the torques, then of the VARIABLEs
    ASSERT_EQ(values.size(), 4u);
    EXPECT_NEAR(values[2], turned, 1e-9) << count;
    EXPECT_NEAR(values[3], turned * 5 / 6, 1e-9) << count;
    EXPECT_TRUE(r.findings.warnings.items().empty());
  }
}

// Two turns in a hundredth of the run, between the instants at which rates are looked at: a spring reads them.
TEST(QuasiStatics, count_turns_that_are_over_soon) {
  for (const std::int64_t count : {1, 2, 10}) {
    QuasiStaticRun r(
        "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\n"
        "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=1\n"
        "MOTION/1, JOINT=1, FUNCTION=STEP(TIME,0.3,0,0.31,720D)\n"
        "SFORCE/1, ROTATIONAL, I=30, J=20, FUNCTION=-5*AZ(30,20)\n"
        "SFORCE/2, ROTATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=-AZ(30,1)\n"
        "VARIABLE/1, FUNCTION=AZ(20,1)\nVARIABLE/2, FUNCTION=AZ(30,1)\n",
        1, count);
    ASSERT_TRUE(r.end) << r.end.error().message;
    const double turned = 4 * std::numbers::pi;
    const std::vector<double>& values = r.end->point.algebraic;
    EXPECT_NEAR(values[2], turned, 1e-9) << count;
    EXPECT_NEAR(values[3], turned * 5 / 6, 1e-9) << count;
    EXPECT_TRUE(r.findings.warnings.items().empty());
  }
}

TEST(QuasiStatics, a_drive_that_jumps_is_told_once) {
  QuasiStaticRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "MOTION/1, JOINT=1, FUNCTION=IF(TIME-0.3:0,90D,90D)\nVARIABLE/1, FUNCTION=AZ(20,1)\n",
      1, 4);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_NEAR(r.end->point.algebraic.back(), std::numbers::pi / 2, 1e-9);
  EXPECT_EQ(r.findings.warnings.items().size(), 1u);
  EXPECT_LT(r.statistics.steps, 40);
}

TEST(QuasiStatics, take_a_fast_course_for_no_jump) {
  QuasiStaticRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "SFORCE/1, ROTATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-AZ(20,1)+20*TIME\nVARIABLE/1, FUNCTION=AZ(20,1)\n",
      2, 2);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_NEAR(r.end->point.algebraic.back(), 40, 1e-9);
  EXPECT_TRUE(r.findings.warnings.items().empty());
}

}  // namespace
}  // namespace dynalin::simulation_test::quasi_statics_test
