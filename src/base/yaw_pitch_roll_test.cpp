#include "base/yaw_pitch_roll.h"

#include <gtest/gtest.h>

#include <numbers>

namespace dynalin::yaw_pitch_roll_test {
namespace {

Matrix3 turned(double yaw, double pitch, double roll) {
  return rotation_exponential({0, 0, yaw}) * rotation_exponential({0, -pitch, 0}) * rotation_exponential({roll, 0, 0});
}

TEST(YawPitchRoll, are_turns_about_z_then_minus_y_then_x) {
  const auto angles = yaw_pitch_roll(turned(2.5, -0.7, -1.9));
  EXPECT_NEAR(angles[0], 2.5, 1e-14);
  EXPECT_NEAR(angles[1], -0.7, 1e-14);
  EXPECT_NEAR(angles[2], -1.9, 1e-14);
}

TEST(YawPitchRoll, a_vertical_x_has_yaw_alone) {
  constexpr double up = std::numbers::pi / 2;
  for (const double pitch : {up, -up}) {
    const Matrix3 R = turned(0.4, pitch, 0.3);
    const auto [yaw, of_x, roll] = yaw_pitch_roll(R);
    EXPECT_NEAR(of_x, pitch, 1e-8);
    EXPECT_EQ(roll, 0);
    const Matrix3 again = turned(yaw, pitch, 0);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(norm(again[k] - R[k]), 1e-12) << pitch;
  }
}

}  // namespace
}  // namespace dynalin::yaw_pitch_roll_test
