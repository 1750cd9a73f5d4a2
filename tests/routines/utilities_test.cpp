// What statements say to their routines, utilities that are no measures, and the damping of modes by a routine.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/flexible.h"
#include "routines/with_libraries.h"

namespace dynalin::cases::utilities_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string driven =
    "Driven\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n";

class RoutinesAreTold : public WithLibraries {
 protected:
  std::string said(const std::string& statements) const {
    const RunResult r = with(driven + statements, {C_UTILITIES}, true, {"SIMULATE/DYNAMICS, END=1, STEPS=10"});
    EXPECT_NE(r.status, 0) << statements;
    return r.err;
  }
};

TEST_F(RoutinesAreTold, what_a_motion_drives) {
  const std::string call = "FUNCTION=USER(0.25), ROUTINE=utilities::Tellingmotion\n";
  EXPECT_THAT(said("JOINT/7, REVOLUTE, I=20, J=1\nMOTION/3, JOINT=7, " + call),
              HasSubstr("motion 3 of 7, ROTATION, 0 0, --, DISPLACEMENT, 1: 0.25"));
  EXPECT_THAT(said("JOINT/7, TRANSLATIONAL, I=20, J=1\nMOTION/3, JOINT=7, VELOCITY, " + call),
              HasSubstr("motion 3 of 7, TRANSLATION, 0 0, --, VELOCITY, 1: 0.25"));
  EXPECT_THAT(said("JOINT/7, CYLINDRICAL, I=20, J=1\nMOTION/3, JOINT=7, TRANSLATION, ACCELERATION, " + call),
              HasSubstr("motion 3 of 7, TRANSLATION, 0 0, --, ACCELERATION, 1: 0.25"));
  EXPECT_THAT(said("MOTION/3, I=20, J=1, Y, " + call),
              HasSubstr("motion 3 of 0, TRANSLATION, 20 1, Y, DISPLACEMENT, 1: 0.25"));
  EXPECT_THAT(said("MOTION/3, I=20, J=1, B2, " + call),
              HasSubstr("motion 3 of 0, ROTATION, 20 1, B2, DISPLACEMENT, 1: 0.25"));
}

TEST_F(RoutinesAreTold, what_a_sensor_waits_for) {
  const std::string call = "HALT, FUNCTION=USER(1), ROUTINE=utilities::Tellingsensor\n";
  EXPECT_THAT(said("SENSOR/4, GE, VALUE=2.5, ERROR=0.125, " + call), HasSubstr("sensor 4: GE 2.5 by 0.125"));
  EXPECT_THAT(said("SENSOR/4, " + call), HasSubstr("sensor 4: EQ 0 by 0.001"));
}

TEST_F(RoutinesAreTold, what_stands_above_a_request) {
  const RunResult r = with(driven +
                               "REQUEST/1, FUNCTION=USER(1), ROUTINE=utilities::Tellingrequest, COMMENT=a line, "
                               "TITLE=one:three:fifteen::seventy\n",
                           {C_UTILITIES}, false, {"SIMULATE/INITIAL"});
  const auto values = requested(r, 0);
  EXPECT_EQ(values, std::vector<double>({6, 3, 5, 7, 0, 7, 0, 0}));
}

class Utilities : public WithLibraries {
 protected:
  RunResult run_of(const std::string& dataset, int what, int of) const {
    return with(dataset + fmt::format("VARIABLE/1, FUNCTION=USER({},{}), ROUTINE=utilities::of_utilities\n"
                                      "VARIABLE/2, FUNCTION=YAW(20,1)\nVARIABLE/3, FUNCTION=PITCH(20,1)\n"
                                      "VARIABLE/4, FUNCTION=ROLL(20,1)\nVARIABLE/5, FUNCTION=AX(20,1)\n"
                                      "VARIABLE/6, FUNCTION=AY(20,1)\nVARIABLE/7, FUNCTION=AZ(20,1)\n"
                                      "REQUEST/1, VARIABLES=1,2,3,4,5,6,7\n",
                                      what, of),
                {C_UTILITIES}, true, {"SIMULATE/INITIAL"});
  }
  std::vector<double> values(const std::string& dataset, int what, int of = 0) const {
    return requested(run_of(dataset, what, of), 0);
  }
};

TEST_F(Utilities, bring_rotations_from_each_description_into_each_other) {
  std::string turned = driven;
  turned.insert(turned.find(", MASS=1"), ", REULER=0.4,2.2,-1.3");
  EXPECT_LE(values(turned, 0).at(0), 2e-15);
  EXPECT_LE(values(turned, 1).at(0), 1e-15);
  for (int k = 0; k < 3; ++k) {
    const auto ypr = values(turned, 2, k), about_axes = values(turned, 3, k);
    EXPECT_NEAR(ypr.at(0), ypr.at(static_cast<std::size_t>(k) + 1), 1e-14) << k;
    EXPECT_NEAR(about_axes.at(0), about_axes.at(static_cast<std::size_t>(k) + 4), 1e-14) << k;
  }
}

