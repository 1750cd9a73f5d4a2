// ENERGY_PER_MODE against modes and matrices computed here from the data of each model.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include "cases/modal_sums_cases.h"

namespace dynalin::cases::modal_energies_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::Not;
using Index = Eigen::Index;
using ModalEnergies = ModalSumCases;

// Three masses on a vertical line between floor and ceiling, each started where and as fast as the data say. `factor`
// is what one unit of force gives in mass·length/time².
struct Line {
  std::array<double, 3> m{1, 2, 1.5};
  std::array<double, 4> k{400, 300, 500, 200}, c{}, free{0.9, 1.3, 1.2, 0.8};
  std::array<double, 3> at{1, 2.1, 3.3}, velocity{0.7, -1.1, 0.4};
  double height = 4.2, gravity = 9.81, factor = 1;
  std::string units = "UNITS/SYSTEM=MKS\n";

  std::string dataset() const {
    std::string s = "Line\n" + units + fmt::format("ACCGRAV/KGRAV={:.17g}\nPART/1, GROUND\nMARKER/1\n", -gravity) +
                    fmt::format("MARKER/2, QP=0,0,{:.17g}\n", height);
    for (std::size_t n = 0; n < 3; ++n) {
      s += fmt::format(
          "PART/{0}, MASS={1}, CM={0}0, IP=1,1,1, QG=0,0,{2:.17g}, VZ={3:.17g}\nMARKER/{0}0\n"
          "JOINT/{0}, TRANSLATIONAL, I={0}0, J=1\n",
          n + 2, m[n], at[n], velocity[n]);
    }
    for (std::size_t n = 0; n < 4; ++n) {
      s += fmt::format("SPRINGDAMPER/{}, TRANSLATIONAL, I={}, J={}, K={:.17g}, C={:.17g}, LENGTH={:.17g}\n", n + 1,
                       n == 3 ? 2 : 10 * (n + 2), n == 0 ? 1 : 10 * (n + 1), k[n], c[n], free[n]);
    }
    return s + "END\n";
  }
  Matrix3d mass() const { return Vector3d(m[0], m[1], m[2]).asDiagonal(); }
  Matrix3d tridiagonal(const std::array<double, 4>& x) const {
    Matrix3d T;
    T << x[0] + x[1], -x[1], 0, -x[1], x[1] + x[2], -x[2], 0, -x[2], x[2] + x[3];
    return factor * T;
  }
  // From the place where springs and weight balance.
  Vector3d displacement() const {
    Vector3d load;
    for (std::size_t n = 0; n < 3; ++n)
      load(static_cast<Index>(n)) = factor * (k[n] * free[n] - k[n + 1] * free[n + 1]) - m[n] * gravity;
    load(2) += factor * k[3] * height;
    return Vector3d(at[0], at[1], at[2]) - tridiagonal(k).inverse() * load;
  }
  Vector3d rates() const { return {velocity[0], velocity[1], velocity[2]}; }
};

struct Energies {
  double kinetic, potential, power;
};

void expect_row(const std::vector<double>& values, const Energies& e, const Energies& sum, double tolerance = 1e-10) {
  ASSERT_EQ(values.size(), 6u);
  const auto check = [&](std::size_t at, double part, double whole) {
    EXPECT_NEAR(values[at], part, tolerance * std::abs(whole));
    EXPECT_NEAR(values[at + 1], whole == 0 ? 0 : 100 * part / whole, 100 * tolerance);
  };
  check(0, e.kinetic, sum.kinetic), check(2, e.potential, sum.potential), check(4, e.power, sum.power);
}

Energies total(const std::vector<Energies>& list) {
  Energies sum{};
  for (const Energies& e : list) sum.kinetic += e.kinetic, sum.potential += e.potential, sum.power += e.power;
  return sum;
}

// Stiffness-proportional damping (or none): real modes of K φ = ω² M φ with φᵀ M φ = 1, in which everything is a sum
// of squares.
std::vector<Energies> by_real_modes(const Line& line, double beta) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(line.tridiagonal(line.k), line.mass());
  const Vector3d eta = solver.eigenvectors().transpose() * line.mass() * line.displacement(),
                 rate = solver.eigenvectors().transpose() * line.mass() * line.rates();
  std::vector<Energies> list;
  for (Index i = 0; i < 3; ++i) {
    const double w2 = solver.eigenvalues()(i);
    list.push_back({0.5 * rate(i) * rate(i), 0.5 * w2 * eta(i) * eta(i), beta * w2 * rate(i) * rate(i)});
  }
  return list;
}

