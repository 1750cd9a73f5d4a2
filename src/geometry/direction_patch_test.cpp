#include "geometry/direction_patch.h"

#include <gtest/gtest.h>

#include <numbers>

namespace dynalin::direction_patch_test {

// A ball parts from a corner along the line to its centre, wherever in the patch that leads, close to its borders as
// well.
TEST(direction_patch, has_the_direction_in_which_a_ball_parts_from_a_corner) {
  const Matrix3 axes = rotation_exponential(Vector{0.3, 0.8, -0.5});
  const double right = std::numbers::pi / 2, radius = 0.2;
  const solid::DirectionPatch patch{axes[2], axes[0], axes[1], 1.2, right, Vector{1, 2, 3}, 0};
  for (const double s : {0.003, 0.02, 0.3, 0.7, 1.18, 1.197}) {
    for (const double t : {0.05, 0.4, 1.1, 1.5}) {
      const Vector centre = patch.base + 0.5 * patch.normal(s, t);
      const auto farthest = [&](const auto& n) {
        using S = std::decay_t<decltype(n.x)>;
        return solid::as<S>(centre) + n * S(radius);
      };
      const auto found = solid::largest_on_patch(patch, farthest, 1.0);
      ASSERT_TRUE(found) << s << " " << t;
      EXPECT_NEAR(found->s, s, 1e-9);
      EXPECT_NEAR(found->t, t, 1e-9);
      EXPECT_NEAR(found->gap, 0.5 - radius, 1e-12);
    }
  }
  // Nothing is found where the centre is beyond the border.
  const Vector beyond = patch.base + 0.5 * patch.normal(-0.1, 0.8);
  EXPECT_FALSE(solid::largest_on_patch(
      patch,
      [&](const auto& n) {
        using S = std::decay_t<decltype(n.x)>;
        return solid::as<S>(beyond) + n * S(radius);
      },
      1.0));
}

}  // namespace dynalin::direction_patch_test
