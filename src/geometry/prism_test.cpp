#include "geometry/prism.h"

#include "geometry/mesh_test_support.h"
#include "geometry/plate.h"

namespace dynalin::prism_test {
namespace {

TEST(Prism, boxes_have_six_sides_whatever_the_signs) {
  for (const double x : {2.0, -2.0}) {
    for (const double y : {3.0, -3.0}) {
      for (const double z : {5.0, -5.0}) {
        const Mesh m = box({x, y, z});
        expect_closed(m, 2), expect_plane(m);
        EXPECT_EQ(m.quads.size(), 6u);
        EXPECT_DOUBLE_EQ(volume_of(m), 30);
        for (const Vector& p : m.vertices) {
          EXPECT_TRUE(p.x == 0 || p.x == x);
          EXPECT_TRUE(p.y == 0 || p.y == y);
          EXPECT_TRUE(p.z == 0 || p.z == z);
        }
      }
    }
  }
}

TEST(Prism, of_a_concave_outline_is_closed) {
  // An L with a corner on one of its straight sides.
  const std::vector<Vector> outline{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  for (const double z : {2.0, -2.0}) {
    const Mesh m = prism(outline, Outline::closed, {0.5, 0, z});
    expect_closed(m, 2), expect_plane(m);
    EXPECT_NEAR(volume_of(m), 5 * 2, 1e-12);
  }
}

TEST(Prism, of_an_open_outline_is_a_sheet) {
  const std::vector<Vector> outline{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const Mesh m = prism(outline, Outline::open, {0, 0, 1});
  expect_sound(m);
  EXPECT_FALSE(m.closed);
  EXPECT_EQ(m.quads.size(), 2u);
}

TEST(Prism, of_an_outline_that_crosses_itself_is_a_sheet) {
  const std::vector<Vector> outline{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const Mesh m = prism(outline, Outline::closed, {0, 0, 1});
  expect_sound(m);
  EXPECT_FALSE(m.closed);
  EXPECT_EQ(m.quads.size(), 4u);
}

TEST(Plate, is_a_polygon_with_arcs_about_its_corners) {
  const std::vector<Vector> corners{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  const auto outline = rounded_outline(corners, 0.5, 16);
  ASSERT_TRUE(outline);
  EXPECT_EQ(outline->size(), 4u * 5u);
  // The rectangle, strips along its sides, and a polygon of 16 corners in four parts.
  const double round = 8 * 0.25 * std::sin(2 * std::numbers::pi / 16);
  const Mesh m = prism(*outline, Outline::closed, {0, 0, 0.2});
  expect_closed(m, 2);
  EXPECT_NEAR(volume_of(m), (12 + 14 * 0.5 + round) * 0.2, 1e-12);
}

TEST(Plate, corners_may_run_either_way) {
  std::vector<Vector> corners{{0, 0, 0}, {0, 3, 0}, {4, 3, 0}, {4, 0, 0}, {4, 0, 0}};
  const auto outline = rounded_outline(corners, 0, 20);
  ASSERT_TRUE(outline);
  EXPECT_EQ(outline->size(), 4u);
  EXPECT_NEAR(volume_of(prism(*outline, Outline::closed, {0, 0, 1})), 12, 1e-12);
}

TEST(Plate, corners_that_are_said_again_or_do_not_turn_change_nothing) {
  const std::vector<Vector> once{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}},
      again{{0, 0, 0}, {2, 0, 5}, {4, 0, 0}, {4, 3, 0}, {4, 3, 7}, {0, 3, 0}, {0, 0, 0}, {0, 0, 0}};
  const auto volume = [](const std::vector<Vector>& corners) {
    const Mesh m = prism(*rounded_outline(corners, 0.5, 12), Outline::closed, {0, 0, 1});
    expect_closed(m, 2);
    return volume_of(m);
  };
  EXPECT_NEAR(volume(once), volume(again), 1e-12);
}

TEST(Plate, concave_corners_stay_sharp) {
  const std::vector<Vector> corners{{0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {2, 2, 0}, {2, 6, 0}, {0, 6, 0}};
  const auto outline = rounded_outline(corners, 0.5, 4);
  ASSERT_TRUE(outline);
  // Strips of half the radius along the sides, less where two of them overlap, and quarters of a square.
  const double strips = 24 * 0.5 - 0.25, quarters = 5 * 0.5 * 0.25;
  const Mesh m = prism(*outline, Outline::closed, {0, 0, 1});
  expect_closed(m, 2);
  EXPECT_NEAR(volume_of(m), 20 + strips + quarters, 1e-12);
  EXPECT_FALSE(rounded_outline(corners, 4.5, 20)) << "the sides beside the concave corner are 4 long";
}

TEST(Plate, of_two_corners_is_a_slot) {
  const std::vector<Vector> corners{{0, 0, 0}, {5, 0, 0}};
  const auto outline = rounded_outline(corners, 1, 12);
  ASSERT_TRUE(outline);
  const Mesh m = prism(*outline, Outline::closed, {0, 0, 3});
  expect_closed(m, 2);
  EXPECT_NEAR(volume_of(m), (5 * 2 + 6 * std::sin(2 * std::numbers::pi / 12)) * 3, 1e-12);
}

TEST(Plate, without_area_is_none) {
  const std::vector<Vector> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, two{{0, 0, 0}, {1, 0, 0}}, one{{1, 1, 0}, {1, 1, 0}};
  EXPECT_FALSE(rounded_outline(line, 0, 20));
  const std::vector<Vector> rounded{{0, 0, 0}, {0.1, 0.3, 0}, {0.2, 0.6, 0}, {0.7, 2.1, 0}};
  EXPECT_FALSE(rounded_outline(rounded, 1, 20)) << "what area it has is rounding";
  EXPECT_FALSE(rounded_outline(two, 0, 20));
  EXPECT_FALSE(rounded_outline(one, 1, 20));
}

}  // namespace
}  // namespace dynalin::prism_test
