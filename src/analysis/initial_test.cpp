// The sequence of initial conditions: its levels in turn, whose velocities hold, what is said of parts that move.
#include "analysis/initial.h"

#include <gmock/gmock.h>

#include "system/model_test_support.h"

namespace dynalin::analysis_test::initial_test {
namespace {

using system_test::system_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::SizeIs;

// A part that turns about the origin, drawn `gap` off its hinge.
std::string hinged(double gap) {
  return "PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0, WZ=3\nMARKER/20\nMARKER/21, QP=" + std::to_string(gap - 1) +
         ",0,0\nJOINT/1, REVOLUTE, I=21, J=1\n";
}

TEST(InitialConditions, take_one_level_after_the_other) {
  const auto system = system_of(hinged(0));
  Findings findings;
  std::vector<std::pair<Level, bool>> seen;
  ASSERT_TRUE(initial_conditions(*system, system->drawn(), Restated::all(), findings,
                                 {.level = [&](Level level, bool done) { seen.emplace_back(level, done); }}));
  EXPECT_THAT(seen, ElementsAre(Pair(Level::position, false), Pair(Level::position, true), Pair(Level::velocity, false),
                                Pair(Level::velocity, true), Pair(Level::acceleration, false),
                                Pair(Level::acceleration, true)));
  EXPECT_THAT(findings.warnings.items(), SizeIs(0));
}

TEST(InitialConditions, end_at_the_level_that_fails) {
  const auto system = system_of(hinged(0) + "MARKER/2, PART=1, QP=0,0,1\nJOINT/2, SPHERICAL, I=21, J=2\n");
  Findings findings;
  std::vector<std::pair<Level, bool>> seen;
  EXPECT_FALSE(initial_conditions(*system, system->drawn(), Restated::all(), findings,
                                  {.level = [&](Level level, bool done) { seen.emplace_back(level, done); }}));
  EXPECT_THAT(seen, ElementsAre(Pair(Level::position, false)));
}

TEST(InitialConditions, say_what_assembly_moves) {
  Findings findings;
  ASSERT_TRUE(initial_conditions(*system_of(hinged(0.01)), findings));
  ASSERT_THAT(findings.warnings.items(), SizeIs(1));
  EXPECT_THAT(findings.warnings.items()[0].message, HasSubstr("JOINT/1"));
}

TEST(InitialConditions, keep_velocities_but_for_those_that_are_stated) {
  const auto system = system_of(hinged(0));
  Findings findings;
  OperatingPoint turning = system->drawn();
  turning.velocity = {0, 5, 0, 0, 0, 5};
  const auto of = [&](const Restated& restated) {
    return initial_conditions(*system, turning, restated, findings).value();
  };
  // ω² r towards the hinge
  const auto kept = of({}), stated = of(Restated::all());
  Restated of_another, of_it;
  of_another.state({"PART", 3}, "WZ"), of_it.state({"PART", 2}, "WZ");
  EXPECT_EQ(of(of_another).velocity, kept.velocity);
  EXPECT_EQ(of(of_it).velocity, stated.velocity);
  EXPECT_NEAR(kept.velocity[5], 5, 1e-13);
  EXPECT_NEAR(kept.acceleration[0], -25, 1e-12);
  EXPECT_NEAR(stated.velocity[5], 3, 1e-13);
  EXPECT_NEAR(stated.acceleration[0], -9, 1e-12);
}

}  // namespace
}  // namespace dynalin::analysis_test::initial_test
