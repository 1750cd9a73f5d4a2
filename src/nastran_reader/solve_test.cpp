// Decks with known answers: analytic, or of a null space reduction with QZ of the same numbers.
#include "nastran_reader/solve.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace dynalin::nastran_reader::solve_test {
namespace {

using ::testing::HasSubstr;
using Complex = std::complex<double>;

Prepared prepared(const std::string& text, Purpose purpose = Purpose::solve) {
  Diagnostics reading;
  Deck deck = deck_of_text("test.bdf", text, reading);
  return prepare(std::move(deck), std::move(reading), purpose);
}

ModeSolution modes(const std::string& text) {
  Prepared p = prepared(text);
  EXPECT_FALSE(p.diagnostics.has_errors()) << render(p.diagnostics);
  if (p.diagnostics.has_errors()) return {};
  auto s = solve_modes(p, p.diagnostics);
  EXPECT_TRUE(s.has_value()) << s.error();
  return s ? *s : ModeSolution{};
}

// Those of positive frequency, in increasing order.
std::vector<double> frequencies(const std::string& text) {
  std::vector<double> out;
  for (const Complex& z : modes(text).eigenvalues) {
    if (z.imag() > 0) out.push_back(z.imag());
  }
  return out;
}

void expect_pairs(const ModeSolution& s, const std::vector<Complex>& expected, double relative) {
  ASSERT_EQ(s.eigenvalues.size(), 2 * expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_LT(std::abs(s.eigenvalues[2 * k + 1] - expected[k]), relative * std::abs(expected[k]))
        << s.eigenvalues[2 * k + 1];
    EXPECT_EQ(s.eigenvalues[2 * k], std::conj(s.eigenvalues[2 * k + 1]));
  }
}

const std::string head = "SOL 107\nCEND\nCMETHOD = 1\n";
const std::string eigc = "EIGC,1,HESS,MAX,,,,10\nPARAM,AUTOSPC,NO\n";

TEST(SolvedDeck, two_scalar_points_with_unsymmetric_matrices) {
  const ModeSolution s = modes(head + "K2PP = KVVV\nB2PP = BVVV\nM2PP = MVVV\nBEGIN BULK\n" + eigc +
                               "SPOINT,1,2\n"
                               "DMIG,MVVV,0,6,2,0\n"
                               "DMIG,MVVV,1,0,,1,0,2.0D0\n"
                               "DMIG,MVVV,2,0,,2,0,1.0D0\n"
                               "DMIG,BVVV,0,1,2,0\n"
                               "DMIG,BVVV,1,0,,1,0,3.0D0\n"
                               ",2,0,-1.0D0\n"
                               "DMIG,BVVV,2,0,,1,0,-1.5D0\n"
                               ",2,0,1.0D0\n"
                               "DMIG*   KVVV                           0               1               2\n"
                               "*                      0\n"
                               "DMIG*   KVVV                           1               0                \n"
                               "*                      1               0         300.0D0\n"
                               "*                      2               0        -100.0D0\n"
                               "*\n"
                               "DMIG*   KVVV                           2               0                \n"
                               "*                      1               0        -120.0D0\n"
                               "*                      2               0         100.0D0\n"
                               "*\n"
                               "ENDDATA\n");
  expect_pairs(s, {{-0.1719610347666, 6.601064746647}, {-1.078038965233, 14.32629340823}}, 1e-11);
}

TEST(SolvedDeck, unsymmetric_stiffness_on_a_dependent_scalar_point) {
  const std::vector<double> w = frequencies(head + "MPC = 5\nSET 3 = KA\nK2PP = 3\nM2PP = MA\nBEGIN BULK\n" + eigc +
                                            "SPOINT  1       THRU    4\n"
                                            "MPC     5       4               1.0     1               -.5\n"
                                            "                2               .25\n"
                                            "DMIG    MA      0       6       2       0\n"
                                            "DMIG    MA      1       0               1       0       2.0D0\n"
                                            "DMIG    MA      2       0               2       0       1.5D0\n"
                                            "DMIG    MA      3       0               3       0       1.0D0\n"
                                            "DMIG    MA      4       0               4       0       0.7D0\n"
                                            "DMIG    KA      0       1       2       0\n"
                                            "DMIG    KA      1       0               1       0       300.D0\n"
                                            "        2       0       -120.D0         3       0       5.D0\n"
                                            "DMIG    KA      2       0               1       0       -100.D0\n"
                                            "        2       0       250.D0          3       0       -20.D0\n"
                                            "        4       0       11.D0\n"
                                            "DMIG    KA      3       0               1       0       7.D0\n"
                                            "        2       0       -30.D0          3       0       90.D0\n"
                                            "DMIG    KA      4       0               1       0       -8.D0\n"
                                            "        4       0       25.D0\n"
                                            "ENDDATA\n");
  ASSERT_EQ(w.size(), 3u);
  EXPECT_NEAR(w[0], 8.983111452811, 1e-11);
  EXPECT_NEAR(w[1], 10.04309477126, 1e-10);
  EXPECT_NEAR(w[2], 14.26716146752, 1e-10);
}

std::string double_pendulum(const std::string& joints) {
  // g (m1 L1/2 + m2 L1) and g m2 L2/2
  return head + "SPC = 1\nMPC = 1\nK2PP = K\nBEGIN BULK\n" + eigc +
         "PARAM,AUTOMSET,LUSOL\n"
         "GRID,1,,0.,0.,0.,,123456\n"
         "GRID,2,,0.,-.5,0.\n"
         "GRID,3,,0.,0.,0.\n"
         "GRID,4,,0.,-1.,0.\n"
         "GRID,5,,0.,-1.4,0.\n"
         "GRID,6,,0.,-1.,0.\n"
         "CONM2,11,2,,2.\n,.2,,.2,,,.2\n"
         "CONM2,12,5,,1.5\n,.1,,.1,,,.1\n"
         "RBE2,21,2,123456,3,4\n"
         "RBE2,22,5,123456,6\n" +
         joints +
         "DMIG,K,0,6,2,0\n"
         "DMIG,K,2,6,,2,6,24.525D0\n"
         "DMIG,K,5,6,,5,6,5.886D0\n"
         "SPC1,1,1,1\nENDDATA\n";
}

TEST(SolvedDeck, double_pendulum_of_hinges) {
  const std::vector<double> w =
      frequencies(double_pendulum("RJOINT,31,1,3,12345\nRJOINT,32,4,6,12345\nMPC,1,2,3,1.,2,3,1.\n"));
  ASSERT_EQ(w.size(), 2u);
  EXPECT_NEAR(w[0], 2.81534543997, 1e-10);
  EXPECT_NEAR(w[1], 6.85120691843, 1e-10);
}

// Which component is dependent, and how often a row is said, changes nothing.
TEST(SolvedDeck, is_the_same_however_its_constraints_are_written) {
  const std::vector<double> w =
      frequencies(double_pendulum("RJOINT,31,1,3,12345\nRJOINT,32,6,4,12345\n"
                                  "RBAR,40,1,3,123456,,,123\n"
                                  "MPC,1,4,1,-1.,6,1,1.\nMPC,1,6,1,3.,4,1,-3.\n"
                                  "MPC,1,2,3,1.,2,4,2.\n"));
  ASSERT_EQ(w.size(), 2u);
  EXPECT_NEAR(w[0], 2.81534543997, 1e-10);
  EXPECT_NEAR(w[1], 6.85120691843, 1e-10);
}

TEST(SolvedDeck, hinge_in_a_skewed_system) {
  // The hinge at (1, 2, 3) about (1, 2, 2)/3, x towards (2, 1, -2)/3, y = z × x = (-2, 2, -1)/3.
  const Vector3d x = Vector3d(2, 1, -2) / 3, y = Vector3d(-2, 2, -1) / 3;
  const Vector3d centre = Vector3d(1, 2, 3) + 0.5 * x + 0.1 * y;
  char grid[200];
  std::snprintf(grid, sizeof grid,
                "GRID*   2                              %16.12f%16.12f\n*       %16.12f               7\n", centre.x(),
                centre.y(), centre.z());
  const ModeSolution s = modes(head + "SPC = 1\nK2PP = K\nB2PP = B\nBEGIN BULK\n" + eigc +
                               "CORD2R  7               1.      2.      3.      2.      4.      5.      +A\n"
                               "+A      3.      3.      1.\n"
                               "GRID,1,,1.,2.,3.,7\n"
                               "GRID,3,,1.,2.,3.,7\n" +
                               grid +
                               "RBE2,21,3,123456,2\n"
                               "RJOINT,31,1,3,12345\n"
                               "SPC,1,1,123456\n"
                               "CONM2,11,2,7,3.\n,.5,,.6,,,.9\n"
                               "DMIG,K,0,1,2,0\nDMIG,K,2,6,,2,6,50.D0\n"
                               "DMIG,B,0,1,2,0\nDMIG,B,2,6,,2,6,.3D0\nENDDATA\n");
  expect_pairs(s, {{-0.0892857143, 5.45471657}}, 1e-9);
}

TEST(SolvedDeck, closed_box_with_singular_mass_has_finite_eigenvalues_only) {
  // Points 1 to 4 of second order, 5 to 7 of first order; all coupled, unsymmetric.
  std::string text = head + "K2PP = K\nB2PP = B\nM2PP = M\nBEGIN BULK\n" + eigc + "SPOINT,1,THRU,7\n";
  for (const std::string name : {"K", "B", "M"}) {
    text += "DMIG," + name + ",0,1,2,0\n";
    for (int c = 1; c <= (name == "M" ? 4 : 7); ++c) {
      text += "DMIG," + name + "," + std::to_string(c) + ",0";
      bool first = true;
      for (int r = 1; r <= 7; ++r) {
        double value = 0;
        if (name == "M" && r <= 4 && c <= 4) value = r == c ? 2 + r : 0.1 * (r + c);
        if (name == "B" && r <= 4 && c <= 4) value = r == c ? 0.3 : 0;
        if (name == "B" && r > 4 && r == c) value = 1;
        if (name == "K") value = r == c ? 40 * r : std::sin(3 * r + 5 * c);
        if (value == 0) continue;
        char term[60];
        std::snprintf(term, sizeof term, "%s,%d,0,%.2fD0\n", first ? "," : "", r, value);
        text += term;
        first = false;
      }
    }
  }
  const ModeSolution s = modes(text + "ENDDATA\n");
  EXPECT_EQ(s.eigenvalues.size(), 11u);
  for (const Complex& z : s.eigenvalues) EXPECT_LT(std::abs(z), 1000);
}

// A parallelogram of four hinges in a plane that lies askew: three rows of them follow from the others, up to rounding.
TEST(SolvedDeck, closed_loop_with_redundant_joints) {
  const double L = 0.7, m = 3, J = 0.05, k = 40;
  const auto deck = [&](const std::string& joints) {
    return head + "SPC = 1\nBEGIN BULK\n" + eigc +
           "PARAM,AUTOMSET,YES\n"
           "CORD2R,7,,.123,-.456,.789,1.2,.3,2.1\n,.9,-2.1,.05\n"
           "GRID,1,7,0.,0.,0.,7\nGRID,2,7,1.3,0.,0.,7\n"     // ground
           "GRID,10,7,0.,0.,0.,7\nGRID,11,7,0.,.7,0.,7\n"    // left crank
           "GRID,20,7,1.3,0.,0.,7\nGRID,21,7,1.3,.7,0.,7\n"  // right crank
           "GRID,30,7,0.,.7,0.,7\nGRID,31,7,1.3,.7,0.,7\n"   // coupler
           "RBE2,101,10,123456,11\nRBE2,102,20,123456,21\nRBE2,103,30,123456,31\n"
           "CONM2,201,10,7\n,.1,,.1,,,.05\nCONM2,202,20,7\n,.1,,.1,,,.05\nCONM2,203,30,,3.\n,.1,,.1,,,.1\n"
           "SPC1,1,123456,1,2\nCELAS2,301,40.,10,6\n" +
           joints + "ENDDATA\n";
  };
  const double expected = std::sqrt(k / (m * L * L + 2 * J));
  for (const std::string joints :
       {"RJOINT,401,1,10,12345\nRJOINT,402,2,20,12345\nRJOINT,403,11,30,12345\nRJOINT,404,21,31,12345\n",
        "RJOINT,404,31,21,12345\nRJOINT,403,30,11,12345\nRJOINT,402,2,20,12345\nRJOINT,401,10,1,12345\n"}) {
    Prepared p = prepared(deck(joints));
    EXPECT_FALSE(p.diagnostics.has_errors()) << render(p.diagnostics);
    EXPECT_EQ(p.elimination.redundant.size(), 3u);
    EXPECT_TRUE(p.elimination.nearly_redundant.empty());
    const std::vector<double> w = frequencies(deck(joints));
    ASSERT_EQ(w.size(), 1u);
    EXPECT_NEAR(w[0], expected, 1e-12 * expected);
  }
}

// Thousands of rows are eliminated together in no time.
TEST(SolvedDeck, long_chain_of_hinges_is_prepared) {
  constexpr int parts = 400;
  std::string text = head + "SPC = 1\nBEGIN BULK\n" + eigc + "PARAM,AUTOMSET,YES\nGRID,1\nSPC1,1,123456,1\n";
  int before = 1, element = 1;
  for (int k = 0; k < parts; ++k) {
    const int centre = 10 + 3 * k, near = centre + 1, far = centre + 2;
    const auto grid = [&](int id, double x) {
      text += "GRID," + std::to_string(id) + ",," + std::to_string(x).substr(0, 7) + "\n";
    };
    grid(centre, k + .5), grid(near, k), grid(far, k + 1);
    const auto e = [&] { return std::to_string(element++); };
    text += "CONM2," + e() + "," + std::to_string(centre) + ",,1.\n,1.,,1.,,,1.\n";
    text += "RBE2," + e() + "," + std::to_string(centre) + ",123456," + std::to_string(near) + "," +
            std::to_string(far) + "\n";
    text += "RJOINT," + e() + "," + std::to_string(before) + "," + std::to_string(near) + ",12345\n";
    before = far;
  }
  const Prepared p = prepared(text + "ENDDATA\n");
  EXPECT_FALSE(p.diagnostics.has_errors()) << render(p.diagnostics);
  EXPECT_EQ(p.elimination.independent.size(), static_cast<std::size_t>(parts));
  EXPECT_TRUE(p.elimination.redundant.empty());
}

TEST(SolvedDeck, rigid_body_in_space_has_exact_zeros) {
  const ModeSolution s =
      modes(head + "BEGIN BULK\n" + eigc +
            "GRID,1,,.1,.2,.3\nGRID,2,,1.1,.2,.3\nCONM2,1,1,,2.,.3,.1\n,.2,.01,.3,,,.4\nCONM2,2,2,,3.\n,.2,,.3,,,.4\n"
            "CBUSH,3,9,1,2,,,,0\nPBUSH,9,K,3.+5,1.+6,2.+6,7.+4,5.+5,9.+4\nENDDATA\n");
  EXPECT_EQ(s.zeros, 12);
  EXPECT_EQ(s.eigenvalues.size(), 24u);
}

// Masses that cancel but for rounding are none: what is left is a damper and a spring.
TEST(SolvedDeck, masses_that_cancel_leave_a_motion_of_first_order) {
  // (.07, .32, -.39) by itself, on points that move alike.
  const ModeSolution s = modes(head + "MPC = 1\nM2PP = M\nBEGIN BULK\n" + eigc +
                               "SPOINT,1,2,3\nMPC,1,1,,1.,2,,-1.\nMPC,1,3,,1.,2,,-1.\nCELAS2,1,6.,1\nCDAMP2,2,2.,3\n"
                               "DMIG,M,0,6,2,0\n"
                               "DMIG,M,1,0,,1,0,.0049D0\n,2,0,.0224D0,,3,0,-.0273D0\n"
                               "DMIG,M,2,0,,2,0,.1024D0\n,3,0,-.1248D0\n"
                               "DMIG,M,3,0,,3,0,.1521D0\nENDDATA\n");
  ASSERT_EQ(s.eigenvalues.size(), 1u);
  EXPECT_NEAR(s.eigenvalues[0].real(), -3, 1e-14);
}

TEST(SolvedDeck, tells_what_nothing_touches_and_takes_it_out) {
  Prepared p = prepared(head + "BEGIN BULK\n" + eigc +
                        "GRID,7\nCONM2,1,7,,2.\nCELAS2,2,8.,7,1\nCELAS2,3,8.,7,2\nCELAS2,4,8.,7,3\nENDDATA\n");
  const auto s = solve_modes(p, p.diagnostics);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->eigenvalues.size(), 6u);
  EXPECT_THAT(render(p.diagnostics), HasSubstr("GRID 7 component 456 have no mass"));
}

