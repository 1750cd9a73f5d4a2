// Routines that have no value: what they say for it ends the run, in their words, whoever calls them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "routines/with_libraries.h"

namespace dynalin::cases::stopped_routine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class StoppedRoutines : public WithLibraries {
 protected:
  std::string said(const std::string& statements, const std::string& command) const {
    const RunResult r = with(
        "Driven\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\n"
        "JOINT/1, REVOLUTE, I=2, J=1\n" +
            statements,
        {C_ROUTINES}, true, {command});
    EXPECT_NE(r.status, 0) << statements << command;
    return r.err;
  }
};

TEST_F(StoppedRoutines, of_motions_end_every_analysis_in_their_words) {
  for (const std::string& by : {std::string(), std::string("VELOCITY, "), std::string("ACCELERATION, ")}) {
    const auto motion = [&](int undefined) {
      return "MOTION/1, JOINT=1, " + by +
             fmt::format("FUNCTION=USER(0.5,{}), ROUTINE=routines::stopping_motion\n", undefined);
    };
    for (const char* command : {"SIMULATE/KINEMATICS, END=1, STEPS=10", "SIMULATE/DYNAMICS, END=1, STEPS=10"}) {
      EXPECT_THAT(said(motion(0), command), AllOf(HasSubstr("MOTION/1"), HasSubstr("the drive has burnt out")))
          << by << command;
      EXPECT_THAT(said(motion(1), command), AllOf(HasSubstr("MOTION/1"), HasSubstr("stopping_motion")))
          << by << command;
    }
  }
}

TEST_F(StoppedRoutines, of_sensors_and_samples_are_not_forgotten) {
  const std::string command = "SIMULATE/DYNAMICS, END=1, STEPS=10";
  const auto sensor = [](int undefined) {
    return fmt::format(
        "SENSOR/3, FUNCTION=TIME, VALUE=0.5, GE, EVALUATE=USER({}), "
        "EVALUATE_ROUTINE=routines::stopping_evaluation\n",
        undefined);
  };
  EXPECT_THAT(said(sensor(0), command), AllOf(HasSubstr("SENSOR/3"), HasSubstr("the gauge is broken")));
  EXPECT_THAT(said(sensor(1), command), AllOf(HasSubstr("SENSOR/3"), HasSubstr("stopping_evaluation")));
  const std::string samples =
      "ARRAY/3, Y\nARRAY/5, X\nGSE/4, NO=1, Y=3, ND=2, XD=5, SAMPLE_PERIOD=0.1, FUNCTION=USER(1), "
      "INTERFACE=::,::stopping_update,::constant_output\n";
  EXPECT_THAT(said(samples, command), AllOf(HasSubstr("GSE/4"), HasSubstr("the controller hangs")));
}

// Utilities know what to give in the thread of the call alone: from another one they give nothing, and nothing goes on.
TEST_F(StoppedRoutines, name_what_calls_utilities_from_a_thread_of_its_own) {
  const auto model = [](const std::string& user) {
    return "Threads\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1, QG=0,0,0.5\n"
           "MARKER/2\nJOINT/1, TRANSLATIONAL, I=2, J=1\nVARIABLE/1, FUNCTION=DZ(2,1)\n"
           "VARIABLE/7, FUNCTION=USER(" +
           user + "), ROUTINE=threads::of_threads\nREQUEST/1, VARIABLES=7\n";
  };
  const std::vector<std::string> commands = {"SIMULATE/INITIAL_CONDITIONS", "SIMULATE/DYNAMICS, END=1, STEPS=2"};
  for (const char* user : {"1,0", "2,0", "1,1", "1,2", "2,2"}) {
    const RunResult r = with(model(user), {C_THREADS}, true, commands);
    EXPECT_NE(r.status, 0) << user;
    EXPECT_THAT(r.err, AllOf(HasSubstr("VARIABLE/7"), HasSubstr("it calls a utility from a thread of its own"),
                             HasSubstr("only from the thread that called the routine")))
        << user;
  }
  // What needs nothing of the model may be called from any.
  const RunResult r = with(model("0,0"), {C_THREADS}, true, commands);
  EXPECT_NEAR(requested(r, 0).at(0), 0.5, 1e-12);
}

}  // namespace
}  // namespace dynalin::cases::stopped_routine_test
