// FRICTION in what commands make of it: statics, the warning of a joint in stiction, deactivation.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::friction_test {
namespace {

using ::testing::HasSubstr;

class FrictionCases : public Cases {};

std::string block(const std::string& friction, const std::string& more = "") {
  return "Block\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\nMARKER/11, REULER=90D,90D,0\n"
         "PART/2, MASS=2, CM=2, IP=1,1,1\nMARKER/2, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=2, J=11\n" +
         friction + more + "END\n";
}

TEST_F(FrictionCases, a_joint_in_stiction_is_named_with_its_mode) {
  const std::string sticks = "FRICTION/4, JOINT=1, MU_STATIC=0.4, STICTION_TRANSITION_VELOCITY=1\n";
  const RunResult r = run(block(sticks), "LINEAR/EIGENSOL\n");
  EXPECT_THAT(r.err,
              HasSubstr("JOINT/1 is in stiction: the stiffness of FRICTION/4 may be spurious, and with it modes, "
                        "most of all in mode 2 of 3.8985 cycles"));
  EXPECT_THAT(r.err, HasSubstr("[joint-in-stiction]"));
}

TEST_F(FrictionCases, what_does_not_stick_is_not_named) {
  const auto warned = [&](const std::string& friction, const std::string& commands = "") {
    const RunResult r = run(block(friction), commands + "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err.find("joint-in-stiction") != std::string::npos;
  };
  EXPECT_TRUE(warned("FRICTION/4, JOINT=1\n"));
  EXPECT_TRUE(warned("FRICTION/4, JOINT=1, EFFECT=STICTION\n"));
  EXPECT_FALSE(warned("FRICTION/4, JOINT=1, EFFECT=SLIDING\n"));
  EXPECT_FALSE(warned("FRICTION/4, JOINT=1, INPUTS=NONE\n"));
  EXPECT_FALSE(warned("FRICTION/4, JOINT=1\n", "DEACTIVATE/FRICTION, ID=4\n"));
}

// With bristles straight at the start, statics finds the equilibrium without friction; run down a slope, the block
// stays where its bristles hold it, but for what goes without friction in statics.
TEST_F(FrictionCases, statics_goes_by_the_creep_that_is_there) {
  const auto place = [](const RunResult& r, std::size_t result) {
    for (const auto& body : r.result(result).at("operating_point").at("bodies")) {
      if (body.at("element") == "PART/2") return body.at("position").at(0).get<double>();
    }
    return -1.0;
  };
  const std::string spring = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=6-200*DZ(2,11,11)\n";
  const std::string friction = "FRICTION/4, JOINT=1, STICTION_TRANSITION_VELOCITY=0.01, MAX_STICTION_DEFORMATION=1E-4";
  for (const std::string inactive : {"", ", INACTIVE=STATIC"}) {
    const RunResult drawn = run(block(friction + inactive + "\n", spring), "SIMULATE/STATICS\n");
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_NEAR(place(drawn, 0), 0.03, 1e-12);
    const RunResult stuck =
        run(block(friction + inactive + "\n", spring), "SIMULATE/DYNAMICS, END=2, STEPS=2\nSIMULATE/STATICS\n");
    ASSERT_EQ(stuck.status, 0) << stuck.err;
    EXPECT_LT(place(stuck, 0), 0.02);
    EXPECT_NEAR(place(stuck, 1), inactive.empty() ? place(stuck, 0) : 0.03, 1e-8);
  }
}

}  // namespace
}  // namespace dynalin::cases::friction_test
