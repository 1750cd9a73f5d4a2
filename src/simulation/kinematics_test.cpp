// Mechanisms without degrees of freedom through time, against closed forms in positions, velocities, accelerations and
// reactions. The closed forms are evaluated along the motion, so that their rates come with them.
#include "simulation/kinematics.h"

#include <cmath>

#include "simulation/kinematics_test_support.h"

namespace dynalin::simulation_test::kinematics_test {
namespace {

// A crank of length 1 about z, driven along φ(t), and a rod of length 3 without mass; a slider of mass 2 along x.
std::string slider_crank(const std::string& motion, const std::string& more = "") {
  return "PART/2, MASS=0, CM=20, IP=0,0,0\nMARKER/20\nMARKER/21, QP=1,0,0\n"
         "PART/3, MASS=0, CM=30, IP=0,0,0, QG=1,0,0\nMARKER/30\nMARKER/31, QP=3,0,0\n"
         "PART/4, MASS=2, CM=40, IP=1,1,1, QG=4,0,0\nMARKER/40\nMARKER/41, REULER=90D,90D,0\n"
         "MARKER/10, PART=1, REULER=90D,90D,0\n"
         "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, SPHERICAL, I=30, J=21\nJOINT/3, UNIVERSAL, I=31, J=42\n"
         "MARKER/42, PART=4, REULER=0,90D,0\n"
         "JOINT/4, TRANSLATIONAL, I=41, J=10\n"
         "MOTION/1, JOINT=1, " +
         motion + "\n" + more;
}

TEST(Kinematics, of_a_slider_crank_have_its_closed_form) {
  KinematicRun r(slider_crank("FUNCTION=2*TIME+0.3*TIME**2"), 8, 37);
  ASSERT_TRUE(r.end) << r.end.error().message;
  ASSERT_EQ(r.outputs.size(), 38u);
  EXPECT_EQ(r.end->time, 8);
  for (const OperatingPoint& op : r.outputs) {
    const Taylor t = at_time(op), phi = 2.0 * t + 0.3 * t * t, s = sin(phi);
    const Taylor x = cos(phi) + sqrt(Taylor(9) - s * s);
    expect_near(r.frame(op, 40).origin.x, x);
    expect_near(r.frame(op, 21).origin.y, s);
    // The torque of the drive works on the slider alone: T φ′ = m x″ x′.
    const double torque = 2 * x.acceleration * x.rate / phi.rate;
    EXPECT_NEAR(r.lambda(op, "MOTION/1"), torque, 1e-9 * std::max(1.0, std::abs(torque))) << op.time;
    EXPECT_EQ(op.mode, AnalysisMode::kinematics);
  }
  EXPECT_EQ(r.outputs[1].time, 8.0 / 37);
}

// Four links in a plane, all hinged: three rows are redundant.
std::string four_bar(double a, double b, double c, double d, const std::string& motion, const std::string& more = "") {
  // Drawn with the crank along x; the coupler's end where circles about both its neighbours meet.
  const double e = d - a, x = (e * e + b * b - c * c) / (2 * e), y = std::sqrt(b * b - x * x);
  const auto n = [](double v) { return fmt::format("{:.17g}", v); };
  const auto turned = [&](double angle) { return "REULER=" + n(angle) + ",0,0"; };
  return "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=" + n(a) + ",0,0\n" +
         "PART/3, MASS=1, CM=30, IP=1,1,1, QG=" + n(a) + ",0,0, " + turned(std::atan2(y, x)) +
         "\nMARKER/30\nMARKER/31, QP=" + n(b) + ",0,0\nPART/4, MASS=1, CM=40, IP=1,1,1, QG=" + n(d) + ",0,0, " +
         turned(std::atan2(y, x - e)) + "\nMARKER/40\nMARKER/41, QP=" + n(c) + ",0,0\nMARKER/10, PART=1, QP=" + n(d) +
         ",0,0\nJOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=21\nJOINT/3, REVOLUTE, I=31, J=41\n"
         "JOINT/4, REVOLUTE, I=40, J=10\nMOTION/1, JOINT=1, " +
         motion + "\n" + more;
}
// Angle of the rocker, the joint of coupler and rocker to the left of the line from crank to rocker's hinge.
Taylor rocker(const Taylor& phi, double a, double b, double c, double d) {
  const Taylor px = a * cos(phi) - Taylor(d), py = a * sin(phi), p2 = px * px + py * py;
  // (p − c e(ψ))² = b², ψ from the direction of p
  const Taylor k = (p2 + Taylor(c * c - b * b)) / (2.0 * c);
  return atan2(py, px) - atan2(sqrt(p2 - k * k), k);
}

TEST(Kinematics, of_a_four_bar_have_its_closed_form_and_pass_over_redundant_rows) {
  const double a = 1, b = 3, c = 2.5, d = 3.5;
  KinematicRun r(four_bar(a, b, c, d, "FUNCTION=3*TIME"), 5, 50);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_EQ(r.findings.redundant_rows.size(), 3u);
  for (const OperatingPoint& op : r.outputs)
    expect_angle(angle_about_z(r.frame(op, 41)), rocker(3.0 * at_time(op), a, b, c, d));
}

TEST(Kinematics, take_steps_between_outputs_where_turns_ask_for_them) {
  const double a = 1, b = 3, c = 2.5, d = 3.5;
  KinematicRun r(four_bar(a, b, c, d, "FUNCTION=3*TIME", "VARIABLE/1, FUNCTION=AZ(20,1)\n"), 20, 4);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_GE(r.steps.size(), 120u);  // half a radian each
  for (const OperatingPoint& op : r.outputs) {
    expect_angle(angle_about_z(r.frame(op, 41)), rocker(3.0 * at_time(op), a, b, c, d));
    EXPECT_NEAR(r.variable(op, 1), 3 * op.time, 1e-11);
  }
}

TEST(Kinematics, take_no_step_longer_than_HMAX) {
  KinematicsSettings settings;
  settings.largest_step = 0.01;
  KinematicRun r(slider_crank("FUNCTION=0.1*TIME"), 1, 2, settings);
  ASSERT_TRUE(r.end);
  EXPECT_EQ(r.steps.size(), 101u);
  EXPECT_EQ(r.statistics.steps, 100);
}

// In space: a crank about z and a rocker about x with a rod between two balls.
TEST(Kinematics, of_a_spatial_four_bar_have_its_closed_form) {
  const double a = 0.4, c = 1.2;
  const std::string text =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=0.4,0,0\n"
      "PART/4, MASS=1, CM=40, IP=1,1,1, QG=0,1.5,0\nMARKER/40, REULER=90D,90D,0\nMARKER/41, QP=0,0,1.2\n"
      "MARKER/10, PART=1, QP=0,1.5,0, REULER=90D,90D,0\n"
      // from (0.4, 0, 0) to (0, 1.5, 1.2)
      "PART/3, MASS=1, CM=30, IP=1,1,1, QG=0.4,0,0\nMARKER/30\nMARKER/31, QP=-0.4,1.5,1.2\nMARKER/32, QP=-0.4,1.5,1.2\n"
      "MARKER/42, PART=4, QP=0,0,1.2, REULER=90D,90D,0\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, SPHERICAL, I=30, J=21\nJOINT/3, UNIVERSAL, I=32, J=42\n"
      "JOINT/4, REVOLUTE, I=40, J=10\nMOTION/1, JOINT=1, FUNCTION=2*TIME\n";
  KinematicRun r(text, 4, 40);
  ASSERT_TRUE(r.end) << r.end.error().message;
  const double L2 = 0.16 + 2.25 + 1.44;
  for (const OperatingPoint& op : r.outputs) {
    // The rocker's ball at (0, 1.5 − c sin ψ, c cos ψ), the crank's at (a cos φ, a sin φ, 0)
    const Taylor phi = 2.0 * at_time(op), x = a * cos(phi), y = Taylor(1.5) - a * sin(phi);
    const Taylor k = (x * x + y * y + Taylor(c * c - L2)) / (2.0 * c);  // y sin ψ = k
    const Taylor psi = atan2(k, sqrt(y * y - k * k));
    const Frame<Taylor> f = r.frame(op, 41);
    expect_near(f.origin.y, Taylor(1.5) - c * sin(psi));
    expect_near(f.origin.z, c * cos(psi));
  }
}

TEST(Kinematics, of_a_hooke_joint_have_its_closed_form_over_many_turns) {
  // The second shaft at 0.5 rad to the first, in the plane of x and z.
  const double beta = 0.5;
  const std::string text =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nPART/3, MASS=1, CM=30, IP=3,3,4, REULER=90D,0.5,-90D\nMARKER/30\n"
      "MARKER/10, PART=1, REULER=90D,0.5,-90D\nMARKER/31, PART=3\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "JOINT/2, REVOLUTE, I=30, J=10\nJOINT/3, HOOKE, I=20, J=31\nMOTION/1, JOINT=1, FUNCTION=5*TIME\n"
      "VARIABLE/1, FUNCTION=AZ(30,10)\nVARIABLE/2, FUNCTION=WZ(30,10,10)\nVARIABLE/3, FUNCTION=WDTZ(30,10,10)\n";
  KinematicRun r(text, 10, 100);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_EQ(r.findings.redundant_rows.size(), 3u);
  for (const OperatingPoint& op : r.outputs) {
    const Taylor theta = 5.0 * at_time(op);
    Taylor psi = atan2(sin(theta), std::cos(beta) * cos(theta));
    psi.value += 2 * std::numbers::pi * std::round((theta.value - psi.value) / (2 * std::numbers::pi));
    expect_near({r.variable(op, 1), r.variable(op, 2), r.variable(op, 3)}, psi);
    // The inertia of the second shaft alone costs work.
    EXPECT_NEAR(r.lambda(op, "MOTION/1"), 4 * psi.acceleration * psi.rate / 5, 1e-8);
  }
}

// A parabola of height 1.7 x² that is pushed to and fro under a follower of mass 3.
TEST(Kinematics, of_a_cam_have_positions_and_forces_of_its_shape) {
  const std::string text =
      "ACCGRAV/JGRAV=-9.81\nMARKER/9, FLOATING, PART=2\nMATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3\n"
      ", VALUES=-1,1.7,0, -0.5,0.425,0, 0,0,0, 0.5,0.425,0, 1,1.7,0\nCURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n"
      "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, REULER=90D,90D,0\nMARKER/10, PART=1, REULER=90D,90D,0\n"
      "JOINT/1, TRANSLATIONAL, I=21, J=10\nPART/3, MASS=3, CM=30, IP=1,1,1\nMARKER/30\nMARKER/31, REULER=0,90D,0\n"
      "MARKER/11, PART=1, REULER=0,90D,0\nJOINT/2, TRANSLATIONAL, I=31, J=11\n"
      "PTCV/1, I=30, JFLOAT=9, CURVE=1, RM=20\nMOTION/1, JOINT=1, FUNCTION=0.6*SIN(3*TIME)\n";
  KinematicRun r(text, 3, 60);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    const Taylor x = 0.6 * sin(3.0 * at_time(op)), y = 1.7 * x * x;
    expect_near(r.frame(op, 30).origin.y, y);
    expect_near(r.frame(op, 20).origin.x, x);
    const double force = 2 * x.acceleration + 3 * (9.81 + y.acceleration) * 3.4 * x.value;
    EXPECT_NEAR(r.lambda(op, "MOTION/1"), force, 1e-9 * std::max(1.0, std::abs(force)));
  }
}

TEST(Kinematics, of_gears_keep_their_ratio_over_many_turns) {
  const std::string text =
      "MARKER/8, QP=0.1,0,0, REULER=180D,90D,0\nMARKER/9, QP=0.4,0,0\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "PART/3, MASS=1, CM=30, IP=5,5,9, QG=0.4,0,0\nMARKER/30\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "JOINT/2, REVOLUTE, I=30, J=9\nGEAR/1, JOINTS=1,2, CV=8\nMOTION/1, JOINT=1, FUNCTION=30*TIME+SIN(TIME)\n"
      "VARIABLE/1, FUNCTION=AZ(30,9)\n";
  KinematicRun r(text, 7, 35);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    const Taylor t = at_time(op), q = 30.0 * t + sin(t);
    EXPECT_NEAR(r.variable(op, 1), -q.value / 3, 1e-11);
    expect_angle(angle_about_z(r.frame(op, 30)), (-1.0 / 3) * q);
    // Both inertias, the second geared down: 1 + 9/9.
    EXPECT_NEAR(r.lambda(op, "MOTION/1"), 2 * q.acceleration, 1e-9);
  }
}

