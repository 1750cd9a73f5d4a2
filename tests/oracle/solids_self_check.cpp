// Solids of the oracle that meet, against closed forms, searches of whole surfaces and the motion of gaps.
#include <algorithm>
#include <utility>

#include "places/draws.h"
#include "self_check.h"
#include "solids.h"

namespace dynalin::oracle::solids_self_check {
namespace {

const Solid egg{SolidShape::ellipsoid, {0.9, 1.3, 1.1}}, brick{SolidShape::box, {0.8, -1.1, 0.9}},
    tin{SolidShape::frustum, {1.2, 0.5, 0.5}}, cup{SolidShape::frustum, {-1.1, 0.4, 0.6}},
    ring{SolidShape::torus, {0.5, 0.15}}, cake{SolidShape::wedge, {0.6, 0.9, 1.7}};
const MarkerPose upright{{}, {}}, askew{{0.2, -0.1, 0.3}, rotation_313(0.7L, 1.1L, -0.4L)};

double number_of(Real x) { return static_cast<double>(x); }
void expect_near(const Vec& a, const Vec& b, double tolerance) { EXPECT_LT(number_of(norm(a - b)), tolerance); }

std::vector<Vec> directions(int count) {
  std::vector<Vec> all;
  for (int k = 0; k < count; ++k) {
    const Real z = (2 * k + 1.0L) / count - 1, turn = 2.399963229728653L * k, r = std::sqrt(1 - z * z);
    all.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return all;
}

// The farthest point of a convex solid.
Vec farthest(const Solid& s, const MarkerPose& pose, const Vec& along) {
  if (s.shape == SolidShape::ellipsoid) return support(s, pose, along);
  std::vector<Vec> points;
  if (s.shape == SolidShape::box || s.shape == SolidShape::wedge) points = corners(s, pose);
  if (s.shape == SolidShape::frustum) {
    for (const Circle& rim : rims(s, pose)) {
      const Real x = dot(rim.x, along), y = dot(rim.y, along), size = std::hypot(x, y);
      points.push_back(size > 0 ? rim.centre + (x / size) * rim.x + (y / size) * rim.y : rim.centre);
    }
  }
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vec& a, const Vec& b) { return dot(a, along) < dot(b, along); });
}

// Of a convex solid: the largest distance of a point beyond a plane that touches it, negative inside.
TEST(Oracle, distance_from_a_convex_solid_is_that_beyond_its_tangent_planes) {
  for (const Solid& s : {egg, brick, tin, cup, cake}) {
    const DistanceOf distance = distance_from(s, askew);
    for (const Vec& at :
         {Vec{1.1L, 0.4L, -0.3L}, Vec{0.3L, 0.2L, 0.5L}, Vec{-0.8L, -0.9L, 1.2L}, Vec{0.1L, -0.5L, 0}}) {
      const Distance d = distance(at);
      const auto beyond = [&](const Vec& n) { return dot(n, at - farthest(s, askew, n)); };
      Real most = -1e300L;
      for (const Vec& n : directions(100000)) most = std::max(most, beyond(n));
      EXPECT_NEAR(number_of(beyond(d.gradient)), number_of(d.value), 1e-15);
      EXPECT_LT(number_of(most), number_of(d.value) + 1e-15);
      EXPECT_GT(number_of(most), number_of(d.value) - 0.02);
      EXPECT_NEAR(number_of(norm(d.gradient)), 1, 1e-17);
      EXPECT_NEAR(number_of(distance(at - d.value * d.gradient).value), 0, 1e-16);
    }
  }
}

TEST(Oracle, distance_from_a_torus_is_that_from_its_circle_less_its_tube) {
  const DistanceOf distance = distance_from(ring, askew);
  const Distance d = distance(askew.at({0.8L, 0, 0.4L}));
  EXPECT_NEAR(number_of(d.value), 0.35, 1e-16);
  expect_near(d.gradient, askew.R * Vec{0.6L, 0, 0.8L}, 1e-16);
}

TEST(Oracle, tilted_torus_stands_on_the_face_of_a_box) {
  const Solid table{SolidShape::box, {4, 4, 1}};
  const MarkerPose under{{-2, -2, -1}, {}}, tilted{{0.1L, 0.2L, 0.55L}, rotation_x(0.6L) * rotation_z(0.3L)};
  const TouchPlace p = place_between(ring, tilted, table, under);
  EXPECT_NEAR(number_of(p.gap), 0.55 - 0.5 * std::sin(0.6) - 0.15, 1e-16);
  expect_near(p.normal, {0, 0, 1}, 1e-17);
  const Real height = 0.55L - 0.5L * std::sin(0.6L);
  expect_near(p.point, {0.1L, 0.2L - 0.5L * std::cos(0.6L), (height - 0.15L) / 2}, 1e-16);
}

// Links of a chain, at right angles: along the line of both centres.
TEST(Oracle, tori_of_a_chain_pull) {
  const MarkerPose crossed{{0.9L, 0, 0}, rotation_x(1.5707963267948966192L)};
  const TouchPlace p = place_between(ring, upright, ring, {{0.75L, 0, 0}, crossed.R});
  EXPECT_NEAR(number_of(p.gap), 0.25 - 0.3, 1e-16);
  expect_near(p.point, {0.375L, 0, 0}, 1e-16);
  expect_near(p.normal, {1, 0, 0}, 1e-16);
}

// The largest separation over all directions; the places on the surfaces.
TEST(Oracle, ellipsoid_meets_a_solid_along_the_largest_separation) {
  for (const Solid& s : {brick, tin, cup}) {
    for (const Vec& way : directions(17)) {
      const DistanceOf distance = distance_from(s, upright);
      MarkerPose pose{
          (s.shape == SolidShape::box ? Vec{0.4L, -0.55L, 0.45L} : Vec{0, 0, s.size[0] / 2.0L}) + 1.6L * way, askew.R};
      const TouchPlace apart = place_between(egg, pose, s, upright);
      pose.p += (-apart.gap - 0.06L) * apart.normal;
      const TouchPlace p = place_between(egg, pose, s, upright);
      EXPECT_NEAR(number_of(p.gap), -0.06, 1e-16);
      expect_near(p.normal, apart.normal, 1e-15);
      const auto separation = [&](const Vec& n) { return dot(n, support(egg, pose, -n) - farthest(s, upright, n)); };
      Real most = -1e300L;
      for (const Vec& n : directions(20000)) most = std::max(most, separation(n));
      EXPECT_LT(number_of(most), number_of(p.gap) + 1e-15);
      EXPECT_GT(number_of(most), number_of(p.gap) - 0.03);
      EXPECT_NEAR(number_of(separation(p.normal)), number_of(p.gap), 1e-15);
      expect_near(support(egg, pose, -p.normal), p.point + (p.gap / 2) * p.normal, 1e-15);
      EXPECT_NEAR(number_of(distance(p.point - (p.gap / 2) * p.normal).value), 0, 1e-15);
    }
  }
}

TEST(Oracle, rims_in_a_ball_are_farthest_away_from_its_centre) {
  const Solid hollow{SolidShape::ellipsoid, {4, 4, 4}};
  const MarkerPose inside{{0.3L, 0.4L, -0.2L}, {}};
  const std::vector<TouchPlace> p = places_in_cavity(tin, inside, hollow, upright);
  ASSERT_EQ(p.size(), 2u);
  EXPECT_NEAR(number_of(p[0].gap), 2 - std::sqrt(1.0 + 0.04), 1e-15);
  EXPECT_NEAR(number_of(p[1].gap), 2 - std::sqrt(1.0 + 1.0), 1e-15);
  expect_near(p[1].normal, -std::sqrt(0.5L) * Vec{0.6L, 0.8L, 1}, 1e-15);
}

TEST(Oracle, torus_in_a_bore_touches_beside_its_axis_and_at_the_ends) {
  const Solid bore{SolidShape::frustum, {3, 1, 1}};
  const MarkerPose inside{{0.3L, 0.4L, 0.2L}, rotation_x(0.1L)};
  const std::vector<TouchPlace> p = places_in_cavity(ring, inside, bore, upright);
  ASSERT_EQ(p.size(), 3u);
  EXPECT_NEAR(number_of(p[0].gap), 0.2 - 0.5 * std::sin(0.1) - 0.15, 1e-16);
  expect_near(p[0].normal, {0, 0, 1}, 1e-17);
  EXPECT_NEAR(number_of(p[2].gap), 2.8 - 0.5 * std::sin(0.1) - 0.15, 1e-15);
  // Outwards across the mantle of a cone: (r - 1 - z/3) cos, tan = 1/3.
  const DistanceOf mantle = walls_of({SolidShape::frustum, {3, 1, 2}}, upright)[1];
  const Distance d = mantle(nearest_on(centre_circle(ring, {inside.p, {}}), mantle));
  EXPECT_NEAR(number_of(d.value), 0.2 / 3 * 3 / std::sqrt(10.0), 1e-15);
  expect_near(d.gradient, (1 / std::sqrt(10.0L)) * Vec{-1.8L, -2.4L, 1}, 1e-15);
}

TEST(Oracle, corners_in_a_box_meet_every_wall) {
  const Solid hollow{SolidShape::box, {-3, 4, 5}};
  const std::vector<TouchPlace> p = places_in_cavity(brick, {{-1, 2, 1}, {}}, hollow, upright);
  ASSERT_EQ(p.size(), 48u);
  std::vector<double> gaps;
  for (const TouchPlace& place : p) gaps.push_back(number_of(place.gap));
  std::sort(gaps.begin(), gaps.end());
  // x from -1 to -0.2 in -3 to 0, y from 0.9 to 2 in 0 to 4, z from 1 to 1.9 in 0 to 5: four corners each.
  std::vector<double> expected;
  for (const double g : {0.2, 1.0, 2.0, 2.8, 0.9, 2.0, 2.0, 3.1, 1.0, 1.9, 3.1, 4.0})
    expected.insert(expected.end(), 4, g);
  std::sort(expected.begin(), expected.end());
  for (std::size_t k = 0; k < 48; ++k) EXPECT_NEAR(gaps[k], expected[k], 1e-15);
}

TEST(Oracle, ellipsoid_in_a_cavity_is_deepest_of_all_its_points) {
  const MarkerPose inside{{0.2L, 0.25L, 1.1L}, askew.R};
  for (const Solid& hollow : {Solid{SolidShape::frustum, {3, 1, 1.5}}, Solid{SolidShape::frustum, {3, 1, 1}},
                              Solid{SolidShape::box, {2, 2, 3}}}) {
    const std::vector<DistanceOf> walls = walls_of(hollow, upright);
    const std::vector<TouchPlace> p = places_in_cavity(egg, inside, hollow, upright);
    ASSERT_EQ(p.size(), walls.size());
    for (std::size_t k = 0; k < p.size(); ++k) {
      Real least = 1e300L;
      for (const Vec& n : directions(20000)) least = std::min(least, walls[k](support(egg, inside, n)).value);
      EXPECT_LT(number_of(p[k].gap), number_of(least) + 1e-15);
      EXPECT_GT(number_of(p[k].gap), number_of(least) - 1e-3);
      EXPECT_NEAR(number_of(walls[k](support(egg, inside, -p[k].normal)).value), number_of(p[k].gap), 1e-15);
      expect_near(walls[k](p[k].point).gradient, p[k].normal, 1e-15);
    }
  }
}

// A box of 0.8 by 1.2 by 1 on the floor of another one, 0.01 deep at four corners with the stiffness k each: up and
// down 4 k; turned about x the corners rise and sink by 0.6, and their normal forces stay below the turning centre.
TEST(Oracle, box_in_a_box_stands_on_four_corners) {
  const double k = 1000, mass = 2, inertia = 0.4;
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 2, mass, {inertia, 0.3, 0.5, 0, 0, 0}, 20);
  body(m, 2).qg = {0, 0, 0.49};
  m.markers = {{20, part, origin, origin}, {21, part, {-0.4, -0.6, -0.5}, origin}, {1, ground, {-2, -2, 0}, origin}};
  Touch t;
  t.id = 1, t.kind = TouchKind::solids, t.i = 21, t.j = 1;
  t.solid_i = {SolidShape::box, {0.8, 1.2, 1}}, t.solid_j = {SolidShape::box, {4, 4, 5}};
  t.cavity = Cavity::j;
  t.stiffness = k, t.exponent = 1;
  for (const bool exchanged : {false, true}) {
    m.touches = {t};
    if (exchanged) {
      std::swap(m.touches[0].i, m.touches[0].j);
      std::swap(m.touches[0].solid_i, m.touches[0].solid_j);
      m.touches[0].cavity = Cavity::i;
    }
    const OracleLinearModel r =
        linearize_drawn(m, {rate(2, 0), value(2, 0), rate(2, 1), value(2, 1), rate(2, 2), value(2, 2), rate(2, 3),
                            value(2, 3), rate(2, 4), value(2, 4), rate(2, 5), value(2, 5)});
    EXPECT_NEAR(r.A[4][5], -4 * k / mass, 1e-9);
    EXPECT_NEAR(r.A[6][7], (-4 * k * 0.6 * 0.6 + 4 * k * 0.01 * 0.5) / inertia, 1e-8);
    EXPECT_NEAR(r.A[0][1], 0, 1e-9);
  }
}

