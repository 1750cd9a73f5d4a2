// Selected modes of models with many eigenvalues alike, or many zeros, above the size up to which all modes are
// computed: what the search cannot tell apart is found by the full solution, and nothing is called complete that is
// not.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <string>

#include "cases/run.h"

namespace dynalin::cases::many_alike_test {
namespace {

using ::testing::HasSubstr;

using ManyAlike = Cases;

const std::string head = "Many alike\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";

// A disc on a hinge with a spring: one mode at √KT.
std::string hinged(int id, double stiffness) {
  return fmt::format(
      "PART/{0}, MASS=1, CM={0}, IP=1,1,1, QG={0},9,0\nMARKER/{0}\nMARKER/{1}, PART=1, QP={0},9,0\n"
      "JOINT/{0}, REVOLUTE, I={0}, J={1}\nSPRINGDAMPER/{0}, ROTATIONAL, I={0}, J={1}, KT={2}\n",
      id, 50000 + id, stiffness);
}
std::string free_part(int id, double spin) {
  return fmt::format("PART/{0}, MASS=1, CM={0}, IP=1,1,1, QG={0},0,0, WZ={1}\nMARKER/{0}\n", id, spin);
}

const nlohmann::json& modes_of(const RunResult& r) { return r.result(0).at("modes"); }
std::size_t zeros(const RunResult& r) {
  return static_cast<std::size_t>(std::count_if(modes_of(r).begin(), modes_of(r).end(),
                                                [](const auto& m) { return m.at("structural_zero") == true; }));
}
bool complete(const RunResult& r) { return r.result(0).at("selected").at("complete") == true; }

// A ball that turns has ten zeros and a pair at its speed.
TEST_F(ManyAlike, zeros_of_bodies_that_turn_at_different_speeds_are_all_found) {
  std::string dataset = head;
  for (int k = 1; k <= 7; ++k) dataset += free_part(10 + k, k);
  for (int k = 0; k < 210; ++k) dataset += hinged(1000 + k, 100 + k);
  for (const char* commands :
       {"LINEAR/EIGENSOL, BAND=0,0.1\n", "LINEAR/EIGENSOL, BAND=1.6,1.75\n", "LINEAR/EIGENSOL, NMODES=3\n"}) {
    const RunResult r = run(dataset + "END\n", commands);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(zeros(r), 70u) << commands;
    EXPECT_TRUE(complete(r)) << commands;
  }
}

TEST_F(ManyAlike, zeros_of_many_free_parts_are_all_found) {
  std::string dataset = head + hinged(5000, 4 * std::numbers::pi * std::numbers::pi);
  for (int k = 0; k < 40; ++k) dataset += free_part(10 + k, 0);
  const RunResult r = run(dataset + "END\n", "LINEAR/EIGENSOL, NMODES=3\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(zeros(r), 480u);
  ASSERT_EQ(modes_of(r).size(), 481u);
  EXPECT_NEAR(modes_of(r).back().at("imag_hz"), 1, 1e-12);
  EXPECT_TRUE(complete(r));
}

TEST_F(ManyAlike, equal_modes_are_all_found) {
  std::string dataset = head;
  for (int k = 0; k < 210; ++k) dataset += hinged(10 + k, 4 * std::numbers::pi * std::numbers::pi);
  for (const char* commands : {"LINEAR/EIGENSOL, NMODES=1\n", "LINEAR/EIGENSOL, BAND=0,2\n"}) {
    const RunResult r = run(dataset + "END\n", commands);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_TRUE(complete(r)) << commands;
    ASSERT_EQ(modes_of(r).size(), 210u) << commands;
    for (const auto& m : modes_of(r)) {
      EXPECT_NEAR(m.at("imag_hz"), 1, 1e-12);
      EXPECT_LT(m.at("error_bound_hz"), 1e-10);
    }
  }
}

// z_k′ = k z_{k+1}: one chain of 405, whose last link is 404! times its first.
TEST_F(ManyAlike, a_long_chain_of_integrators_is_all_zeros) {
  constexpr int count = 405;
  std::string dataset = head;
  for (int k = 1; k < count; ++k) dataset += fmt::format("DIFF/{0}, FUNCTION={0}*DIF({1})\n", k, k + 1);
  dataset += fmt::format("DIFF/{}, FUNCTION=0\n", count);
  const RunResult r = run(dataset + "END\n", "LINEAR/EIGENSOL, BAND=1,5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(zeros(r), static_cast<std::size_t>(count));
  EXPECT_EQ(modes_of(r).size(), static_cast<std::size_t>(count));
  EXPECT_TRUE(complete(r));
}

// A = [a, −(a−1); a+1, −a] has the eigenvalues 1 and −1, of which rounding of a leaves few digits: which is the nearer
// one nobody can tell.
TEST_F(ManyAlike, modes_that_bounds_do_not_tell_apart_are_equally_near) {
  const RunResult r = run(head +
                              "MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=1E7,-9999999,10000001,-1E7\n"
                              "ARRAY/1, X, SIZE=2\nLSE/1, X=1, A=1\nEND\n",
                          "LINEAR/EIGENSOL, NMODES=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  ASSERT_EQ(modes_of(r).size(), 2u);
  EXPECT_TRUE(complete(r));
}

// Discs in a ring with springs between neighbours, which are the same wherever one begins to count: pairs of equal
// modes, with damping too.
TEST_F(ManyAlike, pairs_of_equal_modes_of_a_ring_have_bounds) {
  constexpr int count = 160;
  for (const double damping : {0.0, 0.25}) {
    std::string dataset = head;
    for (int k = 0; k < count; ++k) dataset += hinged(1000 + k, 1);
    for (int k = 0; k < count; ++k) {
      dataset += fmt::format("SPRINGDAMPER/{}, ROTATIONAL, I={}, J={}, KT=100, CT={}\n", 3000 + k, 1000 + k,
                             1000 + (k + 1) % count, damping);
    }
    const RunResult r = run(dataset + "END\n", "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    std::vector<std::complex<double>> expected, found = r.eigenvalues(0);
    for (int k = 0; k < count; ++k) {
      const double of_springs = 2 - 2 * std::cos(2 * std::numbers::pi * k / count), K = 1 + 100 * of_springs,
                   C = damping * of_springs;
      const std::complex<double> root = std::sqrt(std::complex<double>(C * C / 4 - K));
      expected.push_back((-C / 2 + root) / (2 * std::numbers::pi));
    }
    for (const auto& m : modes_of(r)) {
      ASSERT_FALSE(m.at("error_bound_hz").is_null()) << damping;
      EXPECT_LT(m.at("error_bound_hz"), 1e-11);
      const std::complex<double> value(m.at("real_hz"), m.at("imag_hz"));
      double off = 1;
      for (const auto& e : expected) off = std::min(off, std::abs(e - value));
      EXPECT_LE(off, 1.01 * m.at("error_bound_hz").get<double>() + 1e-15);
    }
  }
}

// Each mass moves along one axis in each of its modes, and only along x it has a damper.
TEST_F(ManyAlike, tables_share_out_no_rounding) {
  std::string dataset = head + "MARKER/9, PART=1, FLOATING\n";
  for (int k = 0; k < 70; ++k) {
    dataset += fmt::format(
        "POINT_MASS/{0}, MASS=2, CM={0}\nMARKER/{0}\nMARKER/{1}, PART=1, FLOATING\nVFORCE/{0}, I={0}, JFLOAT={1}, "
        "RM=1, "
        "FX=-{2}*DX({0})-VX({0})\\FY=-{2}*DY({0})\\FZ=-{3}*DZ({0})\n",
        100 + k, 1000 + k, 8 + k, 300 + k);
  }
  const RunResult r =
      run(dataset + "END\n", "LINEAR/EIGENSOL, NMODES=1, NEAR=1.949, COORDS=1, DISSIPAT=1, MASS_PER_MODE=ALL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(modes_of(r).back().at("imag_hz"), std::sqrt(300 / 2.0) / (2 * std::numbers::pi), 1e-12);
  EXPECT_THAT(r.text("model.txt"), HasSubstr("No element of this table dissipates power in this mode"));
  for (const auto& table : r.result(0).at("tables")) {
    if (table.at("table") != "EFFECTIVE_MASS") continue;
    const auto& values = table.at("rows").back().at("values");
    EXPECT_NEAR(values[2], 2, 1e-12);
    for (const std::size_t direction : {0u, 1u, 5u}) EXPECT_EQ(values[direction], 0.0) << direction;
    return;
  }
  ADD_FAILURE() << "no effective masses";
}

// More states than are computed in long double, a defective pair among them, and two modes that are the same to the
// last digit: nothing mixes their vectors, and nothing tells them apart.
TEST_F(ManyAlike, equal_modes_of_parts_that_do_not_touch_have_vectors_of_their_own) {
  const auto disc = [](int id, double stiffness, double damping) {
    return fmt::format(
        "PART/{0}, MASS=1, CM={0}, IP=1,1,1, QG={0},9,0\nMARKER/{0}\nMARKER/{1}, PART=1, QP={0},9,0\n"
        "JOINT/{0}, REVOLUTE, I={0}, J={1}\nSFORCE/{0}, ROTATIONAL, I={0}, J={1}, "
        "FUNCTION=-{2:.17g}*AZ({0},{1})-{3:.17g}*WZ({0},{1})\n",
        id, 50000 + id, stiffness, damping);
  };
  const double once = 2 * std::numbers::pi;
  std::string dataset =
      head + disc(2, once * once, 0.1 * once) + disc(3, once * once, 0.1 * once) + disc(4, 2, std::sqrt(8.0));
  for (int k = 0; k < 150; ++k) {
    const double w = once * (10 + 0.5 * k);
    dataset += disc(10 + k, w * w, 0.04 * w);
  }
  const RunResult r = run(dataset + "END\n", "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, NMODES=4\n");
  ASSERT_EQ(r.status, 0) << r.err;
  for (std::size_t k = 0; k < 2; ++k) {
    std::set<std::string> movers;
    for (const auto& m : r.result(k).at("modes")) {
      for (const auto& entry : m.at("vector")) ASSERT_TRUE(entry.at(0).is_number() && entry.at(1).is_number()) << k;
      if (std::abs(std::hypot(m.at("real_hz").get<double>(), m.at("imag_hz").get<double>()) - 1) > 1e-9) continue;
      EXPECT_TRUE(m.at("condition").is_number());
      movers.insert(m.at("moves_most").get<std::string>());
    }
    EXPECT_THAT(movers, ::testing::ElementsAre("PART/2", "PART/3")) << k;
  }
}

}  // namespace
}  // namespace dynalin::cases::many_alike_test