TEST(Kinematics, have_values_of_functions_where_nothing_can_move) {
  KinematicRun r("VARIABLE/1, FUNCTION=TIME**2\n", 3, 6);
  ASSERT_TRUE(r.end) << r.end.error().message;
  ASSERT_EQ(r.outputs.size(), 7u);
  for (const OperatingPoint& op : r.outputs) EXPECT_DOUBLE_EQ(r.variable(op, 1), op.time * op.time);
}

std::string wheel(const std::string& motion) {
  return "PART/2, MASS=1, CM=20, IP=3,3,4\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\nVARIABLE/1, FUNCTION=AZ(20,1)\n"
         "MOTION/1, JOINT=1, " +
         motion + "\n";
}

TEST(Kinematics, integrate_a_motion_of_velocity) {
  KinematicRun r(wheel("VELOCITY, FUNCTION=10+3*COS(5*TIME), ICDISP=0.5"), 20, 80);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    const Taylor t = at_time(op), q = Taylor(0.5) + 10.0 * t + 0.6 * sin(5.0 * t);
    EXPECT_NEAR(r.variable(op, 1), q.value, 1e-11 * (1 + q.value));
    expect_angle(angle_about_z(r.frame(op, 20)), q);
    EXPECT_NEAR(op.state[0], q.value, 1e-11 * (1 + q.value));
    EXPECT_NEAR(r.lambda(op, "MOTION/1"), 4 * q.acceleration, 1e-9 * 60);
  }
}