// Every place of the draws: its gap changes as fast as the material parts along the normal.
TEST(Oracle, gaps_of_drawn_solids_follow_the_velocity_of_the_material) {
  int closed = 0;
  for (std::uint64_t seed = 291; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    const Mechanism m = random_mechanism(seed);
    ASSERT_EQ(m.touches.size(), 4u);
    Model model(m);
    place(model, drawn_point(m));
    const std::vector<BodyMotion> here = model.motion;
    for (std::size_t k = 0; k < m.touches.size(); ++k) {
      const std::vector<Model::TouchState> states = model.touch_states(k);
      const auto gaps = [&](Real h) {
        for (std::size_t b = 1; b < here.size(); ++b) {
          model.motion[b].p = here[b].p + h * here[b].v;
          model.motion[b].R = rotation_exponential(h * here[b].w) * here[b].R;
        }
        model.update_positions();
        std::vector<Real> gap;
        for (const Model::TouchState& s : model.touch_states(k)) gap.push_back(s.gap);
        return gap;
      };
      constexpr Real h = 1e-6L;
      const std::vector<Real> after = gaps(h), before = gaps(-h);
      (void)gaps(0);
      for (std::size_t p = 0; p < states.size(); ++p) {
        if (states[p].gap > 0) continue;
        ++closed;
        const Real seen = (after[p] - before[p]) / (2 * h), said = dot(states[p].velocity, states[p].normal);
        EXPECT_NEAR(number_of(seen / model.length), number_of(said / model.length), 1e-9);
      }
    }
  }
  EXPECT_GE(closed, 30);
}

TEST(Oracle, drawn_solids_linearize_sharply) {
  for (std::uint64_t seed = 291; seed <= 300; seed += draws(1u, 3u)) {
    SCOPED_TRACE(seed);
    const Mechanism m = random_mechanism(seed);
    const OraclePoint point = drawn_point(m);
    EXPECT_LT(oracle_linearize(m, point, choose_states(m, point)).error_estimate, 1e-10);
  }
}

}  // namespace
}  // namespace dynalin::oracle::solids_self_check
