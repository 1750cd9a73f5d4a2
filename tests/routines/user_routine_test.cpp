// Compiled routines: the same as expressions, in C, Fortran and by formulas that are differentiated; and what goes
// wrong.
#include <gmock/gmock.h>

#include <cfenv>
#include <csignal>
#include <filesystem>

#include "dataset/dataset.h"
#include "elements/catalogue.h"
#include "model/routine_options.h"
#include "places/sanitizers.h"
#include "routine/routine_context.h"
#include "routines/robot.h"
#include "routines/with_libraries.h"

namespace dynalin::cases::user_routine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string oscillator = R"(oscillator
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, REULER=90D,90D,0D
PART/2, MASS=2, CM=20, IP=1,2,3, VX=0.4
MARKER/20, PART=2, QP=0.1,0,0
MARKER/21, PART=2, REULER=90D,90D,0D
)";
const std::string slider = oscillator + "JOINT/1, TRANSLATIONAL, I=21, J=2\n";
const std::string along = "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, ";
const std::string spring = along + "FUNCTION=-(50*DX(20,1,1)+30*DX(20,1,1)**3+2*VX(20,1,1))\n";

class UserRoutines : public WithLibraries {
 protected:
  RunResult with(const std::string& dataset, const std::vector<std::string>& libraries = {C_ROUTINES, CPP_ROUTINES},
                 bool differences = false, const std::vector<std::string>& commands = {"LINEAR/EIGENSOL"}) const {
    return WithLibraries::with(dataset, libraries, differences, commands);
  }
};

TEST_F(UserRoutines, give_the_eigenvalues_of_the_same_expression) {
  const RunResult expression = with(slider + spring);
  expect_same(with(slider + along + "FUNCTION=USER(20,1,50,30,2)\n"), expression, 1e-14);
  expect_same(with(slider + along + "FUNCTION=USER(20,1,50,30,2), ROUTINE=formulas::spring_by_formula\n"), expression,
              1e-14);
  // A statement comes first, with the markers of the SFORCE; they are those of the slider, x is along their z axes.
  const std::string at_slider = along + "FUNCTION=-(50*DX(21,2,2)+30*DX(21,2,2)**3+2*VX(21,2,2))-7*DX(20,1)\n";
  const std::string called =
      along +
      "FUNCTION=USER(50,30,2), ROUTINE=routines::Springc\nSFORCE/2, TRANSLATION, ACTIONONLY, I=21, J=2, "
      "FUNCTION=-7*DX(20,1)\n";
  expect_same(with(slider + called), with(slider + at_slider), 1e-14);
}

// How the program calculates is not for routines to say.
TEST_F(UserRoutines, leave_rounding_and_traps_of_numbers_as_they_were) {
  const RunResult alone = with(slider + along + "FUNCTION=USER(20,1,50,30,2)\n"),
                  upwards = with(slider + along +
                                 "FUNCTION=USER(20,1,50,30,2), ROUTINE=routines::spring_that_rounds_upwards\n");
  expect_same(upwards, alone, 0);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_EQ(::fegetexcept(), 0);
}

// Nobody has promised that routines bear several threads: not of a library that is named, nor of one in a folder.
TEST_F(UserRoutines, are_called_by_one_thread) {
  const auto calls = [](const std::string& force, const std::string& library) {
    const auto text = std::make_shared<const SourceText>("model.adm", slider + along + force + "\nEND\n");
    auto dataset = std::make_shared<const Dataset>(parse_dataset(text).value);
    const auto built = build_model(dataset, catalogue(), {}, RoutineOptions{{library}});
    EXPECT_FALSE(built.diagnostics.has_errors());
    return built.value->calls_routines;
  };
  const std::string called = "FUNCTION=USER(20,1,50,30,2)", named = ", ROUTINE=routines::sfosub";
  EXPECT_TRUE(calls(called, C_ROUTINES));
  EXPECT_TRUE(calls(called + named, C_ROUTINES));
  EXPECT_TRUE(calls(called + named, std::filesystem::path(C_ROUTINES).parent_path().string()));
  EXPECT_FALSE(calls("FUNCTION=3", C_ROUTINES));
}

