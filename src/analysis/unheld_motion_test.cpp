#include "analysis/unheld_motion.h"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "analysis/static_refusal.h"
#include "analysis/statics_test_support.h"

namespace dynalin::unheld_motion_test {
namespace {

using analysis_test::gravity;
using analysis_test::pendulum;
using analysis_test::Search;

std::string mass(int id, const std::string& place) {
  const std::string n = std::to_string(id);
  return "PART/" + n + ", MASS=" + n + ", CM=" + n + "0, IP=1,1,1, QG=" + place + "\nMARKER/" + n + "0\n";
}

TEST(UnheldMotion, a_part_that_falls_falls_by_its_weight) {
  Search s(gravity + mass(2, "1,2,3"));
  const auto motions = unheld_motions(s.equations, s.op);
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0].bodies, (std::vector<std::size_t>{1}));
  EXPECT_FALSE(motions[0].turning);
  EXPECT_NEAR(motions[0].load.y, -20, 1e-12);
  EXPECT_NEAR(motions[0].load.x, 0, 1e-12);
}

TEST(UnheldMotion, parts_that_a_spring_ties_to_each_other_fall_together) {
  const std::string tied = gravity + mass(2, "0,0,0") + mass(3, "1,0,0") + "BUSHING/1, I=20, J=30, K=5,5,5, KT=5,5,5\n";
  Search s(tied);
  const auto motions = unheld_motions(s.equations, s.op);
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0].bodies, (std::vector<std::size_t>{1, 2}));
  EXPECT_NEAR(motions[0].load.y, -50, 1e-9);
  const auto parts = unheld_parts(s.equations, s.op);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NE(parts[0].find("PART/2"), std::string::npos);
  EXPECT_NE(parts[0].find("PART/3"), std::string::npos);
}

TEST(UnheldMotion, two_parts_that_are_not_tied_are_two_motions) {
  Search s(gravity + mass(2, "0,0,0") + mass(3, "1,0,0"));
  const auto motions = unheld_motions(s.equations, s.op);
  ASSERT_EQ(motions.size(), 2u);
  EXPECT_NEAR(motions[0].load.y, -20, 1e-12);
  EXPECT_NEAR(motions[1].load.y, -30, 1e-12);
}

TEST(UnheldMotion, a_torque_about_a_free_hinge_turns) {
  Search s(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "SFORCE/1, ROTATION, I=20, J=1, FUNCTION=7\n");
  const auto motions = unheld_motions(s.equations, s.op);
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_TRUE(motions[0].turning);
  EXPECT_NEAR(motions[0].load.z, 7, 1e-12);
}

// A thread by which one turn advances far beyond the model is a slide, and its weight is what pushes it; on a short one
// the weight is a moment.
TEST(UnheldMotion, a_thread_too_long_for_its_turns_to_show_falls) {
  const auto load_of = [](const std::string& pitch) {
    Search s(gravity + mass(2, "0,0,0") + "MARKER/21, PART=2, REU=0,90D,0\nMARKER/9, PART=1, REU=0,90D,0\n" +
             "JOINT/1, CYLINDRICAL, I=21, J=9\nJOINT/2, SCREW, I=21, J=9, PITCH=" + pitch + "\n");
    const auto motions = unheld_motions(s.equations, s.op);
    EXPECT_EQ(motions.size(), 1u);
    return motions.empty() ? UnheldMotion{} : motions[0];
  };
  const UnheldMotion slide = load_of("1E5"), screw = load_of("1");
  EXPECT_FALSE(slide.turning);
  EXPECT_NEAR(slide.load.y, -20, 1e-9);
  EXPECT_TRUE(screw.turning);
  EXPECT_NEAR(std::abs(screw.load.y), 20 / (2 * std::numbers::pi), 1e-9);
}

// A load of 2 hangs on a drum of radius 0.25 that nothing brakes, on a trolley that its springs hold. A little of the
// motion reaches the trolley; it does not count as moving with them, and what is made of it opposes nothing.
TEST(UnheldMotion, a_load_on_a_drum_pulls_rope_off_it) {
  for (const double stiffness : {1e3, 1e6, 1e9}) {
    std::ostringstream model;
    model << gravity << "MARKER/2, PART=1\nPART/3, MASS=50, CM=30, IP=10,10,10\nMARKER/30\nMARKER/31, QP=0,-0.1,0\n"
          << "MARKER/36, QP=-1,0.3,0\nBUSHING/1, I=30, J=2, K=" << stiffness << "," << 2 * stiffness << ","
          << 3 * stiffness << ", KT=1E5,2E5,3E5\nPART/7, MASS=5, CM=70, IP=1,1,1, QG=-1,0.3,0\nMARKER/70\n"
          << "JOINT/6, REVOLUTE, I=70, J=36\nPART/9, MASS=2, CM=90, IP=1,2,3, QG=0.01,-3,0.02\nMARKER/90\n"
          << "MARKER/91, QP=0,0.2,0\nBUSHING/2, I=91, J=31, K=0,0,0, KT=1,2,3\n"
          << "VARIABLE/7, FUNCTION=2.7-0.25*AZ(70,36)\n"
          << "SFORCE/1, TRANSLATIONAL, I=91, J=31, FUNCTION=-1E4*(DM(91,31)-VARVAL(7))\n"
          << "SFORCE/6, ROTATIONAL, I=70, J=36, FUNCTION=0.25*SFORCE(1,0,1,0)\n";
    Search s(model.str());
    const auto motions = unheld_motions(s.equations, s.op);
    ASSERT_EQ(motions.size(), 1u) << stiffness;
    EXPECT_EQ(motions[0].bodies, (std::vector<std::size_t>{2, 3})) << stiffness;
    EXPECT_TRUE(motions[0].turning);
    EXPECT_NEAR(motions[0].load.z, 0.25 * 20, 1e-3) << stiffness;
  }
}

// A pendulum is held wherever it is not at rest, and what hangs on a spring is.
TEST(UnheldMotion, what_something_opposes_is_none) {
  Search swings(pendulum(0.4));
  EXPECT_TRUE(unheld_motions(swings.equations, swings.op).empty());
  EXPECT_TRUE(unheld_parts(swings.equations, swings.op).empty());
  Search hangs(gravity + mass(2, "0,0,0") + "BUSHING/1, I=20, J=1, K=5,5,5, KT=5,5,5\n");
  EXPECT_TRUE(unheld_motions(hangs.equations, hangs.op).empty());
}

// One place proves nothing: the force of the second one pulls back.
TEST(UnheldMotion, everywhere_takes_all_points) {
  Search s(
      "POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\nMARKER/9, PART=1, FLOATING\n"
      "VFORCE/1, I=20, JFLOAT=9, RM=1, FX=1-STEP(DX(20,1),1,0,2,2)\\, FY=-DY(20,1)\\, FZ=-DZ(20,1)\n");
  OperatingPoint further = s.op, inside = s.op;
  further.poses[1].r.x = 0.5, inside.poses[1].r.x = 1.5;
  EXPECT_EQ(unheld_everywhere(s.equations, {s.op, further}).size(), 1u);
  EXPECT_TRUE(unheld_everywhere(s.equations, {s.op, inside}).empty());
}

}  // namespace
}  // namespace dynalin::unheld_motion_test
