// SIMULATE/KINEMATICS and SIMULATE/STATICS over time from dataset and commands, and what follows them.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::kinematics_test {
namespace {

using ::testing::HasSubstr;

constexpr double turn = 2 * std::numbers::pi;

class Kinematics : public Cases {
 protected:
  // Of the body "PART/n" in result k.
  static const nlohmann::json& body(const RunResult& r, std::size_t k, const std::string& name) {
    for (const auto& b : r.result(k).at("operating_point").at("bodies")) {
      if (b.at("element") == name) return b;
    }
    throw std::runtime_error("no " + name);
  }
};

// An arm that is turned by φ and a slider that is moved along it by u, on a spring of stiffness 200; m = 2.
std::string arm(const std::string& phi, const std::string& u, const std::string& more = "") {
  return "Arm\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\n"
         "MARKER/4, REULER=90D,90D,0\nPART/3, MASS=2, CM=3, IP=1,1,1\nMARKER/3, REULER=90D,90D,0\n"
         "JOINT/1, REVOLUTE, I=2, J=1\nMOTION/1, JOINT=1, " +
         phi + "\nJOINT/2, TRANSLATIONAL, I=3, J=4\nBUSHING/1, I=3, J=4, K=0,0,200\nMOTION/2, JOINT=2, " + u + "\n" +
         more + "END\n";
}

TEST_F(Kinematics, lead_to_a_point_about_which_LINEAR_works_when_a_drive_is_taken_away) {
  const RunResult r = run(arm("FUNCTION=6*TIME", "FUNCTION=0.3*SIN(TIME)"),
                          "SIMULATE/KINEMATICS, END=2, STEPS=40\nDEACTIVATE/MOTION, ID=2\nLINEAR/EIGENSOL, RM=2\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(0).at("time"), 2);
  const double u = 0.3 * std::sin(2);
  const auto place = body(r, 0, "PART/3").at("position").get<std::vector<double>>();
  EXPECT_NEAR(place[0], u * std::cos(12), 1e-11);
  EXPECT_NEAR(place[1], u * std::sin(12), 1e-11);
  const auto velocity = body(r, 0, "PART/3").at("velocity").get<std::vector<double>>();
  EXPECT_NEAR(velocity[0], 0.3 * std::cos(2) * std::cos(12) - 6 * u * std::sin(12), 1e-10);
  // u″ = (Ω² − K/m) u
  expect_eigenvalues(r.eigenvalues(2), {{0, 8 / turn}}, 1e-9);
}

TEST_F(Kinematics, LINEAR_says_that_nothing_is_left_to_move) {
  const RunResult r =
      run(arm("FUNCTION=6*TIME", "FUNCTION=0.3*SIN(TIME)"), "SIMULATE/KINEMATICS, END=2, STEPS=4\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("the model has no states"));
}

TEST_F(Kinematics, are_what_TRANSIENT_does_without_degrees_of_freedom) {
  const RunResult r = run(arm("FUNCTION=6*TIME", "FUNCTION=0.3*SIN(TIME)"), "SIMULATE/TRANSIENT, END=1, DTOUT=0.1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(body(r, 0, "PART/3").at("position")[0].get<double>(), 0.3 * std::sin(1) * std::cos(6), 1e-12);
}

TEST_F(Kinematics, need_a_model_without_degrees_of_freedom) {
  const RunResult r =
      run(arm("FUNCTION=6*TIME", "FUNCTION=0"), "DEACTIVATE/MOTION, ID=2\nSIMULATE/KINEMATICS, END=1\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("KINEMATICS needs a model without degrees of freedom, and this one has 1"));
}

TEST_F(Kinematics, of_motions_of_velocity_go_on_when_their_function_is_changed) {
  const RunResult r =
      run(arm("VELOCITY, FUNCTION=6+TIME", "ACCELERATION, FUNCTION=2, ICVEL=-1"),
          "SIMULATE/KINEMATICS, END=2, STEPS=4\nMOTION/1, FUNCTION=1\nSIMULATE/KINEMATICS, END=3, STEPS=2\n"
          "MOTION/2, VELOCITY, FUNCTION=0\nSIMULATE/KINEMATICS, END=4, STEPS=2\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto angle_and_way = [&](std::size_t k) {
    const auto p = body(r, k, "PART/3").at("position").get<std::vector<double>>();
    const auto x = body(r, k, "PART/2").at("axes")[0].get<std::vector<double>>();
    return std::pair(std::atan2(x[1], x[0]), p[0] * x[0] + p[1] * x[1]);
  };
  const auto expect = [&](std::size_t k, double angle, double way) {
    EXPECT_NEAR(std::remainder(angle_and_way(k).first - angle, turn), 0, 1e-11) << k;
    EXPECT_NEAR(angle_and_way(k).second, way, 1e-11) << k;
  };
  expect(0, 12 + 2, 4 - 2);
  expect(2, 14 + 1, 9 - 3);
  expect(4, 15 + 1, 6);
}

// Differential states are integrated: then it is the integrator that leads the model.
TEST_F(Kinematics, with_differential_states_are_integrated) {
  const RunResult r = run(arm("FUNCTION=6*TIME", "FUNCTION=0.3*SIN(TIME)", "DIFF/1, IC=1, FUNCTION=-2*DIF(1)\n"),
                          "INTEGRATOR/ERROR=1E-7\nSIMULATE/KINEMATICS, END=1, STEPS=10\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(r.result(1).at("operating_point").at("states")[0].at("value").get<double>(), std::exp(-2), 1e-7);
  EXPECT_NEAR(body(r, 1, "PART/3").at("position")[0].get<double>(), 0.3 * std::sin(1) * std::cos(6), 1e-7);
  expect_eigenvalues(r.eigenvalues(2), {{-2 / turn, 0}});
}

const std::string bead =
    "Bead\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=3, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, "
    "TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, "
    "FUNCTION=4*TIME-DZ(20,1)-DZ(20,1)**3\nEND\n";

TEST_F(Kinematics, quasi_statics_lead_to_an_equilibrium_under_load) {
  const RunResult r = run(bead, "SIMULATE/STATICS, END=2.5, STEPS=10\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(body(r, 0, "PART/2").at("position")[2].get<double>(), 2, 1e-12);  // z + z³ = 10
  expect_eigenvalues(r.eigenvalues(1), {{0, std::sqrt(13.0 / 3) / turn}});
}

TEST_F(Kinematics, quasi_statics_refuse_motions_that_contradict_rest) {
  const RunResult r = run(arm("VELOCITY, FUNCTION=6", "FUNCTION=0"), "SIMULATE/STATICS, END=1, STEPS=2\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("MOTION/1"));
}

}  // namespace
}  // namespace dynalin::cases::kinematics_test
