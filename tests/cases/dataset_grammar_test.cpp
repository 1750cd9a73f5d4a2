// Datasets as other programs and people write them: what is no part of a linear model must not keep it from being read.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::dataset_grammar_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A mass of 1 on a spring of 400: 20/2π. Lines of the test stand before END.
const std::string oscillator =
    "oscillator\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
    "MARKER/21\nJOINT/1, TRANSLATIONAL, I=20, J=1\nBUSHING/1, I=20, J=1, K=0,0,400\n";

class DatasetGrammar : public Cases {
 protected:
  RunResult with(const std::string& lines) const { return run(oscillator + lines + "END\n", "LINEAR/EIGENSOL\n"); }
  void expect_read(const std::string& lines) const {
    const RunResult r = with(lines);
    ASSERT_EQ(r.status, 0) << lines << r.err;
    expect_eigenvalues(r.eigenvalues(0), {{0, 20 / (2 * std::numbers::pi)}}, 1e-14);
  }
};

TEST_F(DatasetGrammar, request_takes_lists_of_quoted_texts_with_empty_ones) {
  expect_read(
      "REQUEST/1\n, F2=DX(20,1)\\\n, F3=DY(20,1)\\\n, CNAMES=\"\", \"x, of I\", \"\"\n, CUNITS=\"length\", \"\"\n"
      ", CLABELS=\"a=b\",'c'\n, RESULTS_NAME=REQ_1\n");
  expect_read("REQUEST/1, DISPLACEMENT, I=20, J=1, CNAMES=x,y,z, CUNITS=mm,mm,mm, COMMENT=a, b: c\n");
  expect_read("REQUEST/02, V,I=20,J=1,C=VELOCITY X Y Z\nREQUEST/3, A,I=20\nR/4, D,I=20\nR/5, F, I=20\n");
  expect_read("REQUEST/1, CNAMES=u,v, DISPLACEMENT, I=20, J=1\n");
  expect_read("REQUEST/2, CNAMES=,\"\",, CUNITS=, F2=DX(20,1)\n");
}

TEST_F(DatasetGrammar, request_may_call_what_nothing_here_evaluates) {
  expect_read("REQUEST/1, FUNCTION=USER(1,2,3)\\TITLE=a:b:c\n");
  expect_read("REQUEST/1, FUNCTION=USER(1), ROUTINE=lib::sub\n");
  expect_read("REQUEST/04, F2=ORIENT(27,1,20,1)\\F3=ORIENT(13,2,20,1)\\F4=CONTACT(1,0,2,0),C=EULER PARAMETERS\n");
  const RunResult wrong = with("REQUEST/1, F2=DX(20,1)+*2\n");
  EXPECT_EQ(wrong.status, 0);
  EXPECT_THAT(wrong.err, HasSubstr("model.adm:10:24: warning"));
}

TEST_F(DatasetGrammar, preferences_stand_in_a_dataset_and_f77_points_to_original) {
  expect_read("PREFERENCES/SOLVER=CXX, STATUS_MESSAGE=ON, LIBPATH=/a/b.c, SIMEXIT\n");
  for (const std::string solver : {"F77", "F7", "FORTRAN", "for"}) {
    const RunResult r = with("PREF/SOLVER=" + solver + "\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr("asks for the FORTRAN solver: LINEAR with ORIGINAL")) << solver;
    EXPECT_THAT(r.message, HasSubstr("ORIGINAL"));
  }
  EXPECT_THAT(with("PREF/SOLVER=FORTRAN\n").err, HasSubstr("PREFERENCES/SOLVER=FORTRAN asks"));
}

TEST_F(DatasetGrammar, a_part_may_name_a_material) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nMATERIAL/1, NAME=steel, DENSITY=7801\nPART/1, GROUND, MATERIAL=.mat.steel\nMARKER/1\n"
          "PART/2, MASS=1, CM=20, IP=1,1,1, MATERIAL=steel-2\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
          "BUSHING/1, I=20, J=1, K=0,0,400\nEND\n",
          "LINEAR/EIG\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(run("t\nPART/1, GROUND, MATERIAL=steel, MASS=3\nEND\n", "LINEAR/EIG\n").err,
              HasSubstr("[argument-of-ground]"));
}

