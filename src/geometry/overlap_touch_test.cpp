// Bodies of facets that are not convex, and boxes in cavities: volumes in common, where they push and how that changes.
#include "geometry/overlap_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/facet_overlap.h"
#include "geometry/moved_frame_test_support.h"
#include "geometry/overlap_test_support.h"
#include "geometry/polygon.h"
#include "geometry/prism.h"
#include "geometry/revolution.h"
#include "geometry/seen_back.h"

namespace dynalin::overlap_touch_test {
namespace {

using namespace overlap_test;

Mesh box_at(const Vector& low, const Vector& high) {
  Mesh mesh = box(high - low);
  for (Vector& v : mesh.vertices) v += low;
  return mesh;
}
// A plate of 2 by 2 on legs of 0.2 by 0.2 and 0.5 at its corners, whose feet are at z = 0.
FacetBody table() {
  Mesh mesh = box_at({-1, -1, 0.5}, {1, 1, 0.6});
  for (const double x : {-1.0, 0.8}) {
    for (const double y : {-1.0, 0.8}) append(mesh, box_at({x, y, 0}, {x + 0.2, y + 0.2, 0.4}));
  }
  return FacetBody(mesh);
}

class overlap_touch : public Poses {};

// Of two boxes, by the corners of what planes of both bound: every three planes meet in one, and a face is divided into
// triangles about its middle.
struct Common {
  double volume = 0;
  Vector centroid{};
};
Common common_of_boxes(const Vector& half_I, const RelativeFrame<double>& f, const Vector& half_J) {
  struct Bound {
    Vector n;
    double height;
  };
  std::vector<Bound> bounds;
  for (const double s : {1.0, -1.0}) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector axis = k == 0 ? f.x : k == 1 ? f.y : f.z;
      bounds.push_back({s * axis, s * dot(axis, f.p) + half_I[k]});
      bounds.push_back({s * unit_vectors[k], half_J[k]});
    }
  }
  Common c;
  Vector moment{};
  for (std::size_t a = 0; a < bounds.size(); ++a) {
    std::vector<Vector> corners;
    for (std::size_t b = 0; b < bounds.size(); ++b) {
      for (std::size_t d = b + 1; d < bounds.size(); ++d) {
        const Vector &p = bounds[a].n, &q = bounds[b].n, &r = bounds[d].n;
        const double det = dot(p, cross(q, r));
        if (a == b || a == d || std::abs(det) < 1e-9) continue;
        const Vector x =
            (cross(q, r) * bounds[a].height + cross(r, p) * bounds[b].height + cross(p, q) * bounds[d].height) / det;
        if (std::ranges::all_of(bounds, [&](const Bound& e) { return dot(e.n, x) <= e.height + 1e-10; }))
          corners.push_back(x);
      }
    }
    if (corners.size() < 3) continue;
    Vector middle{};
    for (const Vector& v : corners) middle += v / static_cast<double>(corners.size());
    const Vector x = normalized(corners[0] - middle), y = cross(bounds[a].n, x);
    std::ranges::sort(corners, {}, [&](const Vector& v) { return std::atan2(dot(y, v - middle), dot(x, v - middle)); });
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector &u = corners[k], &v = corners[(k + 1) % corners.size()];
      const double six = dot(middle, cross(u, v));
      c.volume += six / 6, moment += (middle + u + v) * (six / 24);
    }
  }
  c.centroid = moment / c.volume;
  return c;
}

}  // namespace

TEST_F(overlap_touch, volumes_of_two_boxes_are_what_their_planes_bound) {
  const Vector half_I{0.5, 0.4, 0.3}, half_J{0.6, 0.3, 0.45};
  const FacetBody I = facets_of_box(-half_I, half_I), J = facets_of_box(-half_J, half_J);
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    const auto f = pose(0.45);
    const Overlaps found = find_overlaps(I, f, J, false);
    ASSERT_TRUE(found.definite);
    if (found.engulfed || found.volumes.empty()) continue;
    ++seen;
    ASSERT_EQ(found.volumes.size(), 1u);
    const Overlap& o = found.volumes.front();
    const Common wanted = common_of_boxes(half_I, f, half_J);
    EXPECT_NEAR(o.volume, wanted.volume, 1e-11);
    expect_near(o.origin + o.moment / o.volume, wanted.centroid, 1e-10 / wanted.volume);
    EXPECT_TRUE(o.whole);
  }
  EXPECT_GT(seen, 80);
}

