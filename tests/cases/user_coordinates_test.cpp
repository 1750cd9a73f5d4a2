// PSTATE: which coordinates of the user are taken, and what functions of positions and time they may be. Matrices are
// compared with transformations and models written down here.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::user_coordinates_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

constexpr double pi = std::numbers::pi;

class UserCoordinates : public Cases {
 protected:
  static Matrix dense(const std::vector<std::vector<double>>& rows) {
    Matrix m(static_cast<Index>(rows.size()), static_cast<Index>(rows.empty() ? 0 : rows.front().size()));
    for (Index r = 0; r < m.rows(); ++r) {
      for (Index c = 0; c < m.cols(); ++c) m(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    }
    return m;
  }
  static void expect_matrix(const Matrix& a, const Matrix& b, double relative) {
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.cols(), b.cols());
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), relative * b.cwiseAbs().maxCoeff()) << a << "\n\nagainst\n\n" << b;
  }

  // A crank of length 1 at `angle` from the line of the slider, a connecting rod of length 3; springs hold the slider
  // and the crank. Marker 41 is the slider's.
  static std::string slider_crank(double angle, const std::string& more) {
    const double x = std::cos(angle), y = std::sin(angle), rod = -std::asin(y / 3), end = x + 3 * std::cos(rod);
    return fmt::format(
        "Slider-crank\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=6,0,0\nMARKER/3, REULER=90D,90D,0D\n"
        "PART/2, MASS=1, CM=20, IP=0.2,0.2,0.2, REULER={0:.17g},0,0\nMARKER/20, QP=0.5,0,0\nMARKER/21\n"
        "MARKER/22, QP=1,0,0\nPART/3, MASS=2, CM=30, IP=1,1,1, QG={1:.17g},{2:.17g},0, REULER={3:.17g},0,0\n"
        "MARKER/30, QP=1.5,0,0\nMARKER/31\nMARKER/32, QP=3,0,0\nPART/4, MASS=3, CM=41, IP=1,1,1, QG={4:.17g},0,0\n"
        "MARKER/41\nMARKER/42, REULER=90D,90D,0D\nMARKER/43\nJOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, SPHERICAL, I=31, "
        "J=22\n"
        "JOINT/3, HOOKE, I=32, J=44\nMARKER/44, PART=4, REULER=0,90D,0\nJOINT/4, TRANSLATIONAL, I=42, J=3\n"
        "SPRINGDAMPER/1, TRANSLATIONAL, I=41, J=2, K=50, C=1, LENGTH={5:.17g}\n"
        "SPRINGDAMPER/2, ROTATIONAL, I=21, J=1, KT=30, CT=0.5, ANGLE={0:.17g}\n{6}END\n",
        angle, x, y, rod, end, 6 - end, more);
  }
};

