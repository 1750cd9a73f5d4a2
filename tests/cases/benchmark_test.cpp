// Published problems of the field, at their closed-form or extended-precision values.
#include <fmt/format.h>

#include <numbers>

#include "cases/both.h"

namespace dynalin::cases::benchmark_test {
namespace {

using Benchmarks = ProgramAndLibrary;
using Complex = std::complex<double>;
constexpr double tau = 2 * std::numbers::pi;

// A uniform cylinder on a massless rod, centre of mass 0.1 above a ball joint, spinning about the vertical. `axis` says
// which local axis of the part is the spin axis; the part is turned so that it stands upright.
std::string top(char axis, double spin) {
  const double C = 0.00125, A = 0.010658333333333333 - 0.01;  // about the centre of mass
  const std::string reuler = axis == 'z' ? "0,0,0" : axis == 'y' ? "0,90D,0" : "90D,90D,90D";
  const std::string cm = axis == 'z' ? "0,0,0.1" : axis == 'y' ? "0,0.1,0" : "0.1,0,0";
  const std::string inertia = axis == 'z'   ? fmt::format("{0:.17g},{0:.17g},{1:.17g}", A, C)
                              : axis == 'y' ? fmt::format("{0:.17g},{1:.17g},{0:.17g}", A, C)
                                            : fmt::format("{1:.17g},{0:.17g},{0:.17g}", A, C);
  return fmt::format(
      "A sleeping top\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=1, CM=20, IP={}, REULER={}, W{}={}, VX=0, VY=0, VZ=0\nMARKER/20, QP={}\nMARKER/21\n"
      "JOINT/1, SPHERICAL, I=21, J=1\nEND\n",
      inertia, reuler, static_cast<char>(std::toupper(axis)), spin, cm);
}

class SleepingTop : public ProgramAndLibrary, public ::testing::WithParamInterface<char> {};

TEST_P(SleepingTop, has_one_answer_whatever_local_axis_it_spins_about) {
  const RunResult fast = run(top(GetParam(), 200), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(fast.status, 0) << fast.err;
  expect_eigenvalues(fast.eigenvalues(0), {0, 0, Complex(0, 4.982301025652 / tau), Complex(0, 18.473523837522 / tau)},
                     1e-11);
  const RunResult slow = run(top(GetParam(), 100), "LINEAR/EIGENSOL\n");
  const auto values = slow.eigenvalues(0);
  ASSERT_EQ(values.size(), 6u);
  for (std::size_t k = 2; k < 6; ++k) {
    EXPECT_NEAR(std::abs(values[k].real()) * tau, 7.593067513354, 1e-10);
    EXPECT_NEAR(std::abs(values[k].imag()) * tau, 5.863956215794, 1e-10);
  }
}
INSTANTIATE_TEST_SUITE_P(local, SleepingTop, ::testing::Values('x', 'y', 'z'));

TEST_F(Benchmarks, relative_to_a_marker_on_the_top_every_value_shifts_by_the_spin) {
  const RunResult r = run(top('z', 200), "LINEAR/EIGENSOL, RM=21\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::vector<double> expected;
  for (const double w : {18.473523837522, 4.982301025652}) expected.push_back(std::abs(w - 200.0) / tau);
  std::sort(expected.begin(), expected.end());
  const auto values = r.eigenvalues(0);
  ASSERT_EQ(values.size(), 6u);
  EXPECT_NEAR(values[2].imag(), expected[0], 1e-9);
  EXPECT_NEAR(values[4].imag(), expected[1], 1e-9);
}

// n links of length 1/n hanging from a hinge; rods with their inertia, or all mass at the lower end.
std::string chain(int n, bool rods) {
  const double h = 1.0 / n, m = 1.0 / n;
  std::string text = "A hanging chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 1; k <= n; ++k) {
    const int id = k + 1;
    text += fmt::format("PART/{}, MASS={:.17g}, CM={}, QG=0,{:.17g},0, IP=0,0,{:.17g}\n", id, m, 10 * id, -(k - 1) * h,
                        rods ? m * h * h / 12 : 0.0);
    text += fmt::format("MARKER/{}, QP=0,{:.17g},0\nMARKER/{}\nMARKER/{}, QP=0,{:.17g},0\n", 10 * id,
                        rods ? -h / 2 : -h, 10 * id + 1, 10 * id + 2, -h);
    text += fmt::format("JOINT/{}, REVOLUTE, I={}, J={}\n", k, 10 * id + 1, k == 1 ? 1 : 10 * (id - 1) + 2);
  }
  return text + "END\n";
}

void expect_lowest(const RunResult& r, const std::vector<double>& rad, double relative) {
  const auto values = r.eigenvalues(1);
  for (std::size_t k = 0; k < rad.size(); ++k) {
    EXPECT_NEAR(values[2 * k].imag() * tau, rad[k], relative * rad[k]) << "mode " << k + 1;
  }
}

TEST_F(Benchmarks, hanging_chain_of_masses_follows_the_laguerre_zeros) {
  const RunResult three = run(chain(3, false), "SIM/STAT\nLIN/EIG\n");
  ASSERT_EQ(three.status, 0) << three.err;
  expect_lowest(three, {3.49803447755133, 8.21709626346267, 13.6056269164949}, 1e-13);
  const RunResult hundred = run(chain(100, false), "SIM/STAT\nLIN/EIG\n");
  expect_lowest(hundred, {3.756702038025733, 8.623418312648027}, 1e-10);
}

TEST_F(Benchmarks, hanging_chain_of_rods) {
  const RunResult five = run(chain(5, true), "SIM/STAT\nLIN/EIG\n");
  ASSERT_EQ(five.status, 0) << five.err;
  expect_lowest(five, {3.770504534515, 8.948640997891, 15.187287922245, 23.366252154665}, 1e-12);
  const RunResult hundred = run(chain(100, true), "SIM/STAT\nLIN/EIG\n");
  expect_lowest(hundred, {3.766078942130, 8.645587348381, 13.558182125466, 18.487688689792}, 1e-10);
}

TEST_F(Benchmarks, cart_pole_state_and_input_matrix) {
  const RunResult r =
      run("Cart and pole\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.8\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\nMARKER/2, "
          "QP=-5,0,0\n"
          "PART/2, MASS=0.5, CM=20\nMARKER/20\nMARKER/21, REULER=90D,90D,0\n"
          "PART/3, MASS=0.2, CM=30, IP=0.006,0.006,0.006\nMARKER/30, QP=0,0.3,0\nMARKER/31\n"
          "JOINT/1, TRANSLATIONAL, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=20\n"
          "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, C=0.1\n"
          "VARIABLE/1, FUNCTION=0\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=VARVAL(1)\nPINPUT/1, "
          "VARIABLES=1\nEND\n",
          "LINEAR/STATEMAT, PINPUT=1, FILE=plant\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto A = r.matrix(0, "A"), B = r.matrix(0, "B");
  const std::vector<double> cart = {-0.1818181818181818, 0, 0, 2.672727272727273},
                            pole = {-0.4545454545454545, 0, 0, 31.18181818181818};
  for (std::size_t k = 0; k < 4; ++k) {
    expect_close(A[0][k], cart[k], 1e-13);
    expect_close(A[2][k], pole[k], 1e-13);
  }
  expect_close(B[0][0], 1.818181818181818, 1e-13);
  expect_close(B[2][0], 4.545454545454545, 1e-13);
  const auto values = r.eigenvalues(1);
  EXPECT_EQ(values[0], 0.0);
  expect_close(values[1].real() * tau, -0.1428316356947783, 1e-12);
  expect_close(values[2].real() * tau, 5.565107579431316, 1e-12);
  expect_close(values[3].real() * tau, -5.604094125554719, 1e-12);
}

}  // namespace
}  // namespace dynalin::cases::benchmark_test
