// NMODES and BAND where zeros of the structure stand in chains that rounding scatters, where values are dense or
// double, and where bounds leave the membership open: what the full solution lists, and nothing that is not so.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <complex>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::nothing_missed_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Complex = std::complex<double>;

class NothingMissed : public Cases {
 protected:
  RunResult solve(const std::string& dataset, const std::string& command, bool sparse) const {
    SessionOptions options;
    if (sparse) options.dense_up_to = 0;
    return run(dataset, "LINEAR/EIGENSOL" + command + "\n", options);
  }
  struct Listed {
    std::size_t zeros = 0;
    std::vector<Complex> modes;  // those that are no zeros of the structure, by modulus
    double slow_bound = 0;       // the largest of those below a thousandth of a hertz
  };
  static Listed listed(const RunResult& r) {
    Listed all;
    std::vector<Complex> upper;
    for (const auto& e : r.result(0).at("eigenvalues")) {
      if (e.at("imag_hz").get<double>() >= 0) upper.emplace_back(e.at("real_hz"), e.at("imag_hz"));
    }
    const auto& modes = r.result(0).at("modes");
    EXPECT_EQ(modes.size(), upper.size());
    for (std::size_t k = 0; k < upper.size(); ++k) {
      if (modes[k].at("structural_zero").get<bool>()) {
        ++all.zeros;
      } else {
        all.modes.push_back(upper[k]);
        if (std::abs(upper[k]) < 1e-3)
          all.slow_bound = std::max(all.slow_bound, modes[k].at("error_bound_hz").get<double>());
      }
    }
    std::ranges::sort(all.modes, {}, [](Complex v) { return std::abs(v); });
    return all;
  }
  // n modes beside as many zeros as the full solution has, the nearest of them.
  void expect_nearest(const std::string& dataset, std::size_t n) const {
    SCOPED_TRACE(n);
    const RunResult all = solve(dataset, "", false), some = solve(dataset, ", NMODES=" + std::to_string(n), true);
    ASSERT_EQ(all.status, 0) << all.err;
    ASSERT_EQ(some.status, 0) << some.err;
    const Listed full = listed(all), found = listed(some);
    EXPECT_TRUE(some.result(0).at("selected").at("complete")) << some.err;
    EXPECT_THAT(some.err, Not(HasSubstr("missing-mode")));
    EXPECT_EQ(found.zeros, full.zeros);
    ASSERT_GE(found.modes.size(), std::min(n, full.modes.size()));
    for (std::size_t k = 0; k < found.modes.size(); ++k) {
      const double size = std::abs(full.modes[k]);
      const double slow = size < 1e-3 ? found.slow_bound + full.slow_bound : 0.0;
      EXPECT_NEAR(std::abs(found.modes[k]), size, std::max(1e-7 * size, slow));
    }
  }
};

// Parts in a row that nothing holds, with dampers: twelve zeros, six of them of second order.
std::string free_row(int n, double K, double C) {
  std::string s = "Free row\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n";
  for (int k = 2; k < n + 2; ++k) {
    s += fmt::format("PART/{0}, MASS=1.8, CM={0}, IP=1,2,2.5\nMARKER/{0}\n", k);
    if (k > 2) {
      s += fmt::format("BUSHING/{0}, I={0}, J={1}, K={2},{3},{4}, C=0,{5},0, KT={6},{7},{8}, CT={9},0,0\n", k, k - 1, K,
                       1.1 * K, 1.2 * K, C, K / 20, K / 25, K / 33, C / 3);
    }
  }
  return s + "END\n";
}

TEST_F(NothingMissed, in_free_rows_with_dampers) {
  for (const double K : {1e2, 1e4, 1e9}) {
    for (const std::size_t n : {1u, 5u, 8u, 11u}) expect_nearest(free_row(3, K, 10), n);
  }
  expect_nearest(free_row(40, 1e3, 1), 7);
}

