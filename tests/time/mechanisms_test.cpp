// What moves in ways of its own: rolling, curves on curves, masses of all sizes; against closed forms.
#include <fmt/format.h>

#include <numbers>

#include "time/course.h"

namespace dynalin::in_time::mechanisms_test {
namespace {

// A thin disk that leans by 30 degrees rolls around a circle: with the precession Ω and β the angle of its axle to the
// vertical, its rate n about the axle follows from n Ω sin β (C + m r²) − A Ω² sin β cos β + m g r cos β = 0, and the
// centre goes around at −n r/Ω from the middle.
TEST(Mechanisms, a_disk_rolls_around_a_circle) {
  const double m = 4, r = 0.5, A = 0.25, C = 0.5, g = 9.81, precession = 2, beta = std::numbers::pi / 3;
  const double s = std::sin(beta), c = std::cos(beta);
  const double n = (A * precession * precession * s * c - m * g * r * c) / (precession * s * (C + m * r * r));
  const double radius = -n * r / precession;
  const Course rolled = led_through_time(
      fmt::format("disk\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\n"
                  "PART/2, MASS={}, CM=20, IP={},{},{}, QG={:.17g},0,{:.17g}, REULER=90D,60D,0, VM=1, WM=1\n"
                  ", VY={:.17g}, WX={:.17g}, WZ={:.17g}\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=0,0,1\n"
                  "GCON/1, FUNCTION=DZ(20)-0.5*SQRT(1-DZ(21,20)**2)\n"
                  "GCON/2, FUNCTION=VX(20)-WY(20)*0.5*SQRT(1-DZ(21,20)**2)-WZ(20)*0.5*DY(21,20)*DZ(21,20)"
                  "/SQRT(1-DZ(21,20)**2)\n"
                  "GCON/3, FUNCTION=VY(20)+WZ(20)*0.5*DX(21,20)*DZ(21,20)/SQRT(1-DZ(21,20)**2)"
                  "+WX(20)*0.5*SQRT(1-DZ(21,20)**2)\n"
                  "VARIABLE/1, FUNCTION=DX(20,1)-({:.17g})*COS(2*TIME)\n"
                  "VARIABLE/2, FUNCTION=DY(20,1)-({:.17g})*SIN(2*TIME)\nVARIABLE/3, FUNCTION=DZ(21,20)-0.5\nEND\n",
                  m, A, A, C, radius, r * s, precession * radius, s * (n - precession * c),
                  precession + c * (n - precession * c), radius, radius),
      {3, 30, 1e-6});
  ASSERT_TRUE(rolled.ok()) << rolled.failure;
  for (const std::int64_t k : {1, 2, 3}) EXPECT_LT(rolled.largest(k), 1e-6) << k;
}

// The parabola y = a x² rocks on a table without friction. Its mass centre, H above the vertex, is at the height
// h = H cos θ + sin θ tan θ/(4a): (J + m h′²) θ″ + m h′ h″ θ′² + m g h′ = 0.
TEST(Mechanisms, a_parabola_rocks_on_a_table) {
  const auto points = [](int id, double a) {
    std::string text = fmt::format("MATRIX/{}, FULL=RORDER, ROWS=81, COLUMNS=3, VALUES=", id);
    for (int k = -40; k <= 40; ++k)
      text += fmt::format("{}{},{},0", k > -40 ? k % 8 == 0 ? "\n, " : "," : "", 0.02 * k, a * 4e-4 * k * k);
    return text + fmt::format("\nCURVE/{}, OPEN, MATRIX={}, CURVE_POINTS\n", id, id);
  };
  const std::string slope = "(-0.3*SIN(DIF(1))+(SIN(DIF(1))+SIN(DIF(1))/COS(DIF(1))**2)/3.2)";
  const std::string bend = "(-0.3*COS(DIF(1))+(COS(DIF(1))+1/COS(DIF(1))+2*SIN(DIF(1))**2/COS(DIF(1))**3)/3.2)";
  const Course c = led_through_time(
      "rocker\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/9, PART=1, FLOATING\n" +
          points(1, 0.8) + points(2, 0) +
          "PART/2, MASS=2, CM=20, IP=1,1,0.4, WZ=1\nMARKER/20, PART=2, QP=0,0.3,0\nMARKER/21, PART=2\n"
          "MARKER/29, PART=2, FLOATING\nJOINT/1, PLANAR, I=20, J=1\n"
          "CVCV/1, IFLOAT=29, ICURVE=1, IRM=21, JFLOAT=9, JCURVE=2, JRM=1\n"
          "DIFF/1, FUNCTION=DIF(2), IC=0\nDIFF/2, IC=1, FUNCTION=-2*" +
          slope + "*(" + bend + "*DIF(2)**2+9.81)/(0.4+2*" + slope +
          "**2)\nVARIABLE/1, FUNCTION=AZ(20,1)-DIF(1)\nVARIABLE/2, FUNCTION=WZ(20,1)-DIF(2)\n"
          "VARIABLE/3, FUNCTION=DY(20,1)-0.3*COS(DIF(1))-SIN(DIF(1))*TAN(DIF(1))/3.2\n"
          "VARIABLE/90, FUNCTION=VY(20)**2+0.2*WZ(20)**2+19.62*DY(20)\nEND\n",
      {10, 50, 1e-6});
  ASSERT_TRUE(c.ok()) << c.failure;
  // The curve is a spline through points 0.02 apart.
  EXPECT_LT(c.largest(1), 1e-5);
  EXPECT_LT(c.largest(2), 1e-5);
  EXPECT_LT(c.largest(3), 1e-6);
  EXPECT_LT(c.drift(90), 1e-6);
}

// A part of 1e6 on a spring, 1 rad/s, one of 1e-6 on a spring to it, 2 rad/s: what the small one does to the large one
// is far below rounding, x = 3 + 4/3 cos t + A cos 2t. A third, of 1e-6 as well, is locked to the large one.
TEST(Mechanisms, a_gram_rides_on_a_thousand_tonnes) {
  const Course c = led_through_time(R"(light and heavy
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1E6, CM=20, IP=1E6,1E6,1E6, QG=0,0,3
MARKER/20, PART=2
PART/3, MASS=1E-6, CM=30, IP=1E-9,1E-9,1E-9, QG=0,0,4.4
MARKER/30, PART=3
PART/4, MASS=1E-6, CM=40, IP=1E-9,1E-9,1E-9, QG=0,0,3
MARKER/40, PART=4
JOINT/1, TRANSLATIONAL, I=20, J=1
JOINT/2, TRANSLATIONAL, I=30, J=20
JOINT/3, FIXED, I=40, J=20
SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=1E6, LENGTH=2
SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=4E-6, LENGTH=1
VARIABLE/1, FUNCTION=DZ(20,1)-2-COS(TIME)
VARIABLE/2, FUNCTION=DZ(30,1)-3-4/3*COS(TIME)-(1.4-4/3)*COS(2*TIME)
VARIABLE/3, FUNCTION=JOINT(3,0,4,1)+1E-6*COS(TIME)
END
)",
                                    {20, 40, 1e-5});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_LT(c.largest(1), 1e-5);
  EXPECT_LT(c.largest(2), 1e-5);
  EXPECT_LT(c.largest(3), 1e-11);
}

// With a SENSOR, or with a DELAY that is read, a model without freedoms is led by the integrator: what constraints
// alone determine is as exact as without.
TEST(Mechanisms, a_driven_crank_with_a_sensor_is_as_exact_as_without) {
  StudyPoint from = drawn_point(R"(crank
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=21, IP=1,1,1, WZ=0.7
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.5,0,0
JOINT/1, REVOLUTE, I=20, J=1
MOTION/1, JOINT=1, FUNCTION=0.7*TIME+0.4*SIN(TIME)
SENSOR/1, FUNCTION=AZ(20,1), VALUE=2, GE, EVALUATE=1
VARIABLE/5, FUNCTION=DELAY(VARVAL(6),0.1,0)
VARIABLE/6, FUNCTION=TIME
VARIABLE/1, FUNCTION=AZ(20,1)-0.7*TIME-0.4*SIN(TIME)
VARIABLE/2, FUNCTION=WZ(20,1)-0.7-0.4*COS(TIME)
VARIABLE/3, FUNCTION=WDTZ(20,1)+0.4*SIN(TIME)
VARIABLE/4, FUNCTION=JOINT(1,0,2,1)**2+JOINT(1,0,3,1)**2-(0.7+0.4*COS(TIME))**4-0.16*SIN(TIME)**2
END
)");
  std::map<std::int64_t, double> off;
  const auto watch = [&](const SimulationStep& step) {
    const Layout& layout = step.system.layout();
    for (std::size_t k = 0; step.output && k < layout.algebraic.size(); ++k) {
      const ElementId of = layout.algebraic[k].owner->element();
      if (of.statement != "VARIABLE") continue;
      double& most = off[of.id];
      most = std::max(most, std::abs(step.point.algebraic[k]));
    }
    return GoOn::yes;
  };
  const auto end = simulate(std::move(from), {SimulationKind::kinematics, OutputTimes::of_count(0, 6, 30)}, watch);
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_GT(end->statistics.steps, 30);
  for (const std::int64_t k : {1, 2, 3, 4}) EXPECT_LT(off[k], 1e-9) << k;
}

}  // namespace
}  // namespace dynalin::in_time::mechanisms_test
