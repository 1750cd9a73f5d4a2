// A cylinder and an ellipsoid that meet bodies of facets that are not convex.
#include <fmt/format.h>

#include <numbers>

#include "time/course.h"
#include "time/momenta.h"

namespace dynalin::in_time::contact_solids_test {
namespace {

// A drum that lies meets a slab, hollow far away, all along its mantle: half a period, and it goes back as it came.
TEST(ContactInTime, a_drum_that_falls_on_its_mantle_leaves_as_fast) {
  constexpr double k = 1e5, m = 2, v = 1, height = 0.1, radius = 0.2;
  const double blow = std::numbers::pi / std::sqrt(k / m);
  const Course c = led_through_time(
      "Drum\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/5, PART=1, QP=0,2,0, REULER=0,90D,0\n"
      "MATRIX/1, FULL=RORDER, ROWS=7, COLUMNS=3, VALUES=-2,-0.5,0, 2,-0.5,0, 2,0.5,0, 1.9,0.5,0, 1.9,0,0, -2,0,0, "
      "-2,-0.5,0\nCURVE/1, CLOSED, MATRIX=1, CURVE_POINTS, ORDER=2\nGRAPHICS/1, EXTRUSION, CID=1, CRM=5, LENGTH=4\n"
      "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, QG=0,0,0.3, REULER=30D,90D,0, VZ=-1\nMARKER/2\n"
      "MARKER/3, PART=2, QP=0,0,-0.25\nGRAPHICS/2, CYLINDER, CM=3, LENGTH=0.5, RADIUS=0.2\n"
      "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E5, EXPONENT=1, DAMPING=0, DMAX=1\n"
      "VARIABLE/1, FUNCTION=DZ(2)\nVARIABLE/2, FUNCTION=VZ(2)\nVARIABLE/3, FUNCTION=WM(2)\nEND\n",
      {.end = 2 * height / v + blow, .steps = 1, .error = 1e-10});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_NEAR(c.last(1), radius + height, 1e-7);
  EXPECT_NEAR(c.last(2), v, 1e-7);
  EXPECT_NEAR(c.last(3), 0, 1e-5);
}

// VARIABLEs: 1 to 6 momentum and spin, 7 energy of motion, 8 the force. The other body is an angle, a cube of 1 with a
// quarter of it cut out.
std::string solid_and_angle(const std::string& solid, const std::string& law) {
  return "Two bodies\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
         "PART/2, MASS=2, CM=2, IP=0.3,0.3,0.3, QG=0.4,0.3,1.4, REULER=0.3,0.4,0.5, VZ=-3, WX=1, WY=2\nMARKER/2\n"
         "MARKER/4, PART=2, QP=0,0,-0.4\n" +
         solid +
         "PART/3, MASS=3, CM=5, IP=0.5,0.5,0.5, QG=0,0,-0.5, REULER=0.785398,0.785398,0\nMARKER/5, PART=3\n"
         "MARKER/6, PART=3, QP=-0.5,-0.5,-0.5\n"
         "MATRIX/3, FULL=RORDER, ROWS=7, COLUMNS=3, VALUES=0,0,0, 1,0,0, 1,0.5,0, 0.5,0.5,0, 0.5,1,0, 0,1,0, 0,0,0\n"
         "CURVE/3, CLOSED, MATRIX=3, CURVE_POINTS, ORDER=2\nGRAPHICS/3, EXTRUSION, CID=3, CRM=6, LENGTH=1\n"
         "CONTACT/1, IGEOM=2, JGEOM=3, " +
         law + momenta_of_two_bodies() +
         "VARIABLE/7, FUNCTION=VM(2)**2+1.5*VM(5)**2+0.15*WM(2)**2+0.25*WM(5)**2\n"
         "VARIABLE/8, FUNCTION=CONTACT(1,0,1,0)\nEND\n";
}

TEST(ContactInTime, an_ellipsoid_that_meets_an_angle_keeps_its_momentum_and_spin) {
  const std::string elastic = "IMPACT, STIFFNESS=1E6, EXPONENT=1.5, DAMPING=0, DMAX=0.001\n",
                    rubs =
                        "IMPACT, STIFFNESS=2E5, EXPONENT=1.5, DAMPING=100, DMAX=0.001\n"
                        ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2, STICTION_TRANSITION_VELOCITY=0.1"
                        ", FRICTION_TRANSITION_VELOCITY=1\n";
  const std::string egg = "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.9, YSCALE=0.7, ZSCALE=1.1\n";
  for (const bool loses : {false, true}) {
    const Course c =
        led_through_time(solid_and_angle(egg, loses ? rubs : elastic), {.end = 0.6, .steps = 60, .error = 1e-8});
    ASSERT_TRUE(c.ok()) << c.failure;
    for (const int k : {1, 2, 3, 4, 5, 6}) EXPECT_LT(c.drift(k), 1e-6) << k;
    EXPECT_GT(c.largest(8), 10);
    const double change = c.variables.at(7).back() / c.variables.at(7).front() - 1;
    if (loses) {
      EXPECT_LT(change, -0.1);
    } else {
      EXPECT_LT(std::abs(change), 0.01);  // 0.7 %: the force is at the centroid
    }
  }
}

}  // namespace
}  // namespace dynalin::in_time::contact_solids_test