// Two free parts, so stiff that the zeros are scattered beside the first shift.
TEST_F(NothingMissed, between_two_free_parts_held_by_a_stiff_bushing) {
  const std::string pair =
      "Pair\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nPART/3, MASS=1.8, CM=30, IP=1,2,2.5, QG=1.06,-0.07,-0.48\nMARKER/30\n"
      "PART/7, MASS=2.05, CM=70, IP=0.5,0.5,0.7, QG=0.81,-1.6,-0.09\nMARKER/70\nBUSHING/7, I=70, J=30, "
      "K=2.3E14,3.4E14,7.6E13, C=3478,109130,0, KT=9E9,4E9,1.5E10, CT=0,62550,12934\nEND\n";
  for (const std::size_t n : {1u, 4u}) expect_nearest(pair, n);
}

// A row of stiff bushings on one that is all but nothing.
std::string barely_held_row(int n) {
  constexpr double soft = 0.001;
  std::string s = fmt::format(
      "Row\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nBUSHING/2, I=2, J=1, K={0},{1},{2}, C={3},0,0, "
      "KT={0},{2},{4}, CT=0,0,0\n",
      soft, 1.1 * soft, 1.2 * soft, 0.01 * soft, 1.3 * soft);
  for (int k = 2; k < n + 2; ++k) {
    s += fmt::format(
        "PART/{0}, MASS=1.8, CM={0}, IP=1,2,2.5, QG={1},0,0\nMARKER/{0}\nMARKER/{2}, PART={0}, QP=0.1,0,0\n", k,
        0.1 * (k - 2), 1000 + k);
    if (k > 2) {
      s += fmt::format(
          "BUSHING/{0}, I={0}, J={1}, K=1E8,1.1E8,1.2E8, C=1E3,1E3,1E3, KT=1E7,1.2E7,1.3E7, CT=100,100,100\n", k,
          999 + k);
    }
  }
  return s + "END\n";
}

// Six pairs at a thousandth of a hertz or less beside modes of 100 Hz: rounding scatters them over the real axis, where
// they look like twelve modes. Where bounds cannot tell them apart either, the full solution has to.
TEST_F(NothingMissed, slow_pairs_are_one_mode_each) {
  for (const int n : {8, 60}) expect_nearest(barely_held_row(n), 14);
  const RunResult r = solve(barely_held_row(60), ", NMODES=14", true);
  EXPECT_EQ(r.result(0).at("selected").at("counted_by"), "winding_number");
  // Those of the row without dampers, by block elimination and inverse iteration with 60 digits; dampers change them by
  // less than 1e-11.
  const std::array<double, 6> exact = {0.000144342838604355, 0.000148109852876399, 0.000484293069229897,
                                       0.000649747333727803, 0.000903991852962799, 0.000961760474098156};
  const Listed found = listed(r);
  EXPECT_LT(found.slow_bound, 1e-6);
  for (std::size_t k = 0; k < exact.size(); ++k)
    EXPECT_NEAR(std::abs(found.modes.at(k)), exact[k], found.slow_bound) << k;
}

// Two masses on a spring in free space, a third one alone, and a filter that sees it: of the motions that the third
// and the filter make two are one.
TEST_F(NothingMissed, beside_a_filter_that_reads_a_free_mass) {
  std::string s =
      "Filter\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nDIFF/1, FUNCTION=-DIF(1)+DX(2,1)\nBUSHING/3, I=9, "
      "J=8, K=300,200,400\n";
  for (const int k : {2, 8, 9}) s += fmt::format("POINT_MASS/{0}, MASS=1, CM={0}\nMARKER/{0}\n", k);
  s += "END\n";
  const RunResult all = solve(s, "", false);
  ASSERT_EQ(all.status, 0) << all.err;
  const Listed full = listed(all);
  EXPECT_EQ(full.zeros, 12u);
  ASSERT_EQ(full.modes.size(), 4u);
  const std::array<double, 4> expected = {1, 20, std::sqrt(600.0), std::sqrt(800.0)};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(2 * std::numbers::pi * std::abs(full.modes[k]), expected[k], 1e-11 * expected[k]);
  const RunResult band = solve(s, ", BAND=1,20", true);
  ASSERT_EQ(band.status, 0) << band.err;
  EXPECT_EQ(listed(band).zeros, 12u);
  EXPECT_EQ(listed(band).modes.size(), 3u);
}

