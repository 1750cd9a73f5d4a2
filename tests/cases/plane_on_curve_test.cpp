// PLCV against closed forms and against a CVCV with a straight line.
#include "cases/curves.h"

namespace dynalin::cases::plane_on_curve_test {
namespace {

// A body with the edge of curve 1 on a floor whose normal is y, its mass centre H above the vertex.
std::string rocker(double H, const std::string& contact = "PLCV/1, I=1, IFLOAT=9, JFLOAT=29, CURVE=1, RM=21") {
  return fmt::format(
      "ACCGRAV/JGRAV=-9.81\nMARKER/1, REULER=0,-90D,0\nMARKER/2\nMARKER/9, FLOATING\nPART/2, MASS=2, CM=20, "
      "IP=1,1,0.4, QG=0.2,0,0\nMARKER/20, QP=0,{},0\nMARKER/21\nMARKER/29, FLOATING\nJOINT/1, PLANAR, I=20, J=2\n{}\n",
      H, contact);
}

class PlanesOnCurves : public CurveCases {};

TEST_F(PlanesOnCurves, parabola_rocks_on_a_floor) {
  const double a = 0.8, H = 0.3;
  const auto values = solve(parabola(1, a) + rocker(H));
  ASSERT_EQ(values.size(), 4u);  // it slides freely as well
  EXPECT_NEAR(2 * std::numbers::pi * std::abs(values[3].imag()), std::sqrt(2 * 9.81 * (1 / (2 * a) - H) / 0.4), 1e-11);
  EXPECT_NEAR(std::abs(values[0]), 0, 1e-10);
}

TEST_F(PlanesOnCurves, one_whose_mass_centre_is_above_the_centre_of_curvature_falls) {
  const auto values = solve(parabola(1, 0.8) + rocker(0.9));
  ASSERT_EQ(values.size(), 4u);
  const double growth = std::sqrt(2 * 9.81 * (0.9 - 1 / 1.6) / 0.4) / (2 * std::numbers::pi);
  EXPECT_NEAR(std::abs(values[3]), growth, 1e-11);
  EXPECT_NEAR(values[3].imag(), 0, 1e-12);
}

TEST_F(PlanesOnCurves, drawn_off_the_floor_finds_the_contact_and_the_side_that_touches) {
  // Turned by 0.4 the edge touches beside its vertex; statics turns it back.
  std::string text = parabola(1, 0.8) + rocker(0.3);
  text.replace(text.find("QG=0.2,0,0"), 10, "QG=0.2,0.7,0, REULER=0,0,0.4");
  const auto values = solve(text, "SIMULATE/STATIC\n");
  ASSERT_EQ(values.size(), 4u);
  EXPECT_NEAR(2 * std::numbers::pi * std::abs(values[3].imag()), std::sqrt(2 * 9.81 * (1 / 1.6 - 0.3) / 0.4), 1e-6);
}

// The same cam and follower with a straight line as its lower edge, and with a plane: a preload, a contact far from the
// vertex, and everything turned.
TEST_F(PlanesOnCurves, equals_a_straight_line_on_a_curve) {
  const std::string cam =
      parabola(1, -0.9, 0.4) + parabola(2, 0) +
      "MARKER/1\nMARKER/2, PART=1, QP=0.1,1.5,0, REULER=0,-90D,0\nPART/2, MASS=0.7, CM=20, IP=1,1,0.3, "
      "REULER=0,0,0.5\nMARKER/20\nMARKER/29, FLOATING\nPART/3, MASS=1.2, CM=30, IP=1,1,1, QG=0.1,0.5,0\nMARKER/30\n"
      "MARKER/31, REULER=0,-90D,0\nMARKER/39, FLOATING\nJOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=31, "
      "J=2\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=5, CT=0.2, ANGLE=-10D\nSPRINGDAMPER/2, TRANSLATIONAL, I=30, J=2, "
      "K=40, C=0.7, LENGTH=1.3\n";
  const auto line =
      solve(cam + "CVCV/1, IFLOAT=29, ICURVE=1, IRM=20, JFLOAT=39, JCURVE=2, JRM=30\n", "SIMULATE/STATIC\n");
  const auto plane = solve(cam + "PLCV/1, I=31, IFLOAT=39, JFLOAT=29, CURVE=1, RM=20\n", "SIMULATE/STATIC\n");
  ASSERT_EQ(line.size(), 2u);
  ASSERT_EQ(plane.size(), 2u);
  EXPECT_GT(std::abs(line[0].imag()), 0.1);
  EXPECT_LT(line[0].real(), -1e-3);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(std::abs(plane[k] - line[k]), 0, 1e-9 * std::abs(line[k]));
}

TEST_F(PlanesOnCurves, reaction_is_a_force_across_the_plane_at_the_point_of_contact) {
  // What the floor carries is the weight less the inertia of the mass centre, and it works at the vertex.
  const std::string text =
      parabola(1, 0.8) + rocker(0.3) +
      "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nJOINT/3, TRANSLATIONAL, I=30, J=2\nVARIABLE/9, FUNCTION=0\n"
      "VARIABLE/1, FUNCTION=FY(29,9)-2*(9.81+ACCY(20))\nVARIABLE/2, FUNCTION=FY(9,29)+FY(29,9)\n"
      "VARIABLE/3, FUNCTION=FX(29,9)\nVARIABLE/4, FUNCTION=TZ(29,9)\nVARIABLE/5, FUNCTION=DX(29,1)-DX(9,1)\n"
      "VARIABLE/6, FUNCTION=DY(29,1)\nVARIABLE/7, FUNCTION=VZ(30)*FY(29,9)\n"
      "PINPUT/1, VARIABLES=9\nPOUTPUT/1, VARIABLES=1,2,3,4,5,6,7\n";
  const RunResult r = run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + text + "END\n",
                          "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto C = r.matrix(0, "C");
  ASSERT_EQ(C.size(), 7u);
  double weight = 0;
  for (const double c : C[6]) weight = std::max(weight, std::abs(c));
  EXPECT_NEAR(weight, 2 * 9.81, 1e-9);
  for (std::size_t k = 0; k < 6; ++k) {
    for (const double c : C[k]) EXPECT_NEAR(c, 0, 1e-9) << k;
  }
}

TEST_F(PlanesOnCurves, says_where_the_contact_is_undetermined) {
  const RunResult r =
      run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + parabola(1, 0) + rocker(0.3) + "END\n", "LINEAR/EIGENSOL\n");
  EXPECT_NE(r.status, 0);
  EXPECT_NE((r.out + r.err).find("PLCV/1 has no definite point of contact"), std::string::npos) << r.out << r.err;
}

TEST_F(PlanesOnCurves, wants_its_floating_markers_where_the_bodies_are) {
  for (const std::string contact :
       {"PLCV/1, I=1, IFLOAT=29, JFLOAT=9, CURVE=1, RM=21", "PLCV/1, I=1, IFLOAT=2, JFLOAT=29, CURVE=1, RM=21",
        "PLCV/1, I=20, IFLOAT=9, JFLOAT=29, CURVE=1, RM=21",
        "PLCV/1, I=1, IFLOAT=9, JFLOAT=29, CURVE=1, RM=21, ICM=20"}) {
    const RunResult r =
        run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + parabola(1, 0.8) + rocker(0.3, contact) + "END\n",
            "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 1) << contact;
    EXPECT_NE(r.err.find("PLCV/1"), std::string::npos) << r.err;
  }
}

}  // namespace
}  // namespace dynalin::cases::plane_on_curve_test
