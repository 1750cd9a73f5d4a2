// What nothing holds, and where it goes back to.
#include "analysis/first_freedoms.h"

#include <gtest/gtest.h>

#include "analysis/settled_reactions.h"
#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::first_freedoms_test {
namespace {

// A slide on a spring, and a wheel that nothing holds.
const std::string slide_and_wheel =
    "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
    "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-DZ(20,1)\n"
    "PART/3, MASS=1, CM=30, IP=1,1,1, REULER=0.3,0,0\nMARKER/30\nJOINT/2, REVOLUTE, I=30, J=1\n";

TEST(FirstFreedoms, what_the_tangent_leaves_open_goes_back_and_what_it_holds_stays) {
  Search s(slide_and_wheel);
  const FirstFreedoms first = freedoms_at(s.equations, s.op);
  const BodyBlock &slide = s.system->layout().bodies[1], &wheel = s.system->layout().bodies[2];
  EXPECT_FALSE(first.free[static_cast<std::size_t>(slide.offset) + 2]);
  EXPECT_TRUE(first.free[static_cast<std::size_t>(wheel.offset) + 5]);
  s.op.poses[1].r.z = 0.5;
  s.op.poses[2].R = rotation_exponential({0, 0, 1.7});
  settle(s.equations, s.op);
  s.equations.evaluate(s.op, Partials::yes);
  const auto back = put_back(s.equations, s.op, first.at);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->poses[1].r.z, 0.5, 1e-6);
  EXPECT_NEAR(std::atan2(back->poses[2].R(1, 0), back->poses[2].R(0, 0)), 0.3, 1e-6);
}

}  // namespace
}  // namespace dynalin::analysis_test::first_freedoms_test
