// What a message says besides what is wrong: how to go on, who is to blame, and all of it in one run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::hints_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Hints : public Cases {
 protected:
  std::string said(const std::string& model, const std::string& commands) const { return run(model, commands).err; }
};

const std::string ground = "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
const std::string hinge = ground + "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n";

TEST_F(Hints, quit_and_exit_are_stop) {
  for (const std::string word : {"quit", "EXIT"})
    EXPECT_THAT(said(hinge + "END\n", word + "\n"), HasSubstr("hint: STOP ends the run")) << word;
}

TEST_F(Hints, statements_that_are_not_there_have_others_in_their_place) {
  EXPECT_THAT(said(hinge + "UCON/1\nEND\n", "LINEAR/EIGENSOL\n"), HasSubstr("hint: GCON"));
  EXPECT_THAT(said(hinge + "TIRE/1\nEND\n", "LINEAR/EIGENSOL\n"), HasSubstr("hint: a BUSHING or SFORCE"));
  EXPECT_THAT(said(hinge + "SURFACE/1\nEND\n", "LINEAR/EIGENSOL\n"), HasSubstr("hint: GCON keeps a marker on"));
}

TEST_F(Hints, an_exponent_of_fortran_is_none) {
  for (const std::string value : {"2.5D0*WZ(20)", "1d3*TIME"})
    EXPECT_THAT(said(hinge + "VARIABLE/1, FUNCTION=" + value + "\nEND\n", "LINEAR/EIGENSOL\n"),
                HasSubstr("hint: an exponent begins with E"))
        << value;
  EXPECT_THAT(said(hinge + "VARIABLE/1, FUNCTION=2 WZ(20)\nEND\n", "LINEAR/EIGENSOL\n"),
              Not(HasSubstr("an exponent begins")));
}

TEST_F(Hints, a_driven_model_may_be_set_free) {
  const std::string turning = hinge + "MOTION/7, JOINT=1, VELOCITY, FUNCTION=2\nEND\n";
  const std::string at_rest = said(turning, "SIMULATE/STATICS\n");
  EXPECT_THAT(at_rest, HasSubstr("MOTION/7, DISPLACEMENT, FUNCTION=0"));
  EXPECT_THAT(at_rest, HasSubstr("DEACTIVATE/MOTION, ID=7"));
  EXPECT_THAT(said(hinge + "MOTION/7, JOINT=1, FUNCTION=2\nEND\n", "LINEAR/EIGENSOL\n"),
              HasSubstr("MOTION/7 prescribes its motion, and DEACTIVATE/MOTION, ID=7 would leave it free"));
}

TEST_F(Hints, each_freedom_is_listed_once) {
  const std::string err =
      said(ground + "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nEND\n", "SIMULATE/KINEMATICS, END=1, STEPS=2\n");
  EXPECT_EQ(err.find("DY of PART/2"), err.rfind("DY of PART/2")) << err;
  EXPECT_THAT(err, HasSubstr("Nothing determines"));
}

TEST_F(Hints, the_sensor_that_ends_a_run_is_named) {
  const std::string sensors = "SENSOR/1, FUNCTION=TIME, VALUE=0.5, GE, PRINT\nSENSOR/2, FUNCTION=TIME, VALUE=0.5, GE, ";
  for (const std::string how : {"HALT", "RETURN"}) {
    const RunResult r = run(hinge + sensors + how + "\nEND\n", "SIMULATE/DYNAMICS, END=1, STEPS=10\n");
    EXPECT_THAT(r.out, HasSubstr("ended by SENSOR/2 with " + how));
    EXPECT_THAT(r.message, HasSubstr("(" + how + ")"));
  }
}

TEST_F(Hints, functions_that_contradict_each_other_are_said_to) {
  EXPECT_THAT(
      said(hinge + "VARIABLE/1, FUNCTION=VARVAL(2)\nVARIABLE/2, FUNCTION=VARVAL(1)+1\nEND\n", "LINEAR/EIGENSOL\n"),
      HasSubstr("the functions read each other, and contradict each other or agree on any value"));
  EXPECT_THAT(said(hinge + "VARIABLE/1, FUNCTION=VARVAL(1)+1\nEND\n", "LINEAR/EIGENSOL\n"),
              HasSubstr("the function reads itself"));
}

TEST_F(Hints, syntax_hides_nothing_else) {
  const std::string err = said(hinge + "END\n",
                               "PART/2, MASS=\nMARKER/20, QP=1,2\nPART/2, IP=-1,1,1\nPART/7, MASS=1\n"
                               "FOO\n");
  for (const char* text : {"missing-value", "wrong-count", "PART/7 does not exist", "unknown-command"})
    EXPECT_THAT(err, HasSubstr(text));
  const std::string of_linear = said(hinge + "END\n", "PART/2, MASS=\nLINEAR/STATEMAT, FILE=a, PINPUT=3\n");
  for (const char* text : {"missing-value", "refers to PINPUT/3"}) EXPECT_THAT(of_linear, HasSubstr(text));
}

TEST_F(Hints, a_marker_that_is_missing_hides_no_wrong_count) {
  const std::string bushing = "MARKER/21\nBUSHING/1, I=21, J=1, K=1,1,1\nEND\n";
  const std::string err = said(hinge + bushing, "BUSHING/1, I=99\nBUSHING/1, K=1,2\n");
  for (const char* text : {"MARKER/99, which does not exist", "K of BUSHING/1 takes 3 values, here are 2"})
    EXPECT_THAT(err, HasSubstr(text));
}

TEST_F(Hints, constraints_that_are_drawn_open_are_summed_up) {
  std::string chain = ground;
  for (int k = 2; k < 16; ++k)
    chain += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=1,1,1, QG={2},0,{3}\nMARKER/{0}0\nMARKER/{0}1, QP=1,0,0\n"
        "JOINT/{0}, SPHERICAL, I={0}0, J={1}\n",
        k, k == 2 ? "1" : fmt::format("{}1", k - 1), k - 2, k % 2 == 0 ? 0.1 : 0);
  const std::string err = said(chain + "END\n", "SIMULATE/INITIAL\n");
  std::size_t count = 0;
  for (std::size_t at = 0; (at = err.find("[drawn-open]", at)) != err.npos; ++at) ++count;
  EXPECT_EQ(count, 11u) << err;
  EXPECT_THAT(err, HasSubstr("more constraints do not hold as drawn"));
}

TEST_F(Hints, a_damping_ratio_of_nothing_has_no_sign) {
  const RunResult r =
      run(hinge + "SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=-AZ(20,1)+1E-7*WZ(20,1)\nEND\n", "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, Not(HasSubstr("-0.00000")));
  EXPECT_THAT(r.message, Not(HasSubstr("-0.00000 ")));
}

}  // namespace
}  // namespace dynalin::cases::hints_test