TEST_F(DatasetGrammar, a_message_about_a_value_names_statements_as_they_are_written) {
  EXPECT_THAT(with("EQUILIBRIUM/ERROR=-1\n").err, HasSubstr("ERROR of EQUILIBRIUM is -1, it must be at least 0"));
  const RunResult kilograms = with("PART/9, MASS=1 kg\n");
  EXPECT_THAT(kilograms.err, HasSubstr("MASS takes plain numbers, found 'kg'"));
  EXPECT_THAT(kilograms.err, HasSubstr("hint: units are not written behind numbers"));
  EXPECT_THAT(with("MARKER/9, FLEX_BODY=3\n").err, HasSubstr("MARKER/9 refers to FLEX_BODY/3, which does not exist"));
}

TEST_F(DatasetGrammar, a_string_may_hold_anything_or_nothing) {
  expect_read("STRING/1, STRING=mdids://Foo/tab.tbl/x.rpf, and, more=things\n, over lines\n");
  EXPECT_THAT(with("STRING/1, STRING=" + std::string(1025, 'x') + "\n").err,
              HasSubstr("the text of STRING/1 has 1025 characters, 1024 at most"));
  const RunResult empty = with("STRING/1, STRING=\n");
  EXPECT_EQ(empty.status, 0) << empty.err;
  EXPECT_THAT(empty.err, HasSubstr("model.adm:10:17: warning"));
  const RunResult zero = with(std::string("STRING/1, STRING=a\0\0b\n", 22));
  EXPECT_EQ(zero.status, 0) << zero.err;
  EXPECT_THAT(zero.err, HasSubstr("model.adm:10:19: warning"));
}

TEST_F(DatasetGrammar, full_rorder_may_be_two_words) {
  const std::string lse = "VARIABLE/1, FUNCTION=0\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nLSE/1, U=1, X=2, A=1, B=2\n";
  for (const std::string full : {"FULL=RORDER", "FULL RORDER", "FULL, RORDER", "full  rorder"}) {
    const RunResult r = with(lse + "MATRIX/1, " + full + ", ROWS=2, COLUMNS=2, VALUES=0,1,-6,-5\nMATRIX/2, " + full +
                             ", RO=2, COL=1, VALUES=1,1\n");
    ASSERT_EQ(r.status, 0) << full << r.err;
    expect_eigenvalues(
        r.eigenvalues(0),
        {{-2 / (2 * std::numbers::pi), 0}, {-3 / (2 * std::numbers::pi), 0}, {0, 20 / (2 * std::numbers::pi)}}, 1e-12);
  }
  const RunResult columns = with(lse +
                                 "MATRIX/1, FULL CORDER, ROWS=2, COLUMNS=2, VALUES=0,1,-6,-5\nMATRIX/2, FULL "
                                 "CORDER, R=2, C=1, VALUES=1,1\n");
  EXPECT_EQ(columns.status, 0) << columns.err;
}

TEST_F(DatasetGrammar, r_of_a_marker_is_reuler) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, R=90D,90D,0\nPART/2, M=1, CM=20, IP=1,1,1\nMARKER/20, "
          "R=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=20, J=1\nBUSHING/1, I=20, J=1, K=7,7,400\nEND\n",
          "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(0), {{0, 20 / (2 * std::numbers::pi)}}, 1e-14);
  EXPECT_THAT(r.labels(0), ::testing::Contains(HasSubstr("DX(BCS)")));
}

