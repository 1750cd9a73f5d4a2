// PTCV and CVCV against closed forms: beads on parabolas and circles, a parabola that rocks on a table, a cam under a
// flat follower.
#include "cases/curves.h"

namespace dynalin::cases::curve_test {
namespace {

TEST_F(CurveCases, bead_on_a_parabola) {
  const std::string text = "ACCGRAV/JGRAV=-9.81\nMARKER/1\nMARKER/9, FLOATING\n" + parabola(1, 1.7) +
                           "POINT_MASS/2, MASS=3, CM=2, QG={}\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1{}\n";
  const double expected = std::sqrt(2 * 1.7 * 9.81);
  EXPECT_NEAR(frequency(fmt::format(fmt::runtime(text), "0,0,0", "")), expected, 1e-12);
  // Drawn off the curve and far from rest it finds both.
  EXPECT_NEAR(frequency(fmt::format(fmt::runtime(text), "0.4,0.9,-0.2", ""), "SIMULATE/STATIC\n"), expected, 1e-7);
}

// All markers stand at one place but for rounding: the curve says how large the model is.
TEST_F(CurveCases, bead_beside_the_bottom_by_rounding_moves_in_time) {
  for (const char* off : {"0", "1E-17", "1E-15", "-1E-12", "1E-10", "1E-8"}) {
    const RunResult r = run(
        fmt::format("Curves\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/9, FLOATING\n{}"
                    "POINT_MASS/2, MASS=3, CM=2, QG={},0,0\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1\nEND\n",
                    parabola(1, 1.7), off),
        "SIMULATE/DYNAMICS, END=1, STEPS=5\nLINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << off << r.err;
    expect_eigenvalues(r.eigenvalues(1), {{0, std::sqrt(2 * 1.7 * 9.81) / (2 * std::numbers::pi)}}, 1e-6);
  }
}

TEST_F(CurveCases, bead_on_a_parabola_that_turns) {
  // Seen from the turning wire ω² = 2 a g − W², and with W² > 2 a g it runs away.
  for (const double W : {3.0, 7.0}) {
    const RunResult r = run(
        "Curves\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, REULER=0,-90D,0\nPART/3\nMARKER/30, "
        "REULER=0,-90D,0\nMARKER/31\nMARKER/39, PART=3, FLOATING\nJOINT/1, REVOLUTE, I=30, J=1\nMOTION/1, JOINT=1, "
        "FUNCTION=" +
            number(W) + "*TIME\n" + parabola(1, 1.7) +
            "POINT_MASS/2, MASS=3, CM=2\nMARKER/2\nPTCV/1, I=2, JFLOAT=39, CURVE=1, RM=31\nEND\n",
        "LINEAR/EIGENSOL, RM=31\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const double square = 2 * 1.7 * 9.81 - W * W;
    const auto values = r.eigenvalues(0);
    ASSERT_EQ(values.size(), 2u);
    for (const auto& z : values) {
      const std::complex<double> s = 2 * std::numbers::pi * z;
      EXPECT_NEAR(std::abs(s * s + square), 0, 1e-11 * std::abs(square)) << W;
    }
  }
}

TEST_F(CurveCases, ring_of_points_has_the_curvature_of_its_spline) {
  // At the lowest of n points: curvature |c″|/|c′|² of the periodic cubic spline, 2 (1 − cos w)(2 + cos w)/(3 sin²
  // w)/r.
  const int n = 8;
  const double r = 0.7, w = 2 * std::numbers::pi / n, c = std::cos(w);
  std::string s = fmt::format("MATRIX/1, FULL=RORDER, ROWS={}, COLUMNS=3, VALUES=", n + 1);
  for (int i = 0; i <= n; ++i) s += (i > 0 ? "," : "") + xyz({r * std::cos(w * (i % n)), r * std::sin(w * (i % n)), 0});
  const std::string text = s +
                           "\nCURVE/1, CLOSED, MATRIX=1, CURVE_POINTS\nACCGRAV/JGRAV=-9.81\nMARKER/1\nMARKER/9, "
                           "FLOATING\nPOINT_MASS/2, MASS=3, CM=2, QG=0,-0.7,0\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, "
                           "CURVE=1, RM=1\n";
  const double curvature = 2 * (1 - c) * (2 + c) / (3 * std::sin(w) * std::sin(w)) / r;
  EXPECT_NEAR(frequency(text), std::sqrt(9.81 * curvature), 1e-11);
}

TEST_F(CurveCases, parabola_rocks_on_a_table) {
  // Without friction the mass centre, a height H above the vertex, moves on a vertical line: ω² = m g (1/(2a) − H)/J.
  const double a = 0.8, H = 0.3, m = 2, J = 0.4;
  const std::string text = fmt::format(
      "ACCGRAV/JGRAV=-9.81\nMARKER/1\nMARKER/9, FLOATING\n{}{}PART/2, MASS={}, CM=20, IP=1,1,{}, "
      "QG=0.2,0,0\nMARKER/20, QP=0,{},0\nMARKER/21\nMARKER/29, FLOATING\nJOINT/1, PLANAR, I=20, J=1\nCVCV/1, "
      "IFLOAT=29, "
      "ICURVE=1, IRM=21, JFLOAT=9, JCURVE=2, JRM=1\n",
      parabola(1, a), parabola(2, 0), m, J, H);
  const auto values = solve(text);
  // It slides freely as well.
  ASSERT_EQ(values.size(), 4u);
  const double found = 2 * std::numbers::pi * std::abs(values[3].imag());
  EXPECT_NEAR(found, std::sqrt(m * 9.81 * (1 / (2 * a) - H) / J), 1e-11);
  EXPECT_NEAR(std::abs(values[0]), 0, 1e-10);
}

// A cam with the upper edge y = h − a x² turns about its origin under a flat follower that a spring presses down. The
// highest point of the edge turned by θ is x = tan θ/(2a), the lift L = h cos θ + sin θ tan θ/(4a); a torque F L′ holds
// the follower's force F, and (J + m L′²) δθ″ + (kt + F L″ + ks L′²) δθ = 0.
struct CamModel {
  double a = 0.9, h = 0.4, angle = 0.5, J = 0.3, m = 1.2, kt = 5, ks = 40, pressed = 0.3;

  double lift() const { return h * std::cos(angle) + std::sin(angle) * std::tan(angle) / (4 * a); }
  double slope() const {
    const double s = std::sin(angle), c = std::cos(angle);
    return -h * s + (s + s / (c * c)) / (4 * a);
  }
  double bend() const {
    const double s = std::sin(angle), c = std::cos(angle);
    return -h * c + (c + 1 / c + 2 * s * s / (c * c * c)) / (4 * a);
  }
  double force() const { return ks * pressed; }
  // Everything is placed in a frame F at `at`.
  std::string text(const Matrix3& F, const Vector& at, const std::string& more = "") const {
    const Matrix3 R = F * about({0, 0, 1}, angle);
    const Vector follower = at + F * Vector{0.1, lift(), 0}, above = at + F * Vector{0.1, lift() + 1, 0};
    const Matrix3 along_y = F * rotation_313(0, -std::numbers::pi / 2, 0);
    // The torque that balances: kt·0 + T = force · slope.
    return parabola(1, -a, h) + parabola(2, 0) +
           fmt::format(
               "MARKER/1, QP={0}, REULER={1}\nMARKER/2, PART=1, QP={0}, REULER={2}\nMARKER/3, PART=1, QP={3}, "
               "REULER={4}\n"
               "PART/2, MASS=0.7, CM=20, IP=1,1,{5:.17g}, QG={0}, REULER={2}\nMARKER/20\nMARKER/29, FLOATING\n"
               "PART/3, MASS={6:.17g}, CM=30, IP=1,1,1, QG={7}, REULER={1}\nMARKER/30\nMARKER/31, "
               "REULER=0,-90D,0\nMARKER/39, FLOATING\n"
               "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=31, J=3\n"
               "CVCV/1, IFLOAT=29, ICURVE=1, IRM=20, JFLOAT=39, JCURVE=2, JRM=30\n"
               "SPRINGDAMPER/1, ROTATIONAL, I=20, J=2, KT={8:.17g}, TORQUE={9:.17g}\n"
               "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=3, K={10:.17g}, LENGTH={11:.17g}\n",
               xyz(at), reuler(F), reuler(R), xyz(above), reuler(along_y), J, m, xyz(follower), kt, force() * slope(),
               ks, 1 + pressed) +
           more;
  }
  double frequency() const {
    return std::sqrt((kt + force() * bend() + ks * slope() * slope()) / (J + m * slope() * slope()));
  }
};

TEST_F(CurveCases, cam_under_a_flat_follower) {
  const CamModel cam_model;
  EXPECT_NEAR(frequency(cam_model.text(Matrix3::identity(), {})), cam_model.frequency(), 1e-10);
  // Turned and carried away as a whole.
  EXPECT_NEAR(frequency(cam_model.text(rotation_313(0.7, 1.1, -0.4), {3, -2, 5})), cam_model.frequency(), 1e-9);
  // The rotation of the cam is the coordinate, not the parameters.
  const RunResult r =
      run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + cam_model.text(Matrix3::identity(), {}) + "END\n",
          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.result(0).at("states").at(1).at("element"), 2);
  EXPECT_EQ(r.result(0).at("states").at(1).at("type"), 21);
}

TEST_F(CurveCases, reaction_presses_across_the_contact) {
  // The follower's balance m y″ = N + spring, read as two outputs that must agree; N itself through its factor.
  const CamModel cam_model;
  const std::string more =
      "PART/9, MASS=1, CM=90, IP=1,1,1\nMARKER/90\nMARKER/91, PART=1\nJOINT/9, TRANSLATIONAL, I=90, J=91\n"
      "VARIABLE/1, FUNCTION=CVCV(1,1,3,0)\nVARIABLE/2, FUNCTION=1.2*ACCY(30)-SPDP(2,0,3,0)\n"
      "VARIABLE/3, FUNCTION=-FY(29,39,0)\nVARIABLE/4, FUNCTION=VZ(90)*CVCV(1,0,3,0)\n"
      "VARIABLE/5, FUNCTION=CVCV(1,0,8,0)\nVARIABLE/6, FUNCTION=CVCV(1,1,2,30)\nVARIABLE/7, FUNCTION=0\n"
      "VARIABLE/8, FUNCTION=FY(39,0,30)-SPDP(2,0,3,0)\n"
      "PINPUT/1, VARIABLES=7\nPOUTPUT/1, VARIABLES=1,2,3,4,5,6,8\n";
  const RunResult r =
      run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + cam_model.text(Matrix3::identity(), {}, more) + "END\n",
          "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto C = r.matrix(0, "C");
  double largest = 0;
  for (std::size_t k = 0; k < C[0].size(); ++k) {
    EXPECT_NEAR(C[0][k], C[1][k], 1e-10);
    EXPECT_NEAR(C[0][k], C[2][k], 1e-10);
    EXPECT_NEAR(C[4][k], 0, 1e-10);  // no torque at the contact
    EXPECT_NEAR(C[5][k], 0, 1e-10);  // no force along the flat follower
    largest = std::max(largest, std::abs(C[0][k]));
  }
  // δN = m δy″ + ks δy with δy = L′ δθ and δθ″ = −ω² δθ.
  const double w = cam_model.frequency();
  EXPECT_NEAR(largest, std::abs(cam_model.slope() * (cam_model.ks - cam_model.m * w * w)), 1e-10);
  // The spring pushes the follower down on the cam.
  double factor = 0;
  for (const double c : C[3]) factor += c;
  EXPECT_NEAR(factor, -cam_model.force(), 1e-10);
}

TEST_F(CurveCases, starts_where_and_as_fast_as_it_is_asked) {
  // C holds a reading as the factor of the rate of an idle part.
  const auto reading = [&](const std::string& ptcv, const std::string& output) {
    const RunResult r =
        run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=0,0.5,0, REULER=90D,0,0\nMARKER/3, QP=0,0.5,0\n"
            "MARKER/9, FLOATING\n" +
                parabola(1, 1.7) +
                "POINT_MASS/2, MASS=3, CM=2, QG=0,0.5,0\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1" + ptcv +
                "\nVARIABLE/9, FUNCTION=0\nPART/9, MASS=1, CM=90, IP=1,1,1\nMARKER/90\nMARKER/91, PART=1\nJOINT/9, "
                "TRANSLATIONAL, I=90, J=91\nVARIABLE/1, FUNCTION=(" +
                output + ")*VZ(90)\nPINPUT/1, VARIABLES=9\nPOUTPUT/1, VARIABLES=1\nEND\n",
            "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
    EXPECT_EQ(r.status, 0) << r.err;
    double largest = 0;
    if (r.status == 0) {
      const auto C = r.matrix(0, "C");
      for (const double c : C[0]) largest = std::abs(c) > std::abs(largest) ? c : largest;
    }
    return largest;
  };
  const double x = 0.3, y = 1.7 * 0.09, along = std::sqrt(1 + 4 * 1.7 * 1.7 * x * x);
  const std::string there = fmt::format(", DISP={:.17g},{:.17g},0", x, y);
  EXPECT_NEAR(reading("", "1+DX(2,1,1)"), 1, 1e-13);
  EXPECT_NEAR(reading(there, "DX(2,1,1)"), x, 1e-12);
  EXPECT_NEAR(reading(there, "DY(9,1,1)"), y, 1e-12);  // the floating marker is there too
  EXPECT_NEAR(reading(there + ", VEL=2", "VX(2,1,1)"), 2 / along, 1e-12);
  EXPECT_NEAR(reading(", VEL=-3", "VX(2,1,1)"), -3, 1e-12);
  // The same point in the axes of marker 3, which is turned back: x there is −y of marker 1.
  EXPECT_NEAR(reading(fmt::format(", ICM=3, DISP={:.17g},{:.17g},0", -y, x), "DX(2,1,1)"), x, 1e-12);
}

TEST_F(CurveCases, contact_beyond_an_open_end_is_an_error) {
  const RunResult r =
      run("Curves\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=5,0,0\nMARKER/9, "
          "PART=1, FLOATING\n" +
              parabola(1, -0.1) +
              "POINT_MASS/2, MASS=3, CM=20, QG=0.9,0,0\nMARKER/20\nPTCV/1, I=20, JFLOAT=9, CURVE=1, "
              "RM=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K=100\nEND\n",
          "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("PTCV/1 lies beyond the end of its open curve"), std::string::npos) << r.err;
}

TEST_F(CurveCases, function_curve_reads_points_and_slopes) {
  // A spring as stiff as the slope of the curve at half its way, with its sign.
  const double frequency_found =
      frequency("MARKER/1\n" + bow.curve(4, 6) +
                "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\nMARKER/21\nSFORCE/1, "
                "TRANSLATIONAL, ACTIONONLY, I=20, J=20, FUNCTION=-30*(CURVE(0.5+DZ(20),0,3,4)-CURVE(0.5,0,3,4))"
                "-DZ(20)*CURVE(0.25,2,2,4)\n");
  const double stiffness = 30 * bow.slope(0.5).z + (2 * 0.3 + 6 * 0.1 * 0.25);
  EXPECT_NEAR(frequency_found, std::sqrt(stiffness / 2), 1e-11);
}

}  // namespace
}  // namespace dynalin::cases::curve_test
