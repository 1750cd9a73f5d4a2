// Static equilibria that are hard to find, or are none.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::statics_test {
namespace {

using ::testing::HasSubstr;

// A pendulum in its place of rest.
const std::string hanging =
    "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG=0,-1,0\nMARKER/20\nMARKER/21, QP=0,1,0\n"
    "JOINT/1, REVOLUTE, I=21, J=1\n";

class Statics : public Cases {
 protected:
  RunResult rest(const std::string& elements, const std::string& gravity = "JGRAV=-9.81") const {
    return run("Statics\nUNITS/SYSTEM=MKS\nACCGRAV/" + gravity + "\nPART/1, GROUND\nMARKER/1\n" + elements + "END\n",
               "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
  }
};

TEST_F(Statics, a_pendulum_falls_and_hangs_also_from_almost_upright) {
  for (const double lean : {0.001, 0.3, 0.8, 1.0}) {
    const double up = std::sqrt(1 - lean * lean);
    const RunResult r =
        rest(fmt::format("PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG={0:.17g},{1:.17g},0\nMARKER/20\nMARKER/21, "
                         "QP=-{0:.17g},-{1:.17g},0\n"
                         "JOINT/1, REVOLUTE, I=21, J=1\n",
                         lean, up));
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("nothing grows"));
    EXPECT_GT(r.eigenvalues(1)[0].imag(), 0.4);
  }
}

TEST_F(Statics, exactly_upright_it_stays_and_is_called_unstable) {
  const RunResult r = rest(
      "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG=0,1,0\nMARKER/20\nMARKER/21, QP=0,-1,0\nJOINT/1, REVOLUTE, I=21, "
      "J=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("unstable: 1 mode grows"));
  EXPECT_THAT(r.message, HasSubstr("unstable: 1 mode grows"));
}

TEST_F(Statics, a_spring_that_is_slack_at_first_takes_the_load) {
  const RunResult r = rest(
      "PART/2, MASS=2, CM=20, IP=1,1,1, QG=0,-0.5,0\nMARKER/20\nMARKER/2, PART=1, REULER=0,90D,0\nMARKER/22, "
      "REULER=0,90D,0\nJOINT/1, TRANSLATIONAL, I=22, J=2\n"
      "SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=-MAX(0,100*(DM(20,1)-1))\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(r.eigenvalues(1)[0].imag(), std::sqrt(50.0) / (2 * 3.14159265358979), 1e-8);
}

TEST_F(Statics, what_floats_freely_is_named) {
  const RunResult r = rest("PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("PART/2"));
}

TEST_F(Statics, without_load_a_free_part_rests_where_it_is) {
  const RunResult r = rest("PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n", "JGRAV=0");
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(Statics, an_integrator_with_an_input_that_does_not_vanish_is_named) {
  const RunResult r = rest(hanging + "DIFF/7, FUNCTION=2+AZ(21,1)\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("DIFF/7"));
  const RunResult held = rest(hanging + "DIFF/7, STATIC_HOLD, FUNCTION=2+AZ(21,1)\n");
  EXPECT_EQ(held.status, 0) << held.err;
}

TEST_F(Statics, motions_hold_their_value_and_motions_of_velocity_are_refused) {
  const std::string body =
      "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG=1,0,0\nMARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, "
      "J=1\nPART/3, MASS=1, CM=30, IP=0.1,0.1,0.1, QG=2,0,0\nMARKER/30\nMARKER/31, QP=-1,0,0\nJOINT/2, REVOLUTE, I=31, "
      "J=20\n";
  const RunResult r = rest(body + "MOTION/1, JOINT=1, FUNCTION=0.7+TIME\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.eigenvalues(1).size(), 2u);
  const RunResult refused = rest(body + "MOTION/1, JOINT=1, VELOCITY, FUNCTION=1\n");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("MOTION/1"));
}

TEST_F(Statics, stiff_bushings_and_beams_far_from_the_origin_come_to_rest) {
  // Parts in a row, 40 m out; every part rests on its neighbour and no joint carries anything.
  std::string s = "MARKER/2, PART=1, QP=40,0,0\n";
  for (int k = 1; k <= 12; ++k) {
    const double x = 40 + 0.2 * k;
    s += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, IP=0.2,0.3,0.4, QG={1:.17g},0,0\nMARKER/{0}0\nMARKER/{0}1, "
        "QP=0.1,0.05,0\nMARKER/{0}2, QP=-0.1,0.05,0\n",
        k + 1, x);
    const std::string j = k == 1 ? "2" : fmt::format("{}1", k);
    if (k % 2) {
      s += fmt::format("BUSHING/{0}, I={1}2, J={2}, K=3E8,2E8,3E8, KT=1E6,2E6,3E6\n", k, k + 1, j);
    } else {
      s += fmt::format(
          "MARKER/{0}3, PART={0}, QP=0.1,0,0\nBEAM/{1}, I={2}0, J={0}3, LENGTH=0.1, AREA=1E-3, IXX=1E-6, IYY=1E-6, "
          "IZZ=1E-6, EMOD=2.1E11, GMOD=8E10\n",
          k, k, k + 1);
    }
  }
  const RunResult r = rest(s, "KGRAV=-9.81");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("nothing grows"));
  EXPECT_EQ(r.eigenvalues(1).size(), 144u);
  // It does not go on when the rounding of stiff elements is all that is left.
  const auto count = r.out.find("static equilibrium after ");
  ASSERT_NE(count, std::string::npos);
  EXPECT_LT(std::stoi(r.out.substr(count + 25)), 60);
}

TEST_F(Statics, redundant_joints_carry_the_load_all_the_same) {
  const std::string one =
      "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG=1,0,0\nMARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, "
      "J=1\n";
  const RunResult single = rest(one),
                  twice = rest(one +
                               "MARKER/22, QP=-1,0,0.5\nMARKER/2, PART=1, QP=0,0,0.5\nJOINT/2, REVOLUTE, I=22, J=2\n");
  ASSERT_EQ(single.status, 0) << single.err;
  ASSERT_EQ(twice.status, 0) << twice.err;
  expect_same(single.eigenvalues(1), twice.eigenvalues(1), 1e-10);
}

// A point mass in a field that turns it round: from everywhere else a damped motion runs into a cycle.
TEST_F(Statics, an_equilibrium_inside_a_limit_cycle_is_found_and_called_unstable) {
  const std::string u = "(DX(30,1)-0.2)", v = "(DY(30,1)+0.1)", r = "(1-" + u + "**2-" + v + "**2)";
  const RunResult run = rest(
      "POINT_MASS/3, MASS=1, CM=30, QG=0.9,0.4,0\nMARKER/30, POINT_MASS=3\nMARKER/9, PART=1, "
      "FLOATING\nVFORCE/1, I=30, JFLOAT=9, RM=1, FX=" +
          u + "*" + r + "-3*" + v + "\\, FY=" + v + "*" + r + "+3*" + u + "\\, FZ=-DZ(30,1)\n",
      "JGRAV=0");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("unstable"));
  // λ² = 1 ± 3i about the centre, −1 across.
  const std::complex<double> root = std::sqrt(std::complex<double>(1, 3)) / (2 * 3.14159265358979);
  double nearest = 1;
  for (const auto& e : run.eigenvalues(1)) nearest = std::min(nearest, std::abs(e - root));
  EXPECT_LT(nearest, 1e-9);
}

// z′ = z³ − 3z + 4 is least in size at z = 1, where it is 2, on the way from 0.9 to its only zero.
TEST_F(Statics, a_state_passes_the_fold_that_is_in_its_way) {
  const RunResult r = rest(hanging + "DIFF/7, IC=0.9, FUNCTION=DIF(7)**3-3*DIF(7)+4\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const double z = -std::cbrt(2 + std::sqrt(3.0)) - std::cbrt(2 - std::sqrt(3.0));  // Cardano
  EXPECT_NEAR(r.eigenvalues(1)[0].real(), (3 * z * z - 3) / (2 * 3.14159265358979), 1e-9);
}

TEST_F(Statics, a_state_that_cannot_rest_is_named) {
  const RunResult r = rest(hanging + "DIFF/7, IC=0.3, FUNCTION=DIF(7)**2+1\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("DIFF/7"));
}

TEST_F(Statics, parts_that_hold_each_other_but_not_to_ground_are_named_with_their_weight) {
  const RunResult r = rest(
      "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\nPART/3, MASS=3, CM=30, IP=1,1,1, QG=1,0,0\nMARKER/30\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=30, K=100, LENGTH=0.8\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("nothing holds PART/2, PART/3 against the force (0, -49.05, 0)"));
}

TEST_F(Statics, a_slide_on_an_incline_is_pushed_along_it) {
  const RunResult r = rest(
      "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\nMARKER/22, REULER=120D,90D,0\nMARKER/2, PART=1, "
      "REULER=120D,90D,0\nJOINT/1, TRANSLATIONAL, I=22, J=2\n");
  EXPECT_EQ(r.status, 2);
  // z of the markers is (sin 120°, −cos 120°, 0), 30° above x: of the weight m g sin 30° is left.
  EXPECT_THAT(r.err, HasSubstr("nothing holds PART/2 against the force (-8.4957, -4.905, 0)"));
}

TEST_F(Statics, a_torque_turns_a_pendulum_as_far_as_its_weight_allows) {
  const auto driven = [&](double torque) {
    return rest(hanging + fmt::format("SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION={}\n", torque));
  };
  const RunResult held = driven(8);
  ASSERT_EQ(held.status, 0) << held.err;
  EXPECT_THAT(held.out, HasSubstr("nothing grows"));
  const double stiffness = std::sqrt(9.81 * 9.81 - 64);  // m g l cos θ with sin θ = T / m g l
  EXPECT_NEAR(held.eigenvalues(1)[0].imag(), std::sqrt(stiffness / 1.1) / (2 * 3.14159265358979), 1e-9);
  const RunResult spun = driven(11);
  EXPECT_EQ(spun.status, 2);
  EXPECT_THAT(spun.err, HasSubstr("PART/2"));
}

// Contacts that are open as drawn, and that what falls meets at a slant: a ball on a vertical guide over a plane that
// is inclined by 45 degrees bears N cos 45° = m g by N = k p^e, and a free one rolls away.
TEST_F(Statics, inclined_surfaces_below_are_met) {
  const auto ball = [](const char* guide) {
    return std::string(
               "Ball\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\n"
               "MARKER/5, REULER=90D,45D,0\nGRAPHICS/5, PLANE, RM=5, XMIN=-5, XMAX=5, YMIN=-5, YMAX=5\n"
               "PART/2, MASS=1, CM=20, IP=0.004,0.004,0.004, QG=0,0,0.15\nMARKER/20\nMARKER/21\n"
               "GRAPHICS/2, ELLIPSOID, CM=20, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n"
               "CONTACT/1, IGEOM=2, JGEOM=5, IMPACT, STIFFNESS=1E6, EXPONENT=1.5, DAMPING=1000, DMAX=0.0001\n") +
           guide + "END\n";
  };
  const RunResult held =
      run(ball("JOINT/1, TRANSLATIONAL, I=21, J=1\nREQUEST/1, F2=DZ(20,1)\\\n"), "SIMULATE/STATICS\n");
  ASSERT_EQ(held.status, 0) << held.err;
  const double p = std::pow(10 * std::numbers::sqrt2 / 1e6, 1 / 1.5);
  EXPECT_NEAR(held.result(0).at("operating_point").at("requests").at(0).at("values").at(0).get<double>(),
              (0.1 - p) * std::numbers::sqrt2, 1e-12);
  const RunResult loose = run(ball(""), "SIMULATE/STATICS\n");
  EXPECT_EQ(loose.status, 2);
  EXPECT_THAT(loose.err, HasSubstr("no equilibrium was found"));
}

// Values begin at 0, where what reads them may have none: quotients, roots and logarithms of VARIABLEs, of entries of
// an ARRAY, of one that is the root of another one, whatever the order of the statements.
TEST_F(Statics, values_are_there_before_what_reads_them) {
  const std::string block =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\nARRAY/1, U, VARIABLES=1\n";
  const auto force = [&](const std::string& factor) {
    return "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-100*DZ(20,1)*" + factor + "\n";
  };
  for (const auto& [values, factor] :
       {std::pair<std::string, std::string>{"VARIABLE/1, FUNCTION=SQRT(4+DZ(20,1)**2)\n", "(2/VARVAL(1))"},
        {"VARIABLE/1, FUNCTION=1000\n", "SQRT(VARVAL(1)-999)"},
        {"VARIABLE/1, FUNCTION=EXP(1)\n", "LOG(VARVAL(1))"},
        {"VARIABLE/1, FUNCTION=2\n", "(2/ARYVAL(1,1))"},
        {"VARIABLE/2, FUNCTION=SQRT(VARVAL(1)-1)/VARVAL(1)\nVARIABLE/1, FUNCTION=2\n", "(0.5/VARVAL(2))"},
        {"VARIABLE/1, FUNCTION=VARVAL(2)-2\nVARIABLE/2, FUNCTION=3+0*VARVAL(1)\n", "(1/VARVAL(1))"}}) {
    const std::string variable = values.find("/1,") == std::string::npos ? "VARIABLE/1, FUNCTION=2\n" : "";
    const RunResult r = rest(block + force(factor) + variable + values, "KGRAV=-10");
    ASSERT_EQ(r.status, 0) << factor << r.err;
    EXPECT_NEAR(std::abs(r.eigenvalues(1)[0].imag()), 10 / (2 * std::numbers::pi), 0.01) << factor;
  }
  // One that has none at any value still says so.
  const RunResult r = rest(block + force("SQRT(-1-VARVAL(1))") + "VARIABLE/1, FUNCTION=2\n", "KGRAV=-10");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("SFORCE/1: SQRT of -3"));
}

}  // namespace
}  // namespace dynalin::cases::statics_test