TEST_F(UserRoutines, of_an_sforce_are_told_which_type_it_has) {
  std::string forces, expressions;
  int id = 0;
  for (const std::string type : {"TRANSLATION", "TRANSLATIONAL", "TR", "ROTATION", "ROTATIONAL", "RO", "R"}) {
    const bool turns = type.front() == 'R';
    forces += fmt::format("SFORCE/{}, {}, ACTIONONLY, I=20, J=1, FUNCTION=USER({}), ROUTINE=routines::Typec\n", ++id,
                          type, turns ? 1 : 0);
    expressions += fmt::format("VARIABLE/{0}, FUNCTION=SFORCE({0},0,{1},0)\n", id, turns ? 8 : 4);
  }
  const auto values = requested(with(oscillator + forces + expressions + "REQUEST/1, VARIABLES=1,2,3,4,5,6,7\n",
                                     {C_ROUTINES}, false, {"SIMULATE/INITIAL"}),
                                0);
  ASSERT_EQ(values.size(), 7u);
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], 1, 1e-14) << k;
}

// Numbers, and discrete states of a GSE, are constants between samples.
TEST_F(UserRoutines, need_no_derivatives_by_arrays_that_are_constant) {
  const RunResult r = with(slider + along +
                               "FUNCTION=USER(20,1,6,5), ROUTINE=routines::spring_by_arrays\n"
                               "ARRAY/6, IC, NUMBERS=30,12\nARRAY/7, IC, NUMBERS=5,3\nARRAY/5, X\nARRAY/3, Y\n"
                               "GSE/1, NO=2, Y=3, ND=2, XD=5, ICD=7, SAMPLE_PERIOD=0.1, "
                               "INTERFACE=::,clock_update,sampled_output, FUNCTION=USER(0,0,0,0)\n",
                           {C_ROUTINES, C_STATE_EQUATIONS});
  EXPECT_THAT(r.err, Not(HasSubstr("gives no derivatives")));
  expect_same(r, with(slider + along + "FUNCTION=-50*DX(20,1)\n"), 1e-14);
  // An ARRAY of inputs is none.
  const RunResult refused = with(slider + along +
                                     "FUNCTION=USER(20,1,6,5), ROUTINE=routines::spring_by_arrays\n"
                                     "ARRAY/6, IC, NUMBERS=30,12\nARRAY/5, U, VARIABLES=1,2\nVARIABLE/1, "
                                     "FUNCTION=5\nVARIABLE/2, FUNCTION=3+DX(20,1)\n",
                                 {C_ROUTINES});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("LINEAR refuses it"));
}

TEST_F(UserRoutines, without_derivatives_are_refused_in_linear_models_unless_differences_are_asked_for) {
  const std::string called =
      slider + along + "FUNCTION=USER(20,1,50,30,2), ROUTINE=routines::spring_without_derivatives\n";
  const RunResult refused = with(called);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("[differenced-routine]"), HasSubstr("LINEAR refuses it"),
                                 HasSubstr("SFORCE/1: the routine spring_without_derivatives"),
                                 HasSubstr("--difference-user-routines")));
  const RunResult differenced = with(called, {C_ROUTINES}, true);
  EXPECT_THAT(differenced.err, AllOf(HasSubstr("[differenced-routine]"), HasSubstr("eigenvalues have no bound")));
  const RunResult exact = with(slider + spring);
  expect_same(differenced, exact, 1e-9);
  // What bounds the error of the one says nothing of the other.
  const auto mode_of = [](const RunResult& r) { return r.result(0).at("modes").at(0); };
  EXPECT_LT(mode_of(exact).at("error_bound_hz").get<double>(), 1e-12);
  EXPECT_TRUE(mode_of(differenced).at("error_bound_hz").is_null());
  EXPECT_THAT(differenced.out, HasSubstr("?"));
  EXPECT_THAT(exact.out, Not(HasSubstr("?")));
  // An equilibrium needs derivatives for its iteration alone.
  const std::string statics = slider + along +
                              "FUNCTION=USER(20,1,50,30,2), ROUTINE=routines::spring_without_derivatives\n"
                              "VARIABLE/1, FUNCTION=DX(20,1)\nREQUEST/1, VARIABLES=1\n";
  const RunResult found = with(statics, {C_ROUTINES}, false, {"SIMULATE/STATIC"});
  EXPECT_EQ(found.status, 0) << found.err;
}

