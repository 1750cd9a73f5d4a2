// Points of motion that are hard to find, or to be refused: roots that all but coincide, forces of reactions, rows that
// contradict each other a little or on one level only, units and origins far from 1.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::initial_conditions_test {
namespace {

using InitialConditions = Cases;

constexpr const char* head = "Points\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";

// A unit mass on a slide along z, at height z, under a force.
std::string slide(int id, const std::string& force, const std::string& z = "0") {
  return fmt::format(
      "PART/{0}, MASS=1, CM={0}0, IP=1,1,1, QG=0,0,{2}\nMARKER/{0}0\nMARKER/9{0}, PART=1\n"
      "JOINT/{0}, TRANSLATIONAL, I={0}0, J=9{0}\n"
      "SFORCE/{0}, TRANSLATIONAL, ACTIONONLY, I={0}0, J=9{0}, FUNCTION={1}\n",
      id, force, z);
}

double slope_of(const RunResult& r, std::size_t k = 0) { return r.matrix(k, "A")[0][1]; }

// Whichever of the two is found not to hold, both are named, on each of the levels.
TEST_F(InitialConditions, name_both_that_contradict_each_other) {
  const std::string turned = "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n";
  for (const char* of_time : {"0.1", "3*TIME", "4*TIME**2"}) {
    const RunResult r = run(std::string(head) + turned + "MOTION/1, JOINT=1, ROTATION, FUNCTION=0\n" +
                                "MOTION/2, JOINT=1, ROTATION, FUNCTION=" + of_time + "\nEND\n",
                            "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("MOTION/1"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("MOTION/2"), std::string::npos) << r.err;
    EXPECT_EQ(r.err.find("the others"), std::string::npos) << r.err;
    EXPECT_EQ(r.err.find("JOINT/1"), std::string::npos) << r.err;
  }
  // A MOTION against a joint that holds what it moves.
  const RunResult r = run(std::string(head) + turned +
                              "MARKER/21, PART=2\nMARKER/3, PART=1\nJOINT/2, FIXED, I=21, J=3\n"
                              "MOTION/1, JOINT=1, ROTATION, FUNCTION=3*TIME\nEND\n",
                          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("MOTION/1"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("JOINT/2"), std::string::npos) << r.err;
}

// A crank that is drawn off its pin, driven at 3 rad/s from 2 rad/s that it starts with. Levels behind the last are as
// before, and the next analysis makes them.
TEST_F(InitialConditions, are_made_up_to_the_level_that_is_named) {
  const std::string crank =
      "Crank\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0.1,0,0, WZ=2\nMARKER/20, QP=1,0,0\nMARKER/21\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nEND\n";
  const RunResult whole = run(crank, "SIMULATE/INITIAL\n");
  ASSERT_EQ(whole.status, 0) << whole.err;
  const auto body = [](const RunResult& r, std::size_t k) { return r.result(k).at("operating_point").at("bodies")[0]; };
  const auto end = body(whole, 0);
  for (const bool velocity : {false, true}) {
    const RunResult r = run(crank, std::string("SIM/INITIAL, ") + (velocity ? "VELOCITY" : "DISPLACEMENT") +
                                       "\nSIMULATE/INITIAL\nSIM/INITIAL, DISP\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto first = body(r, 0);
    EXPECT_EQ(first.at("position"), end.at("position"));
    EXPECT_EQ(first.at("angular_velocity") == end.at("angular_velocity"), velocity);
    EXPECT_NE(first.at("angular_acceleration"), end.at("angular_acceleration"));
    EXPECT_EQ(r.result(0).at("operating_point").at("constraints")[0].at("multiplier"), 0);
    EXPECT_EQ(body(r, 1), end) << "made by the next analysis";
    EXPECT_EQ(body(r, 2), end) << "done already";
    const std::string said = r.message.substr(0, r.message.find("command: SIMULATE/INITIAL"));
    EXPECT_NE(said.find("End Displacement Initial Conditions"), std::string::npos);
    EXPECT_EQ(said.find("Velocity Initial Conditions") != std::string::npos, velocity);
    EXPECT_EQ(said.find("Acceleration Initial Conditions"), std::string::npos);
  }
}

// w = w²/4 + c − z has the roots 2 (1 ∓ √(1 − c + z)), and at z = 0 the slope dw/dz = −1/√(1 − c) at the lower one.
struct DoubleRoot {
  const char* c;
  double slope, tolerance;  // the rounding of w, ε/√(1 − c), beside 1 − w/2 = √(1 − c)
};
void PrintTo(const DoubleRoot& r, std::ostream* out) { *out << "c=" << r.c; }
class NearDoubleRoot : public Cases, public ::testing::WithParamInterface<DoubleRoot> {};

TEST_P(NearDoubleRoot, has_the_derivative_that_its_digits_allow) {
  const DoubleRoot& d = GetParam();
  const RunResult r =
      run(head + slide(2, "VARVAL(1)") + fmt::format("VARIABLE/1, FUNCTION=VARVAL(1)**2/4+{}-DZ(20,92)\nEND\n", d.c),
          "LIN/STATEMAT, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(slope_of(r), d.slope, d.tolerance * std::abs(d.slope));
  EXPECT_EQ(r.err.find("VARIABLE/1") != std::string::npos, d.tolerance > 1e-9) << r.err;
}
INSTANTIATE_TEST_SUITE_P(c, NearDoubleRoot,
                         ::testing::Values(DoubleRoot{"0.75", -2, 1e-14}, DoubleRoot{"0.99", -10, 1e-13},
                                           DoubleRoot{"0.9999", -100, 1e-11}, DoubleRoot{"0.99999999", -1e4, 1e-7},
                                           DoubleRoot{"0.9999999999", -1e5, 1e-5}));

TEST_F(InitialConditions, refuse_a_double_root_by_name) {
  for (const char* c : {"1", "0.999999999999999"}) {
    const RunResult r =
        run(head + slide(2, "VARVAL(1)") + fmt::format("VARIABLE/1, FUNCTION=VARVAL(1)**2/4+{}-DZ(20,92)\nEND\n", c),
            "LIN/EIG\n");
    EXPECT_EQ(r.status, 2) << c;
    EXPECT_NE(r.err.find("VARIABLE/1"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("multiple root"), std::string::npos) << r.err;
  }
}

TEST_F(InitialConditions, find_no_root_where_there_is_none) {
  const RunResult r =
      run(head + slide(2, "VARVAL(1)") + "VARIABLE/1, FUNCTION=VARVAL(1)**2/4+1.0001-DZ(20,92)\nEND\n", "LIN/EIG\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("VARIABLE/1"), std::string::npos) << r.err;
}

// u = 1 + u²/5 with w = 10⁻⁹ u has u = 5 (1 − √0.2)/2, and dw/dz = −10⁻⁹/√0.2 of a term −10⁻⁹ z.
TEST_F(InitialConditions, say_which_constraint_is_no_number) {
  const RunResult r =
      run(std::string(head) + "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nGCON/1, I=20, FUNCTION=1/DZ(20,1)\nEND\n",
          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("GCON/1: division by 0"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("iteration 0: a constraint is no finite number"), std::string::npos) << r.err;
}

TEST_F(InitialConditions, hold_for_the_smallest_value_beside_the_largest) {
  const RunResult r = run(head + slide(2, "1E15") + slide(3, "VARVAL(1)") +
                              "VARIABLE/1, FUNCTION=1E-9+VARVAL(1)**2*2E8-1E-9*DZ(30,93)\nEND\n",
                          "LIN/STATEMAT, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto A = r.matrix(0, "A");
  const auto labels = r.labels(0);
  double slope = 0;
  for (const auto& row : A) {
    for (const double x : row) slope = x < 0 ? x : slope;
  }
  EXPECT_NEAR(slope, -1e-9 / std::sqrt(0.2), 1e-22);
}

// The force of friction feeds on the acceleration of its own part: a = −2 + a²/4 − z has a = 2 − √12 at z = 0.
TEST_F(InitialConditions, hold_for_forces_of_the_acceleration_itself) {
  const RunResult r = run(head + slide(2, "-2+ACCZ(20)**2/4-DZ(20,92)") + "END\n", "LIN/STATEMAT, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(slope_of(r), -1 / (1 - (2 - std::sqrt(12.0)) / 2), 1e-14);
}

struct Contradiction {
  const char* text;
  const char* named;  // one of the rows, empty if they agree
};
void PrintTo(const Contradiction& c, std::ostream* out) {
  for (const char letter : std::string_view(c.text)) *out << (letter == '\n' ? '|' : letter);
}
class SecondDerivatives : public Cases, public ::testing::WithParamInterface<Contradiction> {};

TEST_P(SecondDerivatives, of_redundant_rows_have_to_agree) {
  const Contradiction& c = GetParam();
  const RunResult r =
      run(head + slide(2, "-4*DZ(20,92)") + slide(3, "-4*DZ(30,93)") + slide(4, "-4*DZ(40,94)") + c.text + "\nEND\n",
          "LIN/EIG\n");
  EXPECT_EQ(r.status, *c.named ? 2 : 0) << r.err;
  if (!*c.named) return;
  EXPECT_NE(r.err.find("contradict each other on accelerations"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find(c.named), std::string::npos) << r.err;
}
INSTANTIATE_TEST_SUITE_P(rows, SecondDerivatives,
                         ::testing::Values(Contradiction{"MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=0\n"
                                                         "MOTION/2, TRANSLATIONAL, JOINT=2, FUNCTION=5*TIME**2",
                                                         "MOTION/"},
                                           // However small beside the accelerations of other parts.
                                           Contradiction{"MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=0\n"
                                                         "MOTION/2, TRANSLATIONAL, JOINT=2, FUNCTION=5E-9*TIME**2\n"
                                                         "MOTION/3, TRANSLATIONAL, JOINT=3, FUNCTION=5E9*TIME**2",
                                                         "MOTION/"},
                                           Contradiction{"MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=5*TIME**2\n"
                                                         "MOTION/2, TRANSLATIONAL, JOINT=2, FUNCTION=(TIME*2)**2*1.25",
                                                         ""},
                                           Contradiction{"MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=0\n"
                                                         "GCON/2, FUNCTION=DZ(20,92)-5*TIME**2",
                                                         "/"},
                                           Contradiction{"MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=0\n"
                                                         "GCON/2, FUNCTION=VZ(20,92)-10*TIME",
                                                         "GCON/2"},
                                           Contradiction{"MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=TIME**2\n"
                                                         "MOTION/2, TRANSLATIONAL, JOINT=2, ACCELERATION, FUNCTION=3",
                                                         "MOTION/"},
                                           Contradiction{"COUPLER/1, JOINTS=2,3, TYPE=T:T, SCALES=1,-1\n"
                                                         "MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=0\n"
                                                         "MOTION/2, TRANSLATIONAL, JOINT=3, FUNCTION=5*TIME**2",
                                                         "/"}));

TEST_F(InitialConditions, velocities_of_redundant_rows_are_measured_in_their_own_size) {
  const RunResult r = run(head + slide(2, "0") + slide(3, "0") + slide(4, "-DZ(40,94)") +
                              "MOTION/1, TRANSLATIONAL, JOINT=2, FUNCTION=0\n"
                              "MOTION/2, TRANSLATIONAL, JOINT=2, FUNCTION=1E-6*TIME\n"
                              "MOTION/3, TRANSLATIONAL, JOINT=3, FUNCTION=1E4*TIME\nEND\n",
                          "LIN/EIG\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("contradict each other on velocities"), std::string::npos) << r.err;
}

// A pendulum, level, of mass 1 with its mass centre at the length 1 and the moment of inertia 2 about a bearing whose
// friction follows from its own load: α = −(g cos θ + 0.1 R tanh(100 ω))/2 with R² = (g sin θ − ω²)² + (α + g cos θ)².
long double friction_pendulum(long double angle, long double rate) {
  constexpr long double g = 9.81L;
  long double a = 0;
  for (int k = 0; k < 60; ++k) {
    const long double R = std::hypot(g * std::sin(angle) - rate * rate, a + g * std::cos(angle));
    a = -(g * std::cos(angle) + 0.1L * R * std::tanh(100 * rate)) / 2;
  }
  return a;
}

TEST_F(InitialConditions, find_reactions_on_which_forces_depend_through_a_root) {
  const RunResult r = run(
      "Friction\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1, WZ=0.01\nMARKER/20, QP=1,0,0\nMARKER/3, PART=2\nJOINT/1, REVOLUTE, I=3, J=1\n"
      "SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=-0.1*SQRT(FX(3,1)**2+FY(3,1)**2)*TANH(WZ(3,1)/0.01)\nEND\n",
      "LIN/STATEMAT, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto A = r.matrix(0, "A");
  constexpr long double h = 1e-6L;  // second-order differences: h² = 1e-12, times third derivatives of 1e6 in the rate
  const auto on_rate = [&](long double step) {
    return (friction_pendulum(0, 0.01L + step) - friction_pendulum(0, 0.01L - step)) / (2 * step);
  };
  const long double on_angle = (friction_pendulum(h, 0.01L) - friction_pendulum(-h, 0.01L)) / (2 * h);
  const long double by_rate = (4 * on_rate(h / 2) - on_rate(h)) / 3;  // fourth order
  EXPECT_NEAR(A[0][0], static_cast<double>(by_rate), 1e-8 * std::abs(static_cast<double>(by_rate)));
  EXPECT_NEAR(A[0][1], static_cast<double>(on_angle), 1e-8);
}

TEST_F(InitialConditions, find_reactions_however_they_are_read) {
  const std::string pendulum =
      "Friction\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/4, PART=1, FLOATING\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1, WZ=0.01\nMARKER/20, QP=1,0,0\nMARKER/3, PART=2\n"
      "JOINT/1, REVOLUTE, I=3, J=1\n";
  const std::string root = "SQRT(FX(3,1)**2+FY(3,1)**2)", law = "*TANH(WZ(3,1)/0.01)";
  const std::string torque = "SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=-0.1*";
  std::vector<std::vector<double>> first;
  for (const std::string& force :
       {torque + root + law, torque + "FM(3,1)" + law, torque + "VARVAL(1)" + law + "\nVARIABLE/1, FUNCTION=" + root,
        torque + "SQRT(JOINT(1,0,2,0)**2+JOINT(1,0,3,0)**2)" + law,
        "GFORCE/1, I=3, JFLOAT=4, RM=1, FX=0\\FY=0\\FZ=0\\TX=0\\TY=0\\TZ=-0.1*" + root + law}) {
    SCOPED_TRACE(force);
    const RunResult r = run(pendulum + force + "\nEND\n", "LIN/STATEMAT, FILE=m\n");
    ASSERT_EQ(r.status, 0) << r.err;
    if (first.empty()) first = r.matrix(0, "A");
    for (std::size_t k = 0; k < 2; ++k) {
      expect_close(r.matrix(0, "A")[0][k], first[0][k], 1e-12);
    }
  }
  // Laws that exist at the solution and not without a load.
  for (const char* law_of_load : {"1/FY(3,1)", "-LOG(FY(3,1)**2)*WZ(3,1)", "SQRT(ABS(FY(3,1))-3)"}) {
    SCOPED_TRACE(law_of_load);
    EXPECT_EQ(run(pendulum + "SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=" + law_of_load + "\nEND\n", "LIN/EIG\n").status,
              0);
  }
  const RunResult r = run(pendulum + "DIFF/1, IC=0, FUNCTION=" + root + "-DIF(1)\nEND\n", "LIN/EIG\n");
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(InitialConditions, name_a_root_of_reactions_that_vanish_at_the_solution_too) {
  const RunResult r =
      run(head + slide(2, "-DZ(20,92)") +
              "VARIABLE/1, FUNCTION=SQRT(FX(20,92)**2+FY(20,92)**2)\nDIFF/1, IC=0, FUNCTION=VARVAL(1)-DIF(1)\nEND\n",
          "LIN/EIG\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("the derivative of SQRT is infinite at 0"), std::string::npos) << r.err;
}

// A door on two hinges, the second one of them misplaced; the spring holds it: ω = √(3/J), J = 1 + 0.16 L² about the
// axis.
std::string door(const std::string& at, const std::string& more = "", double length = 1, const char* state = "") {
  const double L = length;
  return fmt::format(
      "Door\nUNITS/SYSTEM=MKS\n{5}PART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP={6:.17g},{6:.17g},{6:.17g}{4}\n"
      "MARKER/20, QP={0:.17g},0,{1:.17g}\nMARKER/21\nMARKER/22, QP=0,0,{2:.17g}\nMARKER/2, PART=1, QP={3}\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=22, J=2\nSPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT={7:.17g}\n"
      "END\n",
      0.4 * L, 0.5 * L, L, at, state, more, L * L, 3 * L * L);
}
double door_frequency() { return std::sqrt(3 / 1.16) / (2 * std::numbers::pi); }

TEST_F(InitialConditions, go_any_way_where_a_limit_is_zero) {
  const std::string apart =
      "Door\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=1.5,0,0, "
      "REULER=0,40D,0\nMARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nSPRINGDAMPER/1, ROTATIONAL, "
      "I=21, "
      "J=1, KT=2\nEND\n";
  const RunResult r = run(apart, "IC/ALIMIT=0, TLIMIT=0\nSIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(2), {{0, 1 / (2 * std::numbers::pi)}}, 1e-12);  // 2 on an inertia of 1 + 1
}

TEST_F(InitialConditions, take_hinges_that_agree_to_the_error_of_ic) {
  struct Case {
    std::string model, commands;
    bool sound;
  };
  const std::vector<Case> cases = {
      {door("1E-10,0,1"), "", true},
      {door("1E-10,0,1", "", 1, ", WZ=1"), "", true},
      {door("0,0,1, REU=0,1E-10,0"), "", true},
      {door("0.1,0,1E9", "", 1e9), "", true},
      {door("1E-19,0,1E-9", "", 1e-9), "", true},
      {door("1E-17,0,1E-9", "", 1e-9), "", false},
      {door("1E-8,0,1"), "", false},
      {door("0,1E-8,1"), "", false},
      {door("1E-8,0,1", "IC/ERROR=1E-6\n"), "", true},
      {door("1E-8,0,1", "IC/ERROR=1E-6, MAXIT=30, ALIMIT=20D, PATTERN=T:F\n", 1, ", WZ=1"), "", true},
      {door("1E-8,0,1"), "IC/ERROR=1E-6\n", true},
      {door("1E-10,0,1", "IC/ERR=1E-12\n"), "", false},
      {door("1E-10,0,1"), "IC/ERROR=1E-12\n", false},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.model + c.commands);
    const RunResult r = run(c.model, c.commands + "LIN/EIG\n");
    EXPECT_EQ(r.status, c.sound ? 0 : 2) << r.err;
    if (c.sound) {
      // Turning, the point is no equilibrium but its spring is linear: the same frequency.
      const auto values = r.eigenvalues(r.json.at("results").size() - 1);
      expect_eigenvalues(values, {std::complex(0.0, door_frequency())}, 1e-7);
    } else {
      EXPECT_NE(r.err.find("JOINT/"), std::string::npos) << r.err;
      EXPECT_NE(r.err.find("contradict each other"), std::string::npos) << r.err;
    }
  }
}

// Two pendulums in a row; `origin` puts the BCS of the first that far along it from the hinge.
std::string pendulums(double length, double origin) {
  return fmt::format(
      "Pendulums\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV={2:.17g}\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=1, CM=20, IP={3:.17g},{3:.17g},{3:.17g}, QG={1:.17g},0,0\nMARKER/20, QP={4:.17g},0,0\n"
      "MARKER/21, QP={5:.17g},0,0\nMARKER/22, QP={4:.17g},0,0\nJOINT/1, REVOLUTE, I=21, J=1\n"
      "PART/3, MASS=1, CM=30, IP={3:.17g},{3:.17g},{3:.17g}, QG={0:.17g},0,0\nMARKER/30, QP={0:.17g},0,0\nMARKER/31\n"
      "JOINT/3, REVOLUTE, I=31, J=22\nEND\n",
      length, origin, 9.81 * length, 0.1 * length * length, length - origin, -origin);
}

// M = [2.1 1; 1 1.1], K = g diag(2, 1): the frequencies of both angles, θ₁ and θ₂ absolute.
std::vector<std::complex<double>> frequencies_of_pendulums() {
  const double g = 9.81, a = 2.1 * 1.1 - 1, b = g * (2.1 + 2 * 1.1), c = 2 * g * g, root = std::sqrt(b * b - 4 * a * c);
  const auto hz = [](double square) { return std::complex(0.0, std::sqrt(square) / (2 * std::numbers::pi)); };
  return {hz(2 * c / (b + root)), hz((b + root) / (2 * a))};
}

TEST_F(InitialConditions, do_not_depend_on_units_of_length) {
  for (const double length : {1e-12, 1e-9, 1e-6, 1.0, 1e6, 1e9, 1e12}) {
    SCOPED_TRACE(length);
    const RunResult r = run(pendulums(length, 0), "LIN/EIG\n");
    ASSERT_EQ(r.status, 0) << r.err;
    expect_eigenvalues(r.eigenvalues(0), frequencies_of_pendulums(), 1e-11);
  }
}

TEST_F(InitialConditions, keep_the_digits_of_parts_whose_origin_is_far_away) {
  // What is written of a marker is rounded to 16 digits of its distance from the origin.
  for (const auto& [origin, tolerance] :
       {std::pair(10.0, 1e-11), {1e3, 1e-9}, {1e4, 1e-11}, {1e6, 1e-9}, {1e9, 1e-6}}) {
    SCOPED_TRACE(origin);
    const RunResult r = run(pendulums(1, origin), "SIM/INITIAL\nLIN/EIG\n");
    ASSERT_EQ(r.status, 0) << r.err;
    expect_eigenvalues(r.eigenvalues(1), frequencies_of_pendulums(), tolerance);
    EXPECT_EQ(r.err.find("BCS far from all its markers") != std::string::npos, origin > 2e3) << r.err;
  }
}

// A bead on y = x², −3 ≤ x ≤ 3, drawn anywhere; `more` holds it further.
std::string bead(const std::string& at, const std::string& more = "") {
  return "Bead\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=" + at +
         "\nMARKER/20\nMARKER/2, PART=1\nMARKER/3, PART=1, FLOATING\n"
         "MATRIX/1, FULL=RORDER, ROWS=7, COLUMNS=3, "
         "VALUES=-3,9,0,-2,4,0,-1,1,0,0,0,0,1,1,0,2,4,0,3,9,0\nCURVE/1, OPEN, CURVE_POINTS, MATRIX=1\n"
         "PTCV/1, I=20, JFLOAT=3, CURVE=1, RM=2\n" +
         more + "END\n";
}

TEST_F(InitialConditions, put_a_bead_drawn_beyond_the_end_of_its_curve_onto_it) {
  // The place inside next to each, which a variable checks: it has no value elsewhere.
  for (const auto& [at, x] : {std::pair("3,9,0", 3),
                              {"3.01,9.05,0", 3},
                              {"3.1,9.2,0", 3},
                              {"4,10,0", 3},
                              {"4,30,1", 3},
                              {"-3.01,9.05,0", -3},
                              {"-5,10,0", -3}}) {
    SCOPED_TRACE(at);
    const RunResult r =
        run(bead(at, fmt::format("VARIABLE/1, FUNCTION=SQRT(1E-12-(DX(20)-({}))**2)\n", x)), "LIN/EIG\n");
    EXPECT_EQ(r.status, 0) << r.err;
  }
}

TEST_F(InitialConditions, find_the_place_inside_a_curve_where_other_constraints_hold_a_bead) {
  // On a slide along x at the height 4, or at 0.25; drawn where the curve has ended. Nothing but its turns stays free.
  for (const auto& [at, slide_at] : {std::pair("4,4,0", "0,4,0"), {"-9,4,0", "0,4,0"}, {"5,0.25,0", "0,0.25,0"}}) {
    SCOPED_TRACE(at);
    const RunResult r = run(
        bead(at, std::string("MARKER/25, PART=1, QP=") + slide_at + ", REU=90D,90D,0\nJPRIM/1, INLINE, I=20, J=25\n"),
        "LIN/EIG\n");
    EXPECT_EQ(r.status, 0) << r.err;
  }
}

TEST_F(InitialConditions, look_all_over_a_curve_where_the_way_from_the_drawn_place_leads_off_it) {
  // y = x³ − 3x for −2 ≤ x ≤ 1.5 at the height 1.9: from the right end upwards there is nothing, 2 cos 3ϑ = 1.9 has two
  // roots x = 2 cos ϑ on the left, the nearer one beyond −1.
  std::string points;
  for (int k = 0; k < 8; ++k) {
    const double x = -2 + 0.5 * k;
    points += fmt::format("{}{},{},0", k > 0 ? "," : "", x, x * x * x - 3 * x);
  }
  const RunResult r = run(
      "Bead\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=1.45,-0.8,0\nMARKER/20\n"
      "MARKER/2, PART=1\nMARKER/3, PART=1, FLOATING\nMATRIX/1, FULL=RORDER, ROWS=8, COLUMNS=3, VALUES=" +
          points +
          "\nCURVE/1, OPEN, CURVE_POINTS, MATRIX=1\nPTCV/1, I=20, JFLOAT=3, CURVE=1, RM=2\n"
          "MARKER/25, PART=1, QP=0,1.9,0, REU=90D,90D,0\nJPRIM/1, INLINE, I=20, J=25\n"
          "VARIABLE/1, FUNCTION=SQRT(1E-12-(DX(20)**3-3*DX(20)-1.9)**2)*SQRT(1+DX(20))\nEND\n",
      "LIN/EIG\n");
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(InitialConditions, still_refuse_a_bead_that_others_hold_beyond_the_end) {
  const RunResult r =
      run(bead("4,16,0", "MARKER/25, PART=1, QP=0,16,0, REU=90D,90D,0\nJPRIM/1, INLINE, I=20, J=25\n"), "LIN/EIG\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("beyond the end"), std::string::npos) << r.err;
}

// x″ = −y with y = 16/(2 + 8 s + e s²) (1 − x): for e → 0 the poles of 8 s³ + 2 s² + 16 = 0 and one at −8/e.
TEST_F(InitialConditions, take_a_controller_with_a_very_fast_pole) {
  for (const double e : {1e-6, 1e-9, 1e-11, 1e-15, 1e-30}) {
    SCOPED_TRACE(e);
    const RunResult r =
        run(head + slide(2, "VARVAL(2)") +
                fmt::format("VARIABLE/1, FUNCTION=1-DZ(20,92)\nVARIABLE/2, FUNCTION=ARYVAL(3,1)\nARRAY/1, X\n"
                            "ARRAY/2, U, VARIABLES=1\nARRAY/3, Y\n"
                            "TFSISO/1, X=1, U=2, Y=3, NUMERATOR=16, DENOMINATOR=2,8,{}\nEND\n",
                            e),
            "LIN/EIG\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto values = r.eigenvalues(0);
    ASSERT_EQ(values.size(), 4u);
    const double fast = values[1].real() * 2 * std::numbers::pi;
    EXPECT_NEAR(fast * e, -8, 1e-5);
    const std::complex<double> s = values[0] * 2.0 * std::numbers::pi;
    EXPECT_LE(std::abs(8.0 * s * s * s + 2.0 * s * s + 16.0), 1e-4);  // e s⁴ and the digits lost beside 8/e
  }
}

// One part that is drawn far out is brought to its hinges as all others are: it is no scale for what a constraint may
// be off.
TEST_F(InitialConditions, a_part_drawn_far_out_is_no_scale_for_the_others) {
  const auto chain = [](double shift) {
    constexpr int n = 12;
    std::string s = "Chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n";
    for (int k = 1; k <= n; ++k) {
      s += fmt::format(
          "PART/{0}, MASS=1, CM={0}0, IP=0.01,0.01,0.01, QG=0,{1:.17g},0\nMARKER/{0}0, QP=0,-0.05,0\nMARKER/{0}1\n"
          "MARKER/{0}2, QP=0,-0.1,0\nJOINT/{0}, REVOLUTE, I={0}1, J={2}\n",
          k + 1, -0.1 * (k - 1) + (k == 7 ? shift : 0), k == 1 ? "1" : fmt::format("{}2", k));
    }
    return s + "END\n";
  };
  const auto near = run(chain(0), "LINEAR/EIGENSOL\n").eigenvalues(0);
  for (const double shift : {1e5, 1e9, 1e20}) {
    const RunResult r = run(chain(shift), "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto far = r.eigenvalues(0);
    ASSERT_EQ(far.size(), near.size());
    for (std::size_t k = 0; k < far.size(); ++k)
      EXPECT_LE(std::abs(far[k] - near[k]), 1e-9 * std::abs(near[k])) << shift;
  }
}

}  // namespace
}  // namespace dynalin::cases::initial_conditions_test
