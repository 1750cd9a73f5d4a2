// Branches, singular configurations and what else stands in the way of a model that is led through time.
#include <gmock/gmock.h>

#include <cmath>

#include "simulation/kinematics.h"
#include "simulation/kinematics_test_support.h"

namespace dynalin::simulation_test::kinematics_limits_test {
namespace {

using ::testing::HasSubstr;

// A crank of length a about the origin, a coupler of length b and a rocker of length c about (d, 0), drawn with the
// crank at φ and the coupler at θ; one plane, no redundant row.
std::string four_bar(double a, double b, double c, double d, double phi, double theta, const std::string& motion) {
  const auto n = [](double v) { return fmt::format("{:.17g}", v); };
  const double x = a * std::cos(phi), y = a * std::sin(phi);
  const double psi = std::atan2(y + b * std::sin(theta), x + b * std::cos(theta) - d);
  const auto link = [&](int part, double px, double py, double angle, double length) {
    const std::string k = std::to_string(part);
    return "PART/" + k + ", MASS=1, CM=" + k + "0, IP=1,1,1, QG=" + n(px) + "," + n(py) + ",0, REULER=" + n(angle) +
           ",0,0\nMARKER/" + k + "0\nMARKER/" + k + "1, QP=" + n(length) + ",0,0\n";
  };
  return link(2, 0, 0, phi, a) + link(3, x, y, theta, b) + link(4, d, 0, psi, c) + "MARKER/10, PART=1, QP=" + n(d) +
         ",0,0\nJOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=21\n"
         "JPRIM/1, INLINE, I=31, J=41\nJOINT/4, REVOLUTE, I=40, J=10\nMOTION/1, JOINT=1, " +
         motion + "\n";
}
double angle(const KinematicRun& r, const OperatingPoint& op, std::int64_t marker) {
  return angle_about_z(r.frame(op, marker)).value;
}

// A slider that trembles by less than is looked at, between two outputs often: nothing contradicts anything.
TEST(KinematicLimits, a_motion_next_to_nothing_is_followed_in_long_steps) {
  KinematicRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0\nMARKER/20, REULER=90D,90D,0\nMARKER/2, PART=1, "
      "REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=20, J=2\n"
      "MOTION/1, JOINT=1, TRANSLATION, FUNCTION=1+2E-7*SIN(1000*TIME)\n",
      7, 700);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_EQ(r.outputs.size(), 701u);
}

TEST(KinematicLimits, a_parallelogram_passes_its_change_points_and_says_so) {
  // At 180 and 360 degrees all links lie in one line.
  KinematicRun r(four_bar(1, 3, 1, 3, 0.3, 0, "FUNCTION=0.3+TIME"), 6.5, 13);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    EXPECT_NEAR(angle(r, op, 31), 0, 1e-9) << op.time;
    EXPECT_NEAR(std::remainder(angle(r, op, 41) - 0.3 - op.time, 2 * std::numbers::pi), 0, 1e-9) << op.time;
  }
  ASSERT_EQ(r.findings.warnings.items().size(), 2u) << render(r.findings.warnings);
  EXPECT_EQ(r.findings.warnings.items()[0].code, "passed-singular");
  EXPECT_THAT(r.findings.warnings.items()[0].message, HasSubstr("at time 2.841"));
}