TEST_F(UserRoutines, of_forces_torques_values_and_states_are_their_expressions) {
  const std::string fixed = oscillator +
                            "MARKER/3, PART=1, FLOATING\nMARKER/4, PART=1, FLOATING\n"
                            "MARKER/5, PART=1, FLOATING\nVARIABLE/1, FUNCTION=0.3+DX(20,1)\n";
  const auto at = [](std::string_view f) { return std::string(f) + "(20,1,1)"; };
  const std::string called = fixed +
                             "GFORCE/1, I=20, JFLOAT=3, RM=1, FUNCTION=USER(20,1,70,6)\n"
                             "VFORCE/1, I=20, JFLOAT=4, RM=1, FUNCTION=USER(20,1,9)\n"
                             "VTORQUE/1, I=20, JFLOAT=5, RM=1, FUNCTION=USER(20,1,4)\n"
                             "VARIABLE/2, FUNCTION=USER(3,1,5)\nDIFF/1, FUNCTION=USER(2,0.25)\n";
  std::string g = "GFORCE/1, I=20, JFLOAT=3, RM=1", f = "VFORCE/1, I=20, JFLOAT=4, RM=1",
              t = "VTORQUE/1, I=20, JFLOAT=5, RM=1";
  for (const std::string axis : {"X", "Y", "Z"}) {
    g += ", F" + axis + "=-70*" + at("D" + axis) + "\\";
    f += ", F" + axis + "=-9*" + at("D" + axis) + "\\";
    t += ", T" + axis + "=-4*" + at("W" + axis) + "\\";
  }
  for (const std::string axis : {"X", "Y", "Z"}) g += ", T" + axis + "=-6*" + at("W" + axis) + "\\";
  const std::string written = fixed + g + "\n" + f + "\n" + t +
                              "\nVARIABLE/2, FUNCTION=3*VARVAL(1)**2+5*TIME\n"
                              "DIFF/1, FUNCTION=(VARVAL(2)-DIF(1))/0.25\n";
  const std::string driven = "SFORCE/1, TRANSLATION, ACTIONONLY, I=20, J=2, FUNCTION=DIF(1)\n";
  const RunResult a = with(called + driven), b = with(written + driven);
  expect_same(a, b, 1e-13);
  // Many components of one formula, with slopes that the header finds: against differences of the same values.
  const std::string formula = fixed +
                              "GFORCE/1, I=20, JFLOAT=3, RM=1, FUNCTION=USER(20,1), "
                              "ROUTINE=formulas::wrench_by_formula\n";
  const std::string smooth =
      fixed +
      "GFORCE/1, I=20, JFLOAT=3, RM=1, FX=-100*SIN(DX(20,1,1))-5*VX(20,1,1,1)/SQRT(1+DX(20,1,1)**2)\\, "
      "FY=-200*SIN(DY(20,1,1))-5*VY(20,1,1,1)/SQRT(1+DY(20,1,1)**2)\\, "
      "FZ=-300*SIN(DZ(20,1,1))-5*VZ(20,1,1,1)/SQRT(1+DZ(20,1,1)**2)\\, "
      "TX=-TANH(WX(20,1,1))-3*ATAN(UVX(20,1)*[1,0,0])*EXP(-0.5*DX(20,1,1))\\, "
      "TY=-TANH(WY(20,1,1))-3*ATAN(UVX(20,1)*[0,1,0])*EXP(-0.5*DY(20,1,1))\\, "
      "TZ=-TANH(WZ(20,1,1))-3*ATAN(UVX(20,1)*[0,0,1])*EXP(-0.5*DZ(20,1,1))\\\n";
  expect_same(with(formula), with(smooth), 1e-13);
}

class UserFields : public UserRoutines {
 protected:
  // On marker 2, which is turned and carried along by a body of its own.
  static std::string model(const std::string& field, const std::string& more = "") {
    return R"(a field between two bodies
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1,2,3, QG=0.3,0.1,0.2, REULER=0.2,0.3,0.1, WX=0.3, WZ=0.2, VY=0.1
MARKER/20, PART=2, QP=0.05,0.02,0
PART/3, MASS=3, CM=30, IP=2,1,2, WY=0.2
MARKER/30, PART=3, QP=0,0.1,0
MARKER/2, PART=3, REULER=0.1,0.2,0.3
BUSHING/1, I=30, J=1, K=90,80,70, KT=20,30,40, C=1,1,1, CT=1,1,1
FIELD/1, I=20, J=2, LENGTH=0.1,0.2,0.05,0.01,0.02,0.03, )" +
           field + "\n" + more;
  }
  static std::string matrices() {
    return "KMATRIX=100,0,0,0,0,3, 0,12,0,0,0,-6, 0,0,36,0,0,0, 0,0,0,25,0,0, 0,0,0,0,9,0\n,"
           " 0,-6,0,0,0,4, CRATIO=0.01";
  }
};

TEST_F(UserFields, are_those_with_matrices) {
  const RunResult written = with(model(matrices()));
  for (const std::string routine : {"", ", ROUTINE=routines::Fieldc", ", ROUTINE=formulas::field_by_formula"})
    expect_same(with(model("FUNCTION=USER(0.01,0)" + routine)), written, 1e-12);
  // What acts on the markers is the same too.
  const std::string requests = "REQUEST/1, FORCE, I=20, J=2, RM=2\n";
  const auto forces = [&](const std::string& field) {
    const RunResult r = with(model(field, requests), {C_ROUTINES}, false, {"SIMULATE/INITIAL"});
    EXPECT_EQ(r.status, 0) << r.err;
    return r.result(0).at("operating_point").at("requests").at(0).at("values").get<std::vector<double>>();
  };
  const auto a = forces("FUNCTION=USER(0.01,0)"), b = forces(matrices());
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(std::abs(b.at(1)), 1);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12) << k;
}