TEST_F(UserCoordinates, a_slider_near_its_dead_point_is_taken_though_it_hardly_moves) {
  for (const double angle : {1.0, 0.05, 1e-4}) {
    const RunResult r = run(slider_crank(angle, "VARIABLE/1, FUNCTION=DX(41)\nPSTATE/1, VARIABLES=1\n"),
                            "SIMULATE/STATIC\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, PSTATE=1\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.labels(2)[1], "PSTATE VARIABLE VAR/1 DX(41)") << angle;
    // At rest eigenvalues do not know coordinates; a slider that moves 1e-4 of the crank loses as many digits.
    expect_same(r.eigenvalues(1), r.eigenvalues(2), 1e-9);
  }
}

TEST_F(UserCoordinates, a_slider_at_its_dead_point_is_refused_as_constant) {
  const RunResult r =
      run(slider_crank(0, "VARIABLE/1, FUNCTION=DX(41)\nPSTATE/1, VARIABLES=1\n"), "LINEAR/EIGENSOL, PSTATE=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.labels(0)[1], Not(HasSubstr("PSTATE")));
  EXPECT_THAT(r.err, HasSubstr("VAR/1 DX(41) was not taken: the constraints keep it constant here"));
}

TEST_F(UserCoordinates, one_that_is_nearly_constant_is_taken_with_its_size) {
  const RunResult r = run(slider_crank(1e-7, "VARIABLE/1, FUNCTION=DX(41)\nPSTATE/1, VARIABLES=1\n"),
                          "LINEAR/STATEMAT, FILE=a, PSTATE=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(0)[1], "PSTATE VARIABLE VAR/1 DX(41)");
  EXPECT_THAT(r.err, HasSubstr("VAR/1 DX(41) is nearly constant: only "));
}

// Two arms in a row on hinges about z, the second short.
std::string double_pendulum(const std::string& more) {
  return "Double pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, "
         "IP=1,1,1, REULER=0.2,0,0\nMARKER/20, QP=0,-1,0\nMARKER/21\nMARKER/22, QP=0,-2,0\n"
         "PART/3, MASS=1, CM=30, IP=0.3,0.3,0.3, QG=0.39733866159012243,-1.9601331556824833,0, REULER=-0.3,0,0\n"
         "MARKER/30, QP=0,-0.05,0\nMARKER/31\nJOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n"
         "SPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT=90, CT=0.1, ANGLE=0.7\nSPRINGDAMPER/2, ROTATIONAL, I=31, J=22, "
         "KT=2, CT=0.2\n" +
         more + "END\n";
}

TEST_F(UserCoordinates, any_admissible_coordinates_give_the_same_eigenvalues_at_rest) {
  const std::string variables =
      "VARIABLE/1, FUNCTION=AZ(31,22)\nVARIABLE/2, FUNCTION=DX(30)\nVARIABLE/3, FUNCTION=DY(22)\n"
      "VARIABLE/4, FUNCTION=DX(30)+DY(22)\nVARIABLE/5, FUNCTION=DX(22)*DY(30)\n"
      "VARIABLE/6, FUNCTION=SIN(VARVAL(1))*DM(30,1)\nVARIABLE/7, FUNCTION=2*AZ(21,1)-VARVAL(1)+0.1*VARVAL(5)\n"
      "VARIABLE/8, FUNCTION=DX(30,22)\n";
  std::string lists, commands = "SIMULATE/STATIC\nLINEAR/EIGENSOL\n";
  const std::vector<std::string> choices = {"1", "2", "3,1", "4,1", "5,7", "6,4", "7,6", "8", "8,5", "1,2,3,4,5,6,7,8"};
  for (std::size_t k = 0; k < choices.size(); ++k) {
    lists += fmt::format("PSTATE/{}, VARIABLES={}\n", k + 1, choices[k]);
    commands += fmt::format("LINEAR/EIGENSOL, PSTATE={}\n", k + 1);
  }
  const RunResult r = run(double_pendulum(variables + lists), commands);
  ASSERT_EQ(r.status, 0) << r.err;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    SCOPED_TRACE(choices[k]);
    expect_same(r.eigenvalues(1), r.eigenvalues(k + 2), 1e-9);
    EXPECT_EQ(r.labels(k + 2)[1].substr(0, 20), "PSTATE VARIABLE VAR/" + std::string());
    EXPECT_EQ(r.labels(k + 2)[1].substr(20, 1), choices[k].substr(0, 1));
    // Both places go to the user where two are stated.
    EXPECT_EQ(r.labels(k + 2)[3].substr(0, 6) == "PSTATE", choices[k].size() > 1);
  }
}

TEST_F(UserCoordinates, a_refused_coordinate_names_those_it_depends_on) {
  const RunResult r =
      run(double_pendulum("VARIABLE/1, FUNCTION=AZ(21,1)\nVARIABLE/2, FUNCTION=DX(22)\nVARIABLE/3, FUNCTION=AZ(31,22)\n"
                          "VARIABLE/4, FUNCTION=AZ(31)\nVARIABLE/5, FUNCTION=DZ(30)\nVARIABLE/6, FUNCTION=DZ(1)\n"
                          "PSTATE/1, VARIABLES=1,2,6,3,4,5\n"),
          "LINEAR/EIGENSOL, PSTATE=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("VAR/2 DX(22) was not taken: it depends on VAR/1 [dependent-coordinate]\n"));
  EXPECT_THAT(r.err, HasSubstr("VAR/4 AZ(31) was not taken: it depends on VAR/1, VAR/3 [dependent-coordinate]\n"));
  EXPECT_THAT(r.err, HasSubstr("VAR/5 DZ(30) was not taken: the constraints keep it constant here"));
  EXPECT_THAT(r.err, HasSubstr("VAR/6 DZ(1) was not taken: it is constant"));
}

TEST_F(UserCoordinates, an_angle_between_coordinates_of_a_joint_is_taken) {
  // A ball joint: AY of the joint although the part's own rotations would do, and a hinge far from the axes.
  const RunResult r =
      run("Ball\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,2,1.5\n"
          "MARKER/20, QP=0.1,-1,0.1\nMARKER/21\nJOINT/1, UNIVERSAL, I=21, J=2\nMARKER/2, PART=1, REULER=0,90D,0\n"
          "BUSHING/1, I=21, J=1, KT=30,40,50, CT=1,1,1\nVARIABLE/1, FUNCTION=AY(21,1)\nVARIABLE/2, FUNCTION=DX(20)\n"
          "PSTATE/1, VARIABLES=1\nPSTATE/2, VARIABLES=2,1\nEND\n",
          "SIMULATE/STATIC\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, PSTATE=1\nLINEAR/EIGENSOL, PSTATE=2\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(2)[1], "PSTATE VARIABLE VAR/1 AY(21,1)");
  expect_same(r.eigenvalues(1), r.eigenvalues(2), 1e-10);
  EXPECT_EQ(r.labels(3)[1], "PSTATE VARIABLE VAR/2 DX(20)");
  expect_same(r.eigenvalues(1), r.eigenvalues(3), 1e-10);
}

// A point in the plane on springs, far from rest: x″ = −kx x/m, y″ = −ky y/m + g.
struct Point {
  double m = 2, kx = 30, ky = 50, g = -3, x = 0.7, y = -0.4, u = 1.3, v = -2.1;

  std::string dataset(const std::string& function) const {
    return fmt::format(
        "Point\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV={}\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS={}, CM=20, "
        "QG={},{},0, VX={}, VY={}, VZ=0\nMARKER/20, POINT_MASS=2\nJPRIM/1, INPLANE, I=20, J=1\n"
        "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=3, FUNCTION=-{}*DX(20)\nMARKER/3, PART=1, REULER=90D,90D,0D\n"
        "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=20, J=4, FUNCTION=-{}*DY(20)\nMARKER/4, PART=1, REULER=180D,90D,0D\n"
        "{}PSTATE/1, VARIABLES=1,2\nEND\n",
        g, m, x, y, u, v, kx, ky, function);
  }
  // Of coordinates with gradient F along the motion: A = (T A₀ + T′) T⁻¹ with T of the states (s₁′, s₁, s₂′, s₂).
  Matrix transformed(const Eigen::Matrix2d& F, const Eigen::Matrix2d& F1, const Eigen::Matrix2d& F2) const {
    Matrix A0 = Matrix::Zero(4, 4), T(4, 4), rate(4, 4);
    A0(0, 2) = -kx / m, A0(1, 3) = -ky / m, A0(2, 0) = A0(3, 1) = 1;  // (x′, y′, x, y)
    T << F, F1, Matrix::Zero(2, 2), F;
    rate << F1, F2, Matrix::Zero(2, 2), F1;
    const Matrix A = (T * A0 + rate) * T.inverse();  // (s₁′, s₂′, s₁, s₂)
    const std::vector<Index> order = {0, 2, 1, 3};
    return A(order, order);
  }
};

TEST_F(UserCoordinates, sums_and_products_of_moving_coordinates_transform_as_by_hand) {
  const Point p;
  const double ax = -p.kx * p.x / p.m, ay = -p.ky * p.y / p.m + p.g;
  Eigen::Matrix2d F, F1, F2;
  // s₁ = x + y, s₂ = x y
  F << 1, 1, p.y, p.x;
  F1 << 0, 0, p.v, p.u;
  F2 << 0, 0, ay, ax;
  const RunResult r = run(p.dataset("VARIABLE/1, FUNCTION=DX(20)+DY(20)\nVARIABLE/2, FUNCTION=DX(20)*VARVAL(3)\n"
                                    "VARIABLE/3, FUNCTION=DY(20)\n"),
                          "LINEAR/STATEMAT, FILE=a, PSTATE=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(0)[1], "PSTATE VARIABLE VAR/1 DX(20)+DY(20)");
  EXPECT_EQ(r.labels(0)[3], "PSTATE VARIABLE VAR/2 DX(20)*VARVAL(3)");
  expect_matrix(dense(r.matrix(0, "A")), p.transformed(F, F1, F2), 1e-13);
}

TEST_F(UserCoordinates, explicit_time_and_chains_of_variables_transform_as_by_hand) {
  const Point p;
  const double ax = -p.kx * p.x / p.m, ay = -p.ky * p.y / p.m + p.g, w = 5, phi = 0.3;
  // The frame that turns with the angle ψ = w t + φ: s₁ = c x + s y, s₂ = (c y − s x)·(1 + x²), ψ and the parts of s₂
  // as VARIABLEs, one of them used twice.
  const double c = std::cos(phi), s = std::sin(phi);
  const auto e = [&](double x) { return 1 + x * x; };
  const double b = c * p.y - s * p.x;                                           // turned y
  const double b1 = c * p.v - s * p.u - w * (s * p.y + c * p.x);                // its rate
  const double b2 = c * ay - s * ax - 2 * w * (s * p.v + c * p.u) - w * w * b;  // and again
  const double e0 = e(p.x), e1 = 2 * p.x * p.u, e2 = 2 * (p.u * p.u + p.x * ax);
  Eigen::Matrix2d F, F1, F2;
  const double sw = w * s, cw = w * c, s2 = w * w * s, c2 = w * w * c;
  // ∂s₂/∂x = −s e + 2 x b, ∂s₂/∂y = c e
  F << c, s, -s * e0 + 2 * p.x * b, c * e0;
  F1 << -sw, cw, -cw * e0 - s * e1 + 2 * (p.u * b + p.x * b1), -sw * e0 + c * e1;
  F2 << -c2, -s2, s2 * e0 - 2 * cw * e1 - s * e2 + 2 * (ax * b + 2 * p.u * b1 + p.x * b2),
      -c2 * e0 - 2 * sw * e1 + c * e2;
  const RunResult r = run(
      p.dataset("VARIABLE/5, FUNCTION=5*TIME+0.3\nVARIABLE/1, FUNCTION=COS(VARVAL(5))*DX(20)+SIN(VARVAL(5))*DY(20)\n"
                "VARIABLE/2, FUNCTION=VARVAL(6)+VARVAL(6)*DX(20)**2\n"
                "VARIABLE/6, FUNCTION=DY(20)*COS(VARVAL(5))-DX(20)*SIN(VARVAL(5))\n"),
      "LINEAR/STATEMAT, FILE=a, PSTATE=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_matrix(dense(r.matrix(0, "A")), p.transformed(F, F1, F2), 1e-13);
}

TEST_F(UserCoordinates, what_is_no_smooth_function_of_positions_and_time_is_refused_with_its_place) {
  const std::string model = double_pendulum(
      "DIFF/1, FUNCTION=-DIF(1)+DX(30)\n"
      "VARIABLE/1, FUNCTION=VX(30)\nVARIABLE/2, FUNCTION=1+VARVAL(1)\nVARIABLE/3, FUNCTION=DX(30)+DIF(1)\n"
      "VARIABLE/4, FUNCTION=FX(31)\nVARIABLE/5, FUNCTION=ABS(DX(30))\nVARIABLE/6, FUNCTION=TIME\n"
      "VARIABLE/7, FUNCTION=DX(30)+0.1*VARVAL(7)\nVARIABLE/8, FUNCTION=2*VARVAL(5)\nVARIABLE/9, "
      "FUNCTION=SQRT(DZ(30))+DX(30)\nVARIABLE/10, FUNCTION=DX(30)+DM(31,22)\n"
      "VARIABLE/11, FUNCTION=IF(DX(30)-9: DX(30), 0, 1)\n"
      "PSTATE/1, VARIABLES=1\nPSTATE/2, VARIABLES=2\nPSTATE/3, VARIABLES=3\nPSTATE/4, VARIABLES=4\nPSTATE/5, "
      "VARIABLES=5\nPSTATE/6, VARIABLES=6\nPSTATE/7, VARIABLES=7\nPSTATE/8, VARIABLES=8\nPSTATE/9, "
      "VARIABLES=9\nPSTATE/10, VARIABLES=10\nPSTATE/11, VARIABLES=11\n");
  const std::vector<std::pair<int, std::vector<std::string>>> wrong = {
      {1, {"model.adm:18:22: VARIABLE/1", "reads VX(30), a velocity"}},
      {2, {"model.adm:18:22: VARIABLE/2", "reads, through VARIABLE/1, VX(30), a velocity"}},
      {3, {"model.adm:20:29: VARIABLE/3", "reads DIF(1), a differential state"}},
      {4, {"model.adm:21:22: VARIABLE/4", "reads FX(31), a force"}},
      {5, {"model.adm:22:22: VARIABLE/5", "reads ABS(DX(30)), which is not smooth"}},
      {6, {"model.adm:23:22: VARIABLE/6", "does not depend on positions"}},
      {7, {"model.adm:24:33: VARIABLE/7", "depends on VARIABLE/7, which depends on itself"}},
      {8, {"model.adm:22:22: VARIABLE/8", "reads, through VARIABLE/5, ABS(DX(30)), which is not smooth"}},
      {9, {"model.adm:26:22: VARIABLE/9", "the derivative of SQRT is infinite at 0"}},
      {10, {"model.adm:27:30: VARIABLE/10", "reads DM(31,22), a distance that is zero"}},
      {11, {"model.adm:28:23: VARIABLE/11", "reads IF(DX(30)-9: DX(30), 0, 1), which is not smooth"}}};
  for (const auto& [pstate, texts] : wrong) {
    const RunResult r = run(model, fmt::format("LINEAR/EIGENSOL, PSTATE={}\n", pstate));
    EXPECT_EQ(r.status, 2) << pstate;
    for (const std::string& text : texts) EXPECT_THAT(r.err, HasSubstr(text)) << pstate;
  }
}

// A rotor on a support that can move sideways on springs: three blades on hinges with springs and dampers in the plane
// of rotation (the model of ground resonance).
struct Rotor {
  double hub = 40, blade = 6, R = 1.2, J = 2.5, e = 0.3, W = 18;
  double Kx = 9000, Ky = 14000, Cx = 120, Cy = 60, k = 150, c = 9;
  double azimuth = 0;

  std::string dataset() const {
    std::string s = fmt::format(
        "Rotor\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS={0}, CM=20, IP=1,1,1, VX=0, VY=0\n"
        "MARKER/20\nJPRIM/1, ORIENTATION, I=20, J=1\nJPRIM/2, INPLANE, I=20, J=1\n"
        "BUSHING/1, I=20, J=1, K={1},{2},0, C={3},{4},0, KT=0,0,0, CT=0,0,0\n"
        "PART/3, MASS=1, CM=30, IP=1,1,1, REULER={5:.17g},0,0, VX=0, VY=0, WZ={6}\nMARKER/30\n"
        "JOINT/1, REVOLUTE, I=30, J=20\nMOTION/1, JOINT=1, FUNCTION={6}*TIME+{5:.17g}\n",
        hub, Kx, Ky, Cx, Cy, azimuth, W);
    for (int b = 0; b < 3; ++b) {
      const double psi = azimuth + 2 * pi * b / 3;
      s += fmt::format(
          "PART/{0}, MASS={1}, CM={0}0, IP={2},{2},{2}, QG={3:.17g},{4:.17g},0, REULER={5:.17g},0,0, WZ={6}\n"
          "MARKER/{0}0, QP={7},0,0\nMARKER/{0}1\nMARKER/{0}2, PART=3, QP={8:.17g},{9:.17g},0, REULER={10:.17g},0,0\n"
          "JOINT/{0}, REVOLUTE, I={0}1, J={0}2\nSPRINGDAMPER/{0}, ROTATIONAL, I={0}1, J={0}2, KT={11}, CT={12}\n",
          4 + b, blade, J, e * std::cos(psi), e * std::sin(psi), psi, W, R, e * std::cos(2 * pi * b / 3),
          e * std::sin(2 * pi * b / 3), 2 * pi * b / 3, k, c);
      s += fmt::format("VARIABLE/{}, FUNCTION=AZ({}1,{}2)\n", 11 + b, 4 + b, 4 + b);
      s += fmt::format("VARIABLE/{}, FUNCTION={}*TIME+{:.17g}\n", 21 + b, W, psi);            // azimuth by time
      s += fmt::format("VARIABLE/{}, FUNCTION=AZ(30,20)+{:.17g}\n", 31 + b, 2 * pi * b / 3);  // and by position
    }
    for (const int of : {20, 30}) {
      s += fmt::format(
          "VARIABLE/{0}1, FUNCTION=(VARVAL(11)+VARVAL(12)+VARVAL(13))/3\n"
          "VARIABLE/{0}2, "
          "FUNCTION=2/3*(VARVAL(11)*COS(VARVAL({1}))+VARVAL(12)*COS(VARVAL({2}))+VARVAL(13)*COS(VARVAL({3})))\n"
          "VARIABLE/{0}3, "
          "FUNCTION=2/3*(VARVAL(11)*SIN(VARVAL({1}))+VARVAL(12)*SIN(VARVAL({2}))+VARVAL(13)*SIN(VARVAL({3})))\n"
          "VARIABLE/{0}4, FUNCTION=DX(20)\nVARIABLE/{0}5, FUNCTION=DY(20)\n"
          "PSTATE/{0}, VARIABLES={0}1,{0}2,{0}3,{0}4,{0}5\n",
          of, of + 1, of + 2, of + 3);
    }
    return s + "END\n";
  }

  // In (z₀, z_c, z_s, x, y): M q″ + C q′ + K q = 0, with the blade at the angle ζ against the hub's direction.
  Matrix by_hand() const {
    const double S = blade * R, I = J + blade * R * R, stiff = k + e * S * W * W;
    Matrix M = Matrix::Zero(5, 5), C = M, K = M;
    M(0, 0) = M(1, 1) = M(2, 2) = I;
    C(0, 0) = C(1, 1) = C(2, 2) = c;
    K(0, 0) = stiff;
    K(1, 1) = K(2, 2) = stiff - I * W * W;
    C(1, 2) = 2 * I * W, C(2, 1) = -2 * I * W;
    K(1, 2) = c * W, K(2, 1) = -c * W;
    M(1, 4) = S, M(2, 3) = -S;
    M(3, 3) = M(4, 4) = hub + 1 + 3 * blade;
    M(3, 2) = -1.5 * S, M(4, 1) = 1.5 * S;
    K(3, 3) = Kx, K(4, 4) = Ky, C(3, 3) = Cx, C(4, 4) = Cy;
    const Matrix on_rates = -M.partialPivLu().solve(C), on_places = -M.partialPivLu().solve(K);
    Matrix A = Matrix::Zero(10, 10);
    for (Index i = 0; i < 5; ++i) {
      A(2 * i + 1, 2 * i) = 1;
      for (Index j = 0; j < 5; ++j) A(2 * i, 2 * j) = on_rates(i, j), A(2 * i, 2 * j + 1) = on_places(i, j);
    }
    return A;
  }
};

TEST_F(UserCoordinates, a_rotor_in_multiblade_coordinates_has_one_matrix_at_every_azimuth) {
  for (const double azimuth : {0.0, 0.4, 1.7, 5.0}) {
    Rotor rotor;
    rotor.azimuth = azimuth;
    const RunResult r = run(rotor.dataset(),
                            "LINEAR/STATEMAT, FILE=a, PSTATE=20\nLINEAR/STATEMAT, FILE=b, PSTATE=30\n"
                            "LINEAR/EIGENSOL, PSTATE=20\nLINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.labels(0)[3], HasSubstr("PSTATE VARIABLE VAR/202 "));
    // Roundings of sines and of the pose are some 1e-16, the largest entry is 60 times the typical one.
    expect_matrix(dense(r.matrix(0, "A")), rotor.by_hand(), 1e-12);
    expect_matrix(dense(r.matrix(1, "A")), rotor.by_hand(), 1e-12);
    const Eigen::VectorXcd values = rotor.by_hand().eigenvalues() / (2 * pi);
    expect_same(r.eigenvalues(2), {values.begin(), values.end()}, 1e-10);
    // Frozen at the instant, the turning frame's matrix has other eigenvalues: the comparison means something.
    double apart = 0;
    for (const auto& v : r.eigenvalues(3)) apart = std::max(apart, (values.array() - v).abs().minCoeff());
    EXPECT_GT(apart, 1e-2);
  }
}

}  // namespace
}  // namespace dynalin::cases::user_coordinates_test
