#include "analysis/rest_judgement.h"

#include <gtest/gtest.h>

#include "analysis/statics_test_support.h"

namespace dynalin::rest_judgement_test {
namespace {

using analysis_test::gravity;
using analysis_test::pendulum;
using analysis_test::Search;

// A mass on a line along x, which a force of its position acts on.
std::string bead(const std::string& force, double x) {
  return "POINT_MASS/2, MASS=1, CM=20, QG=" + std::to_string(x) +
         ",0,0\nMARKER/20, POINT_MASS=2\nMARKER/9, PART=1, FLOATING\n"
         "VFORCE/1, I=20, JFLOAT=9, RM=1, FX=" +
         force + "\\, FY=-DY(20,1)\\, FZ=-DZ(20,1)\n";
}

RestJudgement judged(Search& s) {
  s.equations.evaluate(s.op, Partials::yes);
  const auto j = judge(s.equations, s.op);
  EXPECT_TRUE(j.has_value());
  return j.value_or(RestJudgement());
}

TEST(RestJudgement, hanging_down_is_rest) {
  Search s(pendulum(0));
  const RestJudgement j = judged(s);
  EXPECT_TRUE(j.balanced);
  EXPECT_TRUE(j.determined);
  EXPECT_TRUE(balanced_to_rounding(s.equations));
}

// Newton's step of φ″ = −2·10·sin φ is −tan φ.
TEST(RestJudgement, a_pendulum_beside_it_is_told_how_far) {
  Search s(pendulum(0.1));
  const RestJudgement j = judged(s);
  EXPECT_FALSE(j.balanced);
  EXPECT_FALSE(j.determined);
  EXPECT_FALSE(balanced_to_rounding(s.equations));
  const std::int32_t turn = s.system->layout().bodies[1].offset + 5;
  EXPECT_NEAR(j.newton(turn), -std::tan(0.1), 1e-12);
  EXPECT_EQ(j.step(turn), j.newton(turn));
  EXPECT_GE(j.largest, std::tan(0.1) * (1 - 1e-12));
}

// Newton's step of e^−x is 1, however little is left of the force.
TEST(RestJudgement, a_force_that_fades_with_distance_is_no_rest) {
  Search s(bead("EXP(-DX(20,1))", 30));
  const RestJudgement j = judged(s);
  EXPECT_FALSE(j.determined);
  EXPECT_NEAR(j.newton(s.system->layout().bodies[1].offset), 1, 1e-9);
}

// x² + δ has no zero; at its least value Newton's step is far.
TEST(RestJudgement, a_force_that_misses_zero_by_little_is_no_rest) {
  Search s(bead("(DX(20,1)-1)**2+1E-8", 1.0001));
  EXPECT_FALSE(judged(s).determined);
}

TEST(RestJudgement, what_nothing_acts_on_is_balanced_and_indifferent) {
  Search s(
      "POINT_MASS/2, MASS=1, CM=20, QG=1,2,3\nMARKER/20, POINT_MASS=2\n"
      "POINT_MASS/3, MASS=1, CM=30\nMARKER/30, POINT_MASS=3\nMARKER/9, PART=1, FLOATING\n"
      "VFORCE/1, I=30, JFLOAT=9, RM=1, FX=-DX(30,1)\\, FY=-DY(30,1)\\, FZ=-DZ(30,1)\n");
  const RestJudgement j = judged(s);
  EXPECT_TRUE(j.balanced);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(j.indifferent[static_cast<std::size_t>(s.system->layout().bodies[1].offset) + k]);
    EXPECT_FALSE(j.indifferent[static_cast<std::size_t>(s.system->layout().bodies[2].offset) + k]);
  }
}

// Of a part that falls nothing is held, of one on a spring and a hinge everything is.
TEST(RestJudgement, free_unknowns_are_those_that_nothing_holds) {
  Search falls(gravity + "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n");
  const auto of_all = free_unknowns(falls.equations, falls.op);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(of_all[k]) << k;
  Search hangs(pendulum(0.3));
  for (const bool free : free_unknowns(hangs.equations, hangs.op)) EXPECT_FALSE(free);
}

TEST(RestJudgement, a_move_along_what_is_free_is_undetermined_and_across_it_is_not) {
  Search s(
      "POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\nMARKER/9, PART=1, FLOATING\n"
      "VFORCE/1, I=20, JFLOAT=9, RM=1, FX=-3*DX(20,1)\\, FY=0\\, FZ=-2*DZ(20,1)\n");
  s.equations.evaluate(s.op, Partials::yes);
  Eigen::VectorXd move = Eigen::VectorXd::Zero(s.equations.augmented().size());
  const std::int32_t first = s.system->layout().bodies[1].offset;
  move.segment<3>(first) << 0.5, 0.25, -0.125;
  const Eigen::VectorXd left = undetermined_part(s.equations, move);
  EXPECT_NEAR(left(first), 0, 1e-9);
  EXPECT_NEAR(left(first + 1), 0.25, 1e-12);
  EXPECT_NEAR(left(first + 2), 0, 1e-9);
}

}  // namespace
}  // namespace dynalin::rest_judgement_test
