// Freedoms without mass beside structural zeros and beside functions without derivatives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::massless_zero_test {
namespace {

using ::testing::HasSubstr;

class MasslessZeros : public Cases {
 protected:
  struct Mode {
    double size, bound;  // rad per unit time
    bool structural_zero;
  };
  std::vector<Mode> solve(const std::string& dataset) const {
    const RunResult r = run(dataset, "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<Mode> modes;
    if (r.status != 0) return modes;
    constexpr double cycle = 2 * std::numbers::pi;
    for (const auto& m : r.result(0).at("modes")) {
      modes.push_back({cycle * std::abs(std::complex<double>(m.at("real_hz"), m.at("imag_hz"))),
                       cycle * m.at("error_bound_hz").get<double>(), m.at("structural_zero")});
    }
    return modes;
  }
  static std::size_t zeros(const std::vector<Mode>& modes) {
    return static_cast<std::size_t>(
        std::count_if(modes.begin(), modes.end(), [](const Mode& m) { return m.structural_zero; }));
  }
};

// Two bodies with mass, and between them, on two bushings, one without. Nothing is loaded, to the last bit, and nothing
// holds the three.
std::string free_bodies(const std::string& first, const std::string& second, const std::string& more = "") {
  return "Free\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=-10,-20,-30\n"
         "PART/2, MASS=1.3, CM=20, IP=1,1.1,1.2\nMARKER/20\nMARKER/21, QP=0.5,0.25,0.125\n"
         "PART/3, MASS=2, CM=30, IP=0.7,0.8,1.2, QG=1,0,0\nMARKER/30\nMARKER/31, QP=-0.5,0.25,0.125\n"
         "PART/4, QG=0.5,0.25,0.125\nMARKER/40\n"
         "BUSHING/1, I=40, J=21, K=100,120,130, KT=10,11,12, " +
         first + "\nBUSHING/2, I=31, J=40, K=200,120,130, KT=20,11,12, " + second + "\n" + more + "END\n";
}

TEST_F(MasslessZeros, rigid_motion_of_a_model_with_a_body_without_mass_is_proved) {
  const std::string none = "C=0,0,0, CT=0,0,0";
  struct Case {
    std::string first, second;
    std::size_t others;  // six vibrations, and the freedoms of first order
  };
  for (const Case& c : {Case{"C=1,2,3, CT=0.1,0.2,0.3", "C=1,0,3, CT=0.1,0.2,0.3", 12}, Case{none, none, 6},
                        Case{"C=1,0,0, CT=0,0,0", "C=0,0,0, CT=0,1,0", 8}}) {
    SCOPED_TRACE(c.first + " and " + c.second);
    std::size_t zeros = 0, others = 0;
    for (const Mode& m : solve(free_bodies(c.first, c.second))) {
      ++(m.structural_zero ? zeros : others);
      EXPECT_EQ(m.structural_zero, m.size == 0);
    }
    EXPECT_EQ(zeros, 12u);
    EXPECT_EQ(others, c.others);
  }
}

// The three as one body on a spring of 1e-6 of the others' stiffness, along u at r from the mass centre:
// ω² = k (1/m + (r × u)ᵀ J⁻¹ (r × u)).
TEST_F(MasslessZeros, a_soft_spring_on_a_body_without_mass_is_no_zero) {
  const Vector point{10.5, 20.25, 30.125}, centre{10 + 2 / 3.3, 20, 30};  // from the end of the spring on ground
  const double stiffness = 1e-4, mass = 3.3, length = norm(point), apart = 1.3 * 2 / mass;
  const Vector inertia{1 + 0.7, 1.1 + 0.8 + apart, 1.2 + 1.2 + apart};
  const Vector turn = cross(point - centre, 1 / length * point);
  double mobility = 1 / mass;
  for (std::size_t k = 0; k < 3; ++k) mobility += turn[k] * turn[k] / inertia[k];
  const auto modes = solve(free_bodies(
      "C=1,0,0, CT=0,0,0", "C=0,0,0, CT=0,1,0",
      fmt::format("SPRINGDAMPER/1, TRANSLATIONAL, I=40, J=1, K={}, C=0, LENGTH={:.17g}\n", stiffness, length)));
  EXPECT_EQ(zeros(modes), 10u);
  double slowest = std::numeric_limits<double>::infinity(), bound = 0;
  for (const Mode& m : modes) {
    if (!m.structural_zero && m.size < slowest) slowest = m.size, bound = m.bound;
  }
  // Bodies that give way by some 1e-6 of what they are pulled.
  const double expected = std::sqrt(stiffness * mobility);
  EXPECT_NEAR(slowest, expected, 1e-5 * expected);
  EXPECT_LT(bound, 1e-5 * expected);
}

std::string slides(const std::string& more) {
  return "Slides\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20\nMARKER/20\n"
         "JOINT/1, TRANSLATIONAL, I=20, J=1\nPART/4\nMARKER/40\nJOINT/2, TRANSLATIONAL, I=40, J=1\n"
         "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-5*DZ(20,1)+3*DZ(40,20)\n" +
         more + "END\n";
}

TEST_F(MasslessZeros, a_root_in_the_balance_of_a_freedom_without_mass_is_named) {
  const RunResult r =
      run(slides("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=40, J=1, FUNCTION=-2*VZ(40,1)-3*DZ(40,20)-VARVAL(1)\n"
                 "VARIABLE/1, FUNCTION=SQRT(ABS(DZ(40,1)))\n"),
          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("VARIABLE/1: the derivative of SQRT is infinite at 0"));
}

TEST_F(MasslessZeros, a_root_that_no_balance_reads_does_not_count) {
  const std::string force = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=40, J=1, FUNCTION=-2*VZ(40,1)-3*DZ(40,20)\n";
  const RunResult without = run(slides(force), "LINEAR/STATEMAT, FILE=m\n");
  const RunResult with = run(slides(force + "VARIABLE/1, FUNCTION=SQRT(ABS(DZ(40,1)))\n"), "LINEAR/STATEMAT, FILE=m\n");
  ASSERT_EQ(without.status, 0) << without.err;
  ASSERT_EQ(with.status, 0) << with.err;
  EXPECT_EQ(with.matrix(0, "A"), without.matrix(0, "A"));
}

}  // namespace
}  // namespace dynalin::cases::massless_zero_test
