// Balls that bounce on facets.
#include <fmt/format.h>

#include <numbers>

#include "time/course.h"
#include "time/momenta.h"

namespace dynalin::in_time::contact_facets_test {
namespace {

// From where it falls freely to where it rests again for an instant: two flights of v/g and, between them, what the
// two walls, as stiff as 2 k cos²β together, take to turn v around: tan(ω t/2) = −v ω/g.
TEST(ContactInTime, a_ball_bounces_in_a_groove_of_facets) {
  constexpr double g = 10, m = 2, radius = 0.2, k = 1e5, beta = 0.6, height = 0.3;
  const double cosine = std::cos(beta), omega = std::sqrt(2 * k / m) * cosine, v = std::sqrt(2 * g * height);
  const double turned = 2 / omega * (std::numbers::pi - std::atan(v * omega / g)), whole = 2 * v / g + turned;
  const double start = radius / cosine + height;
  const Course c = led_through_time(
      fmt::format("Groove\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\n"
                  "MARKER/9, PART=1, QP=0,-2,0, REULER=180D,90D,0\nMATRIX/1, FULL=RORDER, ROWS=6, COLUMNS=3\n"
                  ", VALUES=0,0,0, 1,{0:.17g},0, 1,-1,0, -1,-1,0, -1,{0:.17g},0, 0,0,0\n"
                  "CURVE/1, CLOSED, MATRIX=1, CURVE_POINTS, ORDER=2\nGRAPHICS/1, EXTRUSION, CID=1, CRM=9, LENGTH=4\n"
                  "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0,0.1,{1:.17g}\nMARKER/2\n"
                  "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.4, YSCALE=0.4, ZSCALE=0.4\n"
                  "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E5, EXPONENT=1, DAMPING=0, DMAX=1\n"
                  "VARIABLE/1, FUNCTION=DZ(2)\nVARIABLE/2, FUNCTION=VZ(2)\nVARIABLE/3, FUNCTION=DX(2)\nEND\n",
                  std::tan(beta), start),
      {.end = whole, .steps = 1, .error = 1e-10});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_NEAR(c.variables.at(1).back(), start, 1e-7);
  EXPECT_NEAR(c.variables.at(2).back(), 0, 1e-6);
  EXPECT_NEAR(c.variables.at(3).back(), 0, 1e-7);
}

// What may touch something small is led through time and put together like anything else: only searches for rest take
// steps no longer than it.
TEST(ContactInTime, what_may_touch_something_small_moves_as_far_as_it_does) {
  const Course c = led_through_time(
      "Fast\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0,3,0, VX=50\n"
      "MARKER/2\nGRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.02, YSCALE=0.02, ZSCALE=0.02\n"
      "MARKER/3, PART=1, QP=0,0,-9\nGRAPHICS/1, BOX, CORNER=3, X=0.1, Y=0.1, Z=0.1\n"
      "MARKER/4, PART=2, REULER=90D,90D,0\nMARKER/5, PART=1, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=4, J=5\n"
      "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E4, EXPONENT=1.5, DAMPING=0, DMAX=1\n"
      "VARIABLE/1, FUNCTION=DX(2)\nVARIABLE/2, FUNCTION=DY(2)\nEND\n",
      {.end = 1, .steps = 20, .error = 1e-6});
  ASSERT_TRUE(c.ok()) << c.failure;
  for (std::size_t k = 0; k < c.times.size(); ++k) {
    EXPECT_NEAR(c.variables.at(1)[k], 50 * c.times[k], 1e-9);
    EXPECT_NEAR(c.variables.at(2)[k], 0, 1e-9);
  }
}

// In a bowl whose seams run in and out under the ball, it keeps its energy whenever it is in the air.
TEST(ContactInTime, a_ball_that_bounces_in_a_bowl_of_facets_keeps_its_energy) {
  std::string profile;
  for (const double x : {0.0, 0.3, 0.6, 0.8, 1.0}) profile += fmt::format("{},0,{:.17g}, ", x, 0.4 * x * x);
  const Course c = led_through_time(
      "Bowl\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\nMARKER/9, PART=1\n"
      "MATRIX/1, FULL=RORDER, ROWS=7, COLUMNS=3\n, VALUES=" +
          profile +
          "1,0,-0.3, 0,0,-0.3\nCURVE/1, OPEN, MATRIX=1, CURVE_POINTS, ORDER=2\n"
          "GRAPHICS/1, REVOLUTION, CID=1, CRM=9, SEG=14\n"
          "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0.45,0.1,0.45, VY=0.8\nMARKER/2\n"
          "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.5, YSCALE=0.5, ZSCALE=0.5\n"
          "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=5E3, EXPONENT=1.5, DAMPING=0, DMAX=1\n"
          "VARIABLE/1, FUNCTION=VX(2)**2+VY(2)**2+VZ(2)**2+20*DZ(2)\nVARIABLE/2, FUNCTION=CONTACT(1,0,1,0)\nEND\n",
      {.end = 6, .steps = 300, .error = 1e-9});
  ASSERT_TRUE(c.ok()) << c.failure;
  int in_the_air = 0, touching = 0;
  for (std::size_t k = 1; k < c.times.size(); ++k) {
    if (c.variables.at(2)[k] != 0) {
      ++touching;
      continue;
    }
    ++in_the_air;
    EXPECT_NEAR(c.variables.at(1)[k], c.variables.at(1)[0], 1e-5) << c.times[k];
  }
  EXPECT_GT(in_the_air, 50);
  EXPECT_GT(touching, 20);
}

// Two bodies in space, a corner of the one beside an edge of the other. VARIABLEs: 1 to 6 momentum and spin, 7 energy
// of motion, 8 the force.
std::string two_bodies(const std::string& one, const std::string& other, const std::string& law) {
  std::string text =
      "Two bodies\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=2, CM=2, IP=0.3,0.3,0.3, QG=0.4,0.3,1.4, REULER=0.3,0.4,0.5, VZ=-3, WX=1, WY=2\nMARKER/2\n"
      "MARKER/4, PART=2, QP=-0.5,-0.5,-0.5\n" +
      one +
      "PART/3, MASS=3, CM=5, IP=0.5,0.5,0.5, QG=0,0,-0.5, REULER=0.785398,0.785398,0\nMARKER/5, PART=3\n"
      "MARKER/6, PART=3, QP=-0.5,-0.5,-0.5\n" +
      other + "CONTACT/1, IGEOM=2, JGEOM=3, " + law;
  return text + momenta_of_two_bodies() +
         "VARIABLE/7, FUNCTION=VM(2)**2+1.5*VM(5)**2+0.15*WM(2)**2+0.25*WM(5)**2\n"
         "VARIABLE/8, FUNCTION=CONTACT(1,0,1,0)\nEND\n";
}
std::string cube_of_facets(int id, int marker) {
  return fmt::format(
      "MATRIX/{0}, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=0,0,0, 1,0,0, 1,1,0, 0,1,0, 0,0,0\n"
      "CURVE/{0}, CLOSED, MATRIX={0}, CURVE_POINTS, ORDER=2\nGRAPHICS/{0}, EXTRUSION, CID={0}, CRM={1}, LENGTH=1\n",
      id, marker);
}
std::string cube(int id, int marker) { return fmt::format("GRAPHICS/{}, BOX, CORNER={}, X=1, Y=1, Z=1\n", id, marker); }
// About the middle of its body, 0.5 in radius and height, of 16 bands.
std::string ball_of_facets(int id, int marker) {
  std::string points;
  for (int k = 0; k <= 8; ++k) {
    const double angle = k * std::numbers::pi / 8;
    points += fmt::format("{}{:.17g},0,{:.17g}", k == 0 ? "" : ", ", k % 8 == 0 ? 0 : 0.5 * std::sin(angle),
                          0.5 - 0.5 * std::cos(angle));
  }
  return fmt::format(
      "MARKER/7{0}, RM={1}, QP=0.5,0.5,0\nMATRIX/{0}, FULL=RORDER, ROWS=9, COLUMNS=3, VALUES={2}\n"
      "CURVE/{0}, OPEN, MATRIX={0}, CURVE_POINTS, ORDER=2\nGRAPHICS/{0}, REVOLUTION, CID={0}, CRM=7{0}, SEG=16\n",
      id, marker, points);
}

const std::string elastic = "IMPACT, STIFFNESS=1E6, EXPONENT=1.5, DAMPING=0, DMAX=0.001\n";

TEST(ContactInTime, cubes_of_facets_tumble_as_boxes_do) {
  const in_time::Run run{.end = 0.6, .steps = 60, .error = 1e-8};
  const Course boxes = led_through_time(two_bodies(cube(2, 4), cube(3, 6), elastic), run);
  const Course facets = led_through_time(two_bodies(cube_of_facets(2, 4), cube_of_facets(3, 6), elastic), run);
  ASSERT_TRUE(boxes.ok()) << boxes.failure;
  ASSERT_TRUE(facets.ok()) << facets.failure;
  EXPECT_GT(boxes.largest(8), 100);
  for (const int k : {1, 2, 3, 4, 5, 6, 7}) {
    for (std::size_t t = 0; t < boxes.times.size(); ++t)
      EXPECT_NEAR(facets.variables.at(k)[t], boxes.variables.at(k)[t], 1e-4) << k << ' ' << t;
  }
}

// About the middle of its body, a cube of 1 with a quarter of it cut out.
std::string angle_of_facets(int id, int marker) {
  return fmt::format(
      "MATRIX/{0}, FULL=RORDER, ROWS=7, COLUMNS=3, VALUES=0,0,0, 1,0,0, 1,0.5,0, 0.5,0.5,0, 0.5,1,0, 0,1,0, 0,0,0\n"
      "CURVE/{0}, CLOSED, MATRIX={0}, CURVE_POINTS, ORDER=2\nGRAPHICS/{0}, EXTRUSION, CID={0}, CRM={1}, LENGTH=1\n",
      id, marker);
}

// Two feet meet a slab flat, with 2 k together: half a period of that, and it goes back as it came.
TEST(ContactInTime, what_falls_flat_on_its_feet_leaves_as_fast) {
  constexpr double k = 1e5, m = 2, v = 1, height = 0.1;
  const double blow = std::numbers::pi / std::sqrt(2 * k / m);
  const Course c = led_through_time(
      "Feet\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/5, PART=1, QP=-2,-2,-0.5\n"
      "GRAPHICS/1, BOX, CORNER=5, X=4, Y=4, Z=0.5\nPART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, QG=0,0,0.35, "
      "VZ=-1\nMARKER/2\n"
      "MARKER/3, PART=2, QP=-0.5,0.2,-0.25, REULER=0,90D,0\n"
      "MATRIX/2, FULL=RORDER, ROWS=9, COLUMNS=3, VALUES=0,0,0, 0.2,0,0, 0.2,0.3,0, 0.8,0.3,0, 0.8,0,0, 1,0,0, 1,0.5,0, "
      "0,0.5,0, 0,0,0\nCURVE/2, CLOSED, MATRIX=2, CURVE_POINTS, ORDER=2\n"
      "GRAPHICS/2, EXTRUSION, CID=2, CRM=3, LENGTH=0.4\n"
      "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E5, EXPONENT=1, DAMPING=0, DMAX=1\n"
      "VARIABLE/1, FUNCTION=DZ(2)\nVARIABLE/2, FUNCTION=VZ(2)\nVARIABLE/3, FUNCTION=WM(2)\nEND\n",
      {.end = 2 * height / v + blow, .steps = 1, .error = 1e-10});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_NEAR(c.last(1), 0.35, 1e-7);
  EXPECT_NEAR(c.last(2), v, 1e-7);
  EXPECT_NEAR(c.last(3), 0, 1e-7);
}

TEST(ContactInTime, bodies_of_facets_that_meet_keep_their_momentum_and_spin) {
  const std::string law =
      "IMPACT, STIFFNESS=2E5, EXPONENT=1.5, DAMPING=100, DMAX=0.001\n"
      ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2, STICTION_TRANSITION_VELOCITY=0.1"
      ", FRICTION_TRANSITION_VELOCITY=1\n";
  for (const auto& other : {cube_of_facets(3, 6), ball_of_facets(3, 6), cube(3, 6), angle_of_facets(3, 6)}) {
    const Course c =
        led_through_time(two_bodies(ball_of_facets(2, 4), other, law), {.end = 0.6, .steps = 60, .error = 1e-8});
    ASSERT_TRUE(c.ok()) << c.failure;
    for (const int k : {1, 2, 3, 4, 5, 6}) EXPECT_LT(c.drift(k), 1e-6) << k;
    EXPECT_GT(c.largest(8), 10);
    EXPECT_LT(c.variables.at(7).back(), c.variables.at(7).front());
  }
}

}  // namespace
}  // namespace dynalin::in_time::contact_facets_test