// Outputs that meet the change points exactly, where the constraints leave velocities open.
TEST(KinematicLimits, an_output_at_a_change_point_lies_between_its_neighbours) {
  const double pi = std::numbers::pi;
  for (const double start : {pi / 6, 0.25 * pi, 1.0}) {
    const double step = (pi - start) / 5;
    KinematicRun r(four_bar(1, 3, 1, 3, start, 0, fmt::format("FUNCTION={:.17g}+{:.17g}*TIME", start, step)), 5, 5);
    ASSERT_TRUE(r.end) << r.end.error().message;
    ASSERT_EQ(r.outputs.size(), 6u);
    EXPECT_EQ(r.end->time, 5);
    for (const OperatingPoint& op : r.outputs) {
      const Taylor coupler = angle_about_z(r.frame(op, 31)), rocker = angle_about_z(r.frame(op, 41));
      EXPECT_NEAR(coupler.value, 0, 1e-10);
      EXPECT_NEAR(coupler.rate, 0, 1e-7);
      EXPECT_NEAR(coupler.acceleration, 0, 1e-4);
      EXPECT_NEAR(std::remainder(rocker.value - start - op.time * step, 2 * pi), 0, 1e-10);
      EXPECT_NEAR(rocker.rate, step, 1e-7);
    }
    KinematicRun on(four_bar(1, 3, 1, 3, start, 0, fmt::format("FUNCTION={:.17g}+{:.17g}*TIME", start, step)), 8, 8);
    ASSERT_TRUE(on.end) << on.end.error().message;
    EXPECT_NEAR(angle(on, *on.end, 31), 0, 1e-11);
    EXPECT_EQ(on.findings.warnings.items().size(), 1u) << render(on.findings.warnings);
  }
}

TEST(KinematicLimits, an_antiparallelogram_stays_one) {
  // The coupler's end is the other point of the circles: mirrored at the line from (cos φ, sin φ) to (3, 0).
  const double phi = 1.0, x = std::cos(phi), y = std::sin(phi), line = std::atan2(-y, 3 - x);
  KinematicRun r(four_bar(1, 3, 1, 3, phi, 2 * line, "FUNCTION=1+TIME"), 6, 12);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    const double now = 1 + op.time, l = std::atan2(-std::sin(now), 3 - std::cos(now));
    EXPECT_NEAR(angle(r, op, 31), 2 * l, 1e-8) << op.time;
  }
}

// All but a parallelogram: near 180 degrees the two ways of joining the links come so near each other that a long step
// would end on the wrong one.
TEST(KinematicLimits, ways_that_come_near_each_other_are_told_apart) {
  const double a = 1, b = 3.0005, c = 1, d = 3;
  const auto coupler = [&](double phi) {  // on the side where it began
    const double px = d - a * std::cos(phi), py = -a * std::sin(phi), p2 = px * px + py * py;
    return std::atan2(py, px) + std::acos((p2 + b * b - c * c) / (2 * b * std::sqrt(p2)));
  };
  KinematicRun r(four_bar(a, b, c, d, 1.0, coupler(1.0), "FUNCTION=1+TIME"), 4.5, 9);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) EXPECT_NEAR(angle(r, op, 31), coupler(1 + op.time), 1e-9) << op.time;
  EXPECT_TRUE(r.findings.warnings.items().empty());
}

TEST(KinematicLimits, a_dead_point_is_an_error_that_names_when_and_what) {
  // Crank and coupler can reach no farther than 2 + 1.5; the slider is driven through that.
  KinematicRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,1, REULER=0.5,0,0\nMARKER/20\nMARKER/21, QP=2,0,0\n"
      "POINT_MASS/4, MASS=1, CM=40, QG=3,0,0\nMARKER/40, POINT_MASS=4\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nGCON/1, FUNCTION=DM(40,21)-1.5\nGCON/2, FUNCTION=DY(40,1)\nGCON/3, "
      "FUNCTION=DZ(40,1)\nGCON/4, FUNCTION=DX(40,1)-3-0.1*TIME\n",
      10, 20);
  ASSERT_FALSE(r.end);
  EXPECT_THAT(r.end.error().message, HasSubstr("at time 5: the mechanism comes to a singular configuration"));
  EXPECT_THAT(r.end.error().message, HasSubstr("AZ of PART/2"));
  EXPECT_THAT(r.end.error().message, HasSubstr("JOINT/1"));
  EXPECT_EQ(r.outputs.size(), 10u);  // what lies before it was handed out
}