TEST(Kinematics, integrate_a_motion_of_acceleration) {
  KinematicRun r(wheel("ACCELERATION, FUNCTION=2-6*EXP(-TIME), ICDISP=-1, ICVEL=3"), 12, 24);
  ASSERT_TRUE(r.end) << r.end.error().message;
  for (const OperatingPoint& op : r.outputs) {
    const Taylor t = at_time(op), q = Taylor(-1) + 3.0 * t + t * t + -6.0 * (exp(-t) - Taylor(1) + t);
    EXPECT_NEAR(r.variable(op, 1), q.value, 1e-11 * (1 + std::abs(q.value)));
    expect_angle(angle_about_z(r.frame(op, 20)), q);
  }
}

// Of the angle itself 1e-8 is rounding; of what is left without whole turns nothing is.
TEST(Kinematics, go_on_from_ten_million_turns) {
  KinematicRun r(wheel("VELOCITY, FUNCTION=1, ICDISP=1E8"), 1, 4);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_NEAR(r.variable(*r.end, 1) - r.variable(r.outputs[0], 1), 1, 1e-7);
}

TEST(Kinematics, go_over_a_velocity_that_jumps) {
  KinematicRun r(wheel("VELOCITY, FUNCTION=IF(TIME-0.53: 1, 1, 3)"), 1, 7);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_NEAR(r.end->state[0], 0.53 + 3 * 0.47, 1e-12);
  EXPECT_NEAR(r.variable(*r.end, 1), 0.53 + 3 * 0.47, 1e-12);
}