TEST_F(ModalEnergies, energies_of_a_line_in_real_modes) {
  for (const double beta : {0.0, 1e-3}) {
    for (const bool millimetres : {false, true}) {
      Line line;
      if (millimetres) {
        line.units = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n";
        line.factor = 1000, line.gravity = 9806.65, line.height *= 1000;
        for (auto* list : {&line.k, &line.c}) {
          for (double& x : *list) x /= 1000;
        }
        for (double& x : line.free) x *= 1000;
        for (double& x : line.at) x *= 1000;
        for (double& x : line.velocity) x *= 1000;
      }
      for (std::size_t n = 0; n < 4; ++n) line.c[n] = beta * line.k[n];
      const std::string t = tables(line.dataset(), "ENERGY_PER_MODE=ALL");
      const auto expected = by_real_modes(line, beta);
      const Energies sum = total(expected);
      for (std::size_t i = 0; i < 3; ++i)
        expect_row(row(t, "Energies per mode", std::to_string(i + 1)), expected[i], sum);
      // What the springs, masses and dampers hold together.
      const Vector3d x = line.displacement(), v = line.rates();
      const Energies model{0.5 * v.dot(line.mass() * v), 0.5 * x.dot(line.tridiagonal(line.k) * x),
                           v.dot(line.tridiagonal(line.c) * v)};
      for (const char* label : {"Sum", "Model"}) expect_row(row(t, "Energies per mode", label), model, model);
    }
  }
}

// A force that reads the acceleration is no mass of a body, and the spring beside it keeps its stiffness.
TEST_F(ModalEnergies, potential_energy_is_that_of_the_spring_where_a_force_reads_the_acceleration) {
  const std::string t = tables(
      "One mass\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,1.1, VZ=0.3\n"
      "MARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=50, C=0.4, LENGTH=1\n"
      "SFORCE/2, TRANSLATIONAL, I=20, J=1, FUNCTION=-3*ACCZ(20,1)\nEND\n",
      "ENERGY_PER_MODE=ALL");
  const Energies one{0.5 * 2 * 0.3 * 0.3, 0.5 * 50 * 0.1 * 0.1, 0.4 * 0.3 * 0.3};
  expect_row(row(t, "Energies per mode", "1"), one, one);
  expect_row(row(t, "Energies per mode", "Model"), one, one);
}

TEST_F(ModalEnergies, percentages_belong_to_the_modes_asked_for) {
  const Line line;
  const auto expected = by_real_modes(line, 0);
  const std::string t = tables(line.dataset(), "ENERGY_PER_MODE=2,3");
  EXPECT_THAT(labels(t, "Energies per mode"), ::testing::ElementsAre("2", "3", "Sum", "Model"));
  const Energies two = total({expected[1], expected[2]}), all = total(expected);
  expect_row(row(t, "Energies per mode", "2"), expected[1], two);
  expect_row(row(t, "Energies per mode", "3"), expected[2], two);
  expect_row(row(t, "Energies per mode", "Sum"), two, two);
  const auto model = row(t, "Energies per mode", "Model");
  EXPECT_NEAR(model[0], all.kinetic, 1e-10 * all.kinetic);
  EXPECT_NEAR(model[1], 100 * all.kinetic / two.kinetic, 1e-8);
  EXPECT_NEAR(model[2], all.potential, 1e-10 * all.potential);
  const std::string one = tables(line.dataset(), "ENERGY_PER_MODE=2");
  EXPECT_THAT(labels(one, "Energies per mode"), ::testing::ElementsAre("2", "Sum", "Model"));
  EXPECT_NEAR(row(one, "Energies per mode", "2")[1], 100, 1e-10);
}