TEST_F(DatasetGrammar, longer_spellings_of_linear_are_understood) {
  const RunResult r = run(oscillator + "END\n",
                          "LINEAR/EIGENSOLUTION, NODAMPING, NOVECTORS\nlin/eigensolut, nodamp\nlinear/eigen\n"
                          "LINEAR/STATEMATRIX, FILE=a\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.eigenvalues(1).size(), 2u);
  EXPECT_THAT(run(oscillator + "END\n", "LINEAR/EIGENSOLVER\n").err, HasSubstr("[unknown-argument]"));
}

TEST_F(DatasetGrammar, text_behind_stop_and_end_is_not_read) {
  const RunResult r = run(oscillator + "END\nthis is no statement\n, nor this (\n\x01\x02",
                          "LINEAR/EIGENSOL\nstop\nhere follow notes: (\nFOO/1\nLINEAR/NOTHING\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.json.at("results").size(), 1u);
}

TEST_F(DatasetGrammar, the_fiftieth_problem_of_a_kind_is_counted_and_other_kinds_are_shown) {
  std::string lines;
  for (int k = 0; k < 60; ++k) lines += "VARIABLE/" + std::to_string(100 + k) + ", FUNCTION=DX(77)\n";
  const RunResult r = with(lines + "MARKER/9, PART=9\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("model.adm:58:"));
  EXPECT_THAT(r.err, Not(HasSubstr("model.adm:59:")));
  EXPECT_THAT(r.err, HasSubstr("11 more errors of the kind [unknown-marker]"));
  EXPECT_THAT(r.err, HasSubstr("[unknown-body]"));
}

// Without blanks a word behind a number is no unit, and behind a comma it is an argument.
TEST_F(DatasetGrammar, arguments_behind_numbers_need_no_comma) {
  expect_read("JOINT/9, I=20 J=1 CYLINDRICAL\nSPRINGDAMPER/9, I=20, J=1, KT=1 CT=2 ROTATIONAL\n");
}

// --- compiled routines ------------------------------------------------------------------------------
class UserRoutines : public Cases {
 protected:
  RunResult with(const std::string& lines, std::optional<double> value) const {
    write("model.adm", oscillator + lines + "END\n");
    SessionOptions options;
    options.file = (folder_ / "model.adm").string();
    options.commands = {"SIMULATE/STATIC", "LINEAR/EIGENSOL"};
    options.json = (folder_ / "results.json").string();
    options.user_value = value;
    std::ostringstream out, err;
    RunResult r;
    r.status = run_session(options, out, err);
    r.err = err.str();
    if (std::filesystem::exists(options.json)) r.json = nlohmann::json::parse(read_file(options.json));
    return r;
  }
};

TEST_F(UserRoutines, are_errors_that_name_the_way_around_them) {
  const RunResult r = with("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=USER(1,2)\\ROUTINE=a::b\n", {});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("model.adm:10:58: error: SFORCE/1 calls a compiled routine"));
  EXPECT_THAT(r.err, HasSubstr("--user-value X"));
  EXPECT_THAT(with("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=3, ROUTINE=a::b\n", {}).err,
              HasSubstr("[missing-routine]"));
}

TEST_F(UserRoutines, give_way_to_a_constant_with_a_warning_for_each) {
  // The force of 8 along z stretches the spring by 8/400; a cubic one beside it shows by how much.
  const std::string cubic = "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-1E6*DZ(20,1)**3\n";
  const std::string single = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=USER(1,2), ROUTINE=a::b\n";
  const std::string vector = "MARKER/9, PART=1, FLOATING\nVFORCE/1, I=20, JFLOAT=9, RM=1, FUNCTION=USER(1)\n";
  const std::string general = "MARKER/9, PART=1, FLOATING\nGFORCE/1, I=20, JFLOAT=9, RM=1, FUNCTION=USER(1)\n";
  const std::string field = "FIELD/1, I=20, J=1, FUNCTION=USER(1)\n";
  // 400 z + 1e6 z³ = 16 at z = 0.02.
  const double stiffness = 400 + 3e6 * 0.02 * 0.02;
  for (const std::string& lines : {single, vector, general, field}) {
    const RunResult r = with(cubic + lines, 16.0);
    ASSERT_EQ(r.status, 0) << lines << r.err;
    EXPECT_THAT(r.err, HasSubstr("the constant 16 takes its place"));
    EXPECT_THAT(r.err, HasSubstr("[missing-routine]"));
    expect_eigenvalues(r.eigenvalues(1), {{0, std::sqrt(stiffness) / (2 * std::numbers::pi)}}, 1e-11);
  }
  const RunResult two = with(cubic + single + "VARIABLE/1, FUNCTION=USER(3)\n", -16.0);
  ASSERT_EQ(two.status, 0) << two.err;
  EXPECT_THAT(two.err, HasSubstr("VARIABLE/1 calls a compiled routine"));
  EXPECT_THAT(two.err, HasSubstr("SFORCE/1 calls a compiled routine"));
}

// What is wrong beside the constant points into a text that nobody has written.
TEST_F(UserRoutines, whose_statements_are_wrong_besides_are_errors_at_their_places) {
  const RunResult twice = with(
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=USER(1)\\FUNCTION=2\nMARKER/9, FLOATING\n"
      "GFORCE/1, I=20, JFLOAT=9, RM=1, FUNCTION=USER(1)\\FX=1\n",
      16.0);
  EXPECT_EQ(twice.status, 1);
  EXPECT_THAT(twice.err, HasSubstr("of SFORCE/1 is given twice"));
  EXPECT_THAT(twice.err, HasSubstr("FX of GFORCE/1 is given twice"));
  EXPECT_THAT(twice.err, HasSubstr("--user-value of "));
  const RunResult one = with("MARKER/9, FLOATING, PART=1\nGFORCE/1, I=20, JFLOAT=9, RM=1, FX=USER(1)\\FY=0\n", 16.0);
  EXPECT_EQ(one.status, 1);
  EXPECT_THAT(one.err, HasSubstr("a routine is called by the FUNCTION of GFORCE/1, and gives all of its values"));
  for (const double value : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const RunResult r = with("VARIABLE/1, FUNCTION=USER(3)\n", value);
    EXPECT_EQ(r.status, 1);
    EXPECT_THAT(r.err, HasSubstr("cannot take the place of compiled routines: it is no finite number"));
  }
}

TEST_F(UserRoutines, of_sensors_give_way_too) {
  const std::string sensor = "SENSOR/1, FUNCTION=USER(1), VALUE=1, HALT, ERROR=0.1, ROUTINE=a::b\n";
  EXPECT_EQ(with(sensor, {}).status, 1);
  const RunResult r = with(sensor, 2.0);
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("SENSOR/1 calls a compiled routine: the constant 2 takes its place"));
}

TEST_F(UserRoutines, that_no_constant_can_replace_stay_errors) {
  const RunResult r = with("NFORCE/1, IMARKERS=20, J=1, FUNCTION=USER(1)\n", 0.0);
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("no constant can take its place"));
}

