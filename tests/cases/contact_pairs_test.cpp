// CONTACT of rings, rollers and eggs with solids and in cavities: closed forms, and pairs that must be the same.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::contact_pairs_test {
namespace {

const std::string head = "Contact\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\n";
const std::string law = "IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=0, DMAX=1\n";
constexpr double stiffness = 1e4, gravity = 10;
// z leads along +y.
const std::string level = "REULER=180D,90D,0";

class ContactPairs : public Cases {
 protected:
  std::vector<std::complex<double>> where_it_starts(const std::string& model) const {
    const RunResult r = run(head + model + "END\n", "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0) return {};
    auto v = r.eigenvalues(0);
    std::ranges::sort(
        v, [](auto a, auto b) { return std::pair(std::abs(a), a.imag()) < std::pair(std::abs(b), b.imag()); });
    return v;
  }
  static void expect_frequency(const std::vector<std::complex<double>>& all, double square) {
    const double wanted = std::sqrt(square) / (2 * std::numbers::pi);
    double nearest = 1e300;
    for (const auto& v : all) nearest = std::min(nearest, std::abs(v - std::complex<double>(0, wanted)));
    EXPECT_LT(nearest, 1e-7 * wanted) << wanted;
  }
  static void expect_same(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b) {
    ASSERT_EQ(a.size(), b.size());
    ASSERT_FALSE(a.empty());
    EXPECT_GT(std::abs(a.back()), 1);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LE(std::abs(a[k] - b[k]), 1e-9 * std::abs(a.back())) << k;
  }
};

}  // namespace

// A roller at the bottom of a level bore touches it at its lowest points of both rims. Without friction its centre
// swings about the axis of the bore, √(g/ρ), on the circle of ρ, the difference of the radii and the penetration.
TEST_F(ContactPairs, a_roller_in_a_bore_swings_about_its_axis) {
  const auto values = where_it_starts("MARKER/9, PART=1, QP=0,-0.5,0.5, " + level +
                                      "\nGRAPHICS/9, CYLINDER, CM=9, LENGTH=1, RADIUS=0.5\n"
                                      "PART/2, MASS=2, CM=2, IP=0.1,0.02,0.1, QG=0,0,0.099\nMARKER/2\n"
                                      "MARKER/3, PART=2, QP=0,-0.3,0, " +
                                      level +
                                      "\nGRAPHICS/2, CYLINDER, CM=3, LENGTH=0.6, RADIUS=0.1\n"
                                      "CONTACT/1, IGEOM=2, JGEOM=9, JFLIP_GEOMETRY=9, " +
                                      law);
  const double depth = 2 * gravity / (2 * stiffness);
  expect_frequency(values, gravity / (0.5 - 0.1 + depth));
  expect_frequency(values, 2 * stiffness / 2);
}

// A ring that hangs on a peg: its centre swings as far below the axis of the peg as its circle is above it.
TEST_F(ContactPairs, a_ring_on_a_peg_swings_below_it) {
  const auto values = where_it_starts(
      "MARKER/9, PART=1, QP=0,-0.4,0, " + level +
      "\nGRAPHICS/9, CYLINDER, CM=9, LENGTH=0.8, RADIUS=0.06\n"
      "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.2, QG=0,0,-0.192, " +
      level + "\nMARKER/2\nGRAPHICS/2, TORUS, CM=2, MAJOR_RADIUS=0.3, MINOR_RADIUS=0.05\n" +
      // Upright, and where it is along the peg.
      "MARKER/8, PART=1, " + level + "\nJOINT/1, PLANAR, I=2, J=8\n" + "CONTACT/1, IGEOM=2, JGEOM=9, " + law);
  const double depth = 2 * gravity / stiffness;
  expect_frequency(values, gravity / (0.3 - (0.06 + 0.05 - depth)));
  expect_frequency(values, stiffness / 2);
}

// On the middle of a face of a box all is as on a plane there.
TEST_F(ContactPairs, on_a_face_is_on_a_plane) {
  const std::string plane = "MARKER/5, PART=1\nGRAPHICS/1, PLANE, RM=5, XMIN=-2, XMAX=2, YMIN=-2, YMAX=2\n",
                    box = "MARKER/5, PART=1, QP=-2,-2,-3\nGRAPHICS/1, BOX, CORNER=5, X=4, Y=4, Z=3\n",
                    drum = "MARKER/5, PART=1, QP=0,0,-3\nGRAPHICS/1, CYLINDER, CM=5, LENGTH=3, RADIUS=2\n",
                    hall = "MARKER/5, PART=1, QP=-2,-2,0\nGRAPHICS/1, BOX, CORNER=5, X=4, Y=4, Z=3\n",
                    silo = "MARKER/5, PART=1\nGRAPHICS/1, FRUSTUM, CM=5, LENGTH=3, BOTTOM=2, TOP=1\n";
  const std::string rubs =
      "COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.1, STICTION_TRANSITION_VELOCITY=0.1, "
      "FRICTION_TRANSITION_VELOCITY=1, ";
  struct Solid {
    const char* name;
    std::string part;
    bool on_solids;  // a box stands on boxes with places of its own, a roller on none
  };
  const std::vector<Solid> solids = {
      {"egg",
       "QG=0.1,0.2,0.299, REULER=0,15D,0\nMARKER/2\nGRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.8, YSCALE=1, ZSCALE=0.6\n",
       true},
      {"wheel",
       "QG=0.1,0.2,0.349, REULER=180D,75D,0\nMARKER/2\nGRAPHICS/2, TORUS, CM=2, MAJOR_RADIUS=0.3, "
       "MINOR_RADIUS=0.06\n",
       true},
      {"roller",
       "QG=0.1,0.2,0.099, REULER=180D,92D,0\nMARKER/2\nMARKER/3, PART=2, QP=0,0,-0.3\nGRAPHICS/2, CYLINDER, "
       "CM=3, LENGTH=0.6, RADIUS=0.1\n",
       false},
      {"crate",
       "QG=0.1,0.2,0.24, REULER=10D,3D,20D\nMARKER/2\nMARKER/3, PART=2, QP=-0.4,-0.3,-0.25\nGRAPHICS/2, BOX, "
       "CORNER=3, X=0.8, Y=0.6, Z=0.5\n",
       false}};
  for (const Solid& s : solids) {
    const std::string part = "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, VX=0.02, WY=0.1, " + s.part;
    const auto with = [&](const std::string& ground, const std::string& flip) {
      return where_it_starts(ground + part + "CONTACT/1, IGEOM=2, JGEOM=1, " + flip + rubs + law);
    };
    const auto on_plane = with(plane, "");
    SCOPED_TRACE(s.name);
    if (s.on_solids) {
      expect_same(on_plane, with(box, ""));
      expect_same(on_plane, with(drum, ""));
    }
    expect_same(on_plane, with(hall, "JFLIP_GEOMETRY=1, "));
    expect_same(on_plane, with(silo, "JFLIP_GEOMETRY=1, "));
  }
}

// An egg of three equal axes but for a billionth is a ball, at faces, edges and corners.
TEST_F(ContactPairs, an_egg_that_is_nearly_round_is_a_ball) {
  const auto values = [&](const std::string& solid, const std::string& at, double more) {
    return where_it_starts(
        "MARKER/5, PART=1, QP=-1,-1,-1\n" + solid + "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, QG=" + at +
        fmt::format("\nMARKER/2\nGRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.4, YSCALE=0.4, ZSCALE={:.17g}\n", 0.4 + more) +
        "CONTACT/1, IGEOM=2, JGEOM=1, " + law);
  };
  const std::string box = "GRAPHICS/1, BOX, CORNER=5, X=2, Y=2, Z=2\n",
                    cone = "GRAPHICS/1, FRUSTUM, CM=5, LENGTH=2, BOTTOM=1, TOP=0.4\n";
  // Across a face, an edge, a corner; across the upper face, the mantle and the upper rim.
  for (const auto& [solid, at] : {std::pair{box, "0.3,0.2,1.19"},
                                  {box, "0.2,1.13,1.14"},
                                  {box, "1.11,1.1,1.12"},
                                  {cone, "-1.1,-0.9,1.19"},
                                  {cone, "-0.2,-1.4,0"},
                                  {cone, "-0.5,-1,1.16"}}) {
    SCOPED_TRACE(at);
    const auto ball = values(solid, at, 0), egg = values(solid, at, 1e-10);
    ASSERT_EQ(ball.size(), egg.size());
    EXPECT_GT(std::abs(ball.back()), 1);
    for (std::size_t k = ball.size() - 2; k < ball.size(); ++k)
      EXPECT_LT(std::abs(ball[k] - egg[k]), 1e-7 * std::abs(ball[k])) << k;
  }
}

}  // namespace dynalin::cases::contact_pairs_test
