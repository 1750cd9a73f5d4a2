#include "elements/families/contact_force.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/model_test_support.h"

namespace dynalin::contact_force_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

// A ball 0.01 deep in a plane, 0.3 from its edge, that leaves at some speed.
SwitchList switches_of_ball(const std::string& speed) {
  const auto system = system_test::system_of(
      "PART/2, MASS=1, CM=2, IP=1,1,1, QG=0.7,0,0.09, VZ=" + speed +
      "\nMARKER/2\nGRAPHICS/1, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1\n"
      "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n"
      "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1000, EXPONENT=1, DAMPING=20, DMAX=1E-3\n");
  OperatingPoint op = system->drawn();
  op.velocity[2] = std::stod(speed);
  ExpressionScratch scratch;
  SwitchList list;
  system->switches(system->motion(op), scratch, list);
  return list;
}

}  // namespace

// The gap, the pressure before it is cut off, which the damper pulls below zero, and how far the edge is.
TEST(contact_force, switches_where_it_opens_where_it_no_longer_pushes_and_at_edges) {
  EXPECT_THAT(switches_of_ball("0").value,
              ElementsAre(DoubleNear(-0.01, 1e-15), DoubleNear(10, 1e-12), DoubleNear(0.3, 1e-15)));
  EXPECT_THAT(switches_of_ball("0.7").value,
              ElementsAre(DoubleNear(-0.01, 1e-15), DoubleNear(-4, 1e-12), DoubleNear(0.3, 1e-15)));
  EXPECT_THAT(switches_of_ball("-0.5").value,
              ElementsAre(DoubleNear(-0.01, 1e-15), DoubleNear(20, 1e-12), DoubleNear(0.3, 1e-15)));
}

}  // namespace dynalin::contact_force_test
