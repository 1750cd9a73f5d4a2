// Balls that bounce on facets.
#include <fmt/format.h>

#include <numbers>

#include "time/course.h"

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

}  // namespace
}  // namespace dynalin::in_time::contact_facets_test
