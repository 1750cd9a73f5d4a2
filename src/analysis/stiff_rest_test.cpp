// What a judgement says of points at which rounding of a stiff element is as large as a load.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/rest_judgement.h"
#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::stiff_rest_test {
namespace {

// Two lumps that a bushing of 1e9 welds on a soft one of 1e-3, a thousand away from the origin.
const std::string welded =
    "ACCGRAV/JGRAV=-10\nMARKER/5,PART=1,QP=1000,1000,0\nPART/2,MASS=0.001,CM=20,IP=1,1,1,QG=1000,1000,0\nMARKER/20\n"
    "MARKER/21,QP=50,0,0\nPART/3,MASS=0.001,CM=30,IP=1,1,1,QG=1050,1000,0\nMARKER/30\nJOINT/1,TRANS,I=22,J=2\n"
    "MARKER/22,PART=2,REULER=0,-90D,0\nMARKER/2,PART=1,QP=1000,1000,0,REULER=0,-90D,0\n"
    "BUSHING/1,I=20,J=5,K=1E-3,1E-3,1E-3\nBUSHING/2,I=30,J=21,K=1E9,1E9,1E9,KT=1E9,1E9,1E9\n";

TEST(StiffRest, a_load_below_the_rounding_of_a_weld_leaves_its_soft_support_undetermined) {
  Search s(welded);
  s.equations.evaluate(s.op, Partials::yes);
  EXPECT_TRUE(balanced_to_rounding(s.equations));
  const auto j = judge(s.equations, s.op);
  ASSERT_TRUE(j);
  EXPECT_FALSE(j->determined);
  EXPECT_NEAR(j->newton(1), -20, 1e-2);  // the tangent itself is known to 1e-4
  EXPECT_EQ(std::count(j->indifferent.begin(), j->indifferent.end(), true), 0);
}

TEST(StiffRest, rounding_of_places_is_left_out_of_that_of_terms) {
  Search s(welded);
  s.equations.evaluate(s.op, Partials::yes);
  EXPECT_GT(s.equations.rounding()(1), 1e-4);
  EXPECT_LT(s.equations.rounding_of_terms()(1), 1e-15);
  EXPECT_NEAR(s.equations.rounding_of_unknowns()(1), 1000 * std::sqrt(2) * 2.2e-16, 1e-14);
}

TEST(StiffRest, what_nothing_holds_is_indifferent_all_the_same) {
  Search s("PART/2,MASS=1,CM=20,IP=1,1,1,QG=1000,0,0\nMARKER/20\n");
  s.equations.evaluate(s.op, Partials::yes);
  const auto j = judge(s.equations, s.op);
  ASSERT_TRUE(j);
  EXPECT_EQ(std::count(j->indifferent.begin(), j->indifferent.end(), true), 6);
}

}  // namespace
}  // namespace dynalin::analysis_test::stiff_rest_test
