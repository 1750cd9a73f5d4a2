// Motion under CONTACT against motion under the same forces written as expressions, and where what touches is stiff
// against that on the constraint.
#include <fmt/format.h>

#include <initializer_list>

#include "cases/written_contacts.h"
#include "time/course.h"

namespace dynalin::in_time::contact_written_test {
namespace {

using namespace cases::written_contacts;

// Of VARIABLEs 1, 2 …, which read `measures`.
struct Pair {
  std::string model, contact, written;
  std::vector<std::string> measures;
  double end = 0.4;
};

void expect_same_motion(const Pair& of, double within = 1e-8) {
  std::string reads;
  for (std::size_t k = 0; k < of.measures.size(); ++k)
    reads += fmt::format("VARIABLE/{}, FUNCTION={}\n", k + 1, of.measures[k]);
  const Run run{.end = of.end, .steps = 40, .error = 1e-11};
  const Course touches = led_through_time(of.model + of.contact + reads + "END\n", run),
               pushed = led_through_time(of.model + of.written + reads + "END\n", run);
  ASSERT_TRUE(touches.ok()) << touches.failure;
  ASSERT_TRUE(pushed.ok()) << pushed.failure;
  for (std::size_t k = 0; k < of.measures.size(); ++k) {
    const auto id = static_cast<std::int64_t>(k + 1);
    EXPECT_GT(pushed.drift(id), 0.01) << of.measures[k];  // it moves
    const double scale = std::max(1.0, pushed.largest(id));
    for (std::size_t t = 0; t < touches.times.size(); ++t) {
      ASSERT_NEAR(touches.variables.at(id)[t], pushed.variables.at(id)[t], within * scale)
          << of.measures[k] << " at " << touches.times[t];
    }
  }
}

const std::string space = "Contact\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\n",
                  plane = "Plane contact\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\n",
                  floor = "GRAPHICS/1, PLANE, RM=1, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\n";

std::string ball(const std::string& start) {
  return "PART/2, MASS=2, CM=2, IP=0.008,0.008,0.008, " + start +
         "\nMARKER/2\nGRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n";
}

// It falls, bounces and slides until it rolls.
TEST(ContactMotion, a_thrown_ball_on_a_plane_is_that_of_its_expression) {
  expect_same_motion({space + floor + ball("QG=0,0,0.15, VX=0.7, VY=0.2, WX=3"),
                      "CONTACT/1, IGEOM=2, JGEOM=1, " + impact + friction,
                      ball_on_plane(),
                      {"DX(2)", "DY(2)", "DZ(2)", "WX(2)", "WY(2)"}});
}

TEST(ContactMotion, a_ball_in_a_cone_is_that_of_its_expression) {
  const std::string contact = "CONTACT/1, IGEOM=2, JGEOM=9, JFLIP_GEOMETRY=9, " + impact + "\n";
  // Along a cone that lies level, beside its lowest line.
  expect_same_motion({space + ball("QG=0.1,0.1,-0.25, VX=0.6, VY=0.5") +
                          "MARKER/9, PART=1, QP=-1,0,0, REULER=90D,90D,0\n"
                          "GRAPHICS/9, FRUSTUM, CM=9, LENGTH=3, BOTTOM=0.4, TOP=0.6\n",
                      contact,
                      ball_in_cone(0.4, 0.2 / 3),
                      {"DX(2)", "DY(2)", "DZ(2)"}});
  // Around one that stands.
  expect_same_motion({space + ball("QG=0.6,0,0.47, VY=2.5") +
                          "MARKER/9, PART=1\nGRAPHICS/9, FRUSTUM, CM=9, LENGTH=1, BOTTOM=0.1, TOP=1.6\n",
                      contact,
                      ball_in_cone(0.1, 1.5),
                      {"DX(2)", "DY(2)", "DZ(2)"}});
}

// It rocks from rim to rim.
TEST(ContactMotion, a_cylinder_on_a_plane_is_that_of_its_expression) {
  expect_same_motion({space + floor +
                          "PART/2, MASS=2, CM=2, IP=0.1,0.02,0.1, QG=0,0,0.12, WX=1.5\nMARKER/2\n"
                          "MARKER/3, PART=2, QP=0,-0.3,0, REULER=180D,90D,0\nMARKER/11, PART=2, QP=0,-0.3,0\n"
                          "MARKER/12, PART=2, QP=0,0.3,0\nGRAPHICS/2, CYLINDER, CM=3, LENGTH=0.6, RADIUS=0.1\n",
                      "CONTACT/1, IGEOM=2, JGEOM=1, " + impact + "\n",
                      cylinder_on_plane(),
                      {"DZ(2)", "AX(2,1)", "WX(2)"}});
}

// A wheel on a rail that is bent, with friction. VARIABLEs of the written force have greater numbers.
TEST(ContactMotion, a_wheel_on_a_rail_is_that_of_its_expression) {
  expect_same_motion({plane + rail + body(0.3, 0.53) + "GRAPHICS/2, CIRCLE, CM=2, RADIUS=0.5\n",
                      "CONTACT/1, IGEOM=2, JGEOM=1, " + impact + "\n" + friction,
                      place(2, circle, -1.5, 0.3, true),
                      {"DX(2)", "DY(2)", "AZ(2,1)"}});
}

// A bead that a stiff, damped contact presses on a curve runs along it as one that a PTCV holds there.
TEST(ContactMotion, a_point_pressed_on_a_curve_is_one_on_the_constraint) {
  const double x = 0.4, y = 0.2 * x * x - 0.1 * x * x * x;
  expect_same_motion({plane + rail +
                          fmt::format("PART/2, MASS=2, CM=2, IP=0.1,0.1,0.15, QG={:.17g},{:.17g},0\nMARKER/2\n"
                                      "MARKER/8, PART=1, FLOATING\nJOINT/1, PLANAR, I=2, J=1\n",
                                      x, y),
                      "GRAPHICS/2, POINT, RM=2\n"
                      "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E11, EXPONENT=1, DAMPING=1E6, DMAX=1E-12\n",
                      "PTCV/1, I=2, JFLOAT=8, CURVE=1, RM=1\n",
                      {"DX(2)", "DY(2)"},
                      0.8});
}

}  // namespace
}  // namespace dynalin::in_time::contact_written_test
