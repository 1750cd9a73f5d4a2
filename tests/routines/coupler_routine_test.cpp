// A COUPLER by compiled routines: against the same condition as a GCON, in C, Fortran and by a formula.
#include <gmock/gmock.h>

#include <cmath>

#include "routines/with_libraries.h"

namespace dynalin::cases::coupler_routine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A wheel that turns against a torsion spring, a slider in its own spring and a third one; what is held has slopes and
// second derivatives that the springs and weights make felt.
const std::string model = R"(coupled
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9
PART/1, GROUND
MARKER/1
MARKER/9, QP=1,0,0, REULER=20D,90D,0
MARKER/8, QP=2,0,0, REULER=0,90D,0
PART/2, MASS=1, CM=2, IP=1,1,1, REULER=30D,0,0
MARKER/2
MARKER/21, QP=0.2,0,0
PART/3, MASS=2, CM=3, IP=3,3,4, QG=1,0,0, REULER=20D,90D,0
MARKER/3, QP=0,0,0
PART/4, MASS=3, CM=4, IP=3,3,4, QG=2,0,0, REULER=0,90D,0
MARKER/4
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, TRANSLATIONAL, I=3, J=9
JOINT/3, CYLINDRICAL, I=4, J=8
SPRINGDAMPER/1, ROTATIONAL, I=2, J=1, KT=80, CT=0.1
SPRINGDAMPER/2, TRANSLATION, I=3, J=1, K=90, C=0.2, LENGTH=1.2
BUSHING/1, I=4, J=8, K=50,50,50, KT=7,7,7
)";
const std::string two = "COUPLER/1, JOINTS=1,2, FUNCTION=USER(0.7,0.4)";
const std::string as_gcon = "GCON/1, FUNCTION=AZ(2,1)-0.7*SIN(DZ(3,9,9))-0.4*DZ(3,9,9)\n";

class CouplerRoutines : public WithLibraries {
 protected:
  RunResult with(const std::string& dataset, const std::vector<std::string>& commands = {"LINEAR/EIGENSOL"},
                 const std::vector<std::string>& libraries = {C_COUPLER, CPP_ROUTINES}) const {
    return WithLibraries::with(dataset, libraries, false, commands);
  }
};

TEST_F(CouplerRoutines, hold_what_a_gcon_holds) {
  const std::vector<std::string> statics = {"SIMULATE/STATICS", "LINEAR/EIGENSOL"};
  const RunResult written = with(model + as_gcon, statics);
  for (const std::string& routine : {std::string(), std::string(", ROUTINE=coupler::Heldc,Firstc,Secondc"),
                                     std::string(", ROUTINE=coupled_by_formula")})
    expect_same(with(model + two + routine + "\n", statics), written, 1e-10, 1);
#ifdef FORTRAN_COUPLER
  expect_same(with(model + two + "\n", statics, {FORTRAN_COUPLER}), written, 1e-10, 1);
#endif
  const RunResult linear = with(model + "COUPLER/1, JOINTS=1,2, SCALES=1,-0.4\n", statics);
  expect_same(with(model + "COUPLER/1, JOINTS=1,2, FUNCTION=USER(0,0.4)\n", statics), linear, 1e-10, 1);
  // Three displacements, of the last joint that TYPE says.
  const RunResult of_three =
      with(model +
               "GCON/1, FUNCTION=AZ(2,1)-0.7*SIN(DZ(3,9,9))-0.4*DZ(3,9,9)-0.3*AZ(4,8)**2\nVTORQUE/1, I=4, JFLOAT=99, "
               "RM=8, TZ=3\\\nMARKER/99, PART=1, FLOATING\n",
           statics);
  const std::string called =
      "COUPLER/1, JOINTS=1,2,3, TYPE=R:T:R, FUNCTION=USER(0.7,0.4,0.3)\nVTORQUE/1, I=4, JFLOAT=99, RM=8, TZ=3\\\n"
      "MARKER/99, PART=1, FLOATING\n";
  expect_same(with(model + called, statics), of_three, 1e-10, 1);
#ifdef FORTRAN_COUPLER
  expect_same(with(model + called, statics, {FORTRAN_COUPLER}), of_three, 1e-10, 1);
#endif
}