TEST_F(UserFields, may_be_nonlinear) {
  // A stiff spring along x that grows with the third power beside the field is the sum of both.
  const std::string cubic = "MARKER/4, PART=3, FLOATING\nGFORCE/1, I=20, JFLOAT=4, RM=2, FX=-500*(DX(20,2,2)-0.1)**3\n";
  const RunResult sum = with(model(matrices(), cubic));
  const std::vector<std::string> motion = {"SIMULATE/TRANSIENT, END=0.2, STEPS=4", "LINEAR/EIGENSOL"};
  const RunResult moved = with(model(matrices(), cubic), {C_ROUTINES, CPP_ROUTINES}, false, motion);
  for (const std::string routine : {"", ", ROUTINE=formulas::field_by_formula"}) {
    expect_same(with(model("FUNCTION=USER(0.01,500)" + routine)), sum, 1e-12);
    expect_same(with(model("FUNCTION=USER(0.01,500)" + routine), {C_ROUTINES, CPP_ROUTINES}, false, motion), moved,
                1e-5, 1);
  }
}

TEST_F(UserFields, without_all_derivatives_are_refused_in_linear_models_unless_differences_are_asked_for) {
  for (const std::string name : {"field_without_derivatives", "field_with_gap"}) {
    const std::string called = model("FUNCTION=USER(0.01,500), ROUTINE=routines::" + name);
    const RunResult refused = with(called);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, AllOf(HasSubstr("[differenced-routine]"), HasSubstr("FIELD/1: the routine " + name),
                                   HasSubstr("dfddis and dfdvel"), HasSubstr("--difference-user-routines")));
    const RunResult differenced = with(called, {C_ROUTINES}, true);
    expect_same(differenced, with(model("FUNCTION=USER(0.01,500)")), 1e-9);
    EXPECT_TRUE(differenced.result(0).at("modes").at(0).at("error_bound_hz").is_null());
  }
}

TEST_F(UserFields, that_cannot_be_say_why) {
  const auto said = [&](const std::string& field, int status) {
    const RunResult r = with(model(field));
    EXPECT_EQ(r.status, status) << r.err;
    return r.err;
  };
  EXPECT_THAT(said("FUNCTION=USER(0.01,0), ROUTINE=routines::field_that_asks", 1),
              AllOf(HasSubstr("[routine-failed]"), HasSubstr("DM(20, 1)"), HasSubstr("FIELD/1")));
  EXPECT_THAT(said("FUNCTION=3*TIME", 1), AllOf(HasSubstr("[unknown-word]"), HasSubstr("USER(")));
  EXPECT_THAT(said("FUNCTION=USER(-1,0), ROUTINE=routines::field_without_number", 2),
              AllOf(HasSubstr("FIELD/1: the routine field_without_number"), HasSubstr("no finite number")));
}

TEST_F(UserRoutines, of_motions_give_velocity_and_acceleration) {
  const std::string model = slider +
                            "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30, PART=3, QP=0.3,0,0\n"
                            "MARKER/31, PART=3, REULER=90D,90D,0D\nMARKER/22, PART=2, REULER=90D,90D,0D\n"
                            "JOINT/2, TRANSLATIONAL, I=31, J=22\n"
                            "SPRINGDAMPER/1, TRANSLATION, I=30, J=20, K=40, C=1, LENGTH=0.1\n"
                            "REQUEST/1, F2=VX(20)\\F3=ACCX(20)\\F4=MOTION(1,0,2,0)\n";
  const auto values = [&](const std::string& motion) {
    const RunResult r = with(model + "MOTION/1, JOINT=1, TRANSLATION, " + motion + "\n", {C_ROUTINES, CPP_ROUTINES},
                             false, {"SIMULATE/TRANSIENT, END=0.5, STEPS=2", "SIMULATE/INITIAL"});
    EXPECT_EQ(r.status, 0) << r.err;
    return r.result(1).at("operating_point").at("requests").at(0).at("values").get<std::vector<double>>();
  };
  const auto expression = values("FUNCTION=0.4/3*SIN(3*TIME)");
  for (const std::string called : {"FUNCTION=USER(0.13333333333333333,3)",
                                   "FUNCTION=USER(0.13333333333333333,3), ROUTINE=formulas::course_by_formula"}) {
    const auto found = values(called);
    ASSERT_EQ(found.size(), expression.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expression[k], 1e-7) << called << k;
  }
}