TEST_F(Utilities, refuse_what_is_no_rotation_and_what_is_no_body) { EXPECT_EQ(values(driven, 4).at(0), 8); }

TEST_F(Utilities, write_numbers_and_say_who_calculates) {
  EXPECT_EQ(values(driven, 12).at(0), 5);
  EXPECT_EQ(values(driven, 13).at(0), 3);
  EXPECT_EQ(values(driven, 14).at(0), 1);
  EXPECT_EQ(values(driven, 15).at(0), 1);
}

// Their library loads; it is the call that is refused.
TEST_F(Utilities, that_are_not_built_are_named) {
  for (const auto& [what, name] : {std::pair{16, "MODIFY"}, {17, "GTCMAT"}}) {
    const RunResult r = run_of(driven, what, 0);
    EXPECT_NE(r.status, 0) << name;
    EXPECT_THAT(r.err, AllOf(HasSubstr("VARIABLE/1"),
                             HasSubstr(fmt::format("it calls the utility {}, which is not built", name))));
  }
}

class ModalDampingByRoutine : public Utilities {
 protected:
  // A beam that is free, with four of its modes, and a mark on it.
  std::string beam(const std::string& damping) const {
    const LumpedBeam uniform{6, 0.6, 4.2e6, 900, 1300, 2100, 1.9, 2.5e-3};
    const ReducedBody body = reduced(uniform, vibration(uniform, 0).shapes.middleCols(6, 4));
    write("beam.fem", modal_text(body.nodes, body.stiffness));
    return driven + "SPLINE/7, X=0,1,2,3, Y=0,1,2,3\nFLEX_BODY/5, MNF_FILE=beam.fem" + damping + "\n";
  }
  RunResult damped(const std::string& damping) const { return with(beam(damping), {C_UTILITIES}); }
};

TEST_F(ModalDampingByRoutine, is_that_of_the_expression) {
  const RunResult expected = damped(", CRATIO=IF(FXFREQ-12:0.02,0.04,0.04)");
  double damping = 0;
  for (const auto& e : expected.eigenvalues(0)) damping = std::min(damping, e.real());
  EXPECT_LT(damping, 0);
  expect_same(damped(", CRATIO=USER(0.02,12)"), expected, 1e-13);
  expect_same(damped(", CRATIO=USER(0.02,12), ROUTINE=utilities::Paint"), expected, 1e-13);
}

TEST_F(ModalDampingByRoutine, that_cannot_be_is_refused_in_its_words) {
  const auto said = [&](const std::string& how) {
    const RunResult r = damped(", CRATIO=USER(0.02,12," + how + ")");
    EXPECT_NE(r.status, 0) << how;
    EXPECT_THAT(r.err, AllOf(HasSubstr("model.adm:8:"), HasSubstr("FLEX_BODY/5"))) << how;
    return r.err;
  };
  EXPECT_THAT(said("1"), HasSubstr("other ratios at another time"));
  EXPECT_THAT(said("2"), HasSubstr("other ratios at another time or for another step"));
  EXPECT_THAT(said("3"), HasSubstr("is -0.5 for its mode 4"));
  EXPECT_THAT(said("4"), HasSubstr("it says: no paint that thick"));
  EXPECT_THAT(said("5"), HasSubstr("it reads DX(20)"));
  EXPECT_THAT(said("6"), HasSubstr("data of the model"));
  const RunResult missing = damped(", CRATIO=USER(0.02,12), ROUTINE=utilities::varnish");
  EXPECT_THAT(missing.err, HasSubstr("FLEX_BODY/5 calls varnish of utilities, and no library has it"));
}

TEST_F(ModalDampingByRoutine, and_its_modes_are_known_to_other_routines) {
  const std::string dataset = beam("");
  EXPECT_EQ(values(dataset, 5, 5).at(0), 4);
  const RunResult free = with(dataset, {C_UTILITIES});
  std::vector<double> frequencies;
  for (const auto& e : free.eigenvalues(0)) {
    if (e.imag() > 0) frequencies.push_back(std::abs(e));
  }
  std::ranges::sort(frequencies);
  ASSERT_EQ(frequencies.size(), 4u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(values(dataset, 6 + k, 5).at(0), k + 1);
    EXPECT_NEAR(values(dataset, 9 + k, 5).at(0) / frequencies[static_cast<std::size_t>(k)], 1, 1e-9);
  }
}

