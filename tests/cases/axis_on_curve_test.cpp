// AXCV against a straight joint, closed forms, and the work of its reaction.
#include "cases/curves.h"

namespace dynalin::cases::axis_on_curve_test {
namespace {

class AxesOnCurves : public CurveCases {};

// A straight line along x in a body that turns itself: the joint that the statement bends.
TEST_F(AxesOnCurves, along_a_straight_line_are_a_cylindrical_joint) {
  const std::string bodies =
      "ACCGRAV/JGRAV=-9.81\nMARKER/1\nPART/2, MASS=3, CM=20, IP=0.4,0.5,0.6, REULER=0.1,0.2,0.3\nMARKER/20\n"
      "MARKER/21, QP=0.1,-0.2,0.05, REULER=0.4,0.5,-0.7\nMARKER/22, PART=2, QP=0.1,-0.2,0.05, REULER=90D,90D,0\n"
      "MARKER/29, PART=2, FLOATING\nJOINT/1, SPHERICAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=21, J=2, K=90, "
      "C=1, LENGTH=0.2\nMARKER/2, PART=1, QP=0.5,0.6,0.7\nPART/3, MASS=1.5, CM=30, IP=0.2,0.3,0.1\nMARKER/30\n"
      "SPRINGDAMPER/2, TRANSLATIONAL, I=31, J=2, K=70, C=0.5, LENGTH=0.3\n";
  // I where the line of marker 21 or the z axis of 22 is at 0.3, turned about it by 0.8.
  const auto with = [&](const std::string& joint, const std::string& line) {
    return bodies + line + "MARKER/31, PART=3, QP=0.1,0.2,-0.1, REULER=0.2,0.3,0.4\n" + joint;
  };
  const auto straight = solve(with("JOINT/2, CYLINDRICAL, I=31, J=23\n",
                                   "MARKER/23, PART=2, QP=0.1,-0.2,0.05, "
                                   "REULER=0.3,1.1,0.2\n"),
                              "SIMULATE/STATIC\n");
  // The same axis is x of a marker whose x is z of 23.
  const auto bent = solve(with("AXCV/1, I=31, JFLOAT=29, CURVE=1, RM=23\n",
                               "MARKER/23, PART=2, QP=0.1,-0.2,0.05, REULER=0.3,1.1,0.2\n"
                               "MATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=0,0,-3, 0,0,-1, 0,0,1, 0,0,3\n"
                               "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n"),
                          "SIMULATE/STATIC\n");
  ASSERT_EQ(straight.size(), 10u);
  ASSERT_EQ(bent.size(), straight.size());
  EXPECT_GT(std::abs(straight[9].imag()), 0.1);
  for (std::size_t k = 0; k < straight.size(); ++k)
    EXPECT_NEAR(std::abs(bent[k] - straight[k]), 0, 1e-8 * std::abs(straight[9])) << k;
}

// Under a rail y = a x² at its vertex, d below it: both frequencies of docs/elements/axcv.md in other numbers, and with
// the axis against the curve.
TEST_F(AxesOnCurves, trolley_under_a_parabola) {
  const double a = 0.7, d = 0.15, m = 1.3, I = 0.2, J = 0.35, g = 9.81, k = 2 * a;
  for (const char* axes : {"90D,90D,0", "-90D,90D,0", "90D,90D,1"}) {
    const auto values = solve(
        parabola(1, a) +
        fmt::format("ACCGRAV/JGRAV={}\nMARKER/1\nMARKER/9, FLOATING\nPART/2, MASS={}, CM=20, IP={},1,{}, QG=0,{},0\n"
                    "MARKER/20\nMARKER/21, QP=0,{},0, REULER={}\nAXCV/1, I=21, JFLOAT=9, CURVE=1, RM=1\n",
                    -g, m, I, J, -d, d, axes));
    ASSERT_EQ(values.size(), 4u);
    const double along = std::sqrt(m * g * k * (1 + k * d) / (m * (1 + k * d) * (1 + k * d) + J * k * k));
    const double about = std::sqrt(m * g * d / (I + m * d * d));
    EXPECT_NEAR(2 * std::numbers::pi * std::abs(values[0].imag()), std::min(along, about), 1e-11) << axes;
    EXPECT_NEAR(2 * std::numbers::pi * std::abs(values[3].imag()), std::max(along, about), 1e-11) << axes;
  }
}

// On a circle about the z axis of ground a body turns like one on a hinge, and about the tangent.
TEST_F(AxesOnCurves, on_a_circle_turn_about_its_axis) {
  std::string ring = "MATRIX/1, FULL=RORDER, ROWS=49, COLUMNS=3, VALUES=";
  for (int k = 0; k <= 48; ++k) {
    const double angle = 2 * std::numbers::pi * (k % 48) / 48;
    ring += fmt::format("{}{:.17g},{:.17g},0", k > 0 ? "\n, " : "", 2 * std::cos(angle), 2 * std::sin(angle));
  }
  ring += "\nCURVE/1, CLOSED, MATRIX=1, CURVE_POINTS, ORDER=8\n";
  // A spring about z of ground on an arm holds the first, gravity the second: ω² = KT/(J + m (r − d)²) as a hinge has
  // it, with the mass centre d inside of the ring; gravity along −z turns it about the tangent, and a spring holds it.
  const auto values = solve(ring +
                            "MARKER/1\nMARKER/9, FLOATING\nPART/2, MASS=2, CM=20, IP=0.3,0.5,0.7, QG=1.9,0,0\n"
                            "MARKER/20\nMARKER/21, QP=0.1,0,0, REULER=180D,90D,0\nAXCV/1, I=21, JFLOAT=9, CURVE=1, "
                            "RM=1\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=40\nBUSHING/1, I=20, J=2, K=0,0,100\n"
                            "MARKER/2, PART=1, QP=1.9,0,0\n");
  ASSERT_EQ(values.size(), 4u);
  // The order of 8 through 48 points meets the circle to about 1e-9.
  EXPECT_NEAR(2 * std::numbers::pi * std::abs(values[0].imag()), std::sqrt(100 * 0.01 / (0.5 + 2 * 0.01)), 1e-6);
  EXPECT_NEAR(2 * std::numbers::pi * std::abs(values[3].imag()), std::sqrt(40 / (0.7 + 2 * 1.9 * 1.9)), 1e-6);
}

TEST_F(AxesOnCurves, reaction_does_no_work_along_a_curve_in_space) {
  std::string work = "0";
  for (const char c : {'X', 'Y', 'Z'}) work += fmt::format("+V{0}(21)*F{0}(21,29)+W{0}(21)*T{0}(21,29)", c);
  const RunResult r =
      run("Curves\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/29, FLOATING\n" +
              bow.curve(1, 9) +
              "PART/2, MASS=2, CM=20, IP=0.3,0.5,0.7, VX=1\nMARKER/20\nMARKER/21, QP=0.1,-0.3,0.2, REULER=90D,90D,0.2\n"
              "AXCV/1, I=21, JFLOAT=29, CURVE=1, RM=1, VEL=0.8\nVARIABLE/9, FUNCTION=0\nVARIABLE/1, FUNCTION=" +
              work +
              "\nVARIABLE/2, FUNCTION=FX(21,29)*VX(21)+FY(21,29)*VY(21)+FZ(21,29)*VZ(21)\n"
              "VARIABLE/3, FUNCTION=DX(29,21)\n"
              "PINPUT/1, VARIABLES=9\nPOUTPUT/1, VARIABLES=1,2,3\nEND\n",
          "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto C = r.matrix(0, "C");
  ASSERT_EQ(C.size(), 3u);
  double of_force = 0;
  for (const double c : C[1]) of_force = std::max(of_force, std::abs(c));
  EXPECT_GT(of_force, 0.1);  // the force alone works
  for (const double c : C[0]) EXPECT_NEAR(c, 0, 1e-9 * of_force);
  for (const double c : C[2]) EXPECT_NEAR(c, 0, 1e-12);
}

TEST_F(AxesOnCurves, errors) {
  const auto status = [&](const std::string& text) {
    return run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/9, FLOATING\n" + text + "END\n",
               "LINEAR/EIGENSOL\n");
  };
  const RunResult point =
      status(parabola(1, 0.5) + "POINT_MASS/2, MASS=1, CM=20\nMARKER/20\nAXCV/1, I=20, JFLOAT=9, CURVE=1, RM=1\n");
  EXPECT_NE(point.status, 0);
  EXPECT_NE(point.err.find("AXCV/1"), std::string::npos) << point.err;
  // A polygon has no tangent at its corners.
  const RunResult corner = status(
      "MATRIX/1, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=-1,0,0, 0,0,0, 1,1,0\nCURVE/1, OPEN, MATRIX=1, "
      "CURVE_POINTS, ORDER=2\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, REULER=90D,90D,0\nAXCV/1, I=20, JFLOAT=9, "
      "CURVE=1, RM=1, DISP=0,0,0\n");
  EXPECT_NE(corner.status, 0);
  EXPECT_NE(corner.err.find("corner"), std::string::npos) << corner.err;
}

}  // namespace
}  // namespace dynalin::cases::axis_on_curve_test