// --- MOTION and VARVAL --------------------------------------------------------------------------------
class MotionOfVariables : public Cases {
 protected:
  // A slider on an arm that is driven: its frequency tells the rate of the arm, (100 − Ω²)/4π².
  RunResult with(const std::string& function, const std::string& variables) const {
    return run(
        "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\n"
        "MARKER/4, REULER=90D,90D,0\nPART/3, MASS=2, CM=3, IP=1,1,1\nMARKER/3, REULER=90D,90D,0\n"
        "JOINT/1, REVOLUTE, I=2, J=1\nMOTION/1, JOINT=1, FUNCTION=" +
            function + "\nJOINT/2, TRANSLATIONAL, I=3, J=4\nBUSHING/1, I=3, J=4, K=0,0,200\n" + variables + "END\n",
        "LINEAR/EIGENSOL, RM=2\n");
  }
};

TEST_F(MotionOfVariables, follows_variables_that_depend_on_time_alone) {
  const double wanted = std::sqrt(100.0 - 36.0) / (2 * std::numbers::pi);
  const std::array cases = {
      std::pair("VARVAL(1)", "VARIABLE/1, FUNCTION=6*TIME\n"),
      std::pair("2*VARVAL(1)+VARVAL(1)", "VARIABLE/1, FUNCTION=VARVAL(2)/2\nVARIABLE/2, FUNCTION=4*TIME\n"),
      std::pair("IF(VARVAL(3):9*TIME,VARVAL(1),7)",
                "VARIABLE/1, FUNCTION=IF(TIME-1:6*TIME,1,2)\nVARIABLE/3, FUNCTION=0\n"),
      std::pair("3*VARVAL(1)", "VARIABLE/1, FUNCTION=CUBSPL(TIME,0,1)\nSPLINE/1, X=-2,-1,0,1,2, Y=-4,-2,0,2,4\n"),
      std::pair("VARVAL(1)",
                "VARIABLE/1, FUNCTION=6*TIME*VARVAL(2)*VARVAL(2)\nVARIABLE/2, FUNCTION=VARVAL(3)-VARVAL(3)*"
                "VARVAL(4)\nVARIABLE/3, FUNCTION=1\nVARIABLE/4, FUNCTION=TIME**2\n"),
      std::pair("ARYVAL(1,2)*TIME*ARYVAL(1,3)", "ARRAY/1, IC, NUMBERS=7,3,2\n"),
      std::pair("ARYVAL(2,1)*POUVAL(1,2)",
                "ARRAY/2, U, VARIABLES=2\nVARIABLE/1, FUNCTION=SIN(2*TIME)\nVARIABLE/2, FUNCTION=3\nPOUTPUT/1, "
                "VARIABLES=2,1\n"),
      std::pair("VARVAL(1)*VARVAL(2)", "VARIABLE/1, FUNCTION=SIN(2*TIME)\nVARIABLE/2, FUNCTION=3\n")};
  for (const auto& [function, variables] : cases) {
    const RunResult r = with(function, variables);
    ASSERT_EQ(r.status, 0) << function << r.err;
    expect_eigenvalues(r.eigenvalues(0), {{0, wanted}}, 1e-12);
  }
}

