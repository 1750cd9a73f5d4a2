#include "analysis/original_method.h"

#include <gtest/gtest.h>

#include <numbers>

#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::original_method_test {
namespace {

// A mass of 1 on a spring of stiffness 1 that pulls to z = 101, from z = 1.
const std::string slider =
    "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
    "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=101-DZ(20,1)\n";

OriginalMethod unlimited() {
  OriginalMethod m;
  m.limits = {1e9, 1e9};
  m.stability = 0;
  return m;
}

TEST(OriginalMethod, is_newtons_which_climbs_to_the_rest_nearby) {
  Search s(pendulum(2.8));
  ASSERT_TRUE(iterate_by_newton(s.equations, s.op, {}, s.history));
  EXPECT_NEAR(angle_of(s.op), std::numbers::pi, 1e-6);
}

TEST(OriginalMethod, takes_no_step_beyond_its_limits) {
  Search s(slider);
  OriginalMethod m = unlimited();
  m.limits.translation = 5;
  ASSERT_TRUE(iterate_by_newton(s.equations, s.op, m, s.history));
  EXPECT_GE(s.history.iterations(), 20);
  EXPECT_LE(s.history.iterations(), 23);
}

// (1 + s) δ = −r: with s = 1 every step goes half of the way.
TEST(OriginalMethod, goes_a_part_of_the_way_that_stability_leaves) {
  Search s(slider);
  OriginalMethod m = unlimited();
  m.stability = 1;
  m.iteration_limit = 3;
  EXPECT_FALSE(iterate_by_newton(s.equations, s.op, m, s.history));
  EXPECT_NEAR(s.op.poses[1].r.z, 101 - 100.0 / 8, 1e-10);
}

TEST(OriginalMethod, needs_stability_where_something_is_free) {
  const std::string free = "PART/3, MASS=1, CM=30, IP=1,1,1, QG=5,0,0\nMARKER/30\n";
  OriginalMethod m = unlimited();
  Search loose(slider + free), held(slider + free);
  EXPECT_FALSE(iterate_by_newton(loose.equations, loose.op, m, loose.history));
  m.stability = 1e-5;
  EXPECT_TRUE(iterate_by_newton(held.equations, held.op, m, held.history));
}

TEST(OriginalMethod, evaluates_the_jacobian_where_the_pattern_says_so) {
  const auto iterations = [](std::vector<bool> pattern) {
    Search s(pendulum(0.7));
    OriginalMethod m = unlimited();
    m.pattern = std::move(pattern);
    m.iteration_limit = 60;
    EXPECT_TRUE(iterate_by_newton(s.equations, s.op, m, s.history));
    return s.history.iterations();
  };
  const int each = iterations({true}), second = iterations({true, false}),
            once = iterations({true, false, false, false});
  EXPECT_LT(each, second);
  EXPECT_LT(second, once);
  EXPECT_EQ(each, iterations({}));
}

TEST(OriginalMethod, ends_after_maxit) {
  Search s(pendulum(2.8));
  OriginalMethod m;
  m.iteration_limit = 1;
  EXPECT_FALSE(iterate_by_newton(s.equations, s.op, m, s.history));
  EXPECT_EQ(s.history.iterations(), 1);
}

}  // namespace
}  // namespace dynalin::analysis_test::original_method_test