TEST_F(overlap_touch, a_table_stands_on_each_of_its_legs) {
  const FacetBody feet = table(), floor = facets_of_box({-2, -2, -0.5}, {2, 2, 0});
  auto list = seeded_touches(feet, at({0.1, -0.2, -0.01}), floor);
  ASSERT_EQ(list.size(), 4u);
  for (const auto& t : list) {
    EXPECT_TRUE(t.defined);
    EXPECT_NEAR(t.gap.value, -0.01, 1e-12);
    expect_near(value_of(t.normal), {0, 0, 1}, 1e-12);
    const Vector p = value_of(t.point);
    EXPECT_NEAR(std::abs(p.x - 0.1), 0.9, 1e-11);
    EXPECT_NEAR(std::abs(p.y + 0.2), 0.9, 1e-11);
    EXPECT_NEAR(p.z, -0.005, 1e-12);
    // Up, and as I turns about its origin by the arm of the place.
    const std::array<double, 6> wanted{0, 0, 1, p.y + 0.2, -(p.x - 0.1), 0};
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(t.gap.partial[k], wanted[k], 1e-10) << k;
      // The floor's: it does not turn with the legs.
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(t.normal[c].partial[k], 0) << k;
    }
  }
  EXPECT_EQ(touches(feet, at({0.1, -0.2, 0.02}), floor).size(), 0u);
  std::vector<Touch<double>> open(most_overlaps);
  touch_overlaps<double>(feet, at({0.1, -0.2, 0.02}), floor, false, open);
  EXPECT_NEAR(open.front().gap, 0.02, 1e-15);
  // Just on it, or as little in it as roundings say, they hardly push and are not in doubt.
  for (const double depth : {0.0, 1e-16, 1e-14, 5e-14, 1e-13, 1e-12, 1e-11}) {
    for (const auto& t : touches(feet, at({0.1, -0.2, -depth}), floor)) {
      EXPECT_TRUE(t.defined) << depth;
      EXPECT_LE(-t.gap, depth + 1e-15);
    }
  }
}

