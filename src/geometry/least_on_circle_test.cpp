#include "geometry/least_on_circle.h"

#include <gtest/gtest.h>

#include <random>

namespace dynalin::least_on_circle_test {
namespace {

// Two places that are hardly different, wherever the samples fall on them: the least is taken, not the one that happens
// to be nearer to a sample.
TEST(LeastOnCircle, is_the_least_of_two_that_are_nearly_as_low) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  for (const double difference : {0.3, 1e-2, 1e-4, 1e-8}) {
    for (int draw = 0; draw < 200; ++draw) {
      const double a = angle(random), tilt = draw % 2 == 0 ? 0.0 : 0.4;
      const auto value = [&](double s) { return -std::cos(2 * (s - a)) - difference * std::cos(s - a - tilt); };
      const auto slope = [&](const auto& s) {
        using std::sin;
        return 2.0 * sin(2.0 * (s - a)) + difference * sin(s - a - tilt);
      };
      const solid::LeastAngle found = solid::least_on_turn(value, slope, 1.0);
      EXPECT_NEAR(slope(found.at), 0, 1e-13);
      EXPECT_GT(std::cos(found.at - a), 0.9) << difference << ", " << draw;
      EXPECT_TRUE(found.definite);
    }
  }
}

}  // namespace
}  // namespace dynalin::least_on_circle_test