TEST_F(MotionOfVariables, that_depend_on_the_state_or_on_themselves_are_errors) {
  EXPECT_THAT(with("VARVAL(1)", "VARIABLE/1, FUNCTION=VARVAL(2)\nVARIABLE/2, FUNCTION=DX(3)\n").err,
              HasSubstr("DX(3), it may depend on TIME only [function-of-state]"));
  EXPECT_THAT(with("VARVAL(1)", "VARIABLE/1, FUNCTION=VARVAL(2)\nVARIABLE/2, FUNCTION=VARVAL(1)\n").err,
              HasSubstr("[function-of-state]"));
  EXPECT_THAT(with("VARVAL(1)", "VARIABLE/1, FUNCTION=VARVAL(1)*VARVAL(1)\n").err, HasSubstr("depends on itself"));
  EXPECT_THAT(with("ARYVAL(1,1)", "ARRAY/1, U, VARIABLES=1\nVARIABLE/1, FUNCTION=DX(3)\n").err,
              HasSubstr("DX(3), it may depend on TIME only"));
  EXPECT_THAT(with("ARYVAL(1,1)",
                   "ARRAY/1, X\nARRAY/2, U, VARIABLES=1\nVARIABLE/1, FUNCTION=0\nMATRIX/1, FULL, "
                   "CORDER, ROWS=1, COLUMNS=1, VALUES=-1\nLSE/1, X=1, A=1\n")
                  .err,
              HasSubstr("ARYVAL(1,1), it may depend on TIME only"));
}

TEST_F(MotionOfVariables, a_plant_input_that_a_motion_follows_is_named) {
  write("model.adm", "");
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\nJOINT/1, REVOLUTE, "
          "I=2, "
          "J=1\nMOTION/1, JOINT=1, FUNCTION=VARVAL(1)\nVARIABLE/1, FUNCTION=0\nPINPUT/1, VARIABLES=1\nDIFF/1, "
          "FUNCTION=-DIF(1)+VARVAL(1)\nEND\n",
          "LINEAR/STATEMAT, PINPUT=1, FILE=a\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("VARIABLE/1 is a plant input, and MOTION/1 follows its course in time"));
}

// --- CURVE of low order -------------------------------------------------------------------------------
TEST_F(DatasetGrammar, a_curve_of_order_2_is_the_polygon) {
  // A bead on the second piece of a polygon, which rises by 3 in 4, held by a spring along x: k cos² along the piece.
  const auto bead = [&](double x) {
    return "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, QG=" + std::to_string(x) +
           ",0,0, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/9, PART=1, FLOATING\nMARKER/5, PART=1, QP=" +
           std::to_string(x) +
           ",0,0\nJPRIM/1, ORIENTATION, I=20, J=1\nMATRIX/1, FULL RORDER, ROWS=4, COLUMNS=3, "
           "VALUES=0,0,0,4,0,0,8,3,0,12,3,0\nCURVE/1, OPEN, MATRIX=1, ORDER=2\nPTCV/1, I=20, JFLOAT=9, CURVE=1, "
           "RM=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=6, FUNCTION=-100*DX(20,5)\nMARKER/6, PART=1, "
           "REULER=90D,90D,0\nEND\n";
  };
  const RunResult r = run(bead(6), "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("[rough-curve]"));
  expect_eigenvalues(r.eigenvalues(1), {{0, 10 * 0.8 / (2 * std::numbers::pi)}}, 1e-11);
}

// --- ORIENT -----------------------------------------------------------------------------------------------
using Rotation = std::array<std::array<double, 3>, 3>;
Rotation about(int axis, double angle) {
  const auto a = static_cast<std::size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
  Rotation R{};
  R[a][a] = 1, R[b][b] = R[c][c] = std::cos(angle), R[c][b] = std::sin(angle), R[b][c] = -std::sin(angle);
  return R;
}
Rotation times(const Rotation& A, const Rotation& B) {
  Rotation C{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) C[i][j] += A[i][k] * B[k][j];
    }
  }
  return C;
}
void expect_equal(const Rotation& A, const Rotation& B, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(A[i][j], B[i][j], 1e-14) << what << " " << i << j;
  }
}

