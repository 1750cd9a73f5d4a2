// CONTACT against the same force written as an expression, against closed forms, and against what must be conserved.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"
#include "cases/written_contacts.h"

namespace dynalin::cases::contact_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using written_contacts::ball_in_cone;
using written_contacts::ball_on_plane;
using written_contacts::friction;
using written_contacts::impact;

const std::string head = "Contact\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\n";
const std::string ball =
    "PART/2, MASS=2, CM=2, IP=0.008,0.008,0.008, QG=0.1,0.05,{}\nMARKER/2\n"
    "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n";
const std::string floor = "GRAPHICS/1, PLANE, RM=1, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\n";

class Contacts : public Cases {
 protected:
  std::vector<std::complex<double>> at_rest(const std::string& model) const {
    const RunResult r = run(model + "END\n", "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? sorted(r.eigenvalues(1)) : std::vector<std::complex<double>>{};
  }
  std::vector<std::complex<double>> where_it_starts(const std::string& model) const {
    const RunResult r = run(model + "END\n", "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? sorted(r.eigenvalues(0)) : std::vector<std::complex<double>>{};
  }
  static std::vector<std::complex<double>> sorted(std::vector<std::complex<double>> v) {
    std::sort(v.begin(), v.end(),
              [](auto a, auto b) { return std::pair(std::abs(a), a.imag()) < std::pair(std::abs(b), b.imag()); });
    return v;
  }
  static void expect_same(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b) {
    ASSERT_EQ(a.size(), b.size());
    ASSERT_FALSE(a.empty());
    const double size = std::abs(a.back());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LE(std::abs(a[k] - b[k]), 1e-9 * size) << a[k] << b[k];
  }
  std::string refused(const std::string& lines) const {
    const RunResult r =
        run(head + floor + fmt::format(fmt::runtime(ball), 0.15) + lines + "\nEND\n", "LINEAR/EIGENSOL\n");
    EXPECT_NE(r.status, 0);
    return r.err;
  }
};

// On a slope: friction by slip holds nothing at rest, and the refusal says so.
TEST_F(Contacts, that_only_rub_hold_nothing_at_rest) {
  const std::string slope = "GRAPHICS/1, PLANE, RM=3, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\nMARKER/3, REULER=0,10D,0\n";
  const std::string block =
      "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0,0,0.1, REULER=0,10D,0\nMARKER/2\nMARKER/4, QP=-0.1,-0.1,-0.1\n"
      "GRAPHICS/2, BOX, CORNER=4, X=0.2, Y=0.2, Z=0.2\n";
  for (const auto& [when, says] :
       {std::pair{"ON", "friction of CONTACT/1 goes by the speed of slip and holds nothing at rest"},
        std::pair{"DYNAMICS_ONLY", "friction of CONTACT/1 is left out of statics by DYNAMICS_ONLY"}}) {
    const RunResult r =
        run(head + slope + block +
                "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=2E4, EXPONENT=1, DAMPING=40, DMAX=0.001, " +
                "COULOMB_FRICTION=" + when +
                ", MU_STATIC=0.6, MU_DYNAMIC=0.5, STICTION_TRANSITION_VELOCITY=0.01, "
                "FRICTION_TRANSITION_VELOCITY=0.02\nEND\n",
            "SIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 2);
    EXPECT_THAT(r.err, AllOf(HasSubstr("no equilibrium was found"), HasSubstr(says)));
  }
}

// A sphere on a plane with friction: the same wrench as a GFORCE at its centre, the friction at half the penetration.
TEST_F(Contacts, sphere_on_plane_is_the_force_of_its_expression) {
  const std::string model = head + floor + fmt::format(fmt::runtime(ball), 0.15);
  const std::string law = ", " + impact + friction;
  expect_same(at_rest(model + "CONTACT/1, IGEOM=2, JGEOM=1" + law), at_rest(model + ball_on_plane()));
  expect_same(at_rest(model + "CONTACT/1, IGEOM=1, JGEOM=2" + law), at_rest(model + ball_on_plane()));
}

// Beyond the stiction velocity the coefficient falls by STEP from the static to the dynamic one.
TEST_F(Contacts, friction_of_a_sliding_sphere_is_the_force_of_its_expression) {
  for (const double speed : {0.4, 0.7, 3.0}) {
    const std::string model = head + floor +
                              fmt::format(
                                  "PART/2, MASS=2, CM=2, IP=0.008,0.008,0.008, QG=0.1,0.05,0.099, VX={0}, "
                                  "VY={1}, VZ=-0.01\nMARKER/2\n"
                                  "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n",
                                  speed * 0.8, speed * 0.6);
    expect_same(where_it_starts(model + "CONTACT/1, IGEOM=2, JGEOM=1, " + impact + friction),
                where_it_starts(model + ball_on_plane()));
  }
}

// A ball in a cone: the same as a force between the ball and a point that slides along the axis. Where that lies level
// it rests on the lowest line, where it stands upright it runs around.
TEST_F(Contacts, sphere_in_a_cone_is_the_force_of_its_distance) {
  const std::string contact = "CONTACT/1, IGEOM=2, JGEOM=9, JFLIP_GEOMETRY=9, " + impact + "\n",
                    // The contact without friction leaves it to turn.
      turned = "BUSHING/9, I=2, J=9, K=0,0,0, KT=1,2,3, C=0,0,0, CT=0,0,0\n";
  const std::string level = head + fmt::format(fmt::runtime(ball), -0.3) + turned +
                            "MARKER/9, PART=1, QP=-1,0,0, REULER=90D,90D,0\n"
                            "GRAPHICS/9, FRUSTUM, CM=9, LENGTH=3, BOTTOM=0.4, TOP=0.6\n"
                            // Held along the axis, which it would roll down.
                            "MARKER/4, PART=2\nJPRIM/1, INPLANE, I=4, J=9\n";
  expect_same(at_rest(level + contact), at_rest(level + ball_in_cone(0.4, 0.2 / 3)));
  const std::string upright = head +
                              "PART/2, MASS=2, CM=2, IP=0.008,0.008,0.008, QG=0.6,0,0.45, VY=2, VZ=0.1\nMARKER/2\n"
                              "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n" +
                              turned + "MARKER/9, PART=1\nGRAPHICS/9, FRUSTUM, CM=9, LENGTH=1, BOTTOM=0.1, TOP=1.6\n";
  expect_same(where_it_starts(upright + contact), where_it_starts(upright + ball_in_cone(0.1, 1.5)));
}

// A cylinder that lies on a plane and rocks on its rims: two forces at the lowest points.
TEST_F(Contacts, cylinder_on_plane_rolls_and_rocks) {
  const std::string model = head + floor +
                            "PART/2, MASS=2, CM=2, IP=0.1,0.02,0.1, QG=0,0,0.12\nMARKER/2\n"
                            "MARKER/3, PART=2, QP=0,-0.3,0, REULER=180D,90D,0\n"
                            "GRAPHICS/2, CYLINDER, CM=3, LENGTH=0.6, RADIUS=0.1\n"
                            "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=0, DMAX=1\n";
  const auto values = at_rest(model);
  ASSERT_EQ(values.size(), 12u);
  const double up = std::sqrt(2e4 / 2) / (2 * std::numbers::pi);
  // Tilted by t, both rims lie r cos t ± 0.3 sin t about the centre: 2·10⁴ · 0.3² t − N r t.
  const double rock = std::sqrt((2e4 * 0.09 - 20 * 0.1) / 0.1) / (2 * std::numbers::pi);
  EXPECT_NEAR(std::abs(values[9]), std::min(up, rock), 1e-9 * up);
  EXPECT_NEAR(std::abs(values[11]), std::max(up, rock), 1e-9 * up);
  EXPECT_NEAR(std::abs(values[7]), 0, 1e-6);
}

// POISSON: a bounce leaves r of the speed, and a ball without loss comes back to where it fell from.
TEST(ContactsInTime, ball_bounces_with_the_coefficient_of_restitution) {
  for (const double r : {1.0, 0.8, 0.3}) {
    const auto study = study_of(fmt::format(
        fmt::runtime("Ball\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + floor +
                     "PART/2, MASS=2, CM=2, IP=0.008,0.008,0.008, QG=0,0,0.15, VZ=-1\nMARKER/2\n"
                     "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n"
                     "CONTACT/1, IGEOM=2, JGEOM=1, POISSON, PENALTY=2E5, RESTITUTION_COEFFICIENT={}\nEND\n"),
        r));
    library::SimulationRequest request;
    request.end = 0.2;
    request.error = 1e-8;
    const BodyState ball_state = study.simulate(request).point.state().bodies.at(0);
    EXPECT_NEAR(ball_state.velocity[2], r, 2e-4) << r;
    EXPECT_NEAR(ball_state.velocity[0], 0, 1e-9);
  }
}

// The ratio of damping z that leaves r of the speed: 2 z arccos z = −√(1 − z²) ln r, here where z is next to 1 and the
// pair about to become two real values, which is where what is left of 1 − z decides.
TEST_F(Contacts, poisson_next_to_critical_damping_keeps_its_digits) {
  const auto values = [&](double r) {
    return run(fmt::format(
                   "Ball\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\nGRAPHICS/1, PLANE, RM=1, "
                   "XMIN=-5, XMAX=5, YMIN=-5, YMAX=5\nPART/2, MASS=2, CM=20, IP=.008,.008,.008, QG=0,0,.099\n"
                   "MARKER/20\nGRAPHICS/2, ELLIPSOID, CM=20, XSCALE=.2, YSCALE=.2, ZSCALE=.2\nCONTACT/1, IGEOM=2, "
                   "JGEOM=1, POISSON, PENALTY=2E4, RESTITUTION_COEFFICIENT={:.17g}\nEND\n",
                   r),
               "LINEAR/EIGENSOL\n")
        .eigenvalues(0);
  };
  const auto highest = [](const std::vector<std::complex<double>>& all) {
    return *std::ranges::max_element(all, {}, [](const auto& v) { return v.imag(); });
  };
  constexpr double pi = std::numbers::pi;
  // By mpmath in 40 digits.
  const double rest = 3.972138406920132e-6, z = 1 - rest;
  const std::complex<double> pair = 2 * pi * highest(values(0.135336));
  EXPECT_NEAR(pair.imag(), 100 * std::sqrt(rest * (1 + z)), 1e-9);
  EXPECT_NEAR(pair.real(), -100 * z, 1e-9);
  // Of e⁻² they are equal, as far as numbers can say so.
  EXPECT_LT(2 * pi * highest(values(std::exp(-2))).imag(), 1e-5);
}

TEST_F(Contacts, one_that_is_just_touching_is_named) {
  const std::string model =
      head + floor + fmt::format(fmt::runtime(ball), 0.1) + "CONTACT/7, IGEOM=2, JGEOM=1, " + impact + "\nEND\n";
  const RunResult r = run(model, "LINEAR/EIGENSOL\n");
  EXPECT_THAT(r.err, AllOf(HasSubstr("CONTACT/7 is just touching"), HasSubstr("[touching-contact]")));
  const RunResult settled = run(model, "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  EXPECT_THAT(settled.err, Not(HasSubstr("touching-contact")));
}

// Over an edge of a box, and over the rim of a cylinder, the surface is flat on one side and bent on the other.
TEST_F(Contacts, one_where_a_face_ends_is_named) {
  for (const char* shape : {"MARKER/3, PART=1, QP=-1,-1,-1\nGRAPHICS/3, BOX, CORNER=3, X=1.1, Y=2, Z=1\n",
                            "MARKER/3, PART=1, QP=-0.9,0.05,-1\nGRAPHICS/3, CYLINDER, CM=3, LENGTH=1, RADIUS=1\n"}) {
    const auto said = [&](double off) {
      return run(head + shape +
                     fmt::format("PART/2, MASS=2, CM=2, IP=0.008,0.008,0.008, QG={},0.05,0.099\nMARKER/2\n"
                                 "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n"
                                 "CONTACT/7, IGEOM=2, JGEOM=3, {}\nEND\n",
                                 0.1 + off, impact),
                 "LINEAR/EIGENSOL\n")
          .err;
    };
    EXPECT_THAT(said(0), HasSubstr("CONTACT/7 is just where a face ends in an edge")) << shape;
    EXPECT_THAT(said(1e-6), Not(HasSubstr("touching-contact"))) << shape;
    EXPECT_THAT(said(-1e-6), Not(HasSubstr("touching-contact"))) << shape;
  }
}

TEST_F(Contacts, goes_when_it_is_deactivated) {
  const RunResult r =
      run(head + floor + fmt::format(fmt::runtime(ball), 0.0995) + "CONTACT/7, IGEOM=2, JGEOM=1, " + impact + "\nEND\n",
          "LINEAR/EIGENSOL\nDEACTIVATE/CONTACT, ID=7\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_GT(std::abs(sorted(r.eigenvalues(0)).back()), 1);
  EXPECT_EQ(std::abs(sorted(r.eigenvalues(2)).back()), 0);
}

// A roller lies on a table of finite size as on the plane of its top.
TEST_F(Contacts, roller_on_a_box_is_one_on_a_plane) {
  const auto model = [&](const std::string& below) {
    return head + below +
           "PART/2, MASS=2, CM=2, IP=0.11,0.01,0.12, QG=0.1,0.05,0.0898\nMARKER/2\nMARKER/3, QP=0,-0.5,0.01, "
           "REULER=0,-90D,0\nGRAPHICS/2, CYLINDER, CM=3, LENGTH=1, RADIUS=0.1\n"
           "CONTACT/7, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=2E4, EXPONENT=1, DAMPING=30, DMAX=0.0001\n";
  };
  const std::string table = "MARKER/4, QP=-2,-3,-1\nGRAPHICS/1, BOX, CORNER=4, X=4, Y=6, Z=1\n";
  expect_same(at_rest(model(table)), at_rest(model(floor)));
  EXPECT_GT(std::abs(at_rest(model(table)).back()), 20);
}

// Two bars across each other: one place, as the springs of their common perpendicular say.
TEST_F(Contacts, crossed_cylinders_press_with_one_force) {
  const std::string model =
      head +
      "MARKER/4, QP=0,-1,0, REULER=0,-90D,0\nGRAPHICS/1, CYLINDER, CM=4, LENGTH=2, RADIUS=0.3\n"
      "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0,0,0.495\nMARKER/2\nMARKER/3, QP=-0.5,0,0, REULER=90D,90D,0\n"
      "GRAPHICS/2, CYLINDER, CM=3, LENGTH=1, RADIUS=0.2\nMARKER/5\nJOINT/1, TRANSLATIONAL, I=2, J=1\n"
      "CONTACT/7, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=2E4, EXPONENT=1.5, DAMPING=0, DMAX=0.0001\n";
  // 2e4 g^1.5 = 20 at g = 0.01, where the stiffness is 1.5 · 20/0.01 = 3000.
  const auto values = at_rest(model);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(std::abs(values[1].imag()), std::sqrt(3000 / 2.0) / (2 * std::numbers::pi), 1e-8);
}

TEST_F(Contacts, what_cannot_touch_is_an_error_at_its_place) {
  const auto with = [&](const std::string& geometry) { return refused("CONTACT/7, " + geometry + ", " + impact); };
  EXPECT_THAT(with("IGEOM=2, JGEOM=5"), AllOf(HasSubstr("[unknown-element]"), HasSubstr("model.adm:10:27")));
  EXPECT_THAT(with("IGEOM=2, JGEOM=2"), HasSubstr("[same-body]"));
  EXPECT_THAT(with("IGEOM=1, JGEOM=1"), HasSubstr("[same-body]"));  // whether planes could touch is no question
  EXPECT_THAT(with("IGEOM=2, 1, JGEOM=1"), HasSubstr("[foreign-marker]"));
  EXPECT_THAT(with("IGEOM=2, JGEOM=3\nGRAPHICS/3, CIRCLE, CM=1, RADIUS=1\n!"), AllOf(HasSubstr("[missing-variant]")));
  EXPECT_THAT(refused("GRAPHICS/3, CIRCLE, CM=1, RADIUS=1\nCONTACT/7, IGEOM=2, JGEOM=3, " + impact),
              AllOf(HasSubstr("[contact-shape]"), HasSubstr("model.adm:11:27"), HasSubstr("no curve")));
  EXPECT_THAT(refused("MARKER/12, PART=1\nGRAPHICS/3, LINK, I=1, J=12, WIDTH=1, DEPTH=1\n"
                      "CONTACT/7, IGEOM=2, JGEOM=3, " +
                      impact),
              AllOf(HasSubstr("[contact-shape]"), HasSubstr("a LINK")));
  EXPECT_THAT(
      refused("GRAPHICS/3, TORUS, CM=1, MAJOR_RADIUS=1, MINOR_RADIUS=0.5\nGRAPHICS/4, BOX, CORNER=2, X=1, Y=1, Z=1\n"
              "CONTACT/7, IGEOM=4, JGEOM=3, JFLIP_GEOMETRY=3, " +
              impact),
      AllOf(HasSubstr("[contact-pair-not-built]"),
            HasSubstr("CONTACT/7 lets GRAPHICS/3, the inside of a TORUS, touch GRAPHICS/4, a BOX, which")));
  EXPECT_THAT(with("IGEOM=2, JGEOM=1, IFLIP_GEOMETRY=1"), HasSubstr("[unexpected-value]"));
  EXPECT_THAT(with("IGEOM=2, JGEOM=1, JFLIP_GEOMETRY=1, JFLIP_NORMAL=1"), HasSubstr("[excluded-arguments]"));
  EXPECT_THAT(with("IGEOM=2, JGEOM=1, 1"), HasSubstr("[duplicate-argument]"));
  EXPECT_THAT(with("IGEOM=2, JGEOM=1, COULOMB_FRICTION=ON"), HasSubstr("[missing-argument]"));
  EXPECT_THAT(with("IGEOM=2, JGEOM=1, COULOMB_FRICTION=DYNAMICS_ONLY"),
              HasSubstr("COULOMB_FRICTION=DYNAMICS_ONLY of CONTACT/7 needs MU_STATIC"));
  EXPECT_THAT(with("IGEOM=2, JGEOM=1, MU_STATIC=0.3"), HasSubstr("[unexpected-argument]"));
  EXPECT_THAT(refused("CONTACT/7, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1, EXPONENT=0.5, DAMPING=0, DMAX=1"),
              HasSubstr("[value-out-of-range]"));
  EXPECT_THAT(refused("CONTACT/7, IGEOM=2, JGEOM=1, POISSON, PENALTY=1, RESTITUTION_COEFFICIENT=0"),
              HasSubstr("[value-out-of-range]"));
  EXPECT_THAT(refused("PART/5\nMARKER/55, PART=5\nGRAPHICS/5, POINT, RM=55\n"
                      "CONTACT/7, IGEOM=5, JGEOM=1, POISSON, PENALTY=1, RESTITUTION_COEFFICIENT=0.5"),
              HasSubstr("[contact-without-mass]"));
}

// A box of 2 x 1 x 1 on a larger one, off its middle: four places, a table on springs.
TEST_F(Contacts, box_on_box_stands_on_the_four_corners_of_the_smaller_one) {
  const std::string boxes =
      "MARKER/3, PART=1, QP=-2,-2,-1\nGRAPHICS/1, BOX, CORNER=3, X=4, Y=4, Z=1\n"
      "PART/2, MASS=20, CM=2, IP=2,6,5, QG=0.3,0.2,0.499\nMARKER/2\nMARKER/4, PART=2, QP=-1,-0.5,-0.5\n"
      "GRAPHICS/2, BOX, CORNER=4, X=2, Y=1, Z=1\n";
  const std::string law = ", IMPACT, STIFFNESS=5E4, EXPONENT=1, DAMPING=0, DMAX=1\n";
  const auto one = at_rest(head + boxes + "CONTACT/1, IGEOM=2, JGEOM=1" + law);
  // 4 · 5E4 g = 200, g = 0.001. Each force N = 50 acts half-way between the surfaces, as on a plane.
  expect_same(one, at_rest(head + floor +
                           "PART/2, MASS=20, CM=2, IP=2,6,5, QG=0.3,0.2,0.499\nMARKER/2\n"
                           "MARKER/4, PART=2, QP=-1,-0.5,-0.5\n"
                           "GRAPHICS/2, BOX, CORNER=4, X=2, Y=1, Z=1\n"
                           "CONTACT/1, IGEOM=2, JGEOM=1" +
                           law));
  expect_same(one, at_rest(head + boxes + "CONTACT/1, IGEOM=1, JGEOM=2" + law));
  ASSERT_EQ(one.size(), 12u);
  const double cycles = 2 * std::numbers::pi, h = 0.5, W = 200;
  // About x and y: the corners' stiffness at their arms, less W at the height of the centre above them.
  const std::array<double, 3> squares{(2E5 * 0.25 - W * h) / 2, 2E5 / 20, (2E5 - W * h) / 6};
  std::vector<double> expected;
  for (const double s : squares) expected.push_back(std::sqrt(s) / cycles);
  std::sort(expected.begin(), expected.end());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(one[6 + 2 * k]), expected[k], 1e-7 * expected[k]);
}

// Boxes of one size, flush: a little smaller, the upper one stands on its own corners, a little larger on those of the
// lower one. What stands on edges has the mean of both in each direction.
TEST_F(Contacts, a_stack_of_equal_boxes_stands) {
  const auto squares = [&](double x, double y, double turn) {
    const std::string boxes = fmt::format(
        "MARKER/3, PART=1, QP=-0.5,-0.5,-1\nGRAPHICS/1, BOX, CORNER=3, X=1, Y=1, Z=1\n"
        "PART/2, MASS=20, CM=2, IP=2,4,3, QG=0,0,0.499, REULER={2:.17g},0,0\nMARKER/2\n"
        "MARKER/4, PART=2, QP={0:.17g},{1:.17g},-0.5\nGRAPHICS/2, BOX, CORNER=4, X={3:.17g}, Y={4:.17g}, Z=1\n"
        "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=5E4, EXPONENT=1, DAMPING=0, DMAX=1\n",
        -x / 2, -y / 2, turn, x, y);
    std::vector<double> list;
    for (const auto v : where_it_starts(head + boxes)) {
      if (v.imag() > 1) list.push_back(v.imag() * v.imag());  // slower ones slide
    }
    EXPECT_EQ(list.size(), 3u);
    list.resize(3);
    return list;
  };
  constexpr double off = 1e-7;
  std::array<double, 3> mean{};
  for (const double x : {1 - off, 1 + off}) {
    for (const double y : {1 - off, 1 + off}) {
      const auto of = squares(x, y, 0);
      for (std::size_t k = 0; k < 3; ++k) mean[k] += of[k] / 4;
    }
  }
  const auto flush = squares(1, 1, 0);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(flush[k], mean[k], 1e-5 * mean[k]);
  EXPECT_GT(std::abs(squares(1 - off, 1 - off, 0)[1] / mean[1] - 1), 1e-3);
  // Turned about the vertical it stands on crossings of edges as firmly.
  const double up = 2e5 / 20 / std::pow(2 * std::numbers::pi, 2);
  const auto has_up = [&](const std::vector<double>& list) {
    return std::any_of(list.begin(), list.end(), [&](double s) { return std::abs(s - up) < 1e-9 * up; });
  };
  for (const double turn : {0.0, 1e-6, 0.2, 0.7}) EXPECT_TRUE(has_up(squares(1, 1, turn))) << turn;
}

// As deep in each other sideways as from above there is no telling which way they part.
TEST_F(Contacts, boxes_as_deep_along_two_directions_are_named) {
  const std::string said = refused(
      "MARKER/3, PART=1, QP=5,0,0\nGRAPHICS/3, BOX, CORNER=3, X=1, Y=1, Z=1\n"
      "PART/5, MASS=1, CM=5, IP=1,1,1, QG=5.75,0.2,0.75\nMARKER/5\nGRAPHICS/5, BOX, CORNER=5, X=1, Y=1, Z=1\n"
      "CONTACT/7, IGEOM=5, JGEOM=3, " +
      impact);
  EXPECT_THAT(said, AllOf(HasSubstr("CONTACT/7"), HasSubstr("no place in particular")));
}

// What stands on a rim is held in its middle, and righted by 3/2 N r/0.0001 times its inclination.
TEST_F(Contacts, cylinders_and_rings_stand_flat) {
  const double mass = 2, N = 10 * mass, k = 1e5, r = 0.1, transverse = 0.01;
  const double up = std::sqrt(k / mass) / (2 * std::numbers::pi);
  struct Case {
    const char *what, *shape, *under;
    double radius, height, drawn;  // of the circle, of the mass centre above it, of the mass centre
  };
  const std::string box = "MARKER/9, PART=1, QP=-3,-3,-1\nGRAPHICS/1, BOX, CORNER=9, X=6, Y=6, Z=1\n";
  const std::string drum = "MARKER/9, PART=1, QP=0.1,0.2,-1\nGRAPHICS/1, CYLINDER, CM=9, LENGTH=1, RADIUS=0.5\n";
  const char* cylinder = "MARKER/3, PART=2, QP=0,0,-0.2\nGRAPHICS/2, CYLINDER, CM=3, LENGTH=0.3, RADIUS=0.1\n";
  for (const Case& c :
       {Case{"cylinder on a plane", cylinder, floor.c_str(), r, 0.2, 0.2},
        {"cylinder on a box", cylinder, box.c_str(), r, 0.2, 0.2},
        {"cylinder on a larger one", cylinder, drum.c_str(), r, 0.2, 0.2},
        {"ring on a plane", "MARKER/3, PART=2, QP=0,0,-0.1\nGRAPHICS/2, TORUS, CM=3, MAJOR=0.4, MINOR=0.1\n",
         floor.c_str(), 0.4, 0.1, 0.2}}) {
    for (const char* inclined : {"", ", REULER=0.4,1E-5,0"}) {
      const std::string model =
          head + c.under +
          fmt::format("PART/2, MASS={}, CM=2, IP={},{},0.014, QG=0,0,{}{}\nMARKER/2\n{}", mass, transverse, transverse,
                      c.drawn, inclined, c.shape) +
          fmt::format("CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS={}, EXPONENT=1, DAMPING=0, DMAX=1\n", k);
      const auto values = at_rest(model);
      ASSERT_EQ(values.size(), 12u) << c.what;
      const double rock = std::sqrt(N * (1.5 * c.radius / 1e-4 - c.height) / transverse) / (2 * std::numbers::pi);
      EXPECT_NEAR(std::abs(values[7]), up, 1e-9 * up) << c.what;
      EXPECT_NEAR(std::abs(values[9]), rock, 1e-9 * rock) << c.what;
      EXPECT_NEAR(std::abs(values[11]), rock, 1e-9 * rock) << c.what;
    }
  }
}

// A ball on the axis of a cone has no place in particular on it.
TEST_F(Contacts, one_that_touches_all_around_is_named) {
  const RunResult r = run(head +
                              "MARKER/9, PART=1\nGRAPHICS/9, FRUSTUM, CM=9, LENGTH=1, BOTTOM=0.1, TOP=1\n"
                              "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=0,0,0.5\nMARKER/2\n"
                              "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.85, YSCALE=0.85, ZSCALE=0.85\n"
                              "CONTACT/1, IGEOM=2, JGEOM=9, JFLIP_GEOMETRY=9, " +
                              impact + "\nEND\n",
                          "LINEAR/EIGENSOL\n");
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, AllOf(HasSubstr("CONTACT/1"), HasSubstr("touch all around")));
}

// What of the moment of a force through the centre is not zero is rounding, and no reason to turn.
TEST_F(Contacts, a_ball_comes_to_rest_in_a_hollow_sphere_wherever_it_is_drawn) {
  const double mass = 2, depth = std::pow(mass * 10 / 1e5, 1 / 1.5);
  for (const char* sides : {"IGEOM=2, JGEOM=1, JFLIP_GEOMETRY=1", "IGEOM=1, JGEOM=2, IFLIP_GEOMETRY=1"}) {
    for (const char* drawn : {"QG=0.357835,0.620158,0.584864, REULER=2.5,2.53,-2.4", "QG=0.3,-1.1,-0.2",
                              "QG=-0.8,-0.7,-0.9, REULER=0.3,0.7,-0.8", "QG=0.9,0.2,0.7, REULER=1,2,3",
                              "QG=-0.61,0.42,-1.02, REULER=-1.3,0.2,2.9", "QG=0.11,-0.32,0.83, REULER=3,-2,1"}) {
      const RunResult r = run(head + fmt::format("PART/2, MASS={}, CM=2, IP=0.2,0.2,0.2, {}\nMARKER/2\n", mass, drawn) +
                                  "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=1, YSCALE=1, ZSCALE=1\n"
                                  "GRAPHICS/1, ELLIPSOID, CM=1, XSCALE=4, YSCALE=4, ZSCALE=4\nCONTACT/1, " +
                                  sides + ", IMPACT, STIFFNESS=1E5, EXPONENT=1.5, DAMPING=100, DMAX=0.001\nEND\n",
                              "SIMULATE/STATICS\n");
      ASSERT_EQ(r.status, 0) << sides << drawn << r.err;
      for (const auto& body : r.result(0).at("operating_point").at("bodies")) {
        if (body.at("element") != "PART/2") continue;
        EXPECT_NEAR(body.at("position").at(2).get<double>(), -1.5 - depth, 1e-9);
      }
    }
  }
}

// A ball without friction in a hollow sphere swings as a pendulum does and turns as it likes. Which of the two is I
// decides whether that is seen at once or where moments as large as force times distance cancel: bounds cover the rest.
TEST_F(Contacts, a_ball_in_a_hollow_sphere_is_free_to_turn_whatever_is_called_I) {
  const double mass = 3.2, depth = std::pow(mass * 10 / 1e5, 1 / 1.5);
  const double swings = std::sqrt(10 / (1.5 + depth)), bounces = std::sqrt(1.5e5 * std::sqrt(depth) / mass);
  for (const char* sides : {"IGEOM=2, JGEOM=1, JFLIP_GEOMETRY=1", "IGEOM=1, JGEOM=2, IFLIP_GEOMETRY=1"}) {
    for (const char* drawn : {"-0.49,-0.01,-0.1", "0.3,0.7,-0.8", "1,2,3", "0,0,0"}) {
      const RunResult r =
          run(head +
                  fmt::format("PART/2, MASS={}, CM=2, IP=0.1,0.12,0.15, QG=0,0,{:.17g}, REULER={}\nMARKER/2\n", mass,
                              -1.5 - depth, drawn) +
                  "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=1, YSCALE=1, ZSCALE=1\n"
                  "GRAPHICS/1, ELLIPSOID, CM=1, XSCALE=4, YSCALE=4, ZSCALE=4\nCONTACT/1, " +
                  sides + ", IMPACT, STIFFNESS=1E5, EXPONENT=1.5, DAMPING=10, DMAX=0.001\nEND\n",
              "LINEAR/EIGENSOL\n");
      ASSERT_EQ(r.status, 0) << sides << drawn << r.err;
      std::vector<double> others;
      for (const auto& m : r.result(0).at("modes")) {
        const double value =
            2 * std::numbers::pi * std::hypot(m.at("real_hz").get<double>(), m.at("imag_hz").get<double>());
        if (value > 0.1) {
          others.push_back(value);
        } else {
          EXPECT_LE(value, 2 * std::numbers::pi * m.at("error_bound_hz").get<double>()) << sides << drawn;
        }
      }
      ASSERT_EQ(others.size(), 3u) << sides << drawn;
      EXPECT_NEAR(others[0], swings, 1e-9 * swings);
      EXPECT_NEAR(others[1], swings, 1e-9 * swings);
      EXPECT_NEAR(others[2], bounces, 1e-9 * bounces);
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::contact_test
