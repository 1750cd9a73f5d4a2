#include "geometry/revolution.h"

#include <cmath>

#include "geometry/mesh_test_support.h"

namespace dynalin::revolution_test {
namespace {

constexpr double pi = std::numbers::pi;

// Of a regular polygon with n corners on a circle of radius 1.
double polygon_area(std::size_t n) {
  const auto m = static_cast<double>(n);
  return m / 2 * std::sin(2 * pi / m);
}

TEST(Revolution, cylinders_are_prisms_of_regular_polygons) {
  for (const double length : {5.0, -5.0}) {
    const Mesh m = cylinder(2, length, {.segments = 13});
    expect_closed(m, 2), expect_plane(m);
    EXPECT_EQ(m.quads.size(), 13u);
    EXPECT_EQ(m.triangles.size(), 26u);
    EXPECT_NEAR(volume_of(m), polygon_area(13) * 4 * 5, 1e-12);
    for (const Vector& p : m.vertices) {
      EXPECT_GE(p.z / length, 0);
      EXPECT_LE(p.z / length, 1);
    }
  }
}

TEST(Revolution, a_part_of_a_turn_is_a_wedge) {
  for (const double angle : {pi / 2, -pi / 2, 1.5 * pi}) {
    const Mesh m = cylinder(2, 5, {.angle = angle, .start = 0, .segments = 6});
    expect_closed(m, 2), expect_plane(m);
    const double step = std::abs(angle) / 6;
    EXPECT_NEAR(volume_of(m), 6 * 0.5 * 4 * std::sin(step) * 5, 1e-12);
    for (const Vector& p : m.vertices) {
      const double azimuth = std::atan2(p.y, p.x);
      if (std::abs(angle) < pi && std::hypot(p.x, p.y) > 0) {
        EXPECT_GE(azimuth / angle, -1e-12);
        EXPECT_LE(azimuth / angle, 1 + 1e-12);
      }
    }
  }
}

TEST(Revolution, no_piece_is_wider_than_a_third_of_a_turn) {
  expect_closed(cylinder(1, 1, {.segments = 1}), 2);
  EXPECT_EQ(cylinder(1, 1, {.segments = 1}).quads.size(), 3u);
  EXPECT_EQ(cylinder(1, 1, {.angle = pi / 2, .segments = 1}).vertices.size(), 6u);
}

TEST(Revolution, an_angle_of_360_degrees_is_a_full_turn_whatever_its_rounding) {
  for (const double angle : {360 * (pi / 180), -2 * pi, 2 * pi * (1 - 1e-15)})
    EXPECT_EQ(cylinder(1, 1, {.angle = angle, .segments = 8}).vertices.size(), 18u);
}

TEST(Revolution, frusta_have_the_volume_of_frusta_of_pyramids) {
  const Mesh m = frustum(3, 1, 6, {.segments = 10});
  expect_closed(m, 2), expect_plane(m);
  EXPECT_NEAR(volume_of(m), polygon_area(10) * 6 / 3 * (9 + 3 + 1), 1e-11);
  for (const Vector& p : m.vertices) EXPECT_LE(std::hypot(p.x, p.y), p.z == 0 ? 3 + 1e-12 : 1 + 1e-12);
  const Mesh up = frustum(3, 0, 6, {.segments = 10}), down = frustum(0, 3, 6, {.segments = 10});
  for (const Mesh& cone : {up, down}) {
    expect_closed(cone, 2);
    EXPECT_EQ(cone.vertices.size(), 12u);
    EXPECT_NEAR(volume_of(cone), polygon_area(10) * 6 / 3 * 9, 1e-11);
  }
}

TEST(Revolution, ellipsoids_touch_their_axes_and_are_stacks_of_frusta) {
  const Mesh m = ellipsoid({3, 2, 1}, 12);
  expect_closed(m, 2), expect_plane(m);
  double volume = 0;
  for (int k = 0; k < 6; ++k) {
    const double a = pi * k / 6, b = pi * (k + 1) / 6, r = std::sin(a), s = std::sin(b);
    volume += (std::cos(a) - std::cos(b)) / 3 * (r * r + r * s + s * s);
  }
  EXPECT_NEAR(volume_of(m), polygon_area(12) * volume * 6, 1e-12);
  Vector most;
  for (const Vector& p : m.vertices) {
    for (std::size_t k = 0; k < 3; ++k) most[k] = std::max(most[k], std::abs(p[k]));
    EXPECT_NEAR(p.x * p.x / 9 + p.y * p.y / 4 + p.z * p.z, 1, 1e-12);
  }
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(most[k], 3.0 - static_cast<double>(k), 1e-12);
}

TEST(Revolution, tori_are_rings) {
  const Mesh m = torus(5, 1.5, {.segments = 24});
  expect_closed(m, 0), expect_plane(m);
  EXPECT_EQ(m.quads.size(), 24u * 12u);
  EXPECT_NEAR(volume_of(m), 2 * polygon_area(24) * 5 * polygon_area(12) * 1.5 * 1.5, 1e-10);
}

TEST(Revolution, a_part_of_a_torus_has_ends) {
  const Mesh m = torus(5, 1.5, {.angle = 2.0, .start = 0.3, .segments = 8});
  expect_closed(m, 2);
  EXPECT_NEAR(volume_of(m), 8 * std::sin(2.0 / 8) * 5 * polygon_area(4) * 1.5 * 1.5, 1e-11);
}

TEST(Revolution, a_profile_off_the_axis_sweeps_a_sheet) {
  const std::vector<Meridian> profile{{1, 0}, {2, 1}, {2, 3}};
  const Mesh m = revolved(profile, false, {.segments = 7});
  expect_sound(m), expect_plane(m);
  EXPECT_FALSE(m.closed);
  EXPECT_EQ(m.quads.size(), 14u);
}

TEST(Revolution, a_ring_along_the_axis_is_solid) {
  const std::vector<Meridian> profile{{0, 0}, {1, 0}, {1, 2}, {0, 2}};
  for (const Sweep& sweep : {Sweep{.segments = 9}, Sweep{.angle = 1.0, .segments = 4}})
    expect_closed(revolved(profile, true, sweep), 2);
}

}  // namespace
}  // namespace dynalin::revolution_test
