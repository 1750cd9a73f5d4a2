// CONTACT of curves in a plane against the same mechanics written with CURVE, implicit DIFFs and GFORCE, against closed
// forms, and against what must be conserved.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"
#include "cases/written_contacts.h"

namespace dynalin::cases::plane_contact_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using written_contacts::body;
using written_contacts::circle;
using written_contacts::friction;
using written_contacts::impact;
using written_contacts::place;
using written_contacts::rail;
using written_contacts::tread;

const std::string head = "Plane contact\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\n";
// A tread and a flange, matter above: from the left to the right.
const std::string profile =
    "MATRIX/2, FULL=RORDER, ROWS=6, COLUMNS=3\n"
    ", VALUES=-0.5,0.25,0, -0.3,0.03,0, -0.1,-0.02,0, 0.1,0.01,0, 0.3,0.06,0, 0.5,0.2,0\n"
    "CURVE/2, OPEN, MATRIX=2, CURVE_POINTS\n";
// Held in place softly.
const std::string held = "BUSHING/9, I=2, J=1, K=300,0,0, KT=0,0,20, C=3,0,0, CT=0,0,0.2, FORCE=40,0,0\n";

class PlaneContacts : public Cases {
 protected:
  std::vector<std::complex<double>> at_rest(const std::string& model) const {
    const RunResult r = run(model + "END\n", "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    auto v = r.status == 0 ? r.eigenvalues(1) : std::vector<std::complex<double>>{};
    std::sort(v.begin(), v.end(),
              [](auto a, auto b) { return std::pair(std::abs(a), a.imag()) < std::pair(std::abs(b), b.imag()); });
    return v;
  }
  static void expect_same(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b) {
    ASSERT_EQ(a.size(), b.size());
    ASSERT_FALSE(a.empty());
    const double size = std::abs(a.back());
    EXPECT_GT(size, 1);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LE(std::abs(a[k] - b[k]), 1e-9 * size) << a[k] << b[k];
  }
  std::string refused(const std::string& lines) const {
    const RunResult r = run(head + rail + body(0.1, 0.5) + lines + "\nEND\n", "LINEAR/EIGENSOL\n");
    EXPECT_NE(r.status, 0);
    return r.err;
  }
};

TEST_F(PlaneContacts, wheel_on_a_rail_is_the_force_of_its_expression) {
  const std::string model = head + rail + body(0.1, 0.5) + held, wheel = "GRAPHICS/2, CIRCLE, CM=2, RADIUS=0.5\n";
  for (const bool rubs : {false, true}) {
    const auto written = at_rest(model + place(2, circle, -1.5, -0.1, rubs));
    const std::string law = ", " + impact + (rubs ? "\n" + friction : "\n");
    expect_same(at_rest(model + wheel + "CONTACT/1, IGEOM=2, JGEOM=1" + law), written);
    expect_same(at_rest(model + wheel + "CONTACT/1, IGEOM=1, JGEOM=2" + law), written);
  }
}

TEST_F(PlaneContacts, wheel_profile_on_a_rail_is_the_force_of_its_expression) {
  const std::string model = head + rail + profile + body(0.1, 0.03) + held;
  const std::string contact = "MARKER/4, PART=2\nGRAPHICS/2, CURVE, CID=2, CRM=4\nCONTACT/1, IGEOM=2, JGEOM=1, ";
  expect_same(at_rest(model + contact + impact + "\n" + friction), at_rest(model + place(2, tread, -0.2, 0.0, true)));
}

TEST_F(PlaneContacts, point_on_a_curve_is_the_force_of_its_expression) {
  const std::string model = head + rail + body(0.1, 0.2) + held + "MARKER/4, PART=2, QP=0.05,-0.2,0\n";
  const std::array<std::string, 4> corner = {"0.05", "-0.2", "0", "0"};
  expect_same(at_rest(model + "GRAPHICS/2, POINT, RM=4\nCONTACT/1, IGEOM=2, JGEOM=1, " + impact + "\n" + friction),
              at_rest(model + place(2, corner, 0, -0.1, true, true)));
}

// Pressed on it ever more stiffly, a point is one that PTCV holds on the curve, and one mode more: what the curve bends
// under the load is the same.
TEST_F(PlaneContacts, stiff_point_on_a_curve_is_one_on_the_constraint) {
  const std::string model = head + rail + body(0.3, 0.0153) + held;
  const auto constrained = at_rest(model + "MARKER/8, PART=1, FLOATING\nPTCV/1, I=2, JFLOAT=8, CURVE=1, RM=1\n");
  const auto stiff = [&](double stiffness) {
    return at_rest(model + fmt::format("GRAPHICS/2, POINT, RM=2\nCONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS={}, "
                                       "EXPONENT=1, DAMPING=0, DMAX=1\n",
                                       stiffness));
  };
  ASSERT_EQ(constrained.size(), 4u);
  for (const auto& [stiffness, within] : {std::pair{1e9, 1e-6}, {1e12, 1e-9}}) {
    const auto pressed = stiff(stiffness);
    ASSERT_EQ(pressed.size(), 6u);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LE(std::abs(pressed[k] - constrained[k]), within * std::abs(constrained[k])) << pressed[k];
    const double bounce = std::sqrt(stiffness / 2) / (2 * std::numbers::pi);
    EXPECT_NEAR(std::abs(pressed[5]), bounce, 1e-6 * bounce);
  }
}

// A wheel wider than the valley: it stands on both sides.
TEST_F(PlaneContacts, wheel_between_two_slopes_is_the_force_of_both_places) {
  const std::string valley =
      "MATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=1,1.6,0, 0.5,0.4,0, 0,0,0, -0.5,0.4,0, -1,1.6,0\n"
      "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\nGRAPHICS/1, CURVE, CID=1, CRM=1\n";
  const std::string model = head + valley + body(0.01, 0.54) + "GRAPHICS/2, CIRCLE, CM=2, RADIUS=0.5\n";
  const auto written = at_rest(model + place(2, circle, -2.5, 0.38, true) + place(50, circle, -0.6, -0.38, true));
  expect_same(at_rest(model + "CONTACT/1, IGEOM=2, JGEOM=1, " + impact + "\n" + friction), written);
}

// Two corners of a box: up and down ω² = 2k/m, rocking ω² = (2 k b² − m g h)/J.
TEST_F(PlaneContacts, outline_of_a_box_stands_on_its_corners) {
  const auto values = at_rest(head + body(0, 0.29) +
                              "MARKER/21, PART=2, QP=-0.4,-0.3,0\nMARKER/22, PART=2, QP=0.4,-0.3,0\n"
                              "MARKER/23, PART=2, QP=0.4,0.3,0\nMARKER/24, PART=2, QP=-0.4,0.3,0\n"
                              "GRAPHICS/2, OUTLINE=21,22,23,24,21\n"
                              "MARKER/31, PART=1, QP=2,0,0\nMARKER/32, PART=1, QP=-2,0,0\nGRAPHICS/3, OUTLINE=31,32\n"
                              "CONTACT/1, IGEOM=2, JGEOM=3, IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=0, DMAX=1\n");
  ASSERT_EQ(values.size(), 6u);
  const double turn = 2 * std::numbers::pi;
  const double up = std::sqrt(2e4 / 2) / turn, rock = std::sqrt((2e4 * 0.16 - 20 * 0.3) / 0.15) / turn;
  EXPECT_NEAR(std::abs(values[2]), up, 1e-9 * up);
  EXPECT_NEAR(std::abs(values[5]), rock, 1e-9 * rock);
}

// The pendulum of the distance of both centres, as of a ball in space.
TEST_F(PlaneContacts, disc_in_a_bore_is_a_pendulum) {
  for (const std::string sides : {"IGEOM=2, JGEOM=3, JFLIP_NORMAL=3", "IGEOM=3, JGEOM=2, IFLIP_NORMAL=3"}) {
    SCOPED_TRACE(sides);
    // Without friction it is free to turn.
    const auto values = at_rest(head + body(0, -0.405) + "BUSHING/9, I=2, J=1, K=0,0,0, KT=0,0,1\n" +
                                "GRAPHICS/2, CIRCLE, CM=2, RADIUS=0.1\nGRAPHICS/3, CIRCLE, CM=1, RADIUS=0.5\n" +
                                "CONTACT/1, " + sides + ", IMPACT, STIFFNESS=2E4, EXPONENT=1.5, DAMPING=0, DMAX=1\n");
    ASSERT_EQ(values.size(), 6u);
    const double turn = 2 * std::numbers::pi;
    EXPECT_NEAR(std::abs(values[0]), std::sqrt(1 / 0.15) / turn, 1e-9);
    EXPECT_NEAR(std::abs(values[2]), std::sqrt(10 / 0.41) / turn, 1e-9);
    EXPECT_NEAR(std::abs(values[4]), std::sqrt(3000 / 2.0) / turn, 1e-8);
  }
}

TEST_F(PlaneContacts, what_cannot_touch_is_an_error_at_its_place) {
  const std::string wheel = "GRAPHICS/2, CIRCLE, CM=2, RADIUS=0.5\n", rest = ", " + impact;
  EXPECT_THAT(refused("GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=1, YSCALE=1, ZSCALE=1\nCONTACT/7, IGEOM=2, JGEOM=1" + rest),
              AllOf(HasSubstr("[contact-shape]"), HasSubstr("no curve"), HasSubstr("model.adm:14:27")));
  EXPECT_THAT(refused("MARKER/4, PART=2, REULER=0,90D,0\nGRAPHICS/2, CIRCLE, CM=4, RADIUS=1\n"
                      "CONTACT/7, IGEOM=2, JGEOM=1" +
                      rest),
              AllOf(HasSubstr("[contact-shape]"), HasSubstr("incline by 90 degrees")));
  EXPECT_THAT(refused("MARKER/4, PART=2, QP=1,0,0\nMARKER/5, PART=1, QP=1,0,0\nGRAPHICS/2, OUTLINE=2,4,5\n"
                      "CONTACT/7, IGEOM=2, JGEOM=1" +
                      rest),
              AllOf(HasSubstr("[contact-shape]"), HasSubstr("several bodies")));
  EXPECT_THAT(refused("MARKER/4, PART=2, QP=1,0,0\nMARKER/5, PART=2, QP=1,0,1\nGRAPHICS/2, OUTLINE=2,4,5\n"
                      "CONTACT/7, IGEOM=2, JGEOM=1" +
                      rest),
              AllOf(HasSubstr("[contact-shape]"), HasSubstr("leaves the plane")));
  EXPECT_THAT(refused(wheel +
                      "GRAPHICS/3, CIRCLE, CM=1, RADIUS=5\nCONTACT/7, IGEOM=2, JGEOM=3, IFLIP_GEOMETRY=2"
                      ", JFLIP_GEOMETRY=3" +
                      rest),
              HasSubstr("[contact-pair-not-built]"));
  // Tight in a bore it touches all around.
  EXPECT_THAT(refused("GRAPHICS/2, CIRCLE, CM=2, RADIUS=0.51\nMARKER/4, PART=1, QP=0.1,0.5,0\n"
                      "GRAPHICS/3, CIRCLE, CM=4, RADIUS=0.5\nCONTACT/7, IGEOM=2, JGEOM=3, JFLIP_GEOMETRY=3" +
                      rest),
              AllOf(HasSubstr("CONTACT/7"), HasSubstr("touch all around")));
}

BodyState after(const std::string& model, double end, double error = 1e-9) {
  const auto study = study_of(model + "END\n");
  library::SimulationRequest request;
  request.end = end, request.error = error;
  return study.simulate(request).point.state().bodies.at(0);
}

// A disc slides off the end of a track: from there on it falls freely.
TEST(PlaneContactsInTime, disc_falls_where_its_track_ends) {
  const double depth = 20 / 2e5, end = 0.5;
  const std::string model =
      head + fmt::format(
                 "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.15, QG=0,{:.17g},0, VX=1, VY=0, WZ=0\nMARKER/2\n"
                 "JOINT/1, PLANAR, I=2, J=1\nGRAPHICS/2, CIRCLE, CM=2, RADIUS=0.1\n"
                 "MARKER/31, PART=1, QP=0.2,0,0\nMARKER/32, PART=1, QP=-2,0,0\nGRAPHICS/3, OUTLINE=31,32\n"
                 "CONTACT/1, IGEOM=2, JGEOM=3, IMPACT, STIFFNESS=2E5, EXPONENT=1, DAMPING=0, DMAX=1\n",
                 0.1 - depth);
  const BodyState disc = after(model, end);
  EXPECT_NEAR(disc.position[0], end, 1e-9);
  EXPECT_NEAR(disc.position[1], 0.1 - depth - 5 * 0.3 * 0.3, 1e-6);
  EXPECT_NEAR(disc.velocity[1], -10 * 0.3, 1e-6);
}

// Without friction and damping a profile that rocks on a rail keeps what it has.
TEST(PlaneContactsInTime, curves_conserve_energy) {
  const std::string model = head + rail + profile +
                            "PART/2, MASS=2, CM=20, IP=0.1,0.1,0.15, QG=0.05,0.08,0, VX=0.3, VY=0, WZ=1.5\nMARKER/2\n"
                            "MARKER/20, QP=0,0.1,0\nJOINT/1, PLANAR, I=2, J=1\nGRAPHICS/2, CURVE, CID=2, CRM=2\n"
                            "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=2E4, EXPONENT=2, DAMPING=0, DMAX=1\n";
  // In flight, before and after several blows: no energy is in the contact.
  const auto energy = [](const BodyState& b) {
    const auto& v = b.centre_velocity;
    return v[0] * v[0] + v[1] * v[1] + 0.075 * b.angular_velocity[2] * b.angular_velocity[2] +
           20 * b.centre_position[1];
  };
  const double start = energy(after(model, 1e-6));
  std::vector<double> later;
  for (const double t : {0.2, 0.25, 0.3, 0.35, 0.4}) later.push_back(energy(after(model, t, 1e-10)));
  // Where they are apart they have all of it; pressed together, less.
  const double most = *std::max_element(later.begin(), later.end());
  EXPECT_NEAR(most, start, 1e-6 * std::abs(start));
}

TEST(PlaneContactsInTime, disc_bounces_with_the_coefficient_of_restitution) {
  for (const double r : {1.0, 0.6}) {
    const BodyState disc = after(
        fmt::format("Disc\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=2, IP=0.1,0.1,0.15\n"
                    ", QG=0,1.15,0, VY=-1\nMARKER/2\nGRAPHICS/2, CIRCLE, CM=2, RADIUS=0.15\nGRAPHICS/3, ARC, CM=1, "
                    "RADIUS=0.95, RANGLE=180D\n"
                    "CONTACT/1, IGEOM=2, JGEOM=3, POISSON, PENALTY=2E5, RESTITUTION_COEFFICIENT={}\n",
                    r),
        0.2, 1e-8);
    EXPECT_NEAR(disc.velocity[1], r, 2e-4) << r;
    EXPECT_NEAR(disc.velocity[0], 0, 1e-9);
  }
}

}  // namespace
}  // namespace dynalin::cases::plane_contact_test