// A slider that starts with some speed.
const std::string sliding =
    "Sliding\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, REULER=90D,90D,0\nPART/3, MASS=2, CM=20, IP=1,1,1, "
    "VX=0.9\nMARKER/20\nMARKER/21, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=21, J=2\n"
    "REQUEST/1, F2=VX(20,1)\\\n";

class FormulasInTime : public WithLibraries {};

TEST_F(FormulasInTime, know_numbers_without_fractions_from_others) {
  const std::vector<std::string> commands = {"SIMULATE/DYNAMICS, END=1, STEPS=10", "SIMULATE/INITIAL",
                                             "LINEAR/EIGENSOL"};
  const std::string force = "SFORCE/1, TRANSLATION, ACTIONONLY, I=20, J=2, FUNCTION=";
  const RunResult called =
      with(sliding + force + "USER(5), ROUTINE=drag_by_formula\n", {CPP_ROUTINES}, false, commands);
  // v' = −5/2 v², v = v0/(1 + 5/2 v0 t).
  EXPECT_NEAR(requested(called, 1).at(0), 0.9 / (1 + 2.5 * 0.9), 1e-4);
  expect_same(called, with(sliding + force + "-5*ABS(VX(20,1))*VX(20,1)\n", {CPP_ROUTINES}, false, commands), 1e-6, 2);
}

TEST_F(FormulasInTime, make_requests_and_sensors) {
  const RunResult r = with(sliding +
                               "REQUEST/2, FUNCTION=USER(7), ROUTINE=columns_by_formula\n"
                               "SENSOR/1, FUNCTION=USER(2), ROUTINE=watched_by_formula, VALUE=0.7, GE, RETURN\n",
                           {CPP_ROUTINES}, false, {"SIMULATE/DYNAMICS, END=1, STEPS=10", "SIMULATE/INITIAL"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.result(1).at("operating_point").at("requests").at(1).at("values").get<std::vector<double>>();
  ASSERT_EQ(values.size(), 8u);
  EXPECT_NEAR(values[0], 0.35, 1e-9);
  EXPECT_NEAR(values[2], 0.9, 1e-9);
  EXPECT_EQ(values[5], 7);
  EXPECT_EQ(values[1] + values[3] + values[4] + values[6] + values[7], 0);
}

// Orders that are not derivatives of each other: positions and velocities would contradict each other in silence.
TEST_F(FormulasInTime, motions_that_forget_to_differentiate_are_named) {
  const auto said = [&](const char* routine, const std::vector<std::string>& commands) {
    const RunResult r =
        with(sliding +
                 "PART/4, MASS=1, CM=40, IP=1,1,1, QG=1,0,0\nMARKER/40\nSFORCE/1, TRANSLATION, I=40, J=20, "
                 "FUNCTION=VX(40)\nMOTION/1, JOINT=1, FUNCTION=USER(1), ROUTINE=" +
                 routine + "\n",
             {C_ROUTINES}, false, commands);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  };
  const std::vector<std::string> in_time = {"SIMULATE/DYNAMICS, END=1.5, STEPS=10"};
  EXPECT_THAT(said("cubic_motion", in_time), Not(HasSubstr("wrong-derivative")));
  EXPECT_THAT(said("forgetful_motion", in_time),
              AllOf(HasSubstr("wrong-derivative"), HasSubstr("MOTION/1"), HasSubstr("as derivative 1 at TIME")));
}

class MiscountingRoutines : public WithLibraries {};

TEST_F(MiscountingRoutines, are_told_what_they_counted) {
  const std::string force = "SFORCE/1, TRANSLATION, ACTIONONLY, I=20, J=2, FUNCTION=USER(";
  EXPECT_EQ(
      with(driven + "MARKER/2, PART=1, REULER=90D,90D,0\n" + force + "1), ROUTINE=miscounted\n", {C_ROUTINES}).status,
      0);
  for (const char* count : {"0", "2", "6"}) {
    const RunResult r =
        with(driven + "MARKER/2, PART=1, REULER=90D,90D,0\n" + force + count + "), ROUTINE=miscounted\n", {C_ROUTINES});
    EXPECT_NE(r.status, 0);
    EXPECT_THAT(r.err, AllOf(HasSubstr("SFORCE/1"), HasSubstr(std::string("tells ") + count +
                                                              " partial derivatives by DX, and there are 1: ")));
  }
  const RunResult r =
      with(driven + "MARKER/2, PART=1, REULER=90D,90D,0\n" + force + "10), ROUTINE=overflowing\n", {C_ROUTINES}, true);
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, AllOf(HasSubstr("SFORCE/1"), HasSubstr("it writes 10 values, and SFORCE/1 has 1")));
}

}  // namespace
}  // namespace dynalin::cases::utilities_test
