#include "elements/families/orientation.h"

#include <gtest/gtest.h>

#include "system/model_test_support.h"

namespace dynalin::orientation_test {
namespace {

// The axes of MARKER/9, in columns, along those of ground.
Matrix3 axes(const std::string& marker) {
  const auto system = system_test::system_of("MARKER/9, PART=1, " + marker + "\n");
  return system->motion(system->drawn()).axes(system->layout().marker(*system->model().find_marker(9)));
}
void expect_axes(const std::string& marker, const Vector& x, const Vector& z) {
  const Matrix3 found = axes(marker);
  const Vector y = cross(z, x);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.x[k], x[k], 1e-15) << marker;
    EXPECT_NEAR(found.y[k], y[k], 1e-15) << marker;
    EXPECT_NEAR(found.z[k], z[k], 1e-15) << marker;
  }
}

TEST(Orientation, zp_is_on_z_and_xp_in_the_plane) {
  expect_axes("QP=1,0,0, ZP=1,2,0, XP=4,9,0", {1, 0, 0}, {0, 1, 0});
  expect_axes("ZP=0,0,-1, XP=0,3,5", {0, 1, 0}, {0, 0, -1});
}

TEST(Orientation, usexp_puts_xp_on_x_and_zp_in_the_plane) {
  expect_axes("QP=1,0,0, ZP=1,2,0, XP=4,0,0, USEXP", {1, 0, 0}, {0, 1, 0});
  expect_axes("ZP=5,0,2, XP=3,0,0, USEXP", {1, 0, 0}, {0, 0, 1});
}

// What one point leaves open: z stays where XP alone is given, and with USEXP as near as that allows.
TEST(Orientation, one_point_is_enough) {
  const double c = std::sqrt(0.5), t = std::sqrt(1.0 / 3);
  expect_axes("XP=1,1,1", {c, c, 0}, {0, 0, 1});
  expect_axes("QP=0,0,7, XP=0,-2,0", {0, -1, 0}, {0, 0, 1});
  expect_axes("XP=1,1,1, USEXP", {t, t, t}, {-t * c, -t * c, 2 * t * c});
  expect_axes("ZP=0,1,0", {1, 0, 0}, {0, 1, 0});
  expect_axes("ZP=1,0,0", {0, 1, 0}, {1, 0, 0});
}

}  // namespace
}  // namespace dynalin::orientation_test
