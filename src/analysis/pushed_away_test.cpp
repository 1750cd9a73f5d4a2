#include "analysis/pushed_away.h"

#include <gtest/gtest.h>

#include "analysis/statics_test_support.h"

namespace dynalin::pushed_away_test {
namespace {

using analysis_test::pendulum;
using analysis_test::Search;

// With gravity upwards it stands on its hinge where it would hang.
std::string upright(double angle) {
  std::string text = pendulum(angle);
  return text.replace(text.find("-10"), 3, "10");
}

// The turn about z that leads off the point at an angle of 0; nothing where none does.
std::optional<double> turn_off(const std::string& drawn, const std::string& at_rest) {
  Search s(drawn), there(at_rest);
  const auto step = step_off_saddle(s.equations, there.op, s.op);
  if (!step) return std::nullopt;
  const std::int32_t first = s.system->layout().bodies[1].offset;
  // The mass stands on the hinge, which is held.
  EXPECT_NEAR(step->segment(first, 3).norm(), 0, 1e-12);
  return (*step)(first + 5);
}

TEST(PushedAway, a_pendulum_drawn_beside_upright_falls_to_its_side) {
  for (const double side : {0.2, -0.2}) {
    const auto turn = turn_off(upright(side), upright(0));
    ASSERT_TRUE(turn);
    EXPECT_GT(*turn * side, 0);
    EXPECT_NEAR(std::abs(*turn), 0.01, 1e-12);
  }
}

TEST(PushedAway, one_that_is_drawn_upright_stays) { EXPECT_FALSE(turn_off(upright(0), upright(0))); }

TEST(PushedAway, hanging_down_is_no_saddle) { EXPECT_FALSE(turn_off(pendulum(0.2), pendulum(0))); }

// A force that goes round has no energy to come down from.
TEST(PushedAway, forces_without_energy_stay_where_they_are) {
  Search drawn(analysis_test::swirl());
  OperatingPoint middle = drawn.op;
  middle.poses[1].r = {0.2, -0.1, 0};
  EXPECT_FALSE(step_off_saddle(drawn.equations, middle, drawn.op));
}

}  // namespace
}  // namespace dynalin::pushed_away_test