// A motion, and the linear model of a point of it, which has third derivatives in it: those a formula has.
TEST_F(CouplerRoutines, hold_it_along_a_motion) {
  const std::string shown = "REQUEST/1, F2=AZ(2,1)\\F3=DZ(3,9,9)\\F4=WZ(2,1,1)\\F6=ACCZ(3,9,9)\\F7=WDTZ(2,1,1)\n";
  const std::vector<std::string> commands = {"SIMULATE/TRANSIENT, END=0.4, STEPS=10", "SIMULATE/INITIAL",
                                             "LINEAR/EIGENSOL"};
  const RunResult written = with(model + as_gcon + shown, commands);
  const auto expected = requested(written, 1);
  for (const std::string routine : {"", ", ROUTINE=coupled_by_formula"}) {
    const RunResult r = with(model + two + routine + "\n" + shown, {commands[0], commands[1]});
    const auto found = requested(r, 1);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_GT(std::abs(expected.at(2)), 0.1);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], expected[k], 1e-4 * (1 + std::abs(expected[k]))) << routine << k;
  }
  expect_same(with(model + two + ", ROUTINE=coupled_by_formula\n" + shown, commands), written, 1e-4, 2);
  const RunResult moving = with(model + two + "\n" + shown, commands);
  EXPECT_EQ(moving.status, 2);
  EXPECT_THAT(moving.err, AllOf(HasSubstr("COUPLER/1"), HasSubstr("third")));
}

// What each joint bears: the slopes of the function times the multiplier.
TEST_F(CouplerRoutines, report_what_the_joints_bear) {
  const auto borne = [&](const std::string& coupler) {
    const RunResult r = with(model + coupler, {"SIMULATE/STATICS"});
    EXPECT_EQ(r.status, 0) << r.err;
    return r.json.is_null() ? nlohmann::json() : r.result(0).at("operating_point").at("reactions");
  };
  const auto rows = [&](const nlohmann::json& all) {
    std::vector<nlohmann::json> found;
    for (const auto& row : all)
      if (row.dump().find("COUPLER/1") != std::string::npos) found.push_back(row);
    return found;
  };
  const auto called = rows(borne("COUPLER/1, JOINTS=1,2, FUNCTION=USER(0,0.4)\n")),
             linear = rows(borne("COUPLER/1, JOINTS=1,2, SCALES=1,-0.4\n"));
  ASSERT_EQ(called.size(), linear.size());
  ASSERT_FALSE(called.empty());
  for (std::size_t k = 0; k < called.size(); ++k) {
    for (const std::string component : {"force", "torque"}) {
      const auto a = called[k].at(component).get<std::vector<double>>(),
                 b = linear[k].at(component).get<std::vector<double>>();
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-8) << k << component << c;
    }
  }
}

TEST_F(CouplerRoutines, may_depend_on_time_where_an_entry_gives_the_derivatives) {
  const std::string driven = "GCON/1, FUNCTION=AZ(2,1)-0.7*SIN(DZ(3,9,9))-0.4*DZ(3,9,9)+0.05*SIN(TIME)\n";
  const std::vector<std::string> at_start = {"SIMULATE/INITIAL", "LINEAR/EIGENSOL"};
  expect_same(
      with(model + "COUPLER/1, JOINTS=1,2, FUNCTION=USER(0.7,0.4,0.05), ROUTINE=coupled_by_formula\n", at_start),
      with(model + driven, at_start), 1e-10, 1);
  const RunResult r = with(model + two + ", ROUTINE=coupler::swings,couxx,couxx2\n", at_start);
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("COUPLER/1"), HasSubstr("swings"), HasSubstr("derivative in time")));
}

TEST_F(CouplerRoutines, that_cannot_be_say_why) {
  const auto said = [&](const std::string& coupler) {
    const RunResult r = with(model + coupler + "\n");
    EXPECT_EQ(r.status, 1) << r.err;
    return r.err;
  };
  EXPECT_THAT(said(two + ", ROUTINE=coupler::swings"),
              AllOf(HasSubstr("[routine-failed]"), HasSubstr("couxx and couxx2")));
  EXPECT_THAT(said(two + ", SCALES=1,2"), HasSubstr("takes SCALES or FUNCTION, not both"));
  EXPECT_THAT(said("COUPLER/1, JOINTS=1,2, FUNCTION=3"), AllOf(HasSubstr("[unknown-word]"), HasSubstr("USER(")));
  EXPECT_THAT(said("COUPLER/1, JOINTS=1,2"), AllOf(HasSubstr("[missing-argument]"), HasSubstr("needs SCALES")));
}

TEST_F(CouplerRoutines, with_derivatives_that_are_not_those_of_their_values_are_named) {
  const auto said = [&](const std::string& routines) {
    const RunResult r =
        with(model + two + ", ROUTINE=coupler::cousub," + routines + "\n", {"LINEAR/EIGENSOL", "LINEAR/EIGENSOL"});
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  };
  EXPECT_THAT(said("couxx,couxx2"), Not(HasSubstr("wrong-derivative")));
  EXPECT_THAT(said("wrong_first,couxx2"), AllOf(HasSubstr("wrong-derivative"), HasSubstr("called for COUPLER/1 has"),
                                                HasSubstr("as its derivative by displacement 2")));
  EXPECT_THAT(said("couxx,wrong_second"), AllOf(HasSubstr("wrong-derivative"),
                                                HasSubstr("second derivative by displacement 2 and displacement 2")));
}

}  // namespace
}  // namespace dynalin::cases::coupler_routine_test
