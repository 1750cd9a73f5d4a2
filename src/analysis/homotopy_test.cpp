// The curve of equilibria under partial loads, alone.
#include "analysis/homotopy.h"

#include <gtest/gtest.h>

#include "analysis/levenberg_marquardt.h"
#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::homotopy_test {
namespace {

TEST(Homotopy, passes_the_fold_at_which_least_squares_stop) {
  Search s(fold);
  bool found = false;
  for (const bool forward : {true, false}) {
    const auto rest = follow_to_rest(s.equations, s.op, forward);
    if (!rest) continue;
    found = true;
    EXPECT_NEAR(rest->state[0], root_behind_the_fold(), 1e-9);
  }
  EXPECT_TRUE(found);
}

// f(z) = 1 + z of which the load f(0) = 1 is taken off at first: 1 + z = 1 − s, and so z goes from 0 to −1 as s grows
// to 1.
TEST(Homotopy, a_linear_equation_is_solved_on_a_straight_line) {
  Search s("DIFF/7, IC=0, FUNCTION=1+DIF(7)\n");
  const auto rest = follow_to_rest(s.equations, s.op, true);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->state[0], -1, 1e-9);
  // The other way s falls for ever.
  EXPECT_FALSE(follow_to_rest(s.equations, s.op, false));
}

TEST(Homotopy, constraints_hold_along_the_curve) {
  Search s(pendulum(0.9) + "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=6\n");
  const auto rest = follow_to_rest(s.equations, s.op, true);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(norm(rest->poses[1].r), 0, 1e-9);
  EXPECT_NEAR(20 * std::sin(angle_of(*rest)), 6, 1e-6);
}

TEST(Homotopy, without_an_equilibrium_there_is_none_either_way) {
  Search s("DIFF/7, IC=0.3, FUNCTION=DIF(7)**2+1\n");
  EXPECT_FALSE(follow_to_rest(s.equations, s.op, true));
  EXPECT_FALSE(follow_to_rest(s.equations, s.op, false));
}

TEST(Homotopy, is_no_search_from_a_point_at_rest) {
  Search s("DIFF/7, IC=-1, FUNCTION=1+DIF(7)\n");
  EXPECT_FALSE(follow_to_rest(s.equations, s.op, true));
}

}  // namespace
}  // namespace dynalin::analysis_test::homotopy_test
