// What a run remarks: each with its code, and where a statement is meant with its place; in JSON as on the terminal.
#include <gmock/gmock.h>

#include <set>

#include "cases/run.h"

namespace dynalin::cases::remark_test {
namespace {

using ::testing::HasSubstr;

struct Remark {
  const char* code;
  int line;  // of model.adm, 0 where no statement is meant
  const char* dataset;
  const char* commands;
};

// A slider along z: PART/2 with MARKER/20.
#define SLIDER(mass)                                             \
  "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, " mass \
  "QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
#define BODY "MASS=1, CM=20, IP=1,1,1, "

const std::vector<Remark>& table() {
  static const std::vector<Remark> rows = {
      {"accelerating-point", 5, SLIDER(BODY) "ACCGRAV/KGRAV=-10\nEND\n", "LINEAR/EIGENSOL\n"},
      {"moving-reference", 6,
       "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, WZ=3\nMARKER/20\n"
       "JOINT/1, REVOLUTE, I=20, J=1\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=1,0,0, WZ=3, VY=3\nMARKER/30\n"
       "MARKER/21, PART=2, QP=1,0,0\nBUSHING/1, I=30, J=21, K=9,9,9, KT=9,9,9\nEND\n",
       "LINEAR/EIGENSOL, RM=20\n"},
      {"amplified-velocity", 5,
       "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0.4,4E-6,0, "
       "REULER=1E-5,0,0, "
       "VX=1\nMARKER/20\nMARKER/21, QP=-.4,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nEND\n",
       "SIMULATE/INITIAL_CONDITIONS\n"},
      {"changed-velocity", 5, SLIDER("VX=1, " BODY) "END\n", "LINEAR/EIGENSOL\n"},
      {"changed-position", 5,
       SLIDER(BODY "EXACT=Z, ") "GCON/1, FUNCTION=DZ(20)-2\nMARKER/21, PART=2\nPART/3, MASS=1, CM=30, IP=1,1,1\n"
                                "MARKER/30\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"drawn-open", 8,
       SLIDER(BODY) "JPRIM/1, ATPOINT, I=20, J=2\nMARKER/2, PART=1, QP=0,0,2\nPART/3, MASS=1, CM=30, "
                    "IP=1,1,1\nMARKER/30\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"changed-start", 9,
       SLIDER(BODY) "DIFF/1, IMPLICIT, IC=0.3, FUNCTION=DIF1(1)+DIF1(2)+2*DIF(1)\nDIFF/2, IMPLICIT, IC=3, "
                    "FUNCTION=2*DIF1(1)+2*DIF1(2)+DIF(1)-2*DIF(2)\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"change-point", 17,
       "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=2,0,0\n"
       "PART/2, MASS=1, CM=20, IP=1,1,1, WZ=1\nMARKER/20\nMARKER/21, QP=1,0,0\n"
       "PART/3, MASS=1, CM=30, IP=1,1,1, QG=2,0,0, WZ=1\nMARKER/30\nMARKER/31, QP=1,0,0\n"
       "PART/4, MASS=1, CM=40, IP=1,1,1, QG=1,0,0, VY=1\nMARKER/40\nMARKER/41, QP=2,0,0\n"
       "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=2\nJOINT/3, REVOLUTE, I=40, J=21\n"
       "JOINT/4, REVOLUTE, I=41, J=31\nEND\n",
       "SIMULATE/DYNAMICS, END=1E-3, STEPS=1\n"},
      {"rounded-matrix", 0,
       "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=0.3, 0.7, 0.2\nPART/2, MASS=1, CM=20, IP=1, 1, 1E-9\n"
       "MARKER/20, REULER=0.3, 0.7, 0.2\nJOINT/1, REVOLUTE, I=20, J=1\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, "
       "KT=1\nEND\n",
       "LINEAR/STATEMAT, FILE=m\n"},
      {"rest-by-rolling", 8, SLIDER(BODY) "GCON/1, FUNCTION=VZ(20)\nEND\n", "SIMULATE/STATICS\n"},
      {"joint-in-stiction", 8, SLIDER(BODY) "FRICTION/1, JOINT=1, FRICTION_FORCE_PRELOAD=3\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"kink", 8, SLIDER(BODY) "SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=-ABS(DZ(20)-1)\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"implicit-diff", 8, SLIDER(BODY) "DIFF/1, IMPLICIT, FUNCTION=2*DIF(1)-DIF(2)\nDIFF/2, FUNCTION=-DIF(2)\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"dependent-coordinate", 0, SLIDER(BODY) "VARIABLE/1, FUNCTION=DX(20)\nPSTATE/1, VARIABLES=1\nEND\n",
       "LINEAR/EIGENSOL, PSTATE=1\n"},
      {"dependent-input", 8, SLIDER(BODY) "VARIABLE/1, FUNCTION=2\nPINPUT/1, VARIABLES=1\nEND\n",
       "LINEAR/STATEMAT, PINPUT=1, FILE=a\n"},
      {"followed-input", 9,
       SLIDER(BODY) "MOTION/1, JOINT=1, FUNCTION=VARVAL(1)\nVARIABLE/1, FUNCTION=0\nPINPUT/1, VARIABLES=1\nDIFF/1, "
                    "FUNCTION=-DIF(1)\nEND\n",
       "LINEAR/STATEMAT, PINPUT=1, FILE=a\n"},
      {"rate-of-input", 8,
       SLIDER(BODY) "VARIABLE/1, FUNCTION=0\nPINPUT/1, VARIABLES=1\nDIFF/1, FUNCTION=-DIF(1)+DELAY(VARVAL(1),0.1,0)\n"
                    "END\n",
       "LINEAR/STATEMAT, PINPUT=1, FILE=a\n"},
      {"distant-origin", 5,
       "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, QG=0,0,1e6, MASS=1, CM=20, IP=1,1,1\nMARKER/20, "
       "QP=0,0,-1e6\nMARKER/22, QP=0,0,-999999\nJOINT/1, TRANSLATIONAL, I=20, J=1\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"empty-constraint", 8, SLIDER(BODY) "GCON/1, FUNCTION=DX(20)**2\nEND\n", "LINEAR/EIGENSOL\n"},
      {"environment-variable", 0, SLIDER(BODY) "END\n", "ENVIRONMENT/NAME=NOTHING, VALUE=1\nLINEAR/EIGENSOL\n"},
      {"fortran-solver", 0, SLIDER(BODY) "PREFERENCES/SOLVER=F77\nEND\n", "LINEAR/EIGENSOL\n"},
      {"massless-freedom", 0, SLIDER("") "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=2, C=1, LENGTH=1\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"massless-runaway", 0, SLIDER("") "SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=VZ(20)-(DZ(20)-1)\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"missing-mode", 0, SLIDER(BODY) "END\n", "LINEAR/EIGENSOL, COORDS=7\n"},
      {"no-commands", 0, SLIDER(BODY) "END\n", ""},
      {"no-units", 0, "t\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"not-in-request-file", 0, SLIDER(BODY) "OUTPUT/REQSAVE\nREQUEST/1, F1=1\nEND\n", "LINEAR/EIGENSOL\n"},
      {"request-left-out", 8, SLIDER(BODY) "REQUEST/1, VELOCITY\nEND\n", "LINEAR/EIGENSOL\n"},
      {"stray-id", 8, SLIDER(BODY) "ACCGRAV/1, KGRAV=-1\nEND\n", "LINEAR/EIGENSOL\n"},
      {"undefined-request", 0, SLIDER(BODY) "REQUEST/1, F2=LOG(-1*DZ(20))\nEND\n", "LINEAR/EIGENSOL\n"},
      {"options-disagree", 0, SLIDER(BODY) "END\n", "LINEAR/EIGENSOL, RM=1, ORIGINAL\n"},
      {"overdamped-modes", 0, SLIDER(BODY) "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=1, C=9, LENGTH=1\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"no-freedom-in-dynamics", 0, SLIDER(BODY) "MOTION/1, JOINT=1, FUNCTION=1+TIME\nEND\n",
       "SIMULATE/DYNAMICS, END=0.1\n"},
      {"dense-events", 0,
       SLIDER(BODY) "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=IF(SIN(1E6*TIME): -1, 0, 1)\nEND\n",
       "SIMULATE/DYNAMICS, END=2E-3\n"},
      {"rounding-above-error", 0,
       SLIDER(
           BODY) "VARIABLE/1, FUNCTION=1E9+DIF(1)\nDIFF/1, IC=1, FUNCTION=1E9-VARVAL(1)\nINTEGRATOR/ERROR=1E-14\nEND\n",
       "SIMULATE/DYNAMICS, END=1E-2\n"},
      {"passed-over", 0, SLIDER(BODY) "INTEGRATOR/FIXIT=1\nEND\n", "LINEAR/EIGENSOL\n"},
      {"loose-equilibrium", 0,
       SLIDER(BODY) "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=EXP(-DZ(20))\nEQUILIBRIUM/ERROR=2\nEND\n",
       "SIMULATE/STATICS\n"},
      {"rounding-above-imbalance", 0,
       SLIDER(BODY) "ACCGRAV/KGRAV=-9.81\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=333, "
                    "LENGTH=1.1\nEQUILIBRIUM/IMBALANCE=0\nEND\n",
       "SIMULATE/STATICS\n"},
      {"singular-configuration", 16,
       "Four-bar\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=2,0,0\nPART/2, MASS=1, CM=20, "
       "IP=1,1,1\nMARKER/20\nMARKER/21, QP=1,0,0\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=1,0,0\nMARKER/30\nMARKER/31, "
       "QP=2,0,0\nPART/4, MASS=1, CM=40, IP=1,1,1, QG=2,0,0\nMARKER/40\nMARKER/41, QP=1,0,0\nJOINT/1, REVOLUTE, I=20, "
       "J=1\nJOINT/2, REVOLUTE, I=30, J=21\nJOINT/3, REVOLUTE, I=41, J=31\nJOINT/4, REVOLUTE, I=40, J=2\nEND\n",
       "LINEAR/EIGENSOL\n"},
  };
  return rows;
}

class Remarks : public Cases, public ::testing::WithParamInterface<std::size_t> {};

TEST_P(Remarks, have_a_code_and_a_place) {
  const Remark& remark = table()[GetParam()];
  const RunResult r = run(remark.dataset, remark.commands);
  ASSERT_TRUE(r.json.contains("warnings")) << r.err;
  EXPECT_THAT(r.err, HasSubstr(std::string("[") + remark.code + "]"));
  std::set<int> lines;
  for (const auto& w : r.json.at("warnings")) {
    EXPECT_THAT(r.err, HasSubstr(w.at("message").get<std::string>()));
    if (w.at("code") != remark.code) continue;
    const bool placed = !w.at("at").is_null();
    lines.insert(placed ? w.at("at").at("line").get<int>() : 0);
    if (!placed) continue;
    EXPECT_THAT(w.at("at").at("file").get<std::string>(), ::testing::EndsWith("model.adm"));
    EXPECT_EQ(w.at("at").at("column"), 1);
  }
  EXPECT_THAT(lines, ::testing::Contains(remark.line)) << r.err;
}
INSTANTIATE_TEST_SUITE_P(table, Remarks, ::testing::Range<std::size_t>(0, table().size()));

TEST_F(Cases, name_an_input_that_is_listed_twice_once) {
  const RunResult r =
      run(SLIDER(BODY) "VARIABLE/1, FUNCTION=2\nPINPUT/1, VARIABLES=1,1\nEND\n", "LINEAR/STATEMAT, PINPUT=1, FILE=a\n");
  const auto& said = r.json.at("warnings");
  EXPECT_EQ(std::ranges::count(said, "dependent-input", [](const auto& w) { return w.at("code"); }), 1) << r.err;
}

TEST(RemarkTable, has_every_code_but_those_that_other_tests_hold) {
  std::set<std::string> covered = {
      "lost-digits",            // initial_conditions_test
      "undetermined-reaction",  // friction_test
      "near-singular",          // near_singular_test
      "constraint-left-out",    // near_singular_test
      "export-differs",         // nastran/closed_box_test, open_box_test
      "export-left-out",
      "geometry-file",        // elements/graphics/graphics_test
      "geometry-format",      // the same
      "geometry-part",        // the same
      "undrawn-shape",        // the same
      "passed-singular",      // simulation/kinematics_limits_test
      "equilibrium-jump",     // simulation/quasi_statics_test
      "other-search",         // settings_test
      "incomplete-modes",     // no model is known that brings it about
      "saddle",               // routines/curve_routine_test
      "large-eigensolution",  // selected_modes_test
      "reloaded-in-part",     // save_reload_test
      "touching-contact",     // contact_test
      "jumping-contact",      // contact_flat_test
      "kink-of-routine",      // routines/user_routine_test
      "wrong-derivative",     // the same
      "far-bent-body",        // flex_body_test
      "fast-flexible-body",   // the same
  };
  for (const Remark& r : table()) covered.insert(r.code);
  static constexpr std::string_view codes[] = {
#define DYNALIN_DIAGNOSTIC(code, text, advice) code,
#include "base/diagnostics/remarks.def"
#undef DYNALIN_DIAGNOSTIC
  };
  for (const std::string_view code : codes) EXPECT_TRUE(covered.contains(std::string(code))) << code;
}

class JsonWarnings : public Cases {};

TEST_F(JsonWarnings, of_reading_have_code_place_and_hint_and_those_of_a_command_its_text) {
  const RunResult r = run(
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, "
      "I=20, J=1, MU_STAT_ROT=3\nEND\n",
      "LINEAR/EIGENSOL, COORDS=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto& read = r.json.at("warnings").at(0);
  EXPECT_EQ(read.at("code"), "obsolete-argument");
  EXPECT_EQ(read.at("at").at("line"), 7);
  EXPECT_EQ(read.at("at").at("column"), 31);
  EXPECT_EQ(read.at("hint"), "the statement FRICTION replaces it");
  EXPECT_TRUE(read.at("command").is_null());
  EXPECT_THAT(r.message, HasSubstr("model.adm:7:31: friction as an argument of JOINT/1"));
  const auto& of_command = r.json.at("warnings").back();
  EXPECT_EQ(of_command.at("code"), "missing-mode");
  EXPECT_EQ(of_command.at("command"), "LINEAR/EIGENSOL, COORDS=5");
  EXPECT_TRUE(of_command.at("at").is_null());
}

TEST_F(JsonWarnings, stand_beside_errors_and_the_status_of_a_run_that_fails) {
  const RunResult r =
      run("t\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=MILLISECONDS\n"
          "ACCGRAV/KGRAV=-1\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nEND\n",
          "SIMULATE/INITIAL\nSIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_EQ(r.json.at("status"), 2);
  ASSERT_EQ(r.json.at("errors").size(), 1u);
  EXPECT_EQ(r.json.at("errors").at(0).at("command"), "SIMULATE/STATICS");
  EXPECT_THAT(r.json.at("errors").at(0).at("message").get<std::string>(), HasSubstr("no equilibrium was found"));
  EXPECT_EQ(r.json.at("results").size(), 1u);
  const auto& units = r.json.at("units");
  EXPECT_EQ(units.at("length"), "MILLIMETER");
  EXPECT_EQ(units.at("frequency"), "cycles/ms");
  EXPECT_EQ(units.at("stated"), true);
}

}  // namespace
}  // namespace dynalin::cases::remark_test