TEST(KinematicLimits, degrees_of_freedom_are_counted_and_named) {
  KinematicRun r("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, CYLINDRICAL, I=20, J=1\n", 1, 10);
  ASSERT_FALSE(r.end);
  EXPECT_THAT(r.end.error().message, HasSubstr("this one has 2; SIMULATE/DYNAMICS"));
  EXPECT_EQ(r.end.error().details, (std::vector<std::string>{"AZ of PART/2", "DZ of PART/2"}));
  EXPECT_EQ(degrees_of_freedom(*r.system, r.system->drawn()), 2u);
}

TEST(KinematicLimits, a_drive_that_jumps_is_refused) {
  KinematicRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, "
      "FUNCTION=IF(TIME-0.35: 0, 0, 1)\n",
      1, 10);
  ASSERT_FALSE(r.end);
  EXPECT_THAT(r.end.error().message, HasSubstr("at time 0.35"));
  EXPECT_THAT(r.end.error().message, HasSubstr("what drives it jumps"));
}

TEST(KinematicLimits, the_watch_ends_it_where_it_will) {
  const auto system = system_of(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, FUNCTION=TIME\n");
  Findings findings;
  IntegrationStatistics statistics;
  const SimulationWatch watch = [](const SimulationStep& s) { return s.point.time > 0.25 ? GoOn::no : GoOn::yes; };
  const auto end = advance_kinematics(*system, *initial_conditions(*system, findings), {},
                                      {OutputTimes::of_count(0, 1, 10), watch, statistics, findings});
  ASSERT_TRUE(end);
  EXPECT_DOUBLE_EQ(end->point.time, 0.3);
  EXPECT_EQ(end->end, SimulationEnd::stopped);
}

TEST(KinematicLimits, redundant_rows_may_be_off_by_what_is_allowed) {
  // Two shafts held together twice, which begin to differ as they turn.
  const std::string text =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=1\nCOUPLER/1, JOINTS=1,2, SCALES=1,-1\n"
      "GCON/1, FUNCTION=AZ(30,1)-AZ(20,1)-1E-7*AZ(20,1)**3\nMOTION/1, JOINT=1, FUNCTION=TIME\n";
  KinematicsSettings settings;
  settings.error = 1e-6;
  EXPECT_TRUE(KinematicRun(text, 1, 10, settings).end);
  KinematicRun strict(text, 1, 10);
  ASSERT_FALSE(strict.end);
  EXPECT_THAT(strict.end.error().message, HasSubstr("the constraints begin to contradict each other"));
  EXPECT_LE(strict.outputs.back().time, 0.2);
}

TEST(KinematicLimits, the_motion_that_begins_to_contradict_is_named) {
  // Two hinges on one axis, each driven; those of them are redundant as well.
  const KinematicRun run(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=0,0,1\nMARKER/2, PART=1, QP=0,0,1\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=21, J=2\nMOTION/1, JOINT=1, FUNCTION=TIME\n"
      "MOTION/2, JOINT=2, FUNCTION=TIME+0.1*MAX(TIME-1,0)\n",
      2, 10);
  ASSERT_FALSE(run.end);
  EXPECT_THAT(run.end.error().message, HasSubstr("contradict each other: rotation in MOTION/2 cannot hold"));
}

TEST(KinematicLimits, states_and_rows_on_velocities_have_to_be_integrated) {
  const std::string wheel = "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n";
  EXPECT_FALSE(needs_integration(*system_of(wheel + "MOTION/1, JOINT=1, VELOCITY, FUNCTION=1\n")));
  EXPECT_TRUE(needs_integration(*system_of(wheel + "DIFF/1, IC=0, FUNCTION=-DIF(1)\n")));
  EXPECT_FALSE(needs_integration(*system_of(wheel + "DIFF/1, IC=0, FUNCTION=-DIF(1), DYNAMIC_HOLD\n")));
  EXPECT_TRUE(needs_integration(*system_of(wheel + "GCON/1, FUNCTION=WZ(20,1)-1\n")));
}

}  // namespace
}  // namespace dynalin::simulation_test::kinematics_limits_test
