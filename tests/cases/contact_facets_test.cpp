// CONTACT of files of facets, extrusions, plates, links and wedges: as the solid in closed form where there is one, and
// by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/contacts.h"

namespace dynalin::cases::contact_facets_test {
namespace {

using namespace contacts;

// A box as text of STL, from the origin.
std::string stl_of_box(double x, double y, double z) {
  const auto corner = [&](int k) { return std::array<double, 3>{k & 1 ? x : 0, k & 2 ? y : 0, k & 4 ? z : 0}; };
  std::string text = "solid lump\n";
  for (const auto& [a, b, c] : std::vector<std::array<int, 3>>{{0, 2, 3},
                                                               {0, 3, 1},
                                                               {4, 5, 7},
                                                               {4, 7, 6},
                                                               {0, 1, 5},
                                                               {0, 5, 4},
                                                               {2, 6, 7},
                                                               {2, 7, 3},
                                                               {0, 4, 6},
                                                               {0, 6, 2},
                                                               {1, 3, 7},
                                                               {1, 7, 5}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int k : {a, b, c}) {
      const auto p = corner(k);
      text += fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", p[0], p[1], p[2]);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid lump\n";
}

class ContactFacets : public ContactCases {
 protected:
  void expect_error(const std::string& model, const std::string& what) const {
    const RunResult r = run(head + model + "END\n", "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 1);
    EXPECT_THAT(r.err, ::testing::HasSubstr(what));
  }
  static std::string ball(const std::string& at) {
    return "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, VX=0.02, WY=0.1, QG=" + at +
           "\nMARKER/2\nGRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.4, YSCALE=0.4, ZSCALE=0.4\nCONTACT/1, IGEOM=2, "
           "JGEOM=1, " +
           rubs + law;
  }
};

// Two walls of a groove, each across the angle β from the horizontal: up and down 2 k cos²β/m, across 2 k sin²β/m.
std::string groove(double beta) {
  const double t = std::tan(beta);
  return fmt::format(
      "MARKER/9, PART=1, QP=0,-2,0, REULER=180D,90D,0\nMATRIX/1, FULL=RORDER, ROWS=6, COLUMNS=3\n"
      ", VALUES=0,0,0, 1,{0:.17g},0, 1,-1,0, -1,-1,0, -1,{0:.17g},0, 0,0,0\n"
      "CURVE/1, CLOSED, MATRIX=1, CURVE_POINTS, ORDER=2\nGRAPHICS/1, EXTRUSION, CID=1, CRM=9, LENGTH=4\n",
      t);
}

}  // namespace

// On a face, beyond an edge and at a corner; in a box of facets, at two walls of it.
TEST_F(ContactFacets, a_file_that_holds_a_box_is_that_box) {
  write("lump.stl", stl_of_box(2, 2, 2));
  const std::string marker = "MARKER/5, PART=1, QP=-1,-1,-1\n",
                    file = marker + "GRAPHICS/1, EXTERNAL, RM=5, FILE=lump.stl\n",
                    box = marker + "GRAPHICS/1, BOX, CORNER=5, X=2, Y=2, Z=2\n";
  for (const char* at : {"0.3,0.2,1.19", "0.2,1.13,1.14", "1.11,1.1,1.12", "0.3,1.19,0.3"}) {
    SCOPED_TRACE(at);
    expect_same(values(box + ball(at)), values(file + ball(at)));
  }
  const auto in = [&](std::string model) {
    model.insert(model.find("IMPACT"), "JFLIP_GEOMETRY=1, ");
    return values(model);
  };
  expect_same(in(box + ball("0.3,0.81,-0.82")), in(file + ball("0.3,0.81,-0.82")));
}

TEST_F(ContactFacets, a_file_that_holds_a_crate_stands_and_lies_as_that_crate) {
  write("lump.stl", stl_of_box(0.8, 0.6, 0.5));
  const std::string ground = "MARKER/5, PART=1\nGRAPHICS/1, PLANE, RM=5, XMIN=-2, XMAX=2, YMIN=-2, YMAX=2\n";
  const auto crate = [&](const char* pose, const std::string& shape) {
    return fmt::format(
        "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, VX=0.02, WY=0.1, {}\nMARKER/2\n"
        "MARKER/3, PART=2, QP=-0.4,-0.3,-0.25\n{}CONTACT/1, IGEOM=2, JGEOM=1, {}{}",
        pose, shape, rubs, law);
  };
  const std::string file = "GRAPHICS/2, EXTERNAL, RM=3, FILE=lump.stl\n",
                    box = "GRAPHICS/2, BOX, CORNER=3, X=0.8, Y=0.6, Z=0.5\n";
  for (const char* pose : {"QG=0.1,0.2,0.2495", "QG=0.1,0.2,0.24, REULER=10D,3D,20D"})
    expect_same(values(ground + crate(pose, box)), values(ground + crate(pose, file)));
}

TEST_F(ContactFacets, a_ball_in_a_groove_is_held_by_both_walls) {
  constexpr double k = 1e5, m = 2, radius = 0.2;
  for (const double beta : {0.5, 0.9}) {
    SCOPED_TRACE(beta);
    const double c = std::cos(beta), s = std::sin(beta), depth = m * 10 / (2 * c * k);
    const auto v =
        values(groove(beta) + fmt::format("PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0,0,{:.17g}\nMARKER/2\nGRAPHICS/2, "
                                          "ELLIPSOID, CM=2, XSCALE=0.4, YSCALE=0.4, ZSCALE=0.4\nCONTACT/1, IGEOM=2, "
                                          "JGEOM=1, IMPACT, STIFFNESS=1E5, EXPONENT=1, DAMPING=0, DMAX=1\n",
                                          (radius - depth) / c));
    ASSERT_EQ(v.size(), 12u);
    std::vector<double> wanted{std::sqrt(2 * k * s * s / m), std::sqrt(2 * k * c * c / m)};
    std::ranges::sort(wanted);
    EXPECT_NEAR(2 * std::numbers::pi * std::abs(v[8]), wanted[0], 1e-7 * wanted[0]);
    EXPECT_NEAR(2 * std::numbers::pi * std::abs(v[10]), wanted[1], 1e-7 * wanted[1]);
    EXPECT_LT(std::abs(v[7]), 1e-4);
  }
}

// What falls on a solid from above rests on it, and has not got through it in one step.
TEST_F(ContactFacets, statics_let_a_ball_fall_on_solids_and_into_grooves) {
  write("lump.stl", stl_of_box(2, 2, 2));
  const std::string marker = "MARKER/5, PART=1, QP=-1,-1,-2\n";
  for (const std::string& shape : {marker + "GRAPHICS/1, EXTERNAL, RM=5, FILE=lump.stl\n",
                                   marker + "GRAPHICS/1, BOX, CORNER=5, X=2, Y=2, Z=2\n", groove(0.05), groove(0.5)}) {
    SCOPED_TRACE(shape);
    const RunResult r =
        run(head + shape +
                "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0.02,0,0.3\nMARKER/2\nGRAPHICS/2, "
                "ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\nCONTACT/1, IGEOM=2, JGEOM=1, "
                "IMPACT, STIFFNESS=1E5, EXPONENT=1.5, DAMPING=0, DMAX=1\nJPRIM/1, ORIENTATION, I=2, J=1\nEND\n",
            "SIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 0) << r.err;
  }
}

// Flat places of what is drawn in facets are those of a plane.
TEST_F(ContactFacets, plates_links_extrusions_and_wedges_have_flat_places) {
  const std::string at = "0.3,0.2,0.199";
  const auto plane = values("MARKER/5, PART=1\nGRAPHICS/1, PLANE, RM=5, XMIN=-2, XMAX=2, YMIN=-2, YMAX=2\n" + ball(at));
  for (const char* shape :
       {"MARKER/5, PART=1, QP=-1,-1,-0.1\nMARKER/6, PART=1, QP=1,-1,-0.1\nMARKER/7, PART=1, QP=0,2,-0.1\nGRAPHICS/1, "
        "PLATE, MARKERS=5,6,7, THICKNESS=0.2, RADIUS=0.1\n",
        "MARKER/5, PART=1, QP=-1,0,-0.25\nMARKER/6, PART=1, QP=1,0,-0.25\nGRAPHICS/1, LINK, I=5, J=6, WIDTH=1, "
        "DEPTH=0.5\n",
        "MARKER/5, PART=1, QP=0,0,-1\nGRAPHICS/1, CYLINDER, CM=5, LENGTH=1, RADIUS=2, RANGLE=120D\n"}) {
    SCOPED_TRACE(shape);
    expect_same(plane, values(std::string(shape) + ball(at)));
  }
}

// A corner of a flat face that is off by the roundings of a file: above the diagonal that divides it and elsewhere.
TEST_F(ContactFacets, a_face_that_is_flat_but_for_roundings_is_flat) {
  const auto flat =
      values("MARKER/5, PART=1\nGRAPHICS/1, PLANE, RM=5, XMIN=-2, XMAX=2, YMIN=-2, YMAX=2\n" + ball("0,0,0.199"));
  for (const double off : {1e-15, -1e-12, 1e-9, -1e-8, 1e-7, -1e-6}) {
    std::string text = stl_of_box(2, 2, 2);
    const std::string corner = "vertex 2 2 2\n";
    for (std::size_t at = text.find(corner); at != std::string::npos; at = text.find(corner, at + 1))
      text.replace(at, corner.size(), fmt::format("vertex 2 2 {:.17g}\n", 2 + off));
    write("lump.stl", text);
    SCOPED_TRACE(off);
    const auto found =
        values("MARKER/5, PART=1, QP=-1,-1,-2\nGRAPHICS/1, EXTERNAL, RM=5, FILE=lump.stl\n" + ball("0,0,0.199"));
    ASSERT_EQ(found.size(), flat.size());
    // The face itself is higher by half of it where the ball is.
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LE(std::abs(found[k] - flat[k]), (1e-9 + 1e3 * std::abs(off)) * std::abs(flat.back())) << k;
  }
}

TEST_F(ContactFacets, says_what_facets_nothing_can_touch) {
  write("lid.stl",
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        "endsolid\n");
  const auto file = [](const char* name) {
    return fmt::format("MARKER/5, PART=1, QP=-1,-1,-2\nGRAPHICS/1, EXTERNAL, RM=5, FILE={}\n", name);
  };
  expect_error(
      file("lid.stl") + ball("0,0,0.2"),
      "CONTACT/1 names GRAPHICS/1, an EXTERNAL whose facets do not bound a volume: in the axes of MARKER/5, the "
      "side from (0, 0, 0) to (1, 0, 0) belongs to one facet alone, which nothing can touch");
  expect_error(file("lid.x_t") + ball("0,0,0.2"),
               "CONTACT/1 names GRAPHICS/1, an EXTERNAL (GRAPHICS/1 is not drawn: lid.x_t has a format that is not "
               "read), which nothing can touch");
  expect_error(file("none.stl") + ball("0,0,0.2"), "none.stl cannot be read");
}

// A groove so flat that its bottom is in the ball: two walls less the bottom, 2 U(r − h cos β) − U(r − h) with U = k
// g²/2 for the height h of the centre. Across it the walls turn the force by as much as they incline, and the bottom
// follows.
TEST_F(ContactFacets, a_ball_in_a_flat_groove_is_held_by_both_walls_less_the_bottom) {
  constexpr double k = 1e5, m = 2, radius = 0.2, beta = 0.02;
  const double c = std::cos(beta), s = std::sin(beta);
  // 2 k c (r − h c) − k (r − h) = m g
  const double h = (2 * k * c * radius - k * radius - m * 10) / (2 * k * c * c - k);
  ASSERT_LT(h, radius);
  const auto v =
      values(groove(beta) + fmt::format("PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0,0,{:.17g}\nMARKER/2\nGRAPHICS/2, "
                                        "ELLIPSOID, CM=2, XSCALE=0.4, YSCALE=0.4, ZSCALE=0.4\nCONTACT/1, IGEOM=2, "
                                        "JGEOM=1, IMPACT, STIFFNESS=1E5, EXPONENT=1, DAMPING=0, DMAX=1\n",
                                        h));
  ASSERT_EQ(v.size(), 12u);
  // The bottom pulls with k (r − h), towards itself from wherever the centre is: (r − h)/h against coming back.
  std::vector<double> wanted{2 * k * s * s + k * (radius - h) / h, 2 * k * c * c - k};
  std::ranges::sort(wanted);
  for (std::size_t n = 0; n < 2; ++n) {
    const double expected = std::sqrt(wanted[n] / m) / (2 * std::numbers::pi);
    EXPECT_NEAR(std::abs(v[8 + 2 * n]), expected, 1e-7 * expected);
  }
}

}  // namespace dynalin::cases::contact_facets_test
