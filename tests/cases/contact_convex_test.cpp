// CONTACT of convex bodies of facets with boxes and with each other: as the boxes and planes that they are drawn like.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/contacts.h"

namespace dynalin::cases::contact_convex_test {
namespace {

using namespace contacts;

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// From a marker along its x, y and z.
std::string crate(int id, int marker, double x, double y, double z) {
  return extrusion(id, marker, fmt::format("0,0,0, {0},0,0, {0},{1},0, 0,{1},0, 0,0,0", x, y), 5, z);
}
std::string box(int id, int marker, double x, double y, double z) {
  return fmt::format("GRAPHICS/{}, BOX, CORNER={}, X={}, Y={}, Z={}\n", id, marker, x, y, z);
}

class ContactConvex : public ContactCases {};

// On a slab that reaches from −1 to 1.
std::string on_slab(bool slab_of_facets, bool crate_of_facets, const std::string& pose, bool exchanged = false,
                    const std::string& friction = rubs) {
  return "MARKER/5, PART=1, QP=-1,-1,-0.5\n" + (slab_of_facets ? crate : box)(1, 5, 2, 2, 0.5) +
         "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, " + pose + "\nMARKER/2\nMARKER/3, PART=2, QP=-0.4,-0.3,-0.25\n" +
         (crate_of_facets ? crate : box)(2, 3, 0.8, 0.6, 0.5) +
         (exchanged ? "CONTACT/1, IGEOM=1, JGEOM=2, " : "CONTACT/1, IGEOM=2, JGEOM=1, ") + friction + law;
}

}  // namespace

// Flat, tilted, on an edge, over the edge of the slab with one corner, with two, and edge across edge.
TEST_F(ContactConvex, a_crate_of_facets_on_a_slab_of_facets_is_a_box_on_a_box) {
  for (const char* pose : {"QG=0.1,0.2,0.2495, VX=0.02, WY=0.1", "QG=0.1,0.2,0.24, REULER=10D,3D,20D, VX=0.02, WY=0.1",
                           "QG=0.1,0.2,0.38, REULER=0,40D,0", "QG=0.75,0.3,0.2495, REULER=20D,0,0", "QG=0.8,0.3,0.2495",
                           "QG=0.8,0.3,0.24, REULER=20D,2D,0", "QG=1.1,0.3,0.2, REULER=30D,40D,0"}) {
    SCOPED_TRACE(pose);
    const auto boxes = values(on_slab(false, false, pose));
    expect_same(boxes, values(on_slab(true, true, pose)));
    expect_same(boxes, values(on_slab(true, false, pose)));
    expect_same(boxes, values(on_slab(false, true, pose)));
    expect_same(boxes, values(on_slab(true, true, pose, true)));
  }
}

TEST_F(ContactConvex, comes_to_rest_as_boxes_do) {
  const std::string statics = "SIMULATE/STATICS\n", pose = "QG=0.3,0.2,0.26, REULER=20D,1D,0";
  const auto boxes = values(on_slab(false, false, pose, false, ""), statics);
  expect_same(boxes, values(on_slab(true, true, pose, false, ""), statics), 1e-8);
  expect_same(boxes, values(on_slab(true, true, pose, true, ""), statics), 1e-8);
}

// A slanted block, with six corners below, on what is flat above: all of it is as on a plane.
TEST_F(ContactConvex, on_plates_is_on_a_plane) {
  const std::string outline = "0,0,0, 0.5,-0.1,0, 0.8,0.2,0, 0.7,0.5,0, 0.3,0.7,0, -0.1,0.4,0, 0,0,0";
  const std::string plane = "MARKER/5, PART=1\nGRAPHICS/1, PLANE, RM=5, XMIN=-3, XMAX=3, YMIN=-3, YMAX=3\n";
  for (const char* pose :
       {"QG=0.1,0.2,0.2495", "QG=0.1,0.2,0.235, REULER=10D,3D,20D", "QG=0,0,0.33, REULER=10D,50D,0"}) {
    const std::string block = fmt::format(
                                  "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, {}, VX=0.02, WY=0.1\nMARKER/2\n"
                                  "MARKER/3, PART=2, QP=-0.3,-0.3,-0.25\n",
                                  pose) +
                              extrusion(2, 3, outline, 7, 0.5) + "CONTACT/1, IGEOM=2, JGEOM=1, " + rubs + law;
    const auto wanted = values(plane + block);
    for (const char* shape :
         {"MARKER/5, PART=1, QP=-3,-3,-0.1\nMARKER/6, PART=1, QP=3,-3,-0.1\nMARKER/7, PART=1, QP=0,5,-0.1\n"
          "GRAPHICS/1, PLATE, MARKERS=5,6,7, THICKNESS=0.2, RADIUS=0.1\n",
          "MARKER/5, PART=1, QP=-2,0,-1\nMARKER/6, PART=1, QP=2,0,-1\nGRAPHICS/1, LINK, I=5, J=6, WIDTH=3, DEPTH=2\n",
          "MARKER/5, PART=1, QP=-3,-3,-1\nGRAPHICS/1, CYLINDER, CM=5, LENGTH=1, RADIUS=8, RANGLE=90D\n",
          "MARKER/5, PART=1, QP=-3,-3,-1\nGRAPHICS/1, BOX, CORNER=5, X=6, Y=6, Z=1\n"}) {
      SCOPED_TRACE(std::string(pose) + shape);
      expect_same(wanted, values(shape + block));
    }
  }
}

// Six corners below a block whose centre is above their middle: stiffness at their arms, less the weight at its height.
TEST_F(ContactConvex, a_block_stands_on_all_its_corners) {
  std::string outline;
  for (int k = 0; k <= 6; ++k)
    outline += fmt::format("{}{:.17g},{:.17g},0", k == 0 ? "" : ", ", 0.3 * std::cos(k * std::numbers::pi / 3),
                           0.3 * std::sin(k * std::numbers::pi / 3));
  const auto v = values("MARKER/5, PART=1, QP=-1,-1,-1\n" + crate(1, 5, 2, 2, 1) +
                        "PART/2, MASS=12, CM=2, IP=2,3,4, QG=0.2,0.1,0.398\nMARKER/2\nMARKER/3, PART=2, QP=0,0,-0.4\n" +
                        extrusion(2, 3, outline, 7, 0.8) +
                        "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=0, DMAX=1\n");
  ASSERT_EQ(v.size(), 12u);
  // 6 · 1E4 g = 120; Σ x² = Σ y² = 3 · 0.3² about the middle.
  const double tilting = 1e4 * 3 * 0.09 - 120 * 0.4;
  std::vector<double> squares{6e4 / 12, tilting / 2, tilting / 3};
  std::ranges::sort(squares);
  for (std::size_t k = 0; k < 3; ++k) {
    const double expected = std::sqrt(squares[k]) / (2 * std::numbers::pi);
    EXPECT_NEAR(std::abs(v[6 + 2 * k]), expected, 1e-7 * expected);
  }
}

// The whole turned and moved, and in other units.
TEST_F(ContactConvex, is_the_same_wherever_the_model_stands_and_in_all_units) {
  const auto model = [&](bool moved, double mm) {
    // Global axes of the one seen from those of the other: about x by 90 degrees.
    const std::string start =
        fmt::format("Contact\nUNITS/{}\nACCGRAV/{}={}\nPART/1, GROUND\nMARKER/1\n",
                    mm == 1 ? "SYSTEM=MKS" : "FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND",
                    moved ? "JGRAV" : "KGRAV", -10 * mm);
    const auto at = [&](double x, double y, double z) {
      return moved ? fmt::format("{:.17g},{:.17g},{:.17g}", (x + 3) * mm, (z - 2) * mm, (-y + 1) * mm)
                   : fmt::format("{:.17g},{:.17g},{:.17g}", x * mm, y * mm, z * mm);
    };
    const std::string axes = moved ? ", REULER=0,-90D,0" : "";
    const double inertia = mm * mm;
    return values(
        "MARKER/5, PART=1, QP=" + at(-1, -1, -0.5) + axes + "\n" + crate(1, 5, 2 * mm, 2 * mm, 0.5 * mm) +
            fmt::format("PART/2, MASS=2, CM=2, IP={},{},{}, QG={}{}\nMARKER/2\nMARKER/3, QP={:.17g},{:.17g},{:.17g}\n",
                        0.1 * inertia, 0.12 * inertia, 0.2 * inertia, at(0.8, 0.3, 0.2495), axes, -0.4 * mm, -0.3 * mm,
                        -0.25 * mm) +
            "MARKER/4, PART=2, RM=3, REULER=20D,1D,0\n" + crate(2, 4, 0.8 * mm, 0.6 * mm, 0.5 * mm) +
            fmt::format("CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS={}, EXPONENT=1, DAMPING={}, DMAX={}\n",
                        1e4 / mm, 30 / mm, 1e-5 * mm),
        "", start);
  };
  const auto plain = model(false, 1);
  expect_same(plain, model(true, 1));
  expect_same(plain, model(false, 1000));
  expect_same(plain, model(true, 1000));
}

TEST_F(ContactConvex, one_that_is_just_touching_or_flush_is_named) {
  const auto said = [&](const char* pose) {
    return run(head + on_slab(true, true, pose) + "END\n", "LINEAR/EIGENSOL\n").err;
  };
  EXPECT_THAT(said("QG=0.1,0.2,0.25"), AllOf(HasSubstr("CONTACT/1 is just touching"), HasSubstr("[touching-contact]")));
  EXPECT_THAT(said("QG=0.1,0.2,0.2495"), Not(HasSubstr("touching-contact")));
  EXPECT_THAT(said("QG=0.1,0.2,0.2505"), Not(HasSubstr("touching-contact")));
  EXPECT_THAT(said("QG=0.6,0.2,0.2495"), HasSubstr("[touching-contact]"));  // a side above that of the slab
}

// As deep sideways as from above, and tip on tip.
TEST_F(ContactConvex, as_deep_along_two_directions_are_named) {
  const RunResult r = run(head + on_slab(true, true, "QG=1.3,0.2,0.15") + "END\n", "LINEAR/EIGENSOL\n");
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("CONTACT/1 touch all around or in more places than can be told apart"));
}

