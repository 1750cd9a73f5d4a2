#include "geometry/mesh.h"

#include <algorithm>

#include "geometry/lines.h"
#include "geometry/mesh_test_support.h"
#include "geometry/prism.h"
#include "geometry/spring_damper_shape.h"

namespace dynalin::mesh_test {
namespace {

TEST(Mesh, lists_each_edge_once) {
  Mesh m = box({1, 1, 1});
  EXPECT_EQ(distinct_edges(m).size(), 12u);
  m.segments = {{0, 1}, {1, 0}, {0, 6}};  // a side, the same again, and a diagonal of the box
  const auto edges = distinct_edges(m);
  EXPECT_EQ(edges.size(), 13u);
  for (const Mesh::Edge& e : edges) EXPECT_LT(e[0], e[1]);
}

TEST(Mesh, of_two_is_closed_where_both_are) {
  Mesh m = box({1, 1, 1});
  append(m, box({2, 2, 2}));
  EXPECT_EQ(m.vertices.size(), 16u);
  expect_closed(m, 4);
  EXPECT_NEAR(volume_of(m), 9, 1e-12);
  EXPECT_NEAR(signed_volume(m), 9, 1e-12);
  append(m, polyline(std::vector<Vector>{{0, 0, 0}, {3, 0, 0}}));
  EXPECT_FALSE(m.closed);
  EXPECT_EQ(m.segments.front(), (Mesh::Edge{16, 17}));
}

TEST(Mesh, far_from_its_origin_keeps_the_digits_of_its_volume) {
  Mesh m = box({1, 2, 3});
  for (Vector& p : m.vertices) p += Vector{1e6, -2e6, 3e6};
  EXPECT_NEAR(signed_volume(m), 6, 1e-8);
}

TEST(Mesh, turned_over_bounds_a_negative_volume_and_close_turns_it_back) {
  Mesh m = box({1, 2, 3});
  turn_over(m);
  EXPECT_NEAR(signed_volume(m), -6, 1e-12);
  close(m);
  EXPECT_NEAR(signed_volume(m), 6, 1e-12);
  m.quads.pop_back();
  m.closed = false;
  close(m);
  EXPECT_FALSE(m.closed);
}

TEST(Mesh, without_loose_vertices_keeps_its_faces) {
  Mesh m = box({1, 2, 3});
  std::rotate(m.vertices.begin(), m.vertices.end() - 1, m.vertices.end());
  m.vertices.insert(m.vertices.begin(), Vector{9, 9, 9});
  for (auto& q : m.quads) {
    for (auto& v : q) v = v == 7 ? 1 : v + 2;
  }
  m.add({8, 8, 8});
  drop_loose_vertices(m);
  EXPECT_EQ(m.vertices.size(), 8u);
  expect_closed(m, 2);
  EXPECT_NEAR(volume_of(m), 6, 1e-12);
}

TEST(Lines, arcs_begin_at_x_and_circles_close) {
  const Mesh circle = arc(2, {.segments = 10});
  EXPECT_EQ(circle.vertices.size(), 10u);
  EXPECT_EQ(circle.segments.size(), 10u);
  expect_sound(circle);
  for (const auto& e : circle.segments) {
    const Vector along = circle.vertices[e[1]] - circle.vertices[e[0]];
    EXPECT_NEAR(norm(along), 4 * std::sin(std::numbers::pi / 10), 1e-12);
    EXPECT_GT(cross(circle.vertices[e[0]], along).z, 0);
  }
  const Mesh quarter = arc(2, {.angle = std::numbers::pi / 2, .segments = 5});
  EXPECT_EQ(quarter.segments.size(), 5u);
  expect_sound(quarter);
  EXPECT_NEAR(norm(quarter.vertices.front() - Vector{2, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(norm(quarter.vertices.back() - Vector{0, 2, 0}), 0, 1e-15);
}

TEST(Lines, leave_out_points_that_do_not_move) {
  const Mesh m = polyline(std::vector<Vector>{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(m.segments.size(), 1u);
  expect_sound(m);
  EXPECT_TRUE(polyline(std::vector<Vector>{{1, 0, 0}, {1, 0, 0}}).vertices.empty());
}

TEST(SpringDamper, halves_meet_in_the_middle_and_share_nothing) {
  const auto halves = spring_damper_halves({.coils = 4, .diameter = 2, .tip_length = {1, 3}, .segments = 10}, 12);
  for (const Mesh& half : halves) {
    expect_sound(half), expect_plane(half);
    EXPECT_EQ(half.quads.size(), 20u);
    EXPECT_EQ(half.segments.size(), 1u);
    EXPECT_FALSE(half.closed);
  }
  const auto range = [](const Mesh& m) {
    const auto z = [](const Vector& a, const Vector& b) { return a.z < b.z; };
    const auto [low, high] = std::minmax_element(m.vertices.begin(), m.vertices.end(), z);
    return std::pair(low->z, high->z);
  };
  // The spring lies between 1 and 9, its pitch is 2, its band half of one wide.
  EXPECT_NEAR(range(halves[0]).first, 0, 1e-12);
  EXPECT_NEAR(range(halves[0]).second, 5.25, 1e-12);
  EXPECT_NEAR(range(halves[1]).first, 4.75, 1e-12);
  EXPECT_NEAR(range(halves[1]).second, 12, 1e-12);
}

TEST(SpringDamper, coils_turn_once_in_a_pitch_of_the_diameter_of_the_spring) {
  const auto halves = spring_damper_halves({.coils = 3, .diameter = 5, .segments = 8}, 12);
  std::size_t k = 0;
  for (const Mesh& half : halves) {
    ASSERT_EQ(half.vertices.size(), 2u * 13u) << "a coil and a half in pieces of an eighth";
    for (std::size_t i = 0; i < half.vertices.size(); i += 2, ++k) {
      const auto coil = static_cast<double>(k < 13 ? k : k - 1) / 8;  // the halves share the place of their ends
      const double angle = 2 * std::numbers::pi * coil;
      const Vector middle{2.5 * std::cos(angle), 2.5 * std::sin(angle), 4 * coil};
      EXPECT_NEAR(norm(half.vertices[i] - (middle - Vector{0, 0, 0.5})), 0, 1e-12);
      EXPECT_NEAR(norm(half.vertices[i + 1] - (middle + Vector{0, 0, 0.5})), 0, 1e-12);
    }
  }
}

TEST(SpringDamper, of_which_a_measure_is_missing_has_no_such_part) {
  const auto halves = spring_damper_halves({.coils = 3, .cup_diameter = {1, 0}, .cup_length = {0, 2}}, 8);
  for (const Mesh& half : halves) {
    EXPECT_EQ(half.faces(), 0u);
    EXPECT_EQ(half.segments.size(), 1u);
  }
}

TEST(SpringDamper, tubes_begin_at_the_tips) {
  const SpringDamperSize size{.cup_diameter = {2, 1}, .cup_length = {3, 4}, .tip_length = {1, 2}, .segments = 8};
  const auto halves = spring_damper_halves(size, 10);
  EXPECT_EQ(halves[0].quads.size(), 8u);
  double volume = 0;
  for (const Mesh& half : halves) expect_sound(half), volume += volume_of(half);
  EXPECT_NEAR(volume, 4 * std::sin(std::numbers::pi / 4) * (3 + 0.25 * 4), 1e-12);
  for (const Vector& p : halves[0].vertices) EXPECT_LE(p.z, 4 + 1e-12);
  for (const Vector& p : halves[1].vertices) EXPECT_GE(p.z, 4 - 1e-12);
}

TEST(SpringDamper, without_anything_is_a_line_in_two_pieces) {
  const auto halves = spring_damper_halves({}, 10);
  for (const Mesh& half : halves) EXPECT_EQ(half.segments.size(), 1u);
  EXPECT_NEAR(halves[0].vertices.back().z, 5, 1e-12);
  EXPECT_NEAR(halves[1].vertices.back().z, 5, 1e-12);
}

}  // namespace
}  // namespace dynalin::mesh_test
