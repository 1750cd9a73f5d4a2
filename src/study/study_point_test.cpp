// How analyses lead from one point of a study to the next, and what a changed model takes over.
#include "study/study_point.h"

#include <gmock/gmock.h>

#include <numbers>

#include "system/flexible_test_support.h"
#include "system/model_test_support.h"

namespace dynalin::study_point_test {
namespace {

using system_test::system_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Turns about the origin at 3 rad/s, drawn along x; hangs where it rests.
const std::string pendulum =
    "ACCGRAV/JGRAV=-9.81\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0, WZ=3\nMARKER/20\nMARKER/21, QP=-1,0,0\n"
    "JOINT/1, REVOLUTE, I=21, J=1\n";

// Whether the argument of the element with the id 2 holds at the next analysis.
bool states_anew(const StudyPoint& point, std::string_view statement, std::string_view argument) {
  ElementLabel label;
  label.statement = statement, label.id = 2;
  return point.restated.holds(label, argument);
}

TEST(StudyPoint, is_as_drawn_before_any_analysis) {
  const StudyPoint point = as_drawn(system_of(pendulum));
  EXPECT_FALSE(point.started);
  EXPECT_FALSE(point.consistent);
  EXPECT_EQ(point.values.poses[1].r.x, 1);
}

TEST(StudyPoint, one_that_is_consistent_stays_but_is_no_static_solution_any_more) {
  const auto rest = static_equilibrium(as_drawn(system_of(pendulum)), {});
  ASSERT_TRUE(rest);
  ASSERT_TRUE(rest->point.statics);
  EXPECT_NEAR(rest->point.values.poses[1].r.y, -1, 1e-9);
  EXPECT_NEAR(rest->point.values.velocity[5], 3, 1e-9);  // those of the dataset come back
  EXPECT_EQ(rest->point.statics->at_rest.velocity[5], 0);
  const auto same = initial_conditions(rest->point);
  ASSERT_TRUE(same);
  EXPECT_FALSE(same->point.statics);
  EXPECT_TRUE(same->point.consistent);
  EXPECT_EQ(same->point.values.poses[1].r.y, rest->point.values.poses[1].r.y);
  EXPECT_EQ(same->point.values.velocity, rest->point.values.velocity);
  EXPECT_EQ(same->point.values.lambda, rest->point.values.lambda);
}

TEST(StudyPoint, static_results_know_whether_the_solution_is_stable) {
  const auto rest = static_equilibrium(as_drawn(system_of(pendulum)), {});
  ASSERT_TRUE(rest);
  const StaticResult result = static_result(rest->point);
  EXPECT_EQ(result.iterations, rest->point.statics->iterations);
  EXPECT_EQ(result.stability.verdict, Stability::Verdict::stable);
  ASSERT_THAT(result.at_rest.bodies, SizeIs(1));
  EXPECT_EQ(result.at_rest.bodies[0].angular_velocity[2], 0);
}

TEST(StudyPoint, names_rows_that_depend_on_others) {
  const auto found = initial_conditions(as_drawn(system_of(pendulum + "JPRIM/7, INPLANE, I=21, J=1\n")));
  ASSERT_TRUE(found);
  EXPECT_THAT(found->point.redundant_rows, ElementsAre("DZ in JPRIM/7"));
  EXPECT_TRUE(found->point.consistent);
}

TEST(StudyPoint, goes_on_in_a_changed_model_but_for_what_that_states_anew) {
  const auto before = initial_conditions(as_drawn(system_of(pendulum)));
  ASSERT_TRUE(before);
  Restated restated;
  restated.state({"PART", 2}, "WZ");
  const StudyPoint now = continued(before->point, system_of("PART/3, MASS=1, CM=30\nMARKER/30\n" + pendulum), restated);
  EXPECT_TRUE(now.started);
  EXPECT_FALSE(now.consistent);
  EXPECT_TRUE(states_anew(now, "PART", "WZ"));
  EXPECT_EQ(now.values.velocity[6 + 5], before->point.values.velocity[5]);
  // One that nothing has begun with has nothing to take over.
  const StudyPoint drawn = continued(as_drawn(system_of(pendulum)), before->point.system, restated);
  EXPECT_FALSE(drawn.started);
  EXPECT_TRUE(drawn.restated.empty());
}

// A body that had no modes moves on as a whole; its shape begins as it is stated.
TEST(StudyPoint, shapes_that_were_not_there_begin_as_they_are_stated) {
  const auto bell = [](const std::string& more) {
    return system_of(system_test::dumb_bell_matrices + "FLEX_BODY/2, MATRICES=1,2,3,4,5,6,7,8,9,10,11,12,13, VX=1" +
                     more + "\n");
  };
  const auto stiff = initial_conditions(as_drawn(bell(", REPRESENTATION=RIGID")));
  ASSERT_TRUE(stiff);
  const StudyPoint now = continued(stiff->point, bell(", DMODE=0.1, VMODE=0.2"), {});
  EXPECT_TRUE(states_anew(now, "FLEX_BODY", "DMODE"));
  EXPECT_TRUE(states_anew(now, "FLEX_BODY", "VMODE"));
  EXPECT_FALSE(states_anew(now, "FLEX_BODY", "VX"));
  // With as many modes as before nothing does.
  const auto bent = initial_conditions(as_drawn(bell(", DMODE=0.1")));
  ASSERT_TRUE(bent);
  EXPECT_TRUE(continued(bent->point, bell(", DMODE=0.3"), {}).restated.empty());
}

TEST(StudyPoint, markers_move_with_their_bodies) {
  const auto found = initial_conditions(as_drawn(system_of(pendulum)));
  ASSERT_TRUE(found);
  const System& system = *found->point.system;
  const MarkerState tip = marker_state(system, found->point.values, *system.model().find_marker(20));
  EXPECT_EQ(tip.position, (Triple{1, 0, 0}));
  EXPECT_NEAR(tip.velocity[1], 3, 1e-12);
  EXPECT_NEAR(tip.angular_velocity[2], 3, 1e-12);
  EXPECT_NEAR(tip.acceleration[0], -9, 1e-12);
  EXPECT_NEAR(tip.acceleration[1], -9.81 / 2, 1e-12);
}

TEST(StudyPoint, remarks_that_have_been_made_are_not_made_again) {
  Diagnostics before, now;
  before.warning("no-units", {}, "one");
  now.warning("no-units", {}, "one");
  now.warning("no-units", {}, "two");
  now.warning("passed-over", {}, "one");
  const Diagnostics fresh = new_remarks(now, before);
  ASSERT_THAT(fresh.items(), SizeIs(2));
  EXPECT_EQ(fresh.items()[0].message, "two");
  EXPECT_EQ(fresh.items()[1].code, "passed-over");
}

TEST(StudyPoint, settings_that_nothing_acts_on_are_named_together) {
  EXPECT_THAT(passed_over({}).items(), IsEmpty());
  EXPECT_EQ(passed_over({"INTEGRATOR/HMAX"}).items().at(0).message,
            "nothing here acts on INTEGRATOR/HMAX, which is passed over");
  EXPECT_THAT(passed_over({"A", "B"}).items().at(0).message, HasSubstr("A, B, which are"));
}

}  // namespace
}  // namespace dynalin::study_point_test