TEST_F(UserRoutines, of_requests_and_sensors_are_called) {
  const RunResult r =
      with(slider + spring + "REQUEST/1, FUNCTION=USER(20,1)\n", {C_ROUTINES}, false, {"SIMULATE/INITIAL"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.result(0).at("operating_point").at("requests").at(0).at("values").get<std::vector<double>>();
  ASSERT_EQ(values.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(values[k], static_cast<double>(k) + 0.1, 1e-15);
  const RunResult stopped = with(slider + spring + "SENSOR/1, GE, VALUE=0.5, ERROR=1E-3, HALT, FUNCTION=USER(2)\n",
                                 {C_ROUTINES}, false, {"SIMULATE/TRANSIENT, END=1, STEPS=10", "SIMULATE/INITIAL"});
  ASSERT_FALSE(stopped.json.is_null()) << stopped.err;
  EXPECT_THAT(stopped.err + stopped.out, HasSubstr("dynamics to 0.25:"));
}

TEST_F(UserRoutines, of_requests_that_cannot_be_are_no_missing_ones) {
  for (const std::string what : {"0", "1", "2"}) {
    const RunResult r =
        with(slider + spring + "REQUEST/1, FUNCTION=USER(" + what + "), ROUTINE=routines::unusable_request\n",
             {C_ROUTINES}, false, {"SIMULATE/INITIAL"});
    EXPECT_NE(r.status, 0) << what;
    EXPECT_THAT(r.err, AllOf(HasSubstr("unusable_request"), Not(HasSubstr("no library that has it is named")))) << what;
  }
}

// Nothing pushes the slider: it goes on at 0.4 from 0.1, and is at 0.2 when the time is 0.25.
TEST_F(UserRoutines, of_sensors_say_what_they_evaluate) {
  const auto kept = [&](const std::string& sensor) {
    const RunResult r = with(slider + "VARIABLE/1, FUNCTION=SENVAL(1)\nREQUEST/1, F2=SENVAL(1)\nSENSOR/1, GE, " +
                                 "VALUE=0.5, ERROR=1E-9, RETURN, " + sensor + "\n",
                             {C_ROUTINES}, false, {"SIMULATE/TRANSIENT, END=1, STEPS=10", "SIMULATE/INITIAL"});
    EXPECT_FALSE(r.json.is_null()) << r.err;
    if (r.json.is_null()) return 0.0;
    return r.result(1).at("operating_point").at("requests").at(0).at("values").at(0).get<double>();
  };
  EXPECT_NEAR(kept("FUNCTION=2*TIME, EVALUATE=USER(3,20,1)"), 3 * 0.2, 1e-9);
  EXPECT_NEAR(kept("FUNCTION=USER(2), EVALUATE=USER(3,20,1)"), 3 * 0.2, 1e-9);
  EXPECT_NEAR(kept("EVALUATE=USER(3,20,1), EVALUATE_ROUTINE=routines::doubled_sevsub, FUNCTION=USER(2), "
                   "ROUTINE=routines::sensub"),
              6 * 0.2, 1e-9);
}

TEST_F(UserRoutines, move_a_robot_with_friction_as_expressions_do) {
  const std::vector<std::string> commands = {"SIMULATE/TRANSIENT, END=0.3, STEPS=10", "LINEAR/EIGENSOL"};
  const RunResult expression = with(robot(Friction::expression), {}, false, commands);
  expect_same(with(robot(Friction::routine), {C_FRICTION}, false, commands), expression, 1e-9, 1);
#ifdef FORTRAN_FRICTION
  expect_same(with(robot(Friction::routine), {FORTRAN_FRICTION}, false, commands), expression, 1e-9, 1);
#endif
}

TEST_F(UserRoutines, that_have_no_value_name_their_element) {
  const auto said = [&](const std::string& routine, int status) {
    const RunResult r = with(slider + along + "FUNCTION=USER(20,1), ROUTINE=routines::" + routine + "\n");
    EXPECT_EQ(r.status, status) << r.err;
    return r.err;
  };
  EXPECT_THAT(said("gives_no_number", 2),
              AllOf(HasSubstr("SFORCE/1: the routine gives_no_number"), HasSubstr("no finite number")));
  EXPECT_THAT(said("says_stop", 2), AllOf(HasSubstr("SFORCE/1"), HasSubstr("the table is missing")));
  EXPECT_THAT(said("asks_too_late", 2), AllOf(HasSubstr("SFORCE/1"), HasSubstr("it reads DX(20, 1), for which")));
  EXPECT_THAT(said("asks_nonsense", 1), AllOf(HasSubstr("[routine-failed]"), HasSubstr("HEIGHT(1)")));
  EXPECT_THAT(said("is_not_there", 1), AllOf(HasSubstr("[missing-routine]"), HasSubstr("is_not_there of routines")));
}

TEST_F(UserRoutines, of_motions_that_have_no_value_or_other_rates_name_their_element) {
  const auto said = [&](const std::string& constants, const std::string& routine, const std::string& command) {
    const RunResult r = with(slider + "MOTION/1, JOINT=1, TRANSLATION, FUNCTION=USER(" + constants +
                                 "), ROUTINE=routines::" + routine + "\n",
                             {C_ROUTINES}, false, {command});
    EXPECT_EQ(r.status, 2) << r.err;
    return r.err;
  };
  for (const std::string command : {"SIMULATE/KINEMATICS, END=1, STEPS=2", "SIMULATE/INITIAL"}) {
    EXPECT_THAT(said("0", "lost_motsub", command), AllOf(HasSubstr("MOTION/1"), HasSubstr("no finite number")));
    EXPECT_THAT(said("1", "lost_motsub", command), HasSubstr("the first derivative of FUNCTION of MOTION/1 by time"));
    EXPECT_THAT(said("2", "lost_motsub", command), HasSubstr("the second derivative of FUNCTION of MOTION/1 by time"));
  }
  EXPECT_THAT(said("0", "still_motsub", "SIMULATE/KINEMATICS, END=1, STEPS=2"),
              HasSubstr("in MOTION/1 moves otherwise than its velocities and accelerations say"));
}

// What is no number neither triggers nor goes unnoticed: from 0.3 on.
TEST_F(UserRoutines, and_functions_of_sensors_that_have_no_value_name_their_element) {
  const RunResult r = with(slider + "SENSOR/3, GE, VALUE=5, ERROR=1E-3, HALT, FUNCTION=SQRT(0.3-TIME)\n", {}, false,
                           {"SIMULATE/DYNAMICS, END=1, STEPS=10"});
  EXPECT_EQ(r.status, 2) << r.err;
  EXPECT_THAT(r.err, HasSubstr("SENSOR/3"));
}

TEST_F(UserRoutines, are_no_part_of_expressions) {
  const auto said = [&](const std::string& function) {
    const RunResult r = with(slider + along + "FUNCTION=" + function + "\n");
    EXPECT_EQ(r.status, 1) << r.err;
    return r.err;
  };
  for (const std::string function : {"2*USER(20,1,50,30,2)", "USER(20,1,50,30,2)+DX(20,1)", "USER(20,1,50,30,2)*(3)"})
    EXPECT_THAT(said(function), AllOf(HasSubstr("[routine-in-expression]"), HasSubstr("VARVAL"),
                                      Not(HasSubstr("[unbalanced-parenthesis]"))));
  // What the hint says.
  expect_same(with(slider + along +
                   "FUNCTION=2*VARVAL(7)\nVARIABLE/7, FUNCTION=USER(20,1,25,15,1), "
                   "ROUTINE=routines::sfosub\n"),
              with(slider + spring), 1e-14);
}

TEST_F(UserRoutines, read_markers_that_exist) {
  const RunResult r = with(slider + along + "FUNCTION=USER(99,1,50,30,2)\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, AllOf(HasSubstr("[unknown-marker]"), HasSubstr("SFORCE/1 refers to MARKER/99")));
}

// DIF1 of an algebraic DIFF is the rate of what the routine gives.
TEST_F(UserRoutines, without_derivatives_in_time_are_named_where_a_rate_is_needed) {
  const RunResult r = with(slider + along + "FUNCTION=DIF1(7)\nDIFF/7, IMPLICIT, FUNCTION=DIF(7)-VARVAL(2)\n" +
                               "VARIABLE/2, FUNCTION=USER(2,1,3)\nVARIABLE/1, FUNCTION=DX(20,1)\n",
                           {C_ROUTINES});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("the routine varsub of"));
  EXPECT_THAT(r.err, HasSubstr("gives no derivative in time of its value"));
}

TEST_F(UserRoutines, that_give_some_derivatives_are_told_which_are_missing) {
  const RunResult r =
      with(slider + along + "FUNCTION=USER(20,1,50,3), ROUTINE=routines::forgets_damping\n", {C_ROUTINES});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("gives no derivative by VX(20, 1, 1)"), HasSubstr("[differenced-routine]")));
}

// The marker is where the law jumps, at 0.1.
TEST_F(UserRoutines, that_jump_have_no_differences) {
  const auto linear = [&](const std::string& jump) {
    return with(slider + along + "FUNCTION=USER(20,1,50," + jump + "), ROUTINE=routines::jumps\n", {C_ROUTINES}, true);
  };
  expect_same(linear("0"), with(slider + along + "FUNCTION=-50*DX(20,1)\n"), 1e-9);
  for (const std::string jump : {"1", "-0.1", "1E3"}) {
    const RunResult r = linear(jump);
    EXPECT_EQ(r.status, 2) << jump;
    EXPECT_THAT(r.err, HasSubstr("differences of its values do not agree at TIME 0: it jumps here")) << jump;
  }
}

TEST_F(UserRoutines, with_a_kink_are_differenced_to_the_mean_with_a_warning) {
  const auto linear = [&](const std::string& sides) {
    return with(slider + along + "FUNCTION=USER(" + sides + ",20,1), ROUTINE=routines::bent\n", {C_ROUTINES}, true);
  };
  const RunResult kink = linear("30,70");
  expect_same(kink, with(slider + along + "FUNCTION=-50*(DX(20,1)-0.1)\n"), 1e-9);
  EXPECT_THAT(kink.err,
              AllOf(HasSubstr("[kink-of-routine]"), HasSubstr("called for SFORCE/1 has a kink here: by DX(20, 1"),
                    HasSubstr("its slope is -70 on one side and -30 on the other"),
                    HasSubstr("the linear model has the mean of both")));
  EXPECT_THAT(linear("50,50").err, Not(HasSubstr("kink-of-routine")));
}

TEST_F(UserRoutines, whose_derivatives_their_values_contradict_are_named) {
  const auto linear = [&](const std::string& said) {
    return with(slider + along + "FUNCTION=USER(20,1,50," + said + "), ROUTINE=routines::misled\n", {C_ROUTINES});
  };
  for (const std::string wrong : {"50", "-500", "0", "-50.1"}) {
    const RunResult r = linear(wrong);
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, AllOf(HasSubstr("[wrong-derivative]"), HasSubstr("called for SFORCE/1 gives " + wrong),
                             HasSubstr("by DX(20, 1"), HasSubstr("its values change by -50")))
        << wrong;
  }
  EXPECT_THAT(linear("-50").err, Not(HasSubstr("wrong-derivative")));
}