TEST_F(overlap_touch, of_a_corner_an_edge_and_two_crossing_edges_is_as_deep_as_they_are) {
  // What is not convex has it far from here.
  const FacetBody hook = swept({{-1, -1}, {1, -1}, {1, 1}, {0.8, 1}, {0.8, -0.8}, {-1, -0.8}}, -1, 1);
  const FacetBody cube = facets_of_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  // A corner of the cube below the face y = −0.8, at a turn where no two of its faces incline alike.
  const Matrix3 R = rotation_exponential({0.5, 0.3, 0.7});
  RelativeFrame<double> f{{0, 0, 0}, R.x, R.y, R.z};
  double lowest = 0;
  for (const Vector& v : cube.vertices()) lowest = std::min(lowest, (R * v).y);
  f.p = {-0.3, -0.8 - lowest - 0.01, 0};
  auto list = touches(cube, f, hook);
  ASSERT_EQ(list.size(), 1u);
  expect_near(list[0].normal, {0, 1, 0}, 1e-10);
  EXPECT_NEAR(list[0].gap, -0.01, 1e-10);
  // An edge of the cube across the arm of the hook.
  const double h = std::sqrt(0.5);
  const RelativeFrame<double> turned{{0.9 + 0, 1 + h - 0.02, 0}, {h, 0, h}, {-0.5, h, 0.5}, {-0.5, -h, 0.5}};
  list = touches(cube, turned, hook);
  ASSERT_EQ(list.size(), 1u);
  expect_near(list[0].normal, {0, 1, 0}, 1e-10);
  EXPECT_NEAR(list[0].gap, -0.02, 1e-10);
  // Two ridges across each other, the one upside down. Where the line through the centroid passes over an edge, the
  // depth bends.
  const FacetBody ridge = swept({{0, 0}, {0.5, 0.5}, {0.5, 1}, {0.3, 0.7}, {-0.5, 1}, {-0.5, 0.5}}, -0.3, 0.3);
  list = touches(ridge, {{0, 0.02, 0}, {0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, ridge);
  ASSERT_EQ(list.size(), 1u);
  expect_near(list[0].normal, {0, -1, 0}, 1e-10);
  EXPECT_NEAR(list[0].gap, -0.02, 1e-10);
  EXPECT_LT(list[0].seam, 1e-11);
}

TEST_F(overlap_touch, what_is_apart_is_as_far_as_its_nearest_features) {
  const auto gap = [](const FacetBody& I, const RelativeFrame<double>& f, const FacetBody& J) {
    std::vector<Touch<double>> open(most_overlaps);
    touch_overlaps<double>(I, f, J, false, open);
    EXPECT_FALSE(open.front().closed());
    return open.front().gap;
  };
  const FacetBody a = angle(), cube = facets_of_box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  EXPECT_NEAR(gap(cube, at({0.75, 0.55, 0}), a), 0.15, 1e-15);             // face over face
  EXPECT_NEAR(gap(cube, at({1.4, 0.7, 0.8}), a), std::sqrt(0.27), 1e-15);  // corner to corner
  EXPECT_NEAR(gap(cube, at({0.7, 0.6, 0}), a), 0.2, 1e-15);                // in the corner between both arms
  // An edge of either across each other: along (1, 0, 1), and along z.
  const double h = std::sqrt(0.5);
  const RelativeFrame<double> turned{{1 + 0.2 * h + 0.03, 0.2, 0}, {h, h, 0}, {-h, h, 0}, {0, 0, 1}};
  EXPECT_NEAR(gap(cube, turned, a), 0.03, 1e-15);
  const RelativeFrame<double> on_edge{{0.2, 1.2, 0}, {h, 0, h}, {0, 1, 0}, {-h, 0, h}};
  EXPECT_NEAR(gap(cube, on_edge, a), 0.2, 1e-15);
  // From either, wherever they stand: what is nearest is so seen from both.
  for (int k = 0; k < 100; ++k) {
    const auto f = pose(1.5);
    std::vector<Touch<double>> one(most_overlaps), other(most_overlaps);
    touch_overlaps<double>(a, f, a, false, one), touch_overlaps<double>(a, seen_back(f), a, false, other);
    if (one.front().closed()) continue;
    EXPECT_NEAR(one.front().gap, other.front().gap, 1e-12);
    double by_vertices = 1e300;
    for (const Vector& v : a.vertices())
      by_vertices = std::min(by_vertices, a.nearest(f.p + f.x * v.x + f.y * v.y + f.z * v.z).distance);
    EXPECT_LE(one.front().gap, by_vertices + 1e-12);
  }
}

TEST_F(overlap_touch, changes_as_the_bodies_move) {
  const auto a = angle(), s = star(5), cube = facets_of_box({-0.4, -0.3, -0.5}, {0.4, 0.3, 0.5});
  const std::array<std::pair<const FacetBody*, const FacetBody*>, 4> pairs{{{&a, &s}, {&s, &a}, {&cube, &s}, {&a, &a}}};
  int seen = 0, several = 0;
  for (int k = 0; k < 400; ++k) {
    const auto& [I, J] = pairs[static_cast<std::size_t>(k) % pairs.size()];
    const auto f = pose(0.6);
    const auto list = seeded_touches(*I, f, *J);
    if (list.empty() || std::ranges::any_of(list, [](const auto& t) { return !t.defined || t.seam < 1e-4; })) continue;
    if (std::ranges::any_of(list, [](const auto& t) { return t.gap.value < -0.3; })) continue;
    ++seen, several += list.size() > 1;
    SCOPED_TRACE(k);
    expect_differences(list, *I, f, *J, 2e-5);
    if (HasFailure()) break;
  }
  EXPECT_GT(seen, 60);
  EXPECT_GT(several, 3);
}

TEST_F(overlap_touch, is_the_same_seen_from_either_body) {
  const auto a = angle(), s = star(7);
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    const auto f = pose(0.6);
    auto one = touches(a, f, s), other = touches(s, seen_back(f), a);
    if (one.empty()) continue;
    ++seen;
    ASSERT_EQ(one.size(), other.size());
    const auto deeper = [](const auto& t) { return t.gap; };
    std::ranges::sort(one, {}, deeper), std::ranges::sort(other, {}, deeper);
    for (std::size_t n = 0; n < one.size(); ++n) {
      EXPECT_EQ(one[n].defined, other[n].defined);
      if (!one[n].defined) continue;
      const Touch<double>& t = other[n];
      const Vector point = f.p + f.x * t.point.x + f.y * t.point.y + f.z * t.point.z;
      // What of either surface is in the other one has the same net area but for roundings.
      EXPECT_NEAR(one[n].gap, t.gap, 1e-9);
      expect_near(one[n].normal, -(f.x * t.normal.x + f.y * t.normal.y + f.z * t.normal.z), 1e-8);
      expect_near(one[n].point, point, 1e-8);
    }
  }
  EXPECT_GT(seen, 100);
}

TEST_F(overlap_touch, of_parts_drawn_flush_is_as_deep_as_they_are) {
  const FacetBody a = angle();
  // On top of itself: all its sides are in those of the other one, and edges lie on diagonals of facets.
  auto list = touches(a, at({0, 0, 0.69}), a);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_TRUE(list[0].defined);
  EXPECT_NEAR(list[0].gap, -0.01, 1e-11);
  expect_near(list[0].normal, {0, 0, 1}, 1e-12);
  list = touches(table(), at({0, 0, -0.01}), facets_of_box({-1, -1, -0.5}, {1, 1, 0}));
  ASSERT_EQ(list.size(), 4u);
  for (const auto& t : list) EXPECT_NEAR(t.gap, -0.01, 1e-11);
}

TEST_F(overlap_touch, of_what_reaches_over_an_edge_is_across_the_faces) {
  const FacetBody feet = table(), floor = facets_of_box({-0.9, -2, -0.5}, {2, 2, 0});
  const auto list = seeded_touches(feet, at({0, 0, -0.001}), floor);
  ASSERT_EQ(list.size(), 4u);
  for (const auto& t : list) {
    EXPECT_NEAR(t.gap.value, -0.001, 1e-12);
    expect_near(value_of(t.normal), {0, 0, 1}, 1e-12);
    // Two stand as on a floor without end. Two reach over its edge: of the sides of what they have in common one is
    // that of the floor, three are of the leg, of 0.2 and twice 0.1.
    const bool reaches_over = t.point.x.value < 0;
    EXPECT_NEAR(t.point.x.value, reaches_over ? -0.85 : 0.9, 1e-11);
    EXPECT_NEAR(t.normal.x.partial[4], reaches_over ? 1.0 / 3 : 0, 1e-9);
  }
}

TEST_F(overlap_touch, in_a_cavity_is_that_with_its_walls) {
  const FacetBody room = facets_of_box({-1, -1, -1}, {1, 1, 1}),
                  cube = facets_of_box({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3});
  EXPECT_EQ(touches(cube, at({0, 0.1, 0}), room, true).size(), 0u);
  auto list = touches(cube, at({0.72, 0.1, 0}), room, true);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_TRUE(list[0].defined);
  EXPECT_NEAR(list[0].gap, -0.02, 1e-12);
  expect_near(list[0].normal, {-1, 0, 0}, 1e-12);
  expect_near(list[0].point, {1.01, 0.1, 0}, 1e-11);
  // In a notch of a star, as it stands in one that is cut out of everything else.
  const FacetBody hollow = star(5);
  int seen = 0;
  for (int k = 0; k < 100; ++k) {
    const auto f = pose(0.2);
    const FacetBody small = facets_of_box({-0.12, -0.1, -0.1}, {0.12, 0.1, 0.1});
    for (const auto& t : touches(small, f, hollow, true)) {
      seen += t.defined;
      EXPECT_LT(norm(t.normal) - 1, 1e-12);
    }
  }
  EXPECT_GT(seen, 20);
}

// The middle of what a tube on its end has in common with the floor is in its hole.
TEST_F(overlap_touch, of_a_tube_on_its_end_is_in_the_middle_of_it) {
  const std::array<Meridian, 4> profile{{{0.3, 0}, {0.4, 0}, {0.4, 0.5}, {0.3, 0.5}}};
  const FacetBody tube(revolved(profile, true, {.segments = 12})), floor = facets_of_box({-2, -2, -0.5}, {2, 2, 0});
  const auto upright_tube = seeded_touches(tube, at({0.2, 0, -0.01}), floor);
  ASSERT_EQ(upright_tube.size(), 1u);
  EXPECT_NEAR(upright_tube[0].gap.value, -0.01, 1e-12);
  const std::array<double, 6> wanted{0, 0, 1, 0, 0, 0};
  for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(upright_tube[0].gap.partial[n], wanted[n], 1e-9) << n;
  expect_near(value_of(upright_tube[0].point), {0.2, 0, -0.005}, 1e-10);

  constexpr double tilt = 0.01;
  const RelativeFrame<double> tilted{
      {0.2, 0, -0.01}, {std::cos(tilt), 0, -std::sin(tilt)}, {0, 1, 0}, {std::sin(tilt), 0, std::cos(tilt)}};
  const auto list = seeded_touches(tube, tilted, floor);
  ASSERT_EQ(list.size(), 1u);
  const Touch<Seeded>& t = list.front();
  EXPECT_TRUE(t.defined);
  expect_near(value_of(t.normal), {0, 0, 1}, 1e-12);
  // More than in the middle of a wedge, whose centroid is beside it, and less than at its deepest.
  EXPECT_GT(-t.gap.value, 0.01 + tilt * (t.point.x.value - 0.2));
  EXPECT_LT(-t.gap.value, 0.01 + tilt * 0.4);
  constexpr double h = 1e-6;
  for (std::size_t n = 0; n < 6; ++n) {
    const auto plus = touches(tube, moved(tilted, n, h), floor), minus = touches(tube, moved(tilted, n, -h), floor);
    EXPECT_NEAR(t.gap.partial[n], (plus.front().gap - minus.front().gap) / (2 * h), 1e-6) << n;
    EXPECT_NEAR(t.point.x.partial[n], (plus.front().point.x - minus.front().point.x) / (2 * h), 1e-4) << n;
  }
}

// A ball of facets is as deep in a face as it is, whichever body has it, and so is a ridge.
TEST_F(overlap_touch, of_what_is_pointed_and_round_is_as_deep_as_it_is) {
  Mesh ball = ellipsoid({0.5, 0.5, 0.5}, 40);
  append(ball, box_at({-0.1, -0.1, 2}, {0.1, 0.1, 3}));
  const FacetBody round(ball),
      slab = facets_of_box({-2, -2, -1}, {2, 2, 0}),
      ridge = swept({{0, 0}, {0.5, 0.5}, {0.5, 1}, {0.3, 0.7}, {-0.5, 1}, {-0.5, 0.5}}, -0.3, 0.3),
      wall = facets_of_box({-2, -1, -2}, {2, 0, 2});
  const auto expect_depth = [](const FacetBody& I, const RelativeFrame<double>& f, const FacetBody& J, double depth,
                               double tolerance) {
    for (const auto& list : {touches(I, f, J), touches(J, seen_back(f), I)}) {
      ASSERT_EQ(list.size(), 1u);
      EXPECT_TRUE(list[0].defined);
      EXPECT_NEAR(-list[0].gap, depth, tolerance);
    }
  };
  expect_depth(ridge, at({0.1, -0.01, 0.2}), wall, 0.01, 1e-12);
  for (const double depth : {0.01, 0.05}) expect_depth(round, at({0.3, 0.2, 0.5 - depth}), slab, depth, 0.05 * depth);
}

// Turned by quarters and shifted by eighths of their sizes, so that edges meet edges and faces lie in faces.
TEST_F(overlap_touch, of_bodies_drawn_on_one_grid_is_definite) {
  const FacetBody a = swept({{0, 0}, {1, 0}, {1, 0.25}, {0.5, 0.25}, {0.5, 1}, {0, 1}}, -0.25, 0.25),
                  b = swept({{0, 0}, {0.25, 0}, {0.25, 0.5}, {0.75, 0.5}, {0.75, 0}, {1, 0}, {1, 0.75}, {0, 0.75}}, 0,
                            0.5);
  const auto draw = [&](int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); };
  int seen = 0;
  for (int k = 0; k < 3000; ++k) {
    Matrix3 R = Matrix3::identity();
    for (int t = 0; t < 2; ++t)
      R = rotation_exponential(unit_vectors[static_cast<std::size_t>(draw(3))] * (draw(4) * std::numbers::pi / 2)) * R;
    RelativeFrame<double> f{{0.125 * (draw(17) - 8), 0.125 * (draw(17) - 8), 0.125 * (draw(17) - 8)}, R.x, R.y, R.z};
    const auto volume = [&] {
      const Overlaps found = find_overlaps(a, f, b, false);
      EXPECT_TRUE(found.definite);
      double sum = 0;
      for (const Overlap& o : found.volumes) {
        EXPECT_GT(o.volume, -1e-12);
        EXPECT_TRUE(o.whole);
        sum += o.volume;
      }
      return sum;
    };
    const double here = volume();
    f.p += Vector{1.3e-9, -0.7e-9, 0.9e-9};
    EXPECT_NEAR(volume(), here, 1e-8);
    seen += here > 1e-3;
  }
  EXPECT_GT(seen, 300);
}

