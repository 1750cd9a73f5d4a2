// CONTACT of bodies of facets that are not convex, with boxes, each other and in cavities: a force at each volume in
// common.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/contacts.h"

namespace dynalin::cases::contact_volumes_test {
namespace {

using namespace contacts;

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string elastic = "IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=0, DMAX=1\n";
// Marker 5 of ground at its top: a slab from z = −0.5 to 0, the same with an edge turned up far away, which makes it
// hollow there.
const std::string slab = "MARKER/5, PART=1, QP=-2,-2,-0.5\nGRAPHICS/1, BOX, CORNER=5, X=4, Y=4, Z=0.5\n";
const std::string hollow_slab =
    "MARKER/5, PART=1, QP=0,2,0, REULER=0,90D,0\n" +
    extrusion(1, 5, "-2,-0.5,0, 2,-0.5,0, 2,0.5,0, 1.9,0.5,0, 1.9,0,0, -2,0,0, -2,-0.5,0", 7, 4);
// A bridge of 0.5 by 0.4 on two feet of 0.2 and 0.4 whose middles are at x = ±0.4, and 0.25 below the origin of PART/2.
std::string bridge(const std::string& pose) {
  return "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, " + pose +
         "\nMARKER/2\nMARKER/3, PART=2, QP=-0.5,0.2,-0.25, REULER=0,90D,0\n" +
         extrusion(2, 3, "0,0,0, 0.2,0,0, 0.2,0.3,0, 0.8,0.3,0, 0.8,0,0, 1,0,0, 1,0.5,0, 0,0.5,0, 0,0,0", 9, 0.4);
}
std::string contact(const std::string& laws, bool exchanged = false, const std::string& flip = "") {
  return std::string("CONTACT/1, ") + (exchanged ? "IGEOM=1, JGEOM=2, " : "IGEOM=2, JGEOM=1, ") + flip + laws;
}

class ContactVolumes : public ContactCases {};

}  // namespace

// Each foot bears half of the weight m g in its middle. Up and down 2 k; as it rocks, each foot by its arm a, and by
// how the middle of what it has in common with the floor, w wide, moves: k w²/12 for each; its weight falls.
TEST_F(ContactVolumes, a_bridge_stands_on_its_feet) {
  constexpr double k = 1e4, m = 2, g = 10, a = 0.4, w = 0.2, l = 0.4, Ix = 0.1, Iy = 0.12;
  const double depth = m * g / 2 / k, h = 0.25 - depth / 2;
  const double up = 2 * k / m, about_y = (2 * k * (a * a + w * w / 12) - m * g * h) / Iy,
               about_x = (2 * k * l * l / 12 - m * g * h) / Ix;
  for (const bool exchanged : {false, true}) {
    for (const std::string& floor : {slab, hollow_slab}) {
      const auto v = values(floor + bridge("QG=0.1,0.3,0.2496, REULER=20D,0,0") + contact(elastic, exchanged),
                            "SIMULATE/STATICS\n");
      ASSERT_EQ(v.size(), 12u);
      for (std::size_t n = 0; n < 6; ++n) EXPECT_LE(std::abs(v[n]), 1e-6);
      EXPECT_NEAR(std::abs(v[7]), std::sqrt(std::min(up, about_x)) / (2 * std::numbers::pi), 1e-7);
      EXPECT_NEAR(std::abs(v[9]), std::sqrt(std::max(up, about_x)) / (2 * std::numbers::pi), 1e-7);
      EXPECT_NEAR(std::abs(v[11]), std::sqrt(about_y) / (2 * std::numbers::pi), 1e-7);
    }
  }
}

// Tilted, moving, rubbing, over an edge, on its back.
TEST_F(ContactVolumes, are_the_same_from_either_side) {
  const std::string start = "Contact\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (const char* pose : {"QG=0.1,0.2,0.245, REULER=20D,1D,30D, VX=0.02, WY=0.1", "QG=0.1,0.2,0.4, REULER=10D,60D,40D",
                           "QG=1.6,0.2,0.248, REULER=10D,1D,0, VY=0.1", "QG=0.1,0.2,0.27, REULER=0,175D,20D"}) {
    SCOPED_TRACE(pose);
    const std::string model = slab + bridge(pose);
    expect_same(values(model + contact(rubs + law), "", start), values(model + contact(rubs + law, true), "", start),
                1e-8);
  }
}

// In a room of facets a crate leans on a wall and stands on the floor, each with one force.
TEST_F(ContactVolumes, a_crate_leans_in_a_cavity_of_facets) {
  constexpr double k = 1e4, m = 2;
  const std::string room =
                        "MARKER/5, PART=1, QP=-1,-1,-1\n" + extrusion(1, 5, "0,0,0, 2,0,0, 2,2,0, 0,2,0, 0,0,0", 5, 2),
                    crate =
                        "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, QG=0.851,0,0\nMARKER/2\n"
                        "MARKER/3, PART=2, QP=-0.15,-0.2,-0.25\nGRAPHICS/2, BOX, CORNER=3, X=0.3, Y=0.4, Z=0.5\n"
                        "JPRIM/1, ORIENTATION, I=2, J=1\n";
  const auto v = values(room + crate + contact(elastic, false, "JFLIP_GEOMETRY=1, "), "",
                        "Contact\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n");
  ASSERT_EQ(v.size(), 6u);
  EXPECT_NEAR(std::abs(v.back()), std::sqrt(k / m) / (2 * std::numbers::pi), 1e-9);
}

TEST_F(ContactVolumes, without_a_direction_are_named) {
  // Through the bridge, below its deck.
  const std::string bar = "MARKER/5, PART=1, QP=-0.4,-2,0.1\nGRAPHICS/1, BOX, CORNER=5, X=0.02, Y=4, Z=0.02\n";
  const RunResult through = run(head + bar + bridge("QG=0,0,0.25") + contact(elastic) + "END\n", "LINEAR/EIGENSOL\n");
  EXPECT_NE(through.status, 0);
  EXPECT_THAT(through.err, HasSubstr("CONTACT/1 touch all around or in more places than can be told apart"));
  const std::string crumb = "MARKER/5, PART=1, QP=-0.4,0,0.1\nGRAPHICS/1, BOX, CORNER=5, X=0.02, Y=0.02, Z=0.02\n";
  EXPECT_NE(run(head + crumb + bridge("QG=0,0,0.25") + contact(elastic) + "END\n", "LINEAR/EIGENSOL\n").status, 0);
}

TEST_F(ContactVolumes, that_are_just_none_are_told) {
  const auto said = [&](const std::string& pose) {
    return run(head + slab + bridge(pose) + contact(elastic) + "END\n", "LINEAR/EIGENSOL\n").err;
  };
  EXPECT_THAT(said("QG=0,0,0.25"), AllOf(HasSubstr("CONTACT/1 is just touching"), HasSubstr("[touching-contact]")));
  EXPECT_THAT(said("QG=0,0,0.2499"), Not(HasSubstr("touching-contact")));
  EXPECT_THAT(said("QG=0,0,0.2501"), Not(HasSubstr("touching-contact")));
}

}  // namespace dynalin::cases::contact_volumes_test