// A state that never changes and one that reads it, beside forces that are functions and more states than a state
// matrix is made for: nothing moves along any of them.
TEST_F(NothingMissed, beside_states_that_read_a_constant_one) {
  std::string s =
      "Constant\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nDIFF/1, FUNCTION=0\n"
      "DIFF/9, FUNCTION=-0.5*DIF(9)+DIF(1)\n";
  for (int k = 0; k < 52; ++k) {
    s += fmt::format(
        "POINT_MASS/{0}, MASS=1, CM={0}\nMARKER/{0}\nMARKER/2{0}, PART=1, FLOATING\nVFORCE/{0}, I={0}, JFLOAT=2{0}, "
        "RM=1\n"
        ", FX=-{1}*DX({0})-10*VX({0})\\FY=-{2}*DY({0})-10*VY({0})\\FZ=-{3}*DZ({0})-10*VZ({0})\n",
        1000 + k, 1e4 + 10 * k, 2e4 + 10 * k, 3e4 + 10 * k);
  }
  expect_nearest(s + "END\n", 2);
}

// Masses of their own springs, f² + 1/(16 π²) = (100 + k)/(4 π²), a hundred in a band beside hundreds more, too many
// states for the full solution to help: the count off the real axis is that of the closed form.
TEST_F(NothingMissed, of_a_dense_row_of_values_beside_a_border) {
  std::string s = "Row\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  constexpr int n = 420;
  for (int k = 0; k < n; ++k) {
    s += fmt::format("POINT_MASS/{0}, MASS=1, CM={0}\nMARKER/{0}\nBUSHING/{0}, I={0}, J=1, K={1},{2},{3}, C=1,0,0\n",
                     1000 + k, 100 + k, 1000 + k, 2000 + k);
  }
  s += "END\n";
  for (const auto& [low, high] : {std::pair(1.0, 1.7), std::pair(1.6, 1.9)}) {
    std::size_t inside = 0;
    for (int k = 0; k < n; ++k) {
      const double f = std::sqrt(100 + k - 0.25) / (2 * std::numbers::pi);
      inside += f >= low && f <= high ? 2 : 0;
    }
    const RunResult r = solve(s, fmt::format(", BAND={},{}", low, high), true);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto& selected = r.result(0).at("selected");
    EXPECT_EQ(selected.at("counted_by"), "winding_number");
    EXPECT_EQ(selected.at("found"), inside);
    EXPECT_EQ(selected.at("counted"), inside);
    EXPECT_TRUE(selected.at("complete")) << r.err;
  }
}

// A double value exactly at the border of a band: its bound is wider than its distance.
TEST_F(NothingMissed, what_may_be_beyond_the_border_is_no_complete_list) {
  const std::string critical =
      "Critical\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS=1, CM=2\nMARKER/2\nBUSHING/1, I=2, "
      "J=1, "
      "K=1,9,25, C=2,0,0\nEND\n";
  for (const bool sparse : {true, false}) {
    const RunResult r = solve(critical, ", BAND=0,0.15915494309189535", sparse);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_FALSE(r.result(0).at("selected").at("complete"));
    EXPECT_THAT(r.err, HasSubstr("but bounds do not tell whether one at the border is inside [incomplete-modes]"));
    EXPECT_EQ(listed(r).modes.size(), 2u);
    const RunResult wider = solve(critical, ", BAND=0,0.16", sparse);
    EXPECT_TRUE(wider.result(0).at("selected").at("complete")) << wider.err;
  }
}

// −1 of second order, −2 and −3: two values are two of those that are asked for, whatever they look like before their
// bounds.
TEST_F(NothingMissed, double_values_count_as_two) {
  const std::string chain =
      "Chain\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nARRAY/2, X\nARRAY/3, IC, SIZE=4, NUMBERS=0,0,0,0\nMATRIX/1, "
      "FULL=RORDER, ROWS=4, COLUMNS=4, VALUES=-1,1,0,0, 0,-1,0,0, 0,0,-2,0, 0,0,0,-3\nLSE/1, X=2, A=1, IC=3\nEND\n";
  for (const bool sparse : {true, false}) {
    for (const std::size_t n : {2u, 3u}) {
      const RunResult r = solve(chain, ", NMODES=" + std::to_string(n), sparse);
      ASSERT_EQ(r.status, 0) << r.err;
      EXPECT_EQ(listed(r).modes.size(), n);
      EXPECT_TRUE(r.result(0).at("selected").at("complete"));
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::nothing_missed_test
