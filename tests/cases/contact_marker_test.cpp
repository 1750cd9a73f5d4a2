// Floating markers at points of contact, read by measures, and contacts that are not determined.
#include "cases/curves.h"

namespace dynalin::cases::contact_marker_test {
namespace {

class ContactMarkers : public CurveCases {
 protected:
  // Values of functions: each is the factor of the rate of an idle part in a row of C.
  std::vector<double> readings(const std::string& text, const std::vector<std::string>& functions) const {
    std::string all = text +
                      "VARIABLE/90, FUNCTION=0\nPART/90, MASS=1, CM=900, IP=1,1,1\nMARKER/900\nMARKER/910, PART=1\n"
                      "JOINT/90, TRANSLATIONAL, I=900, J=910\nPINPUT/1, VARIABLES=90\nPOUTPUT/1, VARIABLES=",
                list, variables;
    for (std::size_t k = 0; k < functions.size(); ++k) {
      list += fmt::format("{}{}", k > 0 ? "," : "", 100 + k);
      variables += fmt::format("VARIABLE/{}, FUNCTION=({})*VZ(900)\n", 100 + k, functions[k]);
    }
    const RunResult r = run("Contact\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + all + list + "\n" + variables + "END\n",
                            "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<double> values(functions.size(), 0.0);
    if (r.status != 0) return values;
    const auto C = r.matrix(0, "C");
    for (std::size_t k = 0; k < values.size(); ++k) {
      for (const double c : C[k]) values[k] = std::abs(c) > std::abs(values[k]) ? c : values[k];
    }
    return values;
  }
};

TEST_F(ContactMarkers, axes_follow_tangent_and_curvature) {
  // A bead at x on the wire y = a x² that moves with the speed VX: the tangent leans by θ = atan 2 a x, the centre of
  // curvature is above, so that y points down, and θ′ = 2 a VX/(1 + tan² θ).
  const double a = 1.7, x = 0.3, slope = 2 * a * x, lean = std::atan(slope), vx = 1.5;
  const double speed = vx * std::sqrt(1 + slope * slope), turning = 2 * a * vx / (1 + slope * slope);
  const std::string wire = "MARKER/1\nMARKER/9, FLOATING\n" + parabola(1, a) +
                           fmt::format(
                               "POINT_MASS/2, MASS=3, CM=2, QG={:.17g},{:.17g},0\nMARKER/2\nPTCV/1, I=2, "
                               "JFLOAT=9, CURVE=1, RM=1, VEL={:.17g}\n",
                               x, a * x * x, speed);
  const auto found = readings(wire, {"UVX(9,1)*[1,0,0]", "UVX(9,1)*[0,1,0]", "UVY(9,1)*[1,0,0]", "UVY(9,1)*[0,1,0]",
                                     "UVZ(9,1)*[0,0,1]", "WZ(9,1,1)", "VX(2,1,9)", "DX(2,1,9)"});
  const double s = std::sin(lean), c = std::cos(lean);
  // x along the wire and y below it, so that z = x × y points into the plane.
  const std::vector<double> expected = {c, s, s, -c, -1, turning, speed, x * c + a * x * x * s};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-11) << k;
}

TEST_F(ContactMarkers, markers_of_two_curves_meet_at_the_contact) {
  // A parabola y = a x² that stands on a table, turned by θ about the point at x0 of its edge, 2 a x0 = tan(−θ).
  const double a = 0.8, angle = -0.3, x0 = std::tan(-angle) / (2 * a), height = 0.2;
  const double depth = std::sin(angle) * x0 + std::cos(angle) * a * x0 * x0;
  const double across = std::cos(angle) * x0 - std::sin(angle) * a * x0 * x0;
  const std::string model = fmt::format(
      "MARKER/1\nMARKER/9, FLOATING\n{}{}PART/2, MASS=2, CM=20, IP=1,1,0.4, QG=0.1,{:.17g},0, "
      "REULER={:.17g},0,0\nMARKER/20, QP=0,0.3,0\nMARKER/21\nMARKER/29, FLOATING\nJOINT/1, PLANAR, I=20, J=1\n"
      "CVCV/1, IFLOAT=29, ICURVE=1, IRM=21, JFLOAT=9, JCURVE=2, JRM=1\n",
      parabola(1, a), parabola(2, 0, height), height - depth, angle);
  const auto found = readings(model, {"DX(29,1,1)", "DY(29,1,1)", "DX(9,1,1)", "DY(9,1,1)", "1+DM(29,9)",
                                      "DX(29,21,21)", "UVX(29,1)*[1,0,0]", "UVY(29,1)*[0,1,0]", "DX(29,1,9)"});
  const std::vector<double> expected = {0.1 + across, height, 0.1 + across, height, 1, x0, 1, -1, 0.1 + across};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-10) << k;
}

TEST_F(ContactMarkers, a_straight_curve_has_no_axes_across_it) {
  for (const std::string function : {"DY(2,1,9)", "SFORCE(5,0,3,9)", "FY(2,0,9)"}) {
    const RunResult r =
        run("Contact\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/9, FLOATING\n" + parabola(1, 0) +
                "PART/2, MASS=3, CM=2, IP=1,1,1\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1\n"
                "SFORCE/5, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=3\nVARIABLE/1, FUNCTION=" +
                function + "\nEND\n",
            "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 2) << function;
    EXPECT_NE(
        r.err.find(function + " reads the y or z axis of a marker at a point of contact where the curve is straight"),
        std::string::npos)
        << r.err;
  }
}

TEST_F(ContactMarkers, curves_that_osculate_are_refused_by_name) {
  // Equal parabolas, one upon the other: they touch everywhere. And one that lies on its circle of curvature's
  // parabola.
  for (const double other : {0.8, 0.4}) {
    const RunResult r = run("Contact\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/9, FLOATING\n" +
                                parabola(1, 0.8) + parabola(2, other) +
                                "PART/2, MASS=2, CM=20, IP=1,1,0.4\nMARKER/20\nMARKER/29, FLOATING\nJOINT/1, PLANAR, "
                                "I=20, J=1\nCVCV/1, IFLOAT=29, ICURVE=1, IRM=20, JFLOAT=9, JCURVE=2, JRM=1\nEND\n",
                            "LINEAR/EIGENSOL\n");
    const bool refused = other == 0.8;
    EXPECT_EQ(r.status, refused ? 2 : 0) << r.err;
    EXPECT_EQ(
        r.err.find("CVCV/1 has no definite point of contact: its curves have the same curvature") != std::string::npos,
        refused)
        << r.err;
  }
}

}  // namespace
}  // namespace dynalin::cases::contact_marker_test
