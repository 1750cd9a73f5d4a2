// CONTACT of cylinders, frusta, ellipsoids and rings with bodies of facets that are not convex, and in cavities of
// facets: a force at each volume in common.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/contacts.h"

namespace dynalin::cases::contact_solid_volumes_test {
namespace {

using namespace contacts;

using ::testing::HasSubstr;

constexpr double k = 1e4, m = 2, g = 10, depth = m * g / k;
const std::string elastic = "IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=0, DMAX=1\n";
// From z = −0.5 to 0, with an edge turned up far away, which makes it hollow there.
const std::string hollow_slab =
    "MARKER/5, PART=1, QP=0,2,0, REULER=0,90D,0\n" +
    extrusion(1, 5, "-2,-0.5,0, 2,-0.5,0, 2,0.5,0, 1.9,0.5,0, 1.9,0,0, -2,0,0, -2,-0.5,0", 7, 4);
std::string part(const std::string& pose, const std::string& shape) {
  return "PART/2, MASS=2, CM=2, IP=0.1,0.12,0.2, " + pose + "\nMARKER/2\nMARKER/3, PART=2, QP=0,0,-0.3\n" + shape;
}
const std::string egg = "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.8, YSCALE=0.6, ZSCALE=0.5\n",
                  drum = "GRAPHICS/2, CYLINDER, CM=3, LENGTH=0.6, RADIUS=0.2\n",
                  tub = "GRAPHICS/2, FRUSTUM, CM=3, LENGTH=0.6, BOTTOM=0.2, TOP=0.3\n",
                  ring = "GRAPHICS/2, TORUS, CM=3, MAJOR_RADIUS=0.3, MINOR_RADIUS=0.1\n";
std::string contact(const std::string& laws, bool exchanged = false, const std::string& flip = "") {
  return std::string("CONTACT/1, ") + (exchanged ? "IGEOM=1, JGEOM=2, " : "IGEOM=2, JGEOM=1, ") + flip + laws;
}
double cycles(double square) { return std::sqrt(square) / (2 * std::numbers::pi); }

class ContactSolidVolumes : public ContactCases {
 protected:
  // Of what rests on the slab and slides and spins on it: as it rocks about x and y, and up and down. [rate²]
  void expect_rests(const std::string& pose, const std::string& shape, double about_x, double about_y,
                    double up = k / m) {
    for (const bool exchanged : {false, true}) {
      const auto v = values(hollow_slab + part(pose, shape) + contact(elastic, exchanged), "SIMULATE/STATICS\n");
      ASSERT_EQ(v.size(), 12u);
      std::vector<double> wanted{cycles(up), cycles(about_x), cycles(about_y)};
      std::ranges::sort(wanted);
      for (std::size_t n = 0; n < 6; ++n) EXPECT_LE(std::abs(v[n]), 1e-4) << n;
      for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(std::abs(v[7 + 2 * n]), wanted[n], 1e-6) << n;
    }
  }
};

}  // namespace

// As it rocks the centroid of what it has in common with the slab moves by k r²/4 over its weight, and that falls.
TEST_F(ContactSolidVolumes, a_drum_stands_on_its_end) {
  constexpr double r = 0.2, height = 0.3 - depth / 2, rights = k * r * r / 4 - m * g * height;
  expect_rests("QG=0.1,0.3,0.2981", drum, rights / 0.1, rights / 0.12);
}

// About its middle that rights it by w L²/12 over the area of the segment w wide; the ends move as what is above the
// centroid does. It rolls.
TEST_F(ContactSolidVolumes, a_drum_lies_on_its_mantle) {
  constexpr double r = 0.2, length = 0.6;
  const double half = std::acos(1 - depth / r), w = 2 * r * std::sin(half),
               area = r * r * (half - std::sin(half) * std::cos(half)), above = w * w * w / 12 / area;
  // Where it is drawn at rest it stays, though a push next to none would roll it away, and from above it comes there.
  for (const std::string at : {"0.198", "0.1981"}) {
    SCOPED_TRACE(at);
    const auto v = values(hollow_slab + part("QG=0.1,0.3," + at + ", REULER=90D,90D,0", drum) + contact(elastic),
                          "SIMULATE/STATICS\n");
    ASSERT_EQ(v.size(), 12u);
    for (std::size_t n = 0; n < 8; ++n) EXPECT_LE(std::abs(v[n]), 1e-4) << n;
    // It lies along x, its own z; it rocks about y, its own x or −x.
    EXPECT_NEAR(std::abs(v[9]), cycles(m * g * (w * length * length / 12 / area - above) / 0.1), 1e-5);
    EXPECT_NEAR(std::abs(v[11]), cycles(k / m), 1e-6);
  }
}

// The centroid of a cap is on the way from the middle to the deepest place, ¾ (2 − h)²/(3 − h) of it, with h the share
// of the semi-axis that is below.
TEST_F(ContactSolidVolumes, an_ellipsoid_stands_on_its_shortest_axis) {
  constexpr double a = 0.4, b = 0.25, c = 0.3, h = depth / b, share = 0.75 * (2 - h) * (2 - h) / (3 - h);
  const auto rights = [&](double across) { return m * g * (across * across - b * b) / b * share; };
  expect_rests("QG=0.1,0.3,0.2481", egg, rights(c) / 0.1, rights(a) / 0.12);
}

// Of a ring that lies flat, d deep, by integrals of its sections, rings between R − q and R + q at each height: the
// depth that the mean thickness and the centroid of the trough say. It rights itself by the metacentre: the footprint's
// second moment of area by the volume, above the centroid.
TEST_F(ContactSolidVolumes, a_ring_lies_flat) {
  constexpr double R = 0.3, r = 0.1, pi = std::numbers::pi;
  struct Trough {
    double volume, centroid, gap, second;
  };
  const auto trough = [&](double d) {
    const double z = r - d, q = std::sqrt(r * r - z * z), angle = std::acos(z / r);
    // ∫ 4 π R q dz and ∫ 4 π R q (height − z) dz from z to r
    const double volume = 2 * pi * R * (r * r * angle - z * q), first = 4 * pi * R * q * q * q / 3 - z * volume;
    const double up = first / volume, mean = volume / (4 * pi * R * q), down = mean - up;
    const double gap = up > down ? mean * up / down : mean * down / up;
    return Trough{volume, up, gap, pi / 4 * (std::pow(R + q, 4) - std::pow(R - q, 4))};
  };
  double low = 0.5 * depth, high = 2 * depth;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (trough(middle).gap < depth ? low : high) = middle;
  }
  const Trough t = trough(low);
  const double stiffness = k * (trough(low + 1e-7).gap - trough(low - 1e-7).gap) / 2e-7;
  EXPECT_NEAR(low, depth, 0.02 * depth);
  const double rights = m * g * (t.second / t.volume - (0.4 - low + t.centroid));
  expect_rests("QG=0.1,0.3,0.3981", ring, rights / 0.1, rights / 0.12, stiffness / m);
}