// A bar that comes out at the other side of a plate is no deeper than the plate, or has no direction.
TEST_F(overlap_touch, of_a_bar_through_a_plate_is_no_deeper_than_the_plate) {
  const FacetBody plate = swept({{0, 0}, {1, 0}, {1, 0.05}, {0.05, 0.05}, {0.05, 0.5}, {0, 0.5}}, -0.5, 0.5),
                  bar = facets_of_box({-0.05, -0.3, -0.05}, {0.05, 0.3, 0.05});
  int deep = 0, without = 0;
  for (const double tilt : {0.2, 0.785, 1.1}) {
    for (double y = 0.3; y > -0.3; y -= 0.005) {
      const RelativeFrame<double> f{
          {0.5, y, 0.02}, {std::cos(tilt), -std::sin(tilt), 0}, {std::sin(tilt), std::cos(tilt), 0}, {0, 0, 1}};
      for (const auto& t : touches(bar, f, plate)) {
        ++(t.defined ? deep : without);
        EXPECT_LT(-t.gap, t.defined ? 0.2 : 1) << tilt << ' ' << y;
      }
    }
  }
  EXPECT_GT(deep, 20);
  EXPECT_GT(without, 20);
}

TEST_F(overlap_touch, has_no_direction_all_around_and_wholly_inside) {
  const FacetBody hollow = angle(), small = facets_of_box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02});
  const auto inside = touches(small, at({0.2, 0.2, 0}), hollow);
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_FALSE(inside[0].defined);
  // A bar through the arm of it from side to side.
  const FacetBody bar = facets_of_box({-0.05, -0.05, -2}, {0.05, 0.05, 2});
  const auto through = touches(bar, at({0.2, 0.15, 0}), hollow);
  ASSERT_EQ(through.size(), 1u);
  EXPECT_FALSE(through[0].defined);
  // A face that passes through a void in the other body has a hole in one of its triangles.
  Mesh shell = box_at({-1, -1, -1}, {1, 1, 1}), hole = box_at({0.25, -0.05, -0.1}, {0.35, 0.05, 0.1});
  turn_over(hole);
  append(shell, hole);
  const auto list = touches(facets_of_box({-0.5, -0.5, 0}, {0.5, 0.5, 3}), at({0, 0, 0}), FacetBody(shell));
  EXPECT_TRUE(std::ranges::any_of(list, [](const auto& t) { return !t.defined; }));
}

}  // namespace dynalin::overlap_touch_test
