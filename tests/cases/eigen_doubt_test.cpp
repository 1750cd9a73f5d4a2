// What tables and JSON say of eigenvalues that are not certain to all digits printed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/run.h"

namespace dynalin::cases::eigen_doubt_test {
namespace {

class EigenDoubt : public Cases {};

// (s + 1)^7: one eigenvalue, seven times, with one vector.
const char* const seventh_power =
    "controller\nPART/1, GROUND\nVARIABLE/1, FUNCTION=0\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\n"
    "TFSISO/1, U=1, X=2, Y=3, NUM=1, DEN=1,7,21,35,35,21,7,1\nEND\n";
const char* const simple_lag =
    "controller\nPART/1, GROUND\nVARIABLE/1, FUNCTION=0\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\n"
    "TFSISO/1, U=1, X=2, Y=3, NUM=1, DEN=2,3,1\nEND\n";

TEST_F(EigenDoubt, a_defective_eigenvalue_is_printed_as_the_mean_of_its_cluster_and_marked) {
  const RunResult r = run(seventh_power, "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const double exact = -1 / (2 * 3.14159265358979323846);
  ASSERT_EQ(r.result(0).at("modes").size(), 7u);
  for (const auto& m : r.result(0).at("modes")) {
    EXPECT_EQ(m.at("cluster_size").get<int>(), 7);
    const double bound = m.at("error_bound_hz").get<double>();
    EXPECT_LE(std::abs(m.at("real_hz").get<double>() - exact), 1e-15);  // rounding of the mean and of 1/2π
    EXPECT_GT(bound, 1e-6);  // what 1e-19 makes of a value seven times defective
    EXPECT_LT(bound, 0.05);
    EXPECT_EQ(m.at("imag_hz").get<double>(), 0);
  }
  EXPECT_NE(r.message.find("1             -1.59155E-01?\n"), std::string::npos) << r.message;
  EXPECT_NE(r.message.find("? the error bound is larger than the last digit printed"), std::string::npos);
  EXPECT_NE(r.message.find("1 to 7: the mean of 7 eigenvalues within"), std::string::npos);
  EXPECT_NE(r.out.find("-0.1591549?"), std::string::npos) << r.out;
}

TEST_F(EigenDoubt, well_determined_values_bear_no_mark) {
  const RunResult r = run(simple_lag, "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.message.find('?'), std::string::npos) << r.message;
  EXPECT_EQ(r.out.find('?'), std::string::npos) << r.out;
}

TEST_F(EigenDoubt, without_vectors_values_and_bounds_are_the_same) {
  for (const char* dataset : {seventh_power, simple_lag}) {
    const RunResult r = run(dataset, "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, NOVECTOR\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto &with = r.result(0).at("modes"), &without = r.result(1).at("modes");
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t k = 0; k < with.size(); ++k) {
      for (const char* what : {"real_hz", "imag_hz", "error_bound_hz", "condition", "cluster_size"})
        EXPECT_EQ(with.at(k).at(what), without.at(k).at(what)) << what;
      EXPECT_FALSE(without.at(k).contains("vector"));
    }
  }
}

// Two equal parts on equal mounts, with and without a critically damped slide beside them: that nothing tells the
// slide's two values apart, nor equal ones from each other, costs no digit of the frequencies of the parts.
TEST_F(EigenDoubt, equal_parts_keep_their_frequencies_beside_a_defective_value) {
  std::string parts = "Parts\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n";
  for (const int k : {2, 3}) {
    parts += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, QG=0,{1},0.3, IP=0.8,0.8,0.8\nMARKER/{0}0\nMARKER/{0}1\n"
        "MARKER/{0}2, PART=1, QP=0,{1},0.3\nBUSHING/{0}, I={0}1, J={0}2, K=500,500,500, KT=200,200,200\n",
        k, 2 * k - 5);
  }
  const std::string slide =
      "MARKER/8, PART=1, REULER=90D,90D,0\nPART/9, MASS=1.1, CM=90, IP=1,1,1, QG=5,0,0\nMARKER/90\n"
      "MARKER/91, REULER=90D,90D,0\nJOINT/9, TRANSLATIONAL, I=91, J=8\n"
      "SPRINGDAMPER/9, TRANSLATION, I=90, J=8, K=110, C=22, LENGTH=5\n";
  for (const std::string& beside : {std::string(), slide}) {
    const RunResult r = run(parts + beside + "END\n", "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    int equal = 0;
    for (const auto& mode : r.result(0).at("modes")) {
      if (mode.at("imag_hz").get<double>() == 0) continue;
      EXPECT_NEAR(mode.at("imag_hz").get<double>(), std::sqrt(250.0) / 2 / 3.14159265358979324, 1e-14);
      EXPECT_LT(mode.at("error_bound_hz").get<double>(), 1e-13);
      ++equal;
    }
    EXPECT_EQ(equal, 12);
  }
}

// What is a double value each stays one, however far the bound of a group would reach if it were joined with another.
TEST_F(EigenDoubt, defective_values_that_lie_apart_are_not_joined) {
  const char* const filters =
      "Filters\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, "
      "J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-25*DZ(20,1)-10*VZ(20,1)\n"
      "DIFF/1, FUNCTION=-1*DIF(1)+DZ(20,1)\nDIFF/2, FUNCTION=-1*DIF(2)+DIF(1)\nEND\n";
  const auto states = [](int n, const std::string& values) {
    return fmt::format(
        "States\nPART/1, GROUND\nMATRIX/1, FULL=RORDER, ROWS={0}, COLUMNS={0}, VALUES={1}\n"
        "LSE/1, X=1, A=1\nARRAY/1, X\nEND\n",
        n, values);
  };
  const std::string integers = states(4, "1,1,0,1\n, -1,-1,0,0\n, 4,2,-1,3\n, 0,0,0,-1");
  const std::string three = states(6,
                                   "-1,1,0,1,0,2\n, 0,-1,1,0,3,0\n, 0,0,-1,1,0,1\n, 0,0,0,-2,1,0\n, 0,0,0,0,-5,1\n, "
                                   "0,0,0,0,0,-5");
  using Values = std::vector<std::pair<double, int>>;
  for (const auto& [text, exact] : {std::pair<std::string, Values>(filters, {{-1, 2}, {-5, 2}}),
                                    std::pair<std::string, Values>(integers, {{0, 2}, {-1, 2}}),
                                    std::pair<std::string, Values>(three, {{-1, 3}, {-2, 1}, {-5, 2}})}) {
    const RunResult r = run(text, "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    for (const auto& [value, times] : exact) {
      EXPECT_EQ(std::ranges::count_if(r.result(0).at("modes"),
                                      [&, hz = value / (2 * 3.14159265358979323846)](const nlohmann::json& m) {
                                        const double bound = m.at("error_bound_hz").get<double>();
                                        return std::abs(m.at("real_hz").get<double>() - hz) <= bound && bound < 1e-3;
                                      }),
                times)
          << value << "\n"
          << r.out;
    }
  }
}

// Also where there are too many states for long double: of 151 slides that do not touch one is critically damped.
TEST_F(EigenDoubt, a_defective_value_takes_no_bound_from_others_in_large_models) {
  std::string text = "Slides\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 0; k < 151; ++k) {
    text += fmt::format(
        "PART/{0}, MASS=1, CM={0}, IP=1,1,1, QG={1},0,0\nMARKER/{0}\nMARKER/{2}, PART=1, QP={1},0,0\n"
        "JOINT/{0}, TRANSLATIONAL, I={0}, J={2}\nSFORCE/{0}, TRANSLATIONAL, ACTIONONLY, I={0}, J={2}, "
        "FUNCTION=-{3}*DZ({0},{2}){4}\n",
        100 + k, k, 1000 + k, k == 0 ? 4.0 : (2.9 + 0.1 * k) * (2.9 + 0.1 * k), k == 0 ? "-4*VZ(100,1000)" : "");
  }
  const RunResult r = run(text + "END\n", "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.err.find("overdamped"), std::string::npos) << r.err;
  const auto& modes = r.result(0).at("modes");
  ASSERT_EQ(modes.size(), 152u);
  constexpr double cycle = 2 * 3.14159265358979323846;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    ASSERT_FALSE(modes[k].at("error_bound_hz").is_null()) << k;
    const double bound = modes[k].at("error_bound_hz").get<double>();
    if (k < 2) {
      EXPECT_LE(std::abs(modes[k].at("real_hz").get<double>() + 2 / cycle), bound);
      EXPECT_LT(bound, 1e-6);
      EXPECT_EQ(modes[k].at("cluster_size").get<int>(), 2);
    } else {
      EXPECT_LE(std::abs(modes[k].at("imag_hz").get<double>() - (2.9 + 0.1 * static_cast<double>(k - 1)) / cycle),
                bound + 1e-15);
      EXPECT_LT(bound, 1e-12);
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::eigen_doubt_test
