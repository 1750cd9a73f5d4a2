// MODE is 7 in LINEAR, in values that were solved before as well as in laws that read it. CPU, HSIZE, ORDER, NJAC and
// NRHS are numbers of the last step.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::analysis_kind_test {
namespace {

class AnalysisKind : public Cases {
 protected:
  // A slider of mass 1 on a spring of 4, with a law in which `more` is added; Hz.
  double frequency(const std::string& elements, const std::string& more, const std::string& commands) const {
    const RunResult r =
        run("Slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\n"
            "MARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n" +
                elements + "SFORCE/1, TRANSLATIONAL, ACTION, I=20, J=1, FUNCTION=-(4+" + more + ")*DZ(20,1)\nEND\n",
            commands + "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(r.json.at("results").size() - 1)[0].imag() : 0;
  }
};

TEST_F(AnalysisKind, a_spring_of_one_analysis_is_the_same_in_a_law_and_in_a_variable) {
  const auto hz = [](double k) { return std::sqrt(k) / (2 * std::numbers::pi); };
  const std::string variable = "VARIABLE/5, FUNCTION=";
  for (const auto& [law, stiffness] :
       {std::pair{"IF(MODE-5: 0, 400, 0)", 0.0}, {"IF(MODE-7: 0, 5, 0)", 5.0}, {"MODE", 7.0}}) {
    for (const std::string before : {"", "SIMULATE/STATICS\n", "SIMULATE/DYNAMICS, END=0.1, STEPS=1\n"}) {
      EXPECT_NEAR(frequency("", law, before), hz(4 + stiffness), 1e-12) << law << before;
      EXPECT_NEAR(frequency(variable + law + "\n", "VARVAL(5)", before), hz(4 + stiffness), 1e-12) << law << before;
    }
  }
}

// A pull along a pendulum of length 1 that is there in LINEAR alone, towards a point 2 beyond its mass: it turns the
// pendulum back by F l (1 + l/2), against 1 + m l² about the hinge.
TEST_F(AnalysisKind, preloads_are_those_of_linear) {
  const RunResult r =
      run("Link\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=3,0,0\n"
          "PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0\nMARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\n"
          "SFORCE/1, TRANSLATIONAL, I=20, J=2, FUNCTION=-IF(MODE-7: 0, 50, 0)\nEND\n",
          "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(r.eigenvalues(0)[0].imag() * 2 * std::numbers::pi, std::sqrt(50 * 1.5 / 2), 1e-9);
}

// What was integrated is told, nothing before; LINEAR takes the numbers as they are, without a derivative.
TEST_F(AnalysisKind, functions_of_the_integration_are_constants_of_its_last_step) {
  const std::string slider =
      "Slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\n"
      "MARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\nVARIABLE/5, FUNCTION=NRHS\n"
      "REQUEST/1, F2=CPU\\F3=HSIZE\\F4=ORDER\\F6=NJAC\\F7=NRHS-VARVAL(5)\\F8=VARVAL(5)\n";
  const auto values = [](const RunResult& r, std::size_t result) {
    return r.result(result).at("operating_point").at("requests").at(0).at("values").get<std::vector<double>>();
  };
  const RunResult r = run(slider + "SFORCE/1, TRANSLATIONAL, ACTION, I=20, J=1, FUNCTION=-(4+HSIZE)*DZ(20,1)\nEND\n",
                          "SIMULATE/INITIAL_CONDITIONS\nSIMULATE/DYNAMICS, END=1, STEPS=10\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(values(r, 0), ::testing::Each(0.0));
  const std::vector<double> after = values(r, 2);
  ASSERT_EQ(after.size(), 6u);
  EXPECT_GT(after[0], 0);
  EXPECT_GT(after[1], 0);
  EXPECT_LE(after[1], 0.1);
  EXPECT_THAT(after[2], ::testing::AnyOf(1, 2, 3, 4, 5));
  EXPECT_GE(after[3], 1);
  EXPECT_EQ(after[4], 0);
  EXPECT_GE(after[5], after[3]);
  EXPECT_NEAR(r.eigenvalues(2)[0].imag() * 2 * std::numbers::pi, std::sqrt(4 + after[1]), 1e-12);

  const RunResult led = run(slider + "MOTION/1, JOINT=1, FUNCTION=1+TIME\nEND\n",
                            "SIMULATE/KINEMATICS, END=1, STEPS=10\nSIMULATE/INITIAL_CONDITIONS\n");
  ASSERT_EQ(led.status, 0) << led.err;
  EXPECT_GT(values(led, 1)[1], 0);
  EXPECT_GT(values(led, 1)[5], 0);
}

}  // namespace
}  // namespace dynalin::cases::analysis_kind_test