TEST_F(UserRoutines, have_thirty_constants_at_most_and_read_none_safely) {
  std::string many = "1";
  for (int k = 1; k < 30; ++k) many += ",1";
  const auto called = [&](const std::string& constants) {
    return with(slider + along + "FUNCTION=USER(" + constants + "), ROUTINE=routines::first_constant\n", {C_ROUTINES},
                true, {"SIMULATE/INITIAL"});
  };
  EXPECT_EQ(called(many).status, 0) << called(many).err;
  const RunResult more = called(many + ",1");
  EXPECT_EQ(more.status, 1);
  EXPECT_THAT(more.err,
              AllOf(HasSubstr("USER of SFORCE/1 has 31 constants, and takes 30 at most"), HasSubstr("[wrong-count]")));
  EXPECT_EQ(called("").status, 0) << called("").err;
}

TEST_F(UserRoutines, evaluate_functions_of_the_language) {
  struct Row {
    const char *name, *constants;
    bool of_rate;
  };
  // Of x = 0.1 and x' = 0.4.
  int which = 0;
  for (const Row& f : {Row{"IMPACT", "0.5,100,1.5,7,0.6", true},
                       {"BISTOP", "-1,0.05,100,1.5,7,0.6", true},
                       {"STEP", "0,0,0.3,-9", false},
                       {"STEP5", "0,0,0.3,-9", false},
                       {"HAVSIN", "0,0,0.3,-9", false},
                       {"SHF", "0.2,-30,1.1,0.3,0.5", false},
                       {"POLY", "0.3,1,-20,-5", false},
                       {"CHEBY", "0.3,1,-20,-5", false},
                       {"FORCOS", "0.2,1.5,1,-20,-5", false},
                       {"FORSIN", "0.2,1.5,1,-20,-5", false}}) {
    const RunResult r = with(slider + along + "FUNCTION=USER(" + std::to_string(which++) + ",20,1," + f.constants +
                                 "), ROUTINE=routines::of_the_language\n",
                             {C_ROUTINES});
    const std::string arguments = std::string("DX(20,1,1)") + (f.of_rate ? ",VX(20,1,1,1)," : ",") + f.constants;
    expect_same(r, with(slider + along + "FUNCTION=" + f.name + "(" + arguments + ")\n"), 1e-12);
    EXPECT_THAT(r.err, Not(HasSubstr("wrong-derivative"))) << f.name;
  }
  // STEP with both ends at one place has no value.
  EXPECT_THAT(
      with(slider + along + "FUNCTION=USER(2,20,1,1,0,1,2), ROUTINE=routines::of_the_language\n", {C_ROUTINES}).err,
      HasSubstr("it says: there is no value"));
}