// A shackle on the arm of a bracket, whose upper edges it meets on its inner side: stiff as they are its middle stays
// where it is, and it swings about that.
TEST_F(ContactSolidVolumes, a_ring_hangs_on_the_arm_of_a_bracket) {
  constexpr double inner = 0.4, half = 0.1, hangs = 0.15, about_axis = 0.1;
  const double below = std::sqrt(inner * inner - half * half);
  const std::string bracket =
      "MARKER/5, PART=1, QP=0,0.1,0, REULER=0,90D,0\n" +
      extrusion(1, 5, "-1,-2,0, -0.8,-2,0, -0.8,-0.2,0, 1,-0.2,0, 1,0,0, -1,0,0, -1,-2,0", 7, 2 * half);
  const std::string shackle =
      fmt::format("PART/2, MASS=2, CM=2, IP={},0.12,0.2, QG=0.3,0,{:.17g}\nMARKER/2\n", about_axis, -below - hangs) +
      fmt::format("MARKER/3, PART=2, QP=0,0,{}, REULER=90D,90D,0\nMARKER/6, PART=1, QP=0.3,0,0, REULER=90D,90D,0\n",
                  hangs) +
      "GRAPHICS/2, TORUS, CM=3, MAJOR_RADIUS=0.5, MINOR_RADIUS=0.1\nJOINT/1, PLANAR, I=3, J=6\n";
  for (const bool exchanged : {false, true}) {
    const auto v =
        values(bracket + shackle + contact("IMPACT, STIFFNESS=1E7, EXPONENT=1, DAMPING=0, DMAX=1\n", exchanged),
               "SIMULATE/STATICS\n");
    ASSERT_EQ(v.size(), 6u);
    const double swings = cycles(m * g * hangs / (about_axis + m * hangs * hangs));
    EXPECT_NEAR(std::abs(v[0]), swings, 1e-3 * swings);
    EXPECT_NEAR(v[0].real(), 0, 1e-6);
    EXPECT_GT(std::abs(v[2]), 20 * swings);
  }
}

