// CONTACT of convex bodies of facets with ellipsoids, cylinders and frusta: as with the boxes that they are drawn like.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/contacts.h"

namespace dynalin::cases::contact_flat_test {
namespace {

using namespace contacts;

using ::testing::HasSubstr;

// From −1 to 1 and down from 0, with a point more on each side of its outline or without.
const std::string slab_of_facets =
    "MARKER/5, PART=1, QP=-1,-1,-0.5\n" +
    extrusion(1, 5, "0,0,0, 1.2,0,0, 2,0,0, 2,0.7,0, 2,2,0, 0.9,2,0, 0,2,0, 0,1.1,0, 0,0,0", 9, 0.5);
const std::string slab_of_closed_form = "MARKER/5, PART=1, QP=-1,-1,-0.5\nGRAPHICS/1, BOX, CORNER=5, X=2, Y=2, Z=0.5\n";

std::string on_it(const std::string& shape, const std::string& pose, bool exchanged = false,
                  const std::string& friction = rubs) {
  return "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, " + pose + "\nMARKER/2\nMARKER/3, PART=2, QP=0,0,-0.3\n" + shape +
         (exchanged ? "CONTACT/1, IGEOM=1, JGEOM=2, " : "CONTACT/1, IGEOM=2, JGEOM=1, ") + friction + law;
}
const std::string egg = "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.8, YSCALE=0.6, ZSCALE=0.5\n",
                  drum = "GRAPHICS/2, CYLINDER, CM=3, LENGTH=0.6, RADIUS=0.2\n",
                  ring = "GRAPHICS/2, TORUS, CM=3, MAJOR_RADIUS=0.3, MINOR_RADIUS=0.1\n",
                  tub = "GRAPHICS/2, FRUSTUM, CM=3, LENGTH=0.6, BOTTOM=0.2, TOP=0.3\n";

class ContactFlat : public ContactCases {};

}  // namespace

// On its face, over its edge and at its corner. Where nothing holds it along the edge, the double zero is known to
// roots of roundings.
TEST_F(ContactFlat, an_ellipsoid_on_a_slab_of_facets_is_one_on_a_box) {
  for (const char* pose : {"QG=0.1,0.2,0.2495, VX=0.02, WY=0.1", "QG=0.1,0.2,0.25, REULER=10D,13D,20D, VX=0.02, WY=0.1",
                           "QG=1.1,0.3,0.2, REULER=0,40D,0", "QG=1.12,1.1,0.1, REULER=30D,20D,0"}) {
    SCOPED_TRACE(pose);
    const auto wanted = values(slab_of_closed_form + on_it(egg, pose));
    expect_same(wanted, values(slab_of_facets + on_it(egg, pose)), 1e-8);
    expect_same(wanted, values(slab_of_facets + on_it(egg, pose, true)), 1e-8);
  }
}

// Standing, leaning, lying; each in the middle and over the edge.
TEST_F(ContactFlat, cylinders_and_frusta_on_a_slab_of_facets_are_those_on_a_box) {
  for (const std::string& shape : {drum, tub}) {
    for (const char* pose :
         {"QG=0.1,0.2,0.2995, VX=0.02, WY=0.1", "QG=0.1,0.2,0.345, REULER=10D,20D,20D, VX=0.02, WY=0.1",
          "QG=0.1,0.2,0.199, REULER=10D,90D,0", "QG=0.95,0.2,0.2995", "QG=0.9,0.95,0.2995",
          "QG=0.9,0.2,0.199, REULER=70D,90D,0"}) {
      SCOPED_TRACE(std::string(pose) + shape);
      const auto wanted = values(slab_of_closed_form + on_it(shape, pose));
      expect_same(wanted, values(slab_of_facets + on_it(shape, pose)));
      expect_same(wanted, values(slab_of_facets + on_it(shape, pose, true)));
    }
  }
}

TEST_F(ContactFlat, a_ring_on_a_slab_of_facets_is_one_on_a_box) {
  for (const char* pose : {"QG=0.1,0.2,0.45, REULER=10D,20D,20D", "QG=1.15,0.2,0.49, REULER=90D,60D,0"}) {
    SCOPED_TRACE(pose);
    expect_same(values(slab_of_closed_form + on_it(ring, pose)), values(slab_of_facets + on_it(ring, pose)));
  }
}

TEST_F(ContactFlat, they_come_to_rest_as_on_a_box) {
  for (const auto& [shape, pose] : {std::pair(drum, "QG=0.3,0.2,0.21, REULER=20D,89D,0"),
                                    std::pair(drum, "QG=0.3,0.2,0.301"), std::pair(tub, "QG=0.3,0.2,0.301")}) {
    SCOPED_TRACE(pose);
    const std::string statics = "SIMULATE/STATICS\n";
    expect_same(values(slab_of_closed_form + on_it(shape, pose, false, ""), statics),
                values(slab_of_facets + on_it(shape, pose, false, ""), statics), 1e-8);
  }
}

// A prism with its edge downwards between two rollers, by hand: on each of them it has a line of the length 1, held at
// both ends.
TEST_F(ContactFlat, a_prism_of_facets_lies_on_two_rollers) {
  constexpr double k = 1e4, m = 4, radius = 0.3, slant = std::numbers::pi / 4;
  const double c = std::cos(slant), s = std::sin(slant);
  // Up and down 4 places each bear N with 4 N c = 40.
  const double N = m * 10 / (4 * c), depth = N / k, apart = 0.6;
  // The lower edge of the prism is where both faces meet, at a height above the axes of the rollers.
  const double edge = (radius - depth) / c - apart * s / c;
  const std::string model =
      fmt::format(
          "MARKER/3, QP=-0.6,-1,0, REULER=0,-90D,0\nMARKER/4, QP=0.6,-1,0, REULER=0,-90D,0\n"
          "GRAPHICS/3, CYLINDER, CM=3, LENGTH=2, RADIUS=0.3\nGRAPHICS/4, CYLINDER, CM=4, LENGTH=2, RADIUS=0.3\n"
          "PART/2, MASS=4, CM=2, IP=1,1,1, QG=0,0,{:.17g}\nMARKER/2\nMARKER/6, QP=0,0.5,0, REULER=0,90D,0\nJPRIM/1, "
          "ORIENTATION, I=2, J=1\n",
          edge) +
      extrusion(2, 6, "0,0,0, 1.5,1.5,0, -1.5,1.5,0, 0,0,0", 4, 1) +
      "CONTACT/1, IGEOM=2, JGEOM=3,4, IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=0, DMAX=1\n";
  const auto v = values(model);
  ASSERT_EQ(v.size(), 6u);
  // Faces do not turn, and so the normals stay: up and down 4 k c², across 4 k s².
  EXPECT_NEAR(std::abs(v[2]), std::sqrt(4 * k * s * s / m) / (2 * std::numbers::pi), 1e-7);
  EXPECT_NEAR(std::abs(v[5]), std::sqrt(4 * k * c * c / m) / (2 * std::numbers::pi), 1e-7);
}

// Of a mantle on a dome the force jumps from edge to edge, which is said before anything runs; on prisms it does not.
TEST_F(ContactFlat, of_a_mantle_on_a_dome_of_facets_is_warned_of) {
  const double g = 1.6180339887498949;
  std::string ball;
  for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{{-1, g, 0},
                                                                  {1, g, 0},
                                                                  {-1, -g, 0},
                                                                  {1, -g, 0},
                                                                  {0, -1, g},
                                                                  {0, 1, g},
                                                                  {0, -1, -g},
                                                                  {0, 1, -g},
                                                                  {g, 0, -1},
                                                                  {g, 0, 1},
                                                                  {-g, 0, -1},
                                                                  {-g, 0, 1}})
    ball += fmt::format("v {:.17g} {:.17g} {:.17g}\n", 0.2 * x, 0.2 * y, 0.2 * z);
  for (const char* facet :
       {"1 12 6", "1 6 2", "1 2 8", "1 8 11", "1 11 12", "2 6 10", "6 12 5", "12 11 3", "11 8 7", "8 2 9",
        "4 10 5", "4 5 3", "4 3 7", "4 7 9",  "4 9 10",  "5 10 6", "3 5 12", "7 3 11",  "9 7 8",  "10 9 2"})
    ball += std::string("f ") + facet + "\n";
  write("ball.obj", ball);
  const auto said = [&](const std::string& under, const std::string& shape) {
    return run(head + under + on_it(shape, "QG=0,0,0.6") + "END\n", "LINEAR/EIGENSOL\n").err;
  };
  const std::string dome = "GRAPHICS/1, EXTERNAL, RM=1, FILE=ball.obj\n";
  EXPECT_THAT(said(dome, drum), HasSubstr("CONTACT/1 lets GRAPHICS/2 and GRAPHICS/1 touch: where a mantle passes over "
                                          "corners of facets in shallow bends the force jumps"));
  EXPECT_THAT(said(dome, egg), ::testing::Not(HasSubstr("jumping-contact")));
  EXPECT_THAT(said(slab_of_facets, drum), ::testing::Not(HasSubstr("jumping-contact")));
}

}  // namespace dynalin::cases::contact_flat_test