// With g = x1 − x: k g^e − cmax STEP(g, 0, 0, d, 1) x'.
// As Fortran writes names, some write them in C.
TEST_F(UserRoutines, may_write_names_with_blanks_behind) {
  expect_same(with(slider + along + "FUNCTION=USER(50), ROUTINE=routines::padded_names\n"),
              with(slider + along + "FUNCTION=-50*DX(20,1)\n"), 1e-14);
}

TEST_F(UserRoutines, get_second_derivatives_and_arrays) {
  const auto value = [&](const std::string& call) {
    const RunResult r = with(
        slider + "ARRAY/9, IC, SIZE=3, NUMBERS=4,5,6.5\nVARIABLE/1, FUNCTION=" + call + "\nREQUEST/1, VARIABLES=1\n",
        {C_ROUTINES}, true, {"SIMULATE/INITIAL"});
    return requested(r, 0).at(0);
  };
  const double g = 0.6;
  EXPECT_NEAR(value("USER(0), ROUTINE=routines::curvature"), 100 * 2.5 * 1.5 * std::sqrt(g) + 7 * (6 - 12 * g) * 0.2,
              1e-10);
  EXPECT_NEAR(value("USER(1), ROUTINE=routines::curvature"), 7 * (6 * g - 6 * g * g), 1e-10);
  EXPECT_NEAR(value("USER(2), ROUTINE=routines::curvature"), 0, 1e-12);
  EXPECT_EQ(value("USER(9), ROUTINE=routines::of_an_array"), 6.5);
}

