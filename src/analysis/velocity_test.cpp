// Velocities of the start: what is stated is kept, the rest changes least, contradictions are told.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "analysis/initial.h"
#include "system/model_test_support.h"

namespace dynalin::analysis_test::velocity_test {
namespace {

using system_test::system_of;
using ::testing::HasSubstr;

struct Start {
  std::shared_ptr<const System> system;
  Findings findings{};
  Result<OperatingPoint> op;

  explicit Start(const std::string& text)
      : system(system_of(text)), op(initial_velocity(*system, system->drawn(), findings)) {}
  double velocity(std::size_t k) const { return op->velocity.at(k); }
};

void expect_velocity(const Start& s, const std::vector<double>& expected, double tolerance = 1e-13) {
  ASSERT_TRUE(s.op) << s.op.error().message;
  ASSERT_EQ(s.op->velocity.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(s.velocity(k), expected[k], tolerance)
        << s.system->layout().coordinate_text(static_cast<std::int32_t>(k));
}

TEST(Velocity, of_the_mass_centre_is_stated_and_that_of_the_origin_follows) {
  // v_BCS = v_C − ω × c with c = (0, 2, 0)
  const Start s("PART/2, MASS=1, CM=20, IP=1,1,1, VX=1, VY=2, VZ=3, WX=0.5, WY=-1, WZ=2\nMARKER/20, QP=0,2,0\n");
  expect_velocity(s, {1 + 4, 2, 3 - 1, 0.5, -1, 2});
}

TEST(Velocity, is_stated_along_the_axes_that_are_named) {
  // MARKER/2: x along y, y along −x. WM: the same for the angular velocity.
  const Start s(
      "MARKER/2, REULER=90D,0,0\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1, VX=1, VY=0, VZ=0, VM=2, WX=3, WY=0, WZ=0, WM=2\nMARKER/20\n");
  expect_velocity(s, {0, 1, 0, 0, 3, 0});
}

TEST(Velocity, of_a_hinged_part_follows_from_its_turning) {
  const Start s(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0, WZ=3\nMARKER/20\nMARKER/21, QP=-1,0,0\n"
      "JOINT/1, REVOLUTE, I=21, J=1\n");
  expect_velocity(s, {0, 3, 0, 0, 0, 3});
}

// v + d ω = 2 of a point at d from the mass centre, with the least v² + L² ω².
TEST(Velocity, the_rest_changes_least_in_velocities_of_the_mass_centre_and_turns_by_the_length) {
  const double d = 3, b = 1;  // the mass centre at (b, 0, 0), the marker at (b + d, 0, 0)
  const Start s(
      "MARKER/2, QP=0,0,3\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, QP=1,0,0\nMARKER/21, QP=4,0,0\n"
      "GCON/1, FUNCTION=VY(21,1)-2\n");
  const double L2 = s.system->length() * s.system->length(), w = 2 * d / (L2 + d * d), v = 2 * L2 / (L2 + d * d);
  EXPECT_DOUBLE_EQ(s.system->length(), 5);
  expect_velocity(s, {0, v - w * b, 0, 0, 0, w});
}

TEST(Velocity, what_is_stated_drives_what_is_not) {
  const Start s(
      "POINT_MASS/2, MASS=1, CM=20, QG=0,0,0, VX=2, VY=1\nMARKER/20, POINT_MASS=2\n"
      "POINT_MASS/3, MASS=9, CM=30, QG=3,0,0\nMARKER/30, POINT_MASS=3\nGCON/1, FUNCTION=DM(20,30)-3\n");
  expect_velocity(s, {2, 1, 0, 2, 0, 0});
}

TEST(Velocity, constraints_that_move_in_time_take_parts_with_them) {
  const Start s("POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\nGCON/1, FUNCTION=DX(20,1)+2*DY(20,1)-5*TIME\n");
  expect_velocity(s, {1, 2, 0});
}

TEST(Velocity, a_rate_asked_of_a_joint_is_one_of_the_conditions) {
  const Start s(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,2\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1, IC=2,0.75\n");
  expect_velocity(s, {0, 0, 0.75, 0, 0, 0});
  EXPECT_FALSE(s.findings.warnings.has_errors());
}

TEST(Velocity, stated_values_that_are_met_are_exactly_what_is_stated) {
  const Start s(
      "POINT_MASS/2, MASS=1, CM=20, QG=1,0,0, VX=0.1, VY=0.3, VZ=0.7\nMARKER/20, POINT_MASS=2\n"
      "GCON/1, FUNCTION=3*DX(20,1)-DY(20,1)-3\n");
  ASSERT_TRUE(s.op);
  EXPECT_EQ(s.velocity(0), 0.1);
  EXPECT_EQ(s.velocity(2), 0.7);
  EXPECT_TRUE(s.findings.warnings.items().empty());
}

TEST(Velocity, stated_values_that_contradict_a_constraint_give_way_alike_and_are_told) {
  // x′ + y′ = 0 asks (1, 0.5) to go to the nearest (a, −a): a = 1/4
  const Start s(
      "POINT_MASS/2, MASS=1, CM=20, VX=1, VY=0.5, VZ=3\nMARKER/20, POINT_MASS=2\n"
      "GCON/1, FUNCTION=DX(20,1)+DY(20,1)\n");
  expect_velocity(s, {0.25, -0.25, 3}, 1e-9);
  ASSERT_EQ(s.findings.warnings.items().size(), 2u);
  EXPECT_EQ(s.findings.warnings.items()[0].code, "changed-velocity");
  EXPECT_THAT(s.findings.warnings.items()[0].message, HasSubstr("VX of POINT_MASS/2 = 1 "));
  EXPECT_THAT(s.findings.warnings.items()[0].message, HasSubstr("changed to 0.25"));
  EXPECT_THAT(s.findings.warnings.items()[1].message, HasSubstr("VY of POINT_MASS/2"));
}

// At d from its hinge a mass centre is stated to move by v and not to turn: least (d ω − v)² + L² ω², in any unit.
TEST(Velocity, stated_turns_give_way_by_the_length) {
  for (const double unit : {1.0, 1000.0, 0.01}) {
    const double d = 2 * unit, v = 3 * unit;
    const Start s(
        fmt::format("PART/2, MASS=1, CM=20, IP=1,1,1, QG={0},0,0, VY={1}, WZ=0\nMARKER/20\n"
                    "MARKER/21, QP=-{0},0,0\nJOINT/1, REVOLUTE, I=21, J=1\n",
                    d, v));
    const double L = s.system->length(), w = d * v / (d * d + L * L);
    EXPECT_NEAR(L, 2 * unit, 1e-12 * unit);
    ASSERT_TRUE(s.op);
    EXPECT_NEAR(s.velocity(5), w, 1e-9);
    EXPECT_NEAR(s.velocity(1), d * w, 1e-9 * unit);
    EXPECT_EQ(s.findings.warnings.items().size(), 2u);
  }
}

// A bar from its hinge to a mass centre at 0.4, turned by `angle` from the direction in which that is stated to move.
Start along_a_bar(double angle, const std::string& more = "") {
  return Start(fmt::format("PART/2, MASS=2, CM=20, IP=1,1,1, QG={:.17g},{:.17g},0, REULER={:.17g},0,0, VX=1\n"
                           "MARKER/20\nMARKER/21, QP=-0.4,0,0\nJOINT/1, REVOLUTE, I=21, J=1\n",
                           0.4 * std::cos(angle), 0.4 * std::sin(angle), angle) +
               more);
}
std::vector<std::string> codes_of(const Start& s) {
  std::vector<std::string> codes;
  for (const auto& remark : s.findings.warnings.items()) codes.emplace_back(remark.code);
  return codes;
}

TEST(Velocity, stated_along_a_bar_is_kept_or_given_up_and_never_kept_in_part) {
  // Another that contradicts a constraint of its own, and follows from it alone.
  const std::string contradicting =
      "PART/3, MASS=1, CM=30, IP=1,1,1, VX=1\nMARKER/30\nJOINT/2, TRANSLATIONAL, I=30, J=1\n";
  for (const std::string& more : {std::string(), contradicting}) {
    const std::size_t others = more.empty() ? 0 : 1;
    for (const double angle : {0.0, 1e-14, 1e-11, 1e-10, 3e-10}) {
      const Start s = along_a_bar(angle, more);
      ASSERT_TRUE(s.op);
      EXPECT_NEAR(s.velocity(5), 0, 1e-12) << angle;
      EXPECT_EQ(codes_of(s), std::vector<std::string>(1 + others, "changed-velocity")) << angle;
      EXPECT_THAT(s.findings.warnings.items().back().message + s.findings.warnings.items().front().message,
                  HasSubstr("VX of PART/2 = 1 contradicts"));
    }
    for (const double angle : {1e-5, 1e-4}) {
      const Start s = along_a_bar(angle, more);
      ASSERT_TRUE(s.op);
      EXPECT_NEAR(s.velocity(5) * angle, -1 / 0.4, 1e-6) << angle;
    }
  }
}

TEST(Velocity, that_takes_far_larger_ones_is_told) {
  const Start s = along_a_bar(1e-4);
  ASSERT_EQ(codes_of(s), std::vector<std::string>{"amplified-velocity"});
  EXPECT_THAT(
      s.findings.warnings.items()[0].message,
      HasSubstr("the initial velocity VX of PART/2 = 1 is kept by others that are 1e+04 times as large, most of "
                "all of PART/2 (mass centre 10000 "));
  EXPECT_THAT(codes_of(along_a_bar(0.01)), ::testing::IsEmpty());
  // What a motion drives is no part of it.
  EXPECT_THAT(codes_of(along_a_bar(0.01,
                                   "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nJOINT/2, REVOLUTE, I=30, J=1\n"
                                   "MOTION/1, JOINT=2, FUNCTION=1E9*TIME\n")),
              ::testing::IsEmpty());
}

TEST(Velocity, constraints_that_contradict_each_other_fail_by_name) {
  const Start s(
      "POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\nGCON/1, FUNCTION=DX(20,1)-TIME\n"
      "GCON/2, FUNCTION=DX(20,1)-2*TIME\n");
  ASSERT_FALSE(s.op);
  EXPECT_THAT(s.op.error().message, HasSubstr("contradict each other on velocities"));
  ASSERT_EQ(s.op.error().details.size(), 1u);
  EXPECT_THAT(s.op.error().details[0], HasSubstr("GCON/"));
}

TEST(Velocity, redundant_constraints_may_differ_by_what_ic_states_of_velocities_and_no_more) {
  const std::string model =
      "POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\nGCON/1, FUNCTION=DX(20,1)-TIME\n"
      "GCON/2, FUNCTION=DX(20,1)-1.0000001*TIME\n";
  EXPECT_FALSE(Start(model).op);
  EXPECT_TRUE(Start(model + "IC/VERROR=1E-6\n").op);
  EXPECT_FALSE(Start(model + "IC/AERROR=1E-6\n").op);
}

TEST(Velocity, redundant_constraints_that_agree_are_no_contradiction) {
  const Start s(
      "POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\nGCON/1, FUNCTION=DX(20,1)-TIME\n"
      "GCON/2, FUNCTION=3*DX(20,1)-3*TIME\n");
  expect_velocity(s, {1, 0, 0});
}

TEST(Velocity, reconciling_changes_a_point_least_and_states_nothing) {
  const auto system = system_of(
      "POINT_MASS/2, MASS=1, CM=20, VX=9\nMARKER/20, POINT_MASS=2\n"
      "GCON/1, FUNCTION=DX(20,1)+DY(20,1)\n");
  Findings findings;
  OperatingPoint op = system->drawn();
  op.velocity = {3, 1, 7};
  const auto found = reconcile_velocity(*system, op, findings);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->velocity[0], 1, 1e-13);
  EXPECT_NEAR(found->velocity[1], -1, 1e-13);
  EXPECT_NEAR(found->velocity[2], 7, 1e-13);
  EXPECT_TRUE(findings.warnings.items().empty());
}

}  // namespace
}  // namespace dynalin::analysis_test::velocity_test
