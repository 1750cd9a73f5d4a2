// States at mass centres and along principal axes (ORIGINAL), against closed forms, the published block, and the same
// coordinates spelled out as a PSTATE.
#include <gmock/gmock.h>

#include "cases/original_cases.h"
#include "places/source_tree.h"

namespace dynalin::cases::original_states_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Complex = std::complex<double>;
using OriginalStates = OriginalCases;

TEST_F(OriginalStates, gives_the_published_block_of_the_original_implementation) {
  const auto example = read_file(examples_folder() / "spring_pendulum/spring_pendulum.adm");
  const RunResult r = run(example, "SIM/STAT\nLINEAR/EIGENSOL, ORIGINAL, COORDS=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(1), {Complex(-0.0448686373285978, 0.95828903953554)}, 1e-12);
  EXPECT_EQ(r.labels(1)[1], "Global displacement DX(PBCS) PART/2");
  EXPECT_THAT(codes(r, 1), ::testing::ElementsAre(std::array{1, 2, 7}, std::array{1, 2, 1}));
  EXPECT_THAT(r.message, HasSubstr("  Option ORIGINAL was used.\n"));
  EXPECT_THAT(r.message, HasSubstr("        1 Global displacement DX(PBCS)   PART/2\n"));
  const std::string tables = r.text("model.txt");
  expect_close(after(tables, "Damping ratio"), 4.67704E-02, 1e-5);
  expect_close(after(tables, "Undamped natural freq."), 9.59339E-01, 1e-5);
  expect_close(after(tables, "Generalized stiffness"), 4.09672E+00, 1e-5);
  expect_close(after(tables, "Generalized mass"), 1.12754E-01, 1e-5);
  expect_close(after(tables, "Kinetic energy"), 2.04836E+00, 1e-5);
}

TEST_F(OriginalStates, moving_pendulum_in_the_position_of_its_mass_centre_by_hand) {
  const Pendulum p;
  const double angle = 0.4, w = 1.7;
  const RunResult r = run(p.text(angle, w), "LINEAR/STATEMAT, FILE=a\nLINEAR/STATEMAT, FILE=b, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(0)[1], "Global rotation AZ(BCS) PART/2");
  EXPECT_EQ(r.labels(1)[1], "Global displacement DX(PBCS) PART/2");
  expect_matrices(r.matrix(0, "A"), {{0, -p.kappa() * std::cos(angle)}, {1, 0}}, 1e-13);
  // With X = l sin α:  X″ = −κ X √(1 − X²/l²) − X X′²/(l² − X²)
  const double X = p.l * std::sin(angle), V = p.l * w * std::cos(angle), rest = p.l * p.l - X * X;
  const double c = std::cos(angle);
  const double on_X = -p.kappa() * (c - X * X / (p.l * p.l * c)) - V * V * (p.l * p.l + X * X) / (rest * rest);
  expect_matrices(r.matrix(1, "A"), {{-2 * X * V / rest, on_X}, {1, 0}}, 1e-13);
}

TEST_F(OriginalStates, a_displacement_that_hardly_moves_gives_way_to_another) {
  // The pendulum lies level: its mass centre moves up and down and X does not change.
  const Pendulum p;
  const RunResult r = run(p.text(std::numbers::pi / 2, 0), "LINEAR/EIGENSOL, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(0)[1], "Global displacement DY(PBCS) PART/2");
}

TEST_F(OriginalStates, free_spinning_top_in_its_angles_by_hand) {
  // Torque-free, inertias a, a, c; n = φ′ + ψ′ cos θ is constant:
  //     ψ″ = (c/a n − 2 ψ′ cos θ) θ′/sin θ,   θ″ = (ψ′ cos θ − c/a n) ψ′ sin θ,   φ″ = θ′ψ′ sin θ − ψ″ cos θ
  const double a = 0.7, c = 1.1, psi = 0.3, theta = 1.2, phi = -0.8, dpsi = 1.3, dtheta = 0.6, dphi = 2.9;
  const auto accelerations = [&](Complex T, Complex u, Complex v, Complex w) {
    const Complex n = w + u * std::cos(T);
    const Complex upp = (c / a * n - 2.0 * u * std::cos(T)) * v / std::sin(T);
    return std::array<Complex, 3>{upp, (u * std::cos(T) - c / a * n) * u * std::sin(T),
                                  v * u * std::sin(T) - upp * std::cos(T)};
  };
  const double st = std::sin(theta), sp = std::sin(phi), cp = std::cos(phi);
  const Vector w{dpsi * st * sp + dtheta * cp, dpsi * st * cp - dtheta * sp, dpsi * std::cos(theta) + dphi};
  const RunResult r =
      run(fmt::format(
              "Top\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=3, CM=20, IP={0},{0},{1}, QG=0.1,0.2,0.3, "
              "REULER={2},{3},{4}, WX={5:.17g}, WY={6:.17g}, WZ={7:.17g}, VX=0.4, VY=-0.2, VZ=0.9\n"
              "MARKER/20, QP=0.3,-0.1,0.2\nEND\n",
              a, c, psi, theta, phi, w.x, w.y, w.z),
          "LINEAR/STATEMAT, FILE=a, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  ASSERT_THAT(
      r.labels(0),
      ::testing::ElementsAre("derivative of Global displacement DX(PBCS) PART/2", "Global displacement DX(PBCS) PART/2",
                             "derivative of Global displacement DY(PBCS) PART/2", "Global displacement DY(PBCS) PART/2",
                             "derivative of Global displacement DZ(PBCS) PART/2", "Global displacement DZ(PBCS) PART/2",
                             "derivative of Global angle PSI(PBCS) PART/2", "Global angle PSI(PBCS) PART/2",
                             "derivative of Global angle THETA(PBCS) PART/2", "Global angle THETA(PBCS) PART/2",
                             "derivative of Global angle PHI(PBCS) PART/2", "Global angle PHI(PBCS) PART/2"));
  std::vector<std::vector<double>> A(12, std::vector<double>(12, 0.0));
  for (std::size_t k = 0; k < 6; ++k) A[2 * k + 1][2 * k] = 1;
  // Complex steps through the closed form: columns ψ′, θ′, θ, φ′ are 6, 8, 9, 10.
  const double h = 1e-40;
  const std::array<std::pair<std::size_t, std::size_t>, 4> columns = {{{9, 0}, {6, 1}, {8, 2}, {10, 3}}};
  for (const auto& [column, argument] : columns) {
    std::array<Complex, 4> x = {theta, dpsi, dtheta, dphi};
    x[argument] += Complex(0, h);
    const auto f = accelerations(x[0], x[1], x[2], x[3]);
    for (std::size_t k = 0; k < 3; ++k) A[6 + 2 * k][column] = f[k].imag() / h;
  }
  expect_matrices(r.matrix(0, "A"), A, 1e-13);
}

TEST_F(OriginalStates, changes_nothing_in_the_eigenvalues_of_a_model_at_rest) {
  const Variable rest(no_restore);
  const RunResult r =
      run(two_bodies(
              "MARKER/32, PART=3, QP=-0.1,0.1,-0.2\nSPRINGDAMPER/7, TRANSLATIONAL, I=32, J=3, K=30, C=1, LENGTH=0.5\n"
              "DIFF/1, FUNCTION=VX(30)+2*DX(31,20)-DIF(1)\nSFORCE/9, TRANSLATIONAL, ACTIONONLY, "
              "I=31, J=1, FUNCTION=3*DIF(1)\n"),
          "SIM/STAT\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, ORIGINAL\nLINEAR/EIGENSOL, RM=21, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same(r.eigenvalues(2), r.eigenvalues(1));
  expect_same(r.eigenvalues(3), r.eigenvalues(1));
  EXPECT_THAT(r.labels(2)[1], HasSubstr("(PBCS"));
  // A marker asks for coordinates of its own.
  EXPECT_THAT(r.labels(3)[1], HasSubstr("Relative"));
  EXPECT_THAT(r.err, HasSubstr("RM=21 asks for coordinates relative to that marker"));
}

// Bodies that move in all directions, none of them with its BCS at the mass centre or along principal axes: part 2 with
// products of inertia about a marker away from its mass centre, part 3 with its principal z axis vertical, point
// mass 4.
struct Spatial {
  Matrix3 R_IM = rotation_313(0.4, 0.5, -0.3);
  Matrix3 principal = R_IM * rotation_exponential({0.2, -0.3, 0.25});  // nearest to the axes of IM
  Vector cm{0.05, -0.02, 0.03}, im{0.01, 0.02, -0.03};
  double mass = 2;
  bool upside_down = false;

  std::string text() const {
    const Matrix3 J_CM = principal * Matrix3{{0.2, 0, 0}, {0, 0.3, 0}, {0, 0, 0.25}} * transpose(principal);
    const Vector s = cm - im;
    const Matrix3 about_im = J_CM + mass * (Matrix3::diagonal(dot(s, s)) - outer(s, s));
    const Matrix3 J = transpose(R_IM) * about_im * R_IM;
    // Markers at the mass centres along the frames that the rules give; that of part 3 has its axes renamed y, z, x.
    const Matrix3 part3 = rotation_313(0.6, 0, 0), renamed{part3.y, part3.z, part3.x};
    return fmt::format(
               "Spatial\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=0.4, JGRAV=-9, KGRAV=1.2\nPART/1, GROUND\nMARKER/1, "
               "REULER=0.3,0.4,0.5\nMARKER/2, QP=1,0.5,0\nMARKER/3, QP=-0.5,1,0.3\nMARKER/4, QP=0.2,-0.9,1\n"
               "PART/2, MASS={}, CM=23, IM=24, IP={:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}, QG=0.1,0.2,-0.1, "
               "REULER=0.2,1.1,-0.3, WM=20, WX=0.4, WY=-0.6, WZ=0.9, VX=0.3, VY=0.2, VZ=-0.5\nMARKER/20\n"
               "MARKER/21, QP=0.2,0.1,0, REULER=0.5,0.2,0.1\nMARKER/22, QP=-0.1,0.2,0.15\nMARKER/23, QP={}, "
               "REULER=0.1,0.2,0.3\nMARKER/24, QP={}, REULER={}\nMARKER/29, QP={}, REULER={}\n",
               mass, J(0, 0), J(1, 1), J(2, 2), -J(0, 1), -J(0, 2), -J(1, 2), xyz(cm), xyz(im), reuler(R_IM), xyz(cm),
               reuler(principal)) +
           fmt::format(
               "PART/3, MASS=1, CM=30, IP=0.1,0.15,0.12, QG=0.7,0.1,0.4, REULER=0.5,{},0, WX=0.2, WY=0.3, WZ=-0.7, "
               "VX=0.1, VY=-0.2, VZ=0.5\nMARKER/30, QP=0.1,0.05,-0.1, REULER={}\nMARKER/31, QP=0.1,-0.2,0.1, "
               "REULER=0.7,0.9,0.2\nMARKER/39, QP=0.1,0.05,-0.1, REULER={}\n",
               upside_down ? "180D" : "0", "0.6,0,0", reuler(renamed)) +
           "POINT_MASS/4, MASS=0.7, CM=40, QG=-0.3,-0.4,0.5, REULER=0.3,0.2,0.1, VX=0.3, VY=0.1, VZ=-0.2\n"
           "MARKER/40, POINT_MASS=4, QP=0.1,0.2,-0.1\n"
           "JOINT/1, SPHERICAL, I=22, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K=90, C=1, LENGTH=0.6\n"
           "SPRINGDAMPER/2, TRANSLATIONAL, I=21, J=3, K=70, C=1, LENGTH=0.7\nSPRINGDAMPER/3, TRANSLATIONAL, I=30, "
           "J=4, K=50, C=2, LENGTH=0.4\nSPRINGDAMPER/4, TRANSLATIONAL, I=31, J=21, K=60, C=1, LENGTH=0.3\n"
           "SPRINGDAMPER/5, TRANSLATIONAL, I=31, J=40, K=40, C=1, LENGTH=0.3\nSPRINGDAMPER/6, TRANSLATIONAL, I=40, "
           "J=2, K=45, C=1, LENGTH=0.2\n"
           "VARIABLE/1, FUNCTION=DX(29)\nVARIABLE/2, FUNCTION=DY(29)\nVARIABLE/3, FUNCTION=DZ(29)\n"
           "VARIABLE/4, FUNCTION=PSI(29)\nVARIABLE/5, FUNCTION=THETA(29)\nVARIABLE/6, FUNCTION=PHI(29)\n"
           "VARIABLE/7, FUNCTION=DX(39)\nVARIABLE/8, FUNCTION=DY(39)\nVARIABLE/9, FUNCTION=DZ(39)\n"
           "VARIABLE/10, FUNCTION=PSI(39)\nVARIABLE/11, FUNCTION=THETA(39)\nVARIABLE/12, FUNCTION=PHI(39)\n"
           "VARIABLE/13, FUNCTION=DX(40)\nVARIABLE/14, FUNCTION=DY(40)\nVARIABLE/15, FUNCTION=DZ(40)\n"
           "PSTATE/1, VARIABLES=1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\nPSTATE/2, VARIABLES=13\n"
           "POUTPUT/1, VARIABLES=4,11\nEND\n";
  }
};

TEST_F(OriginalStates, moving_bodies_have_the_coordinates_spelled_out_as_measures) {
  for (const bool upside_down : {false, true}) {
    Spatial model;
    model.upside_down = upside_down;
    const RunResult r =
        run(model.text(),
            "LINEAR/STATEMAT, FILE=a, ORIGINAL, POUTPUT=1\nLINEAR/STATEMAT, FILE=b, PSTATE=1, POUTPUT=1\n"
            "LINEAR/STATEMAT, FILE=c\n");
    ASSERT_EQ(r.status, 0) << r.err;
    ASSERT_EQ(r.matrix(0, "A").size(), 24u);
    expect_matrices(r.matrix(0, "A"), r.matrix(1, "A"), 1e-12);
    expect_matrices(r.matrix(0, "C"), r.matrix(1, "C"), 1e-12);
    // The two charts of the same moving model differ: the comparison means something.
    EXPECT_GT(std::abs(r.matrix(0, "A")[0][0] - r.matrix(2, "A")[0][0]), 1e-3);
    const auto labels = r.labels(0);
    EXPECT_THAT(labels, ::testing::Contains("Global angle PSI(PBCS yzx) PART/3"));
    EXPECT_THAT(labels, ::testing::Contains("Global displacement DX(PBCS) PART/3"));
    EXPECT_THAT(labels, ::testing::Contains("Global displacement DZ(PBCS) POINT_MASS/4"));
    EXPECT_THAT(labels, Not(::testing::Contains(HasSubstr("PSI(PBCS) PART/3"))));
  }
}

TEST_F(OriginalStates, near_the_singularity_the_rule_depends_on_the_angle_alone) {
  for (const double theta : {0.0, 0.9e-3, 1.1e-3, 0.4, std::numbers::pi - 0.9e-3, std::numbers::pi - 1.1e-3}) {
    const RunResult r = run(
        fmt::format("Free\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,2,2.5, "
                    "REULER=0.3,{:.17g},0.2\nMARKER/20\nFIELD/1, I=20, J=1, KMATRIX=4,0,0,0,0,0, 0,5,0,0,0,0, "
                    "0,0,6,0,0,0, 0,0,0,7,0,0, 0,0,0,0,8,0, 0,0,0,0,0,9, LENGTH=0,0,0,0,0,0, FORCE=0,0,0,0,0,0\nEND\n",
                    theta),
        "LINEAR/STATEMAT, FILE=a, ORIGINAL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const bool renamed = std::sin(theta) < 1e-3;
    EXPECT_EQ(r.labels(0)[7], renamed ? "Global angle PSI(PBCS yzx) PART/2" : "Global angle PSI(PBCS) PART/2") << theta;
    for (const auto& row : r.matrix(0, "A")) {
      for (const double v : row) EXPECT_TRUE(std::isfinite(v));
    }
  }
}

TEST_F(OriginalStates, states_files_carry_the_codes_of_principal_coordinates) {
  const RunResult r = run(Spatial().text(),
                          "LINEAR/STATEMAT, FILE=plant, FORMAT=MATLAB, ORIGINAL\nLINEAR/MKB, FILE=second, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::istringstream in(r.text("plantst"));
  std::vector<std::array<int, 3>> states;
  for (double type = 0, element = 0, coordinate = 0; in >> type >> element >> coordinate;)
    states.push_back({static_cast<int>(type), static_cast<int>(element), static_cast<int>(coordinate)});
  ASSERT_EQ(states.size(), 24u);
  EXPECT_EQ(states, codes(r, 0));
  // Part 3 is free and has all six; of the point mass come 4 to 6 for the rates.
  const std::vector<std::array<int, 3>> tail(states.end() - 18, states.end());
  EXPECT_EQ(tail, (std::vector<std::array<int, 3>>{{1, 3, 7},
                                                   {1, 3, 1},
                                                   {1, 3, 8},
                                                   {1, 3, 2},
                                                   {1, 3, 9},
                                                   {1, 3, 3},
                                                   {1, 3, 10},
                                                   {1, 3, 4},
                                                   {1, 3, 11},
                                                   {1, 3, 5},
                                                   {1, 3, 12},
                                                   {1, 3, 6},
                                                   {9, 4, 4},
                                                   {9, 4, 1},
                                                   {9, 4, 5},
                                                   {9, 4, 2},
                                                   {9, 4, 6},
                                                   {9, 4, 3}}));
  // MKB lists coordinates alone; its matrices are those of A.
  ASSERT_EQ(r.result(1).at("states").size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(codes(r, 1)[i], states[2 * i + 1]);
    for (std::size_t j = 0; j < 12; ++j) {
      EXPECT_EQ(r.matrix(1, "B")[i][j], -r.matrix(0, "A")[2 * i][2 * j] + 0.0);
      EXPECT_EQ(r.matrix(1, "K")[i][j], -r.matrix(0, "A")[2 * i][2 * j + 1] + 0.0);
    }
  }
}

TEST_F(OriginalStates, own_coordinates_come_before_principal_ones) {
  const RunResult r = run(Spatial().text(), "LINEAR/EIGENSOL, PSTATE=2, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(0)[1], "PSTATE VARIABLE VAR/13 DX(40)");
  EXPECT_THAT(r.labels(0), ::testing::Contains("Global displacement DY(PBCS) POINT_MASS/4"));
  EXPECT_THAT(r.labels(0), Not(::testing::Contains("Global displacement DX(PBCS) POINT_MASS/4")));
}

TEST_F(OriginalStates, a_part_without_mass_has_the_axes_of_its_own_frame) {
  // The massless arm has a free swing of its own only through the weight on it.
  const RunResult r =
      run("Arm\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, QG=0,-1,0, "
          "REULER=0.2,0.3,0.4\nMARKER/20\nMARKER/21, REULER=-0.4,-0.3,-0.2\nMARKER/22, QP=0,0,0\n"
          "PART/3, MASS=2, CM=30, QG=0,-1,0, IP=0.1,0.1,0.1\nMARKER/30\nMARKER/31, QP=0,1,0\n"
          "JOINT/1, REVOLUTE, I=31, J=1\nJOINT/2, FIXED, I=21, J=30\nEND\n",
          "SIM/STAT\nLINEAR/EIGENSOL, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(1)[1], "Global displacement DX(PBCS) PART/2");
  expect_eigenvalues(r.eigenvalues(1), {Complex(0, std::sqrt(2 * 9.81 / 2.1) / two_pi)}, 1e-11);
}

TEST_F(OriginalStates, a_sleigh_has_fewer_rates_than_principal_coordinates) {
  // Chaplygin's sleigh of mass m and inertia j about its mass centre, the blade b behind it, at the speed v:
  // one eigenvalue −m b v/(j + m b²), four zeros.
  const double m = 2, j = 0.3, b = 0.4, v = 1.5;
  const RunResult r = run(fmt::format("Sleigh\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS={}, CM=20, "
                                      "IP=0.1,0.2,{}, VX={}, VY=0, WZ=0\nMARKER/20\nMARKER/21, QP=-{},0,0\n"
                                      "JOINT/1, PLANAR, I=20, J=1\nGCON/1, FUNCTION=VY(21,0,21)\nEND\n",
                                      m, j, v, b),
                          "LINEAR/EIGENSOL, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(codes(r, 0), ::testing::ElementsAre(std::array{1, 2, 7}, std::array{1, 2, 1}, std::array{1, 2, 8},
                                                  std::array{1, 2, 2}, std::array{1, 2, 4}));
  double largest = 0;
  for (const Complex& value : r.eigenvalues(0)) largest = std::min(largest, value.real());
  expect_close(largest * two_pi, -m * b * v / (j + m * b * b), 1e-12);
}

}  // namespace
}  // namespace dynalin::cases::original_states_test