// Dampers out of proportion: complex shapes, whose shares ½ η′_iᴴ Σ_j (ΦᴴMΦ)_ij η′_j are no squares.
TEST_F(ModalEnergies, energies_of_a_line_in_complex_modes) {
  Line line;
  line.c = {9, 0.5, 6, 0};
  const Matrix3d M = line.mass(), K = line.tridiagonal(line.k), C = line.tridiagonal(line.c);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6);
  A.topRightCorner<3, 3>().setIdentity();
  A.bottomLeftCorner<3, 3>() = -M.inverse() * K;
  A.bottomRightCorner<3, 3>() = -M.inverse() * C;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  std::vector<std::pair<double, Index>> order;
  for (Index i = 0; i < 6; ++i) {
    if (solver.eigenvalues()(i).imag() > 0) order.emplace_back(solver.eigenvalues()(i).imag(), i);
  }
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), 3u);
  Eigen::Matrix3cd Phi;
  for (Index i = 0; i < 3; ++i)
    Phi.col(i) = solver.eigenvectors().col(order[static_cast<std::size_t>(i)].second).head<3>();
  const Eigen::Vector3cd eta = Phi.inverse() * line.displacement(), rate = Phi.inverse() * line.rates();
  const auto share = [&](const Matrix3d& m, const Eigen::Vector3cd& e, Index i) {
    const Eigen::Matrix3cd modal = Phi.adjoint() * m * Phi;
    return std::real(std::conj(e(i)) * (modal.row(i) * e)(0));
  };
  std::vector<Energies> expected;
  for (Index i = 0; i < 3; ++i)
    expected.push_back({0.5 * share(M, rate, i), 0.5 * share(K, eta, i), share(C, rate, i)});
  const Energies sum = total(expected);
  EXPECT_NEAR(sum.power, line.rates().dot(C * line.rates()), 1e-10 * sum.power);
  const std::string t = tables(line.dataset(), "ENERGY_PER_MODE=ALL");
  for (std::size_t i = 0; i < 3; ++i) expect_row(row(t, "Energies per mode", std::to_string(i + 1)), expected[i], sum);
}

// Two real modes with one shape hold the energy of a slide damped beyond the critical damping.
TEST_F(ModalEnergies, an_overdamped_slide_has_its_energy_once) {
  const std::string t = tables(
      "Slide\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,1.5, "
      "VZ=3\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=10, C=40, LENGTH=1\nEND\n",
      "ENERGY_PER_MODE=ALL");
  const Energies model{9, 0.5 * 10 * 0.25, 360};
  double kinetic = 0, potential = 0, power = 0;
  for (const char* mode : {"1", "2"}) {
    const auto r = row(t, "Energies per mode", mode);
    kinetic += r[0], potential += r[2], power += r[4];
  }
  EXPECT_NEAR(kinetic, model.kinetic, 1e-12);
  EXPECT_NEAR(potential, model.potential, 1e-12);
  EXPECT_NEAR(power, model.power, 1e-10);
  expect_row(row(t, "Energies per mode", "Model"), model, model);
}

// A body on a mount, turned, with an offset mass centre and products of inertia: the sum is ½ m v² + ½ ωᵀ J ω.
TEST_F(ModalEnergies, kinetic_energy_of_a_turned_body) {
  Matrix3d J;
  J << 0.5, -0.05, 0.04, -0.05, 0.7, -0.06, 0.04, -0.06, 0.6;  // off the diagonal the tensor is −IP
  const Vector3d v(0.4, -0.3, 1.2), w_local(1.1, 0.6, -0.8);   // W in the axes of CM, those of the part
  const double kinetic = 0.5 * 3 * v.squaredNorm() + 0.5 * w_local.dot(J * w_local);
  const std::string t = tables(
      "Body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=1,2,3\nPART/2, MASS=3, CM=20, "
      "IP=0.5,0.7,0.6,0.05,-0.04,0.06, QG=1,2,3, REULER=0.4,0.9,-0.7, VX=0.4, VY=-0.3, VZ=1.2, WX=1.1, WY=0.6, "
      "WZ=-0.8\nMARKER/20, QP=0.2,-0.3,0.1\nMARKER/21, REULER=0.7,-0.9,-0.4\n"
      "BUSHING/1, I=21, J=1, K=500,700,900, KT=30,40,50, C=1,2,3, CT=0.1,0.2,0.3\nEND\n",
      "ENERGY_PER_MODE=ALL");
  for (const char* label : {"Sum", "Model"}) EXPECT_NEAR(row(t, "Energies per mode", label)[0], kinetic, 1e-11);
}

// Equal frequencies coupled one way: x″ = −(k/m) x, y″ = −(k/m) y + (c/m) x has one shape, (0, 1), for both pairs.
// `turn` mixes the two so that the matrix is not triangular.
std::string one_way(double k, double c, double turn) {
  const double s = std::sin(turn), q = std::cos(turn);
  // K = k 1 − c b aᵀ with a = (cos, sin), b = (−sin, cos).
  const std::array<double, 4> K = {k + c * s * q, c * s * s, -c * q * q, k - c * s * q};
  return fmt::format(
      "One way\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, VZ=1\nMARKER/20\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1, VZ=2\nMARKER/30\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "JOINT/2, TRANSLATIONAL, I=30, J=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION={:.17g}*DZ(20)+{:.17g}*DZ(30)\n"
      "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION={:.17g}*DZ(20)+{:.17g}*DZ(30)\nEND\n",
      -K[0], -K[1], -K[2], -K[3]);
}

class SingularShapes : public ModalEnergies, public ::testing::WithParamInterface<std::tuple<double, double>> {};