// A whole turn from rest to rest within one output, by displacement, velocity and acceleration, of a joint or a pair of
// markers: a screw counts it.
TEST(Kinematics, count_turns_that_begin_and_end_within_a_step) {
  const std::string screw =
      "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=30, J=1\nJOINT/3, SCREW, I=30, J=20, PITCH=0.5\n"
      "VARIABLE/1, FUNCTION=AZ(20,1)\nVARIABLE/2, FUNCTION=DZ(30,1)\n";
  for (const char* driven :
       {"MOTION/1, JOINT=1, FUNCTION=STEP(TIME,0.1,0,0.9,2*PI)\n",
        "MOTION/1, I=20, J=1, B3, FUNCTION=STEP(TIME,0.6,0,0.9,2*PI)\n",
        "MOTION/1, JOINT=1, VELOCITY, FUNCTION=STEP(TIME,0.1,0,0.5,2.5*PI)-STEP(TIME,0.5,0,0.9,2.5*PI)\n",
        "MOTION/1, JOINT=1, ACCELERATION, FUNCTION=IF(TIME-0.5:8*PI,0,-8*PI)\n"}) {
    KinematicRun r(screw + driven, 1, 1);
    ASSERT_TRUE(r.end) << driven << r.end.error().message;
    const double turn =
        std::string(driven).find("VELOCITY") != std::string::npos ? std::numbers::pi : 2 * std::numbers::pi;
    EXPECT_NEAR(r.variable(*r.end, 1), turn, 1e-9) << driven;
    EXPECT_NEAR(r.variable(*r.end, 2), -0.5 * turn / (2 * std::numbers::pi), 1e-9) << driven;
  }
}

