// A box of facets touches as a box in closed form does, with all derivatives.
#include "geometry/facet_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "geometry/prism.h"

namespace dynalin::facet_touch_test {
namespace {

using namespace solid;

const Box plain{{-0.35, -0.4, -0.3}, {0.35, 0.4, 0.3}};

Polyhedron facets_of_box() {
  Mesh mesh = dynalin::box(plain.high - plain.low);
  for (Vector& v : mesh.vertices) v += plain.low;
  return {std::make_shared<const FacetBody>(mesh)};
}

using Seeded = Dual<12>;
std::vector<Touch<Seeded>> touches(const Side& I, const Side& J, const RelativeFrame<double>& f) {
  const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
  const auto s = path::seeded<12>({along(f.p), along(f.x), along(f.y), along(f.z)});
  const auto values = [](const auto& v) { return Vec3<Seeded>{v.x.value, v.y.value, v.z.value}; };
  std::vector<Touch<Seeded>> list(touch_count(I, J));
  find_touches<Seeded>(I, J, {values(s.p), values(s.x), values(s.y), values(s.z)}, list);
  std::erase_if(list, [](const auto& t) { return !t.closed(); });
  std::ranges::sort(list, {}, [](const auto& t) { return t.gap.value; });
  return list;
}

void expect_same(const Seeded& a, const Seeded& b) {
  EXPECT_NEAR(a.value, b.value, 1e-13);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(a.partial[k], b.partial[k], 1e-11);
}
void expect_same(const Touch<Seeded>& a, const Touch<Seeded>& b) {
  EXPECT_EQ(a.defined, b.defined);
  expect_same(a.gap, b.gap);
  for (std::size_t k = 0; k < 3; ++k) expect_same(a.normal[k], b.normal[k]), expect_same(a.point[k], b.point[k]);
  EXPECT_EQ(a.weight.value, b.weight.value);
}

class facet_touch : public ::testing::Test {
 protected:
  RelativeFrame<double> pose(double far) {
    std::normal_distribution<double> n;
    const Matrix3 R = rotation_exponential({n(random_), n(random_), n(random_)});
    return {{far * n(random_), far * n(random_), far * n(random_)}, R.x, R.y, R.z};
  }
  // Deepest first, in `draws` poses where a box has at least one, and none deeper than `most`.
  void compare(const Side& I, const Side& J, const Side& I_box, const Side& J_box, double far, double most = 1e300) {
    int seen = 0;
    for (int k = 0; k < 4000 && seen < 60; ++k) {
      const auto f = pose(far);
      const auto wanted = touches(I_box, J_box, f);
      if (wanted.empty() || -wanted.front().gap.value > most) continue;
      ++seen;
      const auto found = touches(I, J, f);
      ASSERT_EQ(found.size(), wanted.size()) << f.p.x << ' ' << f.p.y << ' ' << f.p.z;
      for (std::size_t t = 0; t < found.size(); ++t) expect_same(found[t], wanted[t]);
    }
    EXPECT_GE(seen, 20);
  }

  std::mt19937_64 random_{11};
};

}  // namespace

TEST_F(facet_touch, of_a_point_and_a_ball_is_that_of_a_box) {
  const Side facets{facets_of_box()}, box{plain};
  compare({Ball{0}}, facets, {Ball{0}}, box, 0.3);
  compare({Ball{0.3}}, facets, {Ball{0.3}}, box, 0.6);
  compare(facets, {Ball{0.3}}, box, {Ball{0.3}}, 0.6);
}

TEST_F(facet_touch, of_a_ring_on_a_box_of_facets_is_that_on_a_box) {
  const Side facets{facets_of_box()}, box{plain};
  for (const Torus& ring : {Torus{0.5, 0.1}, Torus{0.2, 0.15}}) {
    // Deeper than its tube is wide its circle goes through the body.
    compare({ring}, facets, {ring}, box, 0.4, ring.minor);
    compare(facets, {ring}, box, {ring}, 0.4, ring.minor);
  }
}

// A ball in a box touches each wall that it reaches.
TEST_F(facet_touch, in_a_box_of_facets_is_that_in_a_box) {
  const Side facets{facets_of_box(), true}, box{plain, true};
  compare({Ball{0.25}}, facets, {Ball{0.25}}, box, 0.1, 0.05);
}

TEST_F(facet_touch, of_corners_with_planes_and_walls_is_that_of_a_box) {
  const Side facets{facets_of_box()}, box{plain};
  for (const Side& J : {Side{Plane{-1e3, 1e3, -1e3, 1e3}}, Side{Plane{-1, 1, -1, 1}, true},
                        Side{Box{{-0.7, -0.6, -0.5}, {0.6, 0.5, 0.7}}, true}, Side{Frustum{-0.5, 0.8, 0.6, 0.5}, true},
                        Side{Ball{0.5}, true}, Side{Ellipsoid{{0.5, 0.6, 0.7}}, true}})
    compare(facets, J, box, J, 0.2);
}

TEST_F(facet_touch, ends_in_more_places_than_are_told_apart) {
  // A comb of 120 blades into which a ball dips.
  Mesh comb;
  for (int k = 0; k < 120; ++k) {
    Mesh blade = dynalin::box({0.004, 1, 1});
    for (Vector& v : blade.vertices) v.x += 0.008 * k - 0.5;
    append(comb, blade);
  }
  const Side J{Polyhedron{std::make_shared<const FacetBody>(comb)}};
  std::vector<Touch<double>> list(touch_count({Ball{1}}, J));
  find_touches<double>({Ball{1}}, J, {{0, 0.5, 1.7}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, list);
  EXPECT_TRUE(std::ranges::all_of(list, [](const auto& t) { return t.closed(); }));
  EXPECT_FALSE(list.back().defined);
}

}  // namespace dynalin::facet_touch_test