TEST(Orient, angles_of_every_sequence_give_the_rotation_back) {
  constexpr std::array<std::array<int, 3>, 12> sequences = {{{0, 1, 2},
                                                             {1, 2, 0},
                                                             {2, 0, 1},
                                                             {0, 2, 1},
                                                             {1, 0, 2},
                                                             {2, 1, 0},
                                                             {0, 1, 0},
                                                             {0, 2, 0},
                                                             {1, 0, 1},
                                                             {1, 2, 1},
                                                             {2, 0, 2},
                                                             {2, 1, 2}}};
  std::string lines;
  for (int s = 0; s < 12; ++s) {
    for (int k = 1; k <= 3; ++k)
      lines += fmt::format("VARIABLE/{}, FUNCTION=ORIENT({},{},20,11)\n", 10 * (s + 1) + k, s + 1, k);
  }
  for (int k = 1; k <= 4; ++k) lines += fmt::format("VARIABLE/{}, FUNCTION=ORIENT(27,{},20,11)\n", 270 + k, k);
  const auto study = study_of(
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/11, PART=1, REULER=0.3,0.7,-1.1\nPART/2, MASS=1, CM=20, "
      "IP=1,1,1, REULER=0.9,1.3,-0.4\nMARKER/20\nMARKER/2\nJOINT/1, SPHERICAL, I=20, J=1\n" +
      lines + "END\n");
  const auto m = study.initial_conditions();
  const auto euler = [](double a, double b, double c) { return times(times(about(2, a), about(0, b)), about(2, c)); };
  Rotation J = euler(0.3, 0.7, -1.1), transposed{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) transposed[i][j] = J[j][i];
  }
  const Rotation wanted = times(transposed, euler(0.9, 1.3, -0.4));
  for (std::size_t s = 0; s < 12; ++s) {
    const auto angle = [&](int k) { return m.variable(static_cast<std::int64_t>(10 * (s + 1)) + k); };
    expect_equal(times(times(about(sequences[s][0], angle(1)), about(sequences[s][1], angle(2))),
                       about(sequences[s][2], angle(3))),
                 wanted, fmt::format("system {}", s + 1));
  }
  const double e0 = m.variable(271), e1 = m.variable(272), e2 = m.variable(273), e3 = m.variable(274);
  expect_equal({{{e0 * e0 + e1 * e1 - e2 * e2 - e3 * e3, 2 * (e1 * e2 - e0 * e3), 2 * (e1 * e3 + e0 * e2)},
                 {2 * (e1 * e2 + e0 * e3), e0 * e0 - e1 * e1 + e2 * e2 - e3 * e3, 2 * (e2 * e3 - e0 * e1)},
                 {2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), e0 * e0 - e1 * e1 - e2 * e2 + e3 * e3}}},
               wanted, "Euler parameters");
  EXPECT_GT(e0, 0);
}

TEST(Orient, refuses_systems_that_are_not_known_and_components_that_are_not_there) {
  const auto error = [](const std::string& function) -> std::string {
    try {
      study_of("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nVARIABLE/1, FUNCTION=" + function + "\nEND\n");
    } catch (const Error& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_THAT(error("ORIENT(13,1,1)"), HasSubstr("[function-not-built]"));
  EXPECT_THAT(error("ORIENT(1,4,1)"), HasSubstr("[argument-range]"));
  EXPECT_THAT(error("ORIENT(27,5,1)"), HasSubstr("[argument-range]"));
  EXPECT_THAT(error("ORIENT(30,1,1)"), HasSubstr("[argument-range]"));
  EXPECT_THAT(error("ORIENT(1,1,77)"), HasSubstr("[unknown-marker]"));
  EXPECT_THAT(error("ORIENT(1,1)"), HasSubstr("[wrong-argument-count]"));
}

}  // namespace
}  // namespace dynalin::cases::dataset_grammar_test