// Turns that are done in the hundredth part of an output or less: the function knows where it begins and where it ends.
// A coupler counts them.
TEST(Kinematics, count_turns_that_are_over_soon) {
  const std::string coupled =
      "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/3, REVOLUTE, I=30, J=1\nCOUPLER/1, JOINTS=1,3, SCALES=1,-3\n"
      "VARIABLE/1, FUNCTION=AZ(20,1)\nVARIABLE/2, FUNCTION=AZ(30,1)\nVARIABLE/3, FUNCTION=AZ(20,30)\n";
  for (const char* driven : {"MOTION/1, JOINT=1, FUNCTION=STEP(TIME,0.3,0,0.31,720D)\n",
                             "MOTION/1, JOINT=1, FUNCTION=STEP(TIME,0.3,0,0.30001,720D)\n",
                             "MOTION/1, I=20, J=1, B3, FUNCTION=STEP(TIME,0.3,0,0.31,720D)\n",
                             "MOTION/1, JOINT=1, FUNCTION=IF(TIME-0.2:0,360D,360D)+STEP(TIME,0.3,0,0.31,720D)\n",
                             "MOTION/1, JOINT=1, VELOCITY, FUNCTION=IF(TIME-0.3:0,0,IF(TIME-0.31:720D/0.01,0,0))\n",
                             "MOTION/1, JOINT=1, ACCELERATION, FUNCTION=IF(TIME-0.3:0,0,IF(TIME-0.31:720D/0.0001,0,"
                             "IF(TIME-0.32:-720D/0.0001,0,0)))\n"}) {
    for (const std::int64_t outputs : {1, 2, 3, 10}) {
      KinematicRun r(coupled + driven, 1, outputs);
      ASSERT_TRUE(r.end) << driven << r.end.error().message;
      const double turned = 4 * std::numbers::pi;
      EXPECT_NEAR(r.variable(*r.end, 1), turned, 1e-9) << driven << outputs;
      EXPECT_NEAR(r.variable(*r.end, 2), turned / 3, 1e-9) << driven << outputs;
      EXPECT_NEAR(r.variable(*r.end, 3), turned * 2 / 3, 1e-9) << driven << outputs;
    }
  }
}

// A speed that is there for 0.06 s of 2 s: no point at which a step is looked at lies in it.
TEST(Kinematics, miss_no_pulse_of_a_speed) {
  KinematicRun r(
      "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "MOTION/1, JOINT=1, VELOCITY, FUNCTION=STEP(TIME,1.02,0,1.05,1)-STEP(TIME,1.05,0,1.08,1)\n"
      "VARIABLE/1, FUNCTION=DZ(20,1)\n",
      2, 1);
  ASSERT_TRUE(r.end) << r.end.error().message;
  EXPECT_NEAR(r.variable(*r.end, 1), 0.03, 1e-12);
}

// The same of a table.
TEST(Kinematics, miss_no_pulse_of_a_speed_that_a_table_gives) {
  for (const auto& [course, way] : {std::pair{"VELOCITY", 1.0}, std::pair{"ACCELERATION", 0.5}}) {
    KinematicRun r(std::string("PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
                               "SPLINE/1, X=0,0.1,0.425,0.475,0.525,0.575,0.9,1, Y=0,0,0,10,10,0,0,0\n"
                               "VARIABLE/1, FUNCTION=DZ(20,1)\nMOTION/1, JOINT=1, FUNCTION=AKISPL(TIME,0,1), ") +
                       course + "\n",
                   1, 1);
    ASSERT_TRUE(r.end) << r.end.error().message;
    EXPECT_NEAR(r.variable(*r.end, 1), way, 1e-12);
  }
}

}  // namespace
}  // namespace dynalin::simulation_test::kinematics_test