TEST_F(UserRoutines, of_a_library_that_cannot_be_loaded_are_not_missing_as_well) {
  write("broken.so", "no library");
  const RunResult r = with(slider + along + "FUNCTION=USER(1)\n", {(folder_ / "broken.so").string()});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, AllOf(HasSubstr("[unusable-library]"), Not(HasSubstr("missing-routine"))));
}

TEST_F(UserRoutines, say_what_they_have_to_say_once) {
  ::testing::internal::CaptureStderr();
  const RunResult r =
      with(slider + along + "FUNCTION=USER(20,1,50,0,0), ROUTINE=routines::speaks\n", {C_ROUTINES}, true);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(said, AllOf(HasSubstr("the routine speaks of"), HasSubstr("called for SFORCE/1: a spring of 50\n")));
  EXPECT_EQ(said.find("a spring"), said.rfind("a spring")) << said;
}

TEST_F(UserRoutines, run_only_from_libraries_that_the_user_names) {
  const std::string file = C_ROUTINES;
  const RunResult r =
      with(slider + along + "FUNCTION=USER(20,1,50,30,2), ROUTINE=" + file + "::sfosub\n", {CPP_ROUTINES});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("[missing-routine]"));
  const std::string folder = std::filesystem::path(file).parent_path().string();
  expect_same(with(slider + along + "FUNCTION=USER(20,1,50,30,2), ROUTINE=routines::sfosub\n", {folder}),
              with(slider + spring), 1e-14);
  EXPECT_THAT(with(slider + spring + "VARIABLE/1, FUNCTION=USER(1)\n", {"nowhere.so"}).err,
              HasSubstr("[unusable-library]"));
}

TEST_F(UserRoutines, that_crash_are_named_before_the_program_dies) {
  if (sanitized) GTEST_SKIP() << "the sanitizer takes the signal";
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        name_routine_of_crash();
        with(slider + along + "FUNCTION=USER(20,1), ROUTINE=routines::crashes\n");
      },
      ::testing::KilledBySignal(SIGSEGV), "the routine crashes of .*, called for SFORCE/1");
}

TEST_F(UserRoutines, that_end_the_program_are_named_and_do_not_pass_for_success) {
  if (sanitized) GTEST_SKIP() << "the sanitizer takes the signal";
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  for (const std::string quickly : {"0", "1"}) {
    EXPECT_EXIT(
        {
          name_routine_of_crash();
          with(slider + along + "FUNCTION=USER(20," + quickly + "), ROUTINE=routines::stops\n");
        },
        ::testing::KilledBySignal(SIGABRT), "told to end by the routine stops of .*, called for SFORCE/1");
  }
}

}  // namespace
}  // namespace dynalin::cases::user_routine_test