TEST_F(ContactConvex, in_a_tube_are_refused_by_what_they_are) {
  const std::string part = "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, QG=0,0,0.2\nMARKER/2\n",
                    angle = "0,0,0, 2,0,0, 2,1,0, 1,1,0, 1,2,0, 0,2,0, 0,0,0";
  const auto said = [&](const std::string& on_ground, const std::string& on_part, const std::string& flip) {
    const RunResult r = run(head + "MARKER/5, PART=1, QP=-1,-1,-1\n" + on_ground + part + on_part +
                                "CONTACT/1, IGEOM=2, JGEOM=1, " + flip + law + "END\n",
                            "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 1);
    EXPECT_THAT(r.err, HasSubstr("[contact-pair-not-built]"));
    return r.err;
  };
  const auto refused = [](const std::string& on_ground, const std::string& on_part) {
    return HasSubstr("CONTACT/1 lets GRAPHICS/1, " + on_ground + ", touch GRAPHICS/2, " + on_part +
                     ", which is not available yet");
  };
  const std::string tube = "GRAPHICS/2, TORUS, CM=2, MAJOR_RADIUS=3, MINOR_RADIUS=2\n", inside = "IFLIP_GEOMETRY=2, ";
  EXPECT_THAT(said(extrusion(1, 5, angle, 7, 1), tube, inside),
              refused("a body of facets that is not convex", "the inside of a TORUS"));
  EXPECT_THAT(said(crate(1, 5, 2, 2, 1), tube, inside), refused("a convex body of facets", "the inside of a TORUS"));
}

// An angle of two convex legs: each presses with its own corners.
TEST_F(ContactConvex, several_convex_bodies_stand_for_one_that_is_not) {
  const std::string slab = "MARKER/5, PART=1, QP=-2,-2,-1\n" + crate(1, 5, 4, 4, 1),
                    floor = "MARKER/5, PART=1\nGRAPHICS/1, PLANE, RM=5, XMIN=-2, XMAX=2, YMIN=-2, YMAX=2\n";
  const std::string part =
      "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, QG=0,0,0.2495\nMARKER/2\nMARKER/3, QP=-0.2,-0.2,-0.25\n"
      "MARKER/4, QP=0.1,-0.2,-0.25\n" +
      crate(2, 3, 0.3, 0.8, 0.5) + crate(3, 4, 0.5, 0.3, 0.5) + "CONTACT/1, IGEOM=2,3, JGEOM=1, " + rubs + law;
  expect_same(values(floor + part), values(slab + part));
}

}  // namespace dynalin::cases::contact_convex_test