TEST_P(SingularShapes, are_refused_and_no_table_is_written) {
  const auto [coupling, turn] = GetParam();
  const std::string text = one_way(100, coupling, turn);
  const RunResult r = run(text, "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("modal matrix is singular"));
  if (r.wrote("model.txt")) {
    EXPECT_THAT(r.text("model.txt"), Not(HasSubstr("Energies per mode"))) << r.text("model.txt");
  }
}
INSTANTIATE_TEST_SUITE_P(couplings, SingularShapes,
                         ::testing::Combine(::testing::Values(1.0, 30.0, 100.0), ::testing::Values(0.0, 0.5, 2.0)));

// Without the coupling the shapes of the same pair of frequencies are any two, and the energies are fine.
TEST_F(ModalEnergies, equal_frequencies_are_not_singular) {
  const std::string t = tables(one_way(100, 0, 0.5), "ENERGY_PER_MODE=ALL");
  const Energies model{2.5, 0, 0};
  EXPECT_NEAR(row(t, "Energies per mode", "Sum")[0], model.kinetic, 1e-12);
}

TEST_F(ModalEnergies, of_differential_states_alone_are_none) {
  for (const char* body : {"", "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, FIXED, I=20, J=1\n"}) {
    const RunResult r = run(
        std::string("Filter\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nDIFF/1, FUNCTION=-DIF(1)\n") + body + "END\n",
        "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL, MASS_PER_MODE=ALL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(row(r.text("model.txt"), "Energies per mode", "Sum")[0], 0);
  }
}

// An arm that is driven at 4, a slider of 3 at 2 on it with u′ = 2, on a spring of 300 and a damper of 6 with v = u′:
// in u on the arm M = 3, C = 6, K = 300 − 3 · 16, and 3 u″ = 3 · 16 u − 300 (u − 1) − 6 u′ of u = 2.
TEST_F(ModalEnergies, along_an_axis_that_is_driven) {
  const std::string text =
      "Driven\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\n"
      "MARKER/21, REULER=90D,90D,0\nPART/3, MASS=3, CM=30, IP=1,1,1, QG=2,0,0, VX=2\nMARKER/30\n"
      "MARKER/31, REULER=90D,90D,0\nJOINT/1, REVOLUTE, I=2, J=1\nJOINT/2, TRANSLATIONAL, I=31, J=21\n"
      "MOTION/1, ROTATIONAL, JOINT=1, FUNCTION=4*TIME\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=31, J=2, K=300, C=6, LENGTH=1\nEND\n";
  const double a = 16 * 2 - 100 * 1.0 - 2 * 2, x = (3 * a + 6 * 2) / 252;
  for (const std::string coordinates : {"RM=2, ", ""}) {
    const auto sum = row(tables(text, coordinates + "ENERGY_PER_MODE=ALL"), "Energies per mode", "Sum");
    EXPECT_NEAR(sum[0], 0.5 * 3 * 2 * 2, 1e-11) << coordinates;
    EXPECT_NEAR(sum[4], 6 * 2 * 2, 1e-11) << coordinates;
    if (!coordinates.empty()) {
      EXPECT_NEAR(sum[2], 0.5 * 252 * x * x, 1e-10);
    }
  }
}

// The same wherever the BCS of the slider is: mass centre 10 out on an arm that turns freely at 10.
TEST_F(ModalEnergies, whatever_bodies_are_referred_to) {
  const auto potential = [&](const std::string& slider, const std::string& cm, const std::string& guide) {
    return row(tables("Slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/6\nPART/2, MASS=3, CM=7, IP=10,10,10, WZ=10\n"
                      "MARKER/5\nMARKER/7, QP=1,0,0\nMARKER/10, REULER=90D,90D,0\nPART/3, MASS=3, CM=8, IP=10,10,10, "
                      "WZ=10" +
                          slider + "\nMARKER/8, QP=" + cm + ",0,0\nMARKER/9, QP=" + guide +
                          ",0,0, REULER=90D,90D,0\nJOINT/1, REVOLUTE, I=5, J=6\nJOINT/2, TRANSLATIONAL, I=9, J=10\n"
                          "SPRINGDAMPER/1, TRANSLATIONAL, I=6, J=8, K=5, LENGTH=10\nEND\n",
                      "RM=5, ENERGY_PER_MODE=ALL"),
               "Energies per mode", "Sum")[2];
  };
  // 3 u″ = 3 ω² u and the Coriolis torque of it: K = 5 − 300, M u″ + C φ′ = 3000 − 6000.
  const double x = 3000.0 / 295;
  EXPECT_NEAR(potential("", "10", "0"), -0.5 * 295 * x * x, 1e-7);
  EXPECT_NEAR(potential(", QG=10,0,0, VX=0, VY=100", "0", "-10"), -0.5 * 295 * x * x, 1e-7);
}

// A pendulum of length 1 at 45 degrees with a rate of 2, in x = sin φ: with c = cos φ it is
// Q = x″/c² + x′² x/c⁴ + 10 x/c, and x″ = −10 sin φ cos φ − 4 sin φ.
TEST_F(ModalEnergies, in_a_coordinate_that_bends) {
  const double c = std::sqrt(0.5), x = c, v = 2 * c, a = -10 * x * c - 4 * x, c2 = c * c, c4 = c2 * c2;
  const double M = 1 / c2, C = 2 * v * x / c4,
               K = 2 * a * x / c4 + v * v * (1 / c4 + 4 * x * x / (c4 * c2)) + 10 * (1 / c + x * x / (c * c2));
  const double off = (M * a + C * v) / K;
  const auto sum = row(tables("Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\n"
                              "PART/2, MASS=1, CM=20, IP=0,0,0, REULER=45D,0,0, WZ=2\nMARKER/20, QP=0,-1,0\nMARKER/21\n"
                              "JOINT/1, REVOLUTE, I=21, J=1\nVARIABLE/1, FUNCTION=DX(20)\nPSTATE/1, VARIABLES=1\nEND\n",
                              "PSTATE=1, ENERGY_PER_MODE=ALL"),
                       "Energies per mode", "Sum");
  EXPECT_NEAR(sum[0], 0.5 * M * v * v, 1e-12);
  EXPECT_NEAR(sum[2], 0.5 * K * off * off, 1e-11);
  EXPECT_NEAR(sum[4], C * v * v, 1e-11);
}

// TIME moves x = z − 3 t − t² as well: x′ = 1 − 3 and x″ = −2 where nothing pulls, so that K x = 2 · 2.
TEST_F(ModalEnergies, in_a_coordinate_that_time_moves) {
  const auto sum =
      row(tables("Bead\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, VZ=1\n"
                 "MARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
                 "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-5*DZ(20)\n"
                 "VARIABLE/1, FUNCTION=DZ(20)-3*TIME-TIME**2\nPSTATE/1, VARIABLES=1\nEND\n",
                 "PSTATE=1, ENERGY_PER_MODE=ALL"),
          "Energies per mode", "Sum");
  EXPECT_NEAR(sum[0], 0.5 * 2 * 4, 1e-12);
  EXPECT_NEAR(sum[2], 0.5 * 5 * 0.8 * 0.8, 1e-12);
}

// Two masses that stand 0.1 from rest: what holds them there does not depend on damping.
TEST_F(ModalEnergies, potential_energy_is_the_same_without_damping) {
  const std::string text =
      "Two\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\nMARKER/3, QP=-1,0,0\n"
      "PART/2, MASS=1, CM=2, IP=1,1,1, VX=1\nMARKER/2\nMARKER/21, REULER=90D,90D,0\n"
      "PART/4, MASS=1, CM=4, IP=1,1,1, VX=3\nMARKER/4, QP=1,0,0\nMARKER/41, QP=1,0,0, REULER=90D,90D,0\n"
      "JOINT/1, TRANSLATIONAL, I=21, J=1\nJOINT/2, TRANSLATIONAL, I=41, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=3, K=100, C=10, LENGTH=1.1\n"
      "SPRINGDAMPER/2, TRANSLATIONAL, I=2, J=4, K=100, C=1, LENGTH=1\nEND\n";
  for (const std::string damping : {"", "NODAMPIN, "}) {
    const auto sum = row(tables(text, damping + "ENERGY_PER_MODE=ALL"), "Energies per mode", "Sum");
    EXPECT_NEAR(sum[0], 0.5 * (1 + 9), 1e-12) << damping;
    EXPECT_NEAR(sum[2], 0.5 * 100 * 0.1 * 0.1, 1e-12) << damping;
    EXPECT_NEAR(sum[4], damping.empty() ? 10 * 1 + 1 * 4 : 0, 1e-12) << damping;
  }
}

TEST_F(ModalEnergies, velocity_constraints_are_refused) {
  const RunResult r =
      run("Sleigh\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, "
          "VX=1\nMARKER/20\nJOINT/1, PLANAR, I=20, J=1\nGCON/1, FUNCTION=VY(20,0,20)\nEND\n",
          "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("velocity constraints"));
  EXPECT_FALSE(r.wrote("model.txt"));
}

}  // namespace
}  // namespace dynalin::cases::modal_energies_test