// Leaning, moving, rubbing, over an edge.
TEST_F(ContactSolidVolumes, are_the_same_from_either_side) {
  const std::string start = "Contact\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (const std::string& shape : {egg, drum, tub, ring}) {
    for (const char* pose : {"QG=0.1,0.2,0.22, REULER=20D,80D,30D, VX=0.02, WY=0.1", "QG=2,0.2,0.19, REULER=10D,88D,0",
                             "QG=1.75,0.2,0.22, REULER=0,70D,20D, VY=0.1"}) {
      SCOPED_TRACE(shape + pose);
      const std::string model = hollow_slab + part(pose, shape);
      expect_same(values(model + contact(rubs + law), "", start), values(model + contact(rubs + law, true), "", start),
                  1e-8);
    }
  }
}

TEST_F(ContactSolidVolumes, lean_in_a_cavity_of_facets) {
  const std::string room =
      "MARKER/5, PART=1, QP=-1,-1,-1\n" + extrusion(1, 5, "0,0,0, 2,0,0, 2,2,0, 0,2,0, 0,0,0", 5, 2);
  for (const std::string& shape : {drum, egg, ring}) {
    const double reach = shape == drum ? 0.2 : 0.4;
    const auto v = values(room + part(fmt::format("QG={:.17g},0,0", 1.001 - reach), shape) +
                              "JPRIM/1, ORIENTATION, I=2, J=1\n" + contact(elastic, false, "JFLIP_GEOMETRY=1, "),
                          "", "Contact\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n");
    ASSERT_EQ(v.size(), 6u);
    EXPECT_NEAR(std::abs(v.back()), cycles(k / m), 1e-7);
  }
}

TEST_F(ContactSolidVolumes, without_a_direction_are_named) {
  const std::string bridge = "MARKER/5, PART=1, QP=-0.5,0.2,-0.25, REULER=0,90D,0\n" +
                             extrusion(1, 5,
                                       "0,0,0, 0.2,0,0, 0.2,0.3,0, 0.8,0.3,0, 0.8,0,0, 1,0,0, 1,0.5,0, 0,0.5,0, "
                                       "0,0,0",
                                       9, 0.4);
  const auto run_with = [&](const std::string& shape) {
    return run(head + bridge + part("QG=0.4,0,-0.05", shape) + contact(elastic) + "END\n", "LINEAR/EIGENSOL\n");
  };
  const RunResult through = run_with("GRAPHICS/2, CYLINDER, CM=3, LENGTH=1.2, RADIUS=0.02\n"),
                  crumb = run_with("GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.02, YSCALE=0.03, ZSCALE=0.02\n");
  EXPECT_NE(through.status, 0);
  EXPECT_THAT(through.err, HasSubstr("CONTACT/1 touch all around or in more places than can be told apart"));
  EXPECT_NE(crumb.status, 0);
}

}  // namespace dynalin::cases::contact_solid_volumes_test
