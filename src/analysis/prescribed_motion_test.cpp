// MOTIONs that prescribe a velocity or an acceleration: what they integrate is a constant of everything at one instant.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/initial.h"
#include "system/model_test_support.h"
#include "system/operating_state.h"

namespace dynalin::analysis_test::prescribed_motion_test {
namespace {

using system_test::system_of;

std::shared_ptr<const System> crank(const std::string& motion) {
  return system_of("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, " +
                   motion + "\n");
}

// Consistent on all levels at `time` with the courses `state`.
OperatingPoint at(const System& s, double time, const std::vector<double>& state) {
  OperatingPoint op = s.drawn();
  op.time = time, op.state = state;
  Findings ignored;
  auto found = assemble_position(s, op, ignored)
                   .and_then([&](OperatingPoint p) { return reconcile_velocity(s, std::move(p), ignored); })
                   .and_then([&](OperatingPoint p) { return solve_acceleration(s, std::move(p), ignored); });
  if (!found) throw std::runtime_error(found.error().message);
  return *found;
}
double turned(const OperatingPoint& op) { return std::atan2(op.poses[1].R.x.y, op.poses[1].R.x.x); }

TEST(PrescribedMotion, starts_where_it_says_or_where_it_is_drawn) {
  EXPECT_EQ(crank("VELOCITY, FUNCTION=1, ICDISP=0.5")->drawn().state, std::vector<double>{0.5});
  EXPECT_EQ(crank("ACCELERATION, FUNCTION=1, ICDISP=0.5, ICVEL=2")->drawn().state, (std::vector<double>{0.5, 2}));
  const auto drawn = system_of(
      "PART/2, MASS=1, CM=20, IP=1,1,1, REULER=0.7,0,0\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "MOTION/1, JOINT=1, ACCELERATION, FUNCTION=1\n");
  EXPECT_NEAR(drawn->drawn().state.at(0), 0.7, 1e-15);
  EXPECT_EQ(drawn->drawn().state.at(1), 0);
  EXPECT_TRUE(crank("FUNCTION=1")->drawn().state.empty());
}

TEST(PrescribedMotion, of_velocity_holds_the_displacement_that_it_has_come_to) {
  const auto s = crank("VELOCITY, FUNCTION=3*TIME**2");
  const OperatingPoint op = at(*s, 2, {20.3});  // beyond three turns
  EXPECT_NEAR(turned(op), std::remainder(20.3, 2 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(op.velocity[5], 12, 1e-13);
  EXPECT_NEAR(op.acceleration[5], 12, 1e-12);
  EXPECT_NEAR(op.state_rate[0], 12, 1e-13);
  EXPECT_EQ(op.state[0], 20.3);
}

TEST(PrescribedMotion, of_acceleration_holds_displacement_and_velocity) {
  const auto s = crank("ACCELERATION, FUNCTION=3*TIME**2");
  const OperatingPoint op = at(*s, 2, {-7.5, 4});
  EXPECT_NEAR(turned(op), std::remainder(-7.5, 2 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(op.velocity[5], 4, 1e-13);
  EXPECT_NEAR(op.acceleration[5], 12, 1e-12);
  EXPECT_NEAR(op.state_rate[0], 4, 1e-13);
  EXPECT_NEAR(op.state_rate[1], 12, 1e-12);
  std::vector<double> rates(2, -1.0);
  s->course_rates(s->motion(op), rates);
  EXPECT_EQ(rates, (std::vector<double>{4, 12}));
}

// The factors of courses in their rows, by which whoever integrates them knows their partials.
TEST(PrescribedMotion, rows_have_their_courses_with_the_factor_minus_one) {
  const auto s = crank("ACCELERATION, FUNCTION=TIME");
  ASSERT_EQ(s->layout().row_count(), 6u);
  OperatingPoint op = s->drawn();
  ConstraintRows rows;
  rows.resize(s->layout());
  op.state = {0.25, 4};
  s->constraints(s->motion(op), rows);
  EXPECT_NEAR(rows.along_motion(5).value, -0.25, 1e-15);
  EXPECT_NEAR(rows.along_motion(5).rate, -4, 1e-15);
  EXPECT_EQ(s->layout().rows[5].course, 0);
  EXPECT_EQ(s->layout().rows[5].course_rate, 1);
  EXPECT_EQ(s->layout().rows[4].course, -1);
  EXPECT_EQ(crank("VELOCITY, FUNCTION=TIME")->layout().rows[5].course_rate, -1);
}

TEST(PrescribedMotion, has_no_state_that_is_listed) {
  const auto s = crank("VELOCITY, FUNCTION=1");
  EXPECT_TRUE(operating_state(*s, at(*s, 0, {0.5})).states.empty());
  EXPECT_FALSE(s->layout().states.at(0).varies());
}

}  // namespace
}  // namespace dynalin::analysis_test::prescribed_motion_test