TEST(SolvedDeck, singular_matrices_are_a_failure_with_a_name) {
  Prepared p = prepared(head + "K2PP = K\nBEGIN BULK\n" + eigc +
                        "SPOINT,1,2\nDMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.\n,2,0,1.\nENDDATA\n");
  const auto s = solve_modes(p, p.diagnostics);
  ASSERT_FALSE(s);
  EXPECT_THAT(s.error(), HasSubstr("the column of SPOINT 2 is empty"));
}

TEST(SolvedDeck, mode_shape_of_the_first_mode) {
  Prepared p = prepared(double_pendulum("RJOINT,31,1,3,12345\nRJOINT,32,4,6,12345\nMPC,1,2,3,1.\n"));
  const auto s = solve_modes(p, p.diagnostics);
  ASSERT_TRUE(s);
  const Eigen::VectorXcd u = mode_shape(p, *s, s->eigenvalues[1]);
  // The lower rod's centre moves furthest or a rotation does; joints stay together.
  EXPECT_NEAR(u.cwiseAbs().maxCoeff(), 1, 1e-14);
  const Point &a = *p.points->find(4), &b = *p.points->find(6);
  EXPECT_NEAR(std::abs(u[a.first] - u[b.first]), 0, 1e-13);
  const Point &one = *p.points->find(2), &two = *p.points->find(5);
  const std::complex<double> z = s->eigenvalues[1];
  // The second equation of motion of the rods' angles: m2 L2/2 L1 θ1″ + (I2 + m2 L2²/4) θ2″ + m2 g L2/2 θ2 = 0.
  EXPECT_LT(
      std::abs(z * z * (1.5 * .4 * u[one.first + 5] + (.1 + 1.5 * .16) * u[two.first + 5]) + 5.886 * u[two.first + 5]),
      1e-12);
}

}  // namespace
}  // namespace dynalin::nastran_reader::solve_test
