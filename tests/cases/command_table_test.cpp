// Every command of the language with every argument: it acts, which shows, or it is named as having no effect, or it is
// refused. Nothing is swallowed in silence.
#include <gmock/gmock.h>

#include <algorithm>

#include "cases/run.h"
#include "command/command_catalogue.h"
#include "elements/catalogue.h"

namespace dynalin::cases::command_table_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

// The command set of the solver, and its two shorthands.
const std::vector<std::string> language = {
    "ACCGRAV",  "ACTIVATE",    "ARRAY",        "BEAM",        "BUSHING", "CONTROL", "COUPLER",    "DEACTIVATE",
    "DEBUG",    "DIFF",        "ENVIRONMENT",  "EQUILIBRIUM", "FIELD",   "FILE",    "FLEX_BODY",  "FRICTION",
    "GCON",     "GEAR",        "GFORCE",       "HELP",        "IC",      "INFO",    "INTEGRATOR", "JOINT",
    "JPRIM",    "KINEMATICS",  "LINEAR",       "LSOLVER",     "MARKER",  "MENU",    "MOTION",     "OUTPUT",
    "PART",     "PREFERENCES", "RELOAD",       "REQUEST",     "SAVE",    "SENSOR",  "SFORCE",     "SHOW",
    "SIMULATE", "SPLINE",      "SPRINGDAMPER", "STOP",        "STRING",  "TIME",    "VARIABLE",   "VFORCE",
    "VTORQUE",  "GSTIFF",      "WSTIFF"};

const std::string model =
    "table\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\n"
    "MARKER/20\nMARKER/21, PART=2, QP=0,0,1\nMARKER/3, PART=1, QP=0,0,-2\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=21, J=3, K=800, C=3, LENGTH=3\nVARIABLE/1, FUNCTION=DZ(20,1)\n"
    "SENSOR/1, FUNCTION=DZ(20,1), VALUE=9, GE, ERROR=1, HALT\nREQUEST/1, DISPLACEMENT, I=20, J=1\n"
    "STRING/1, STRING=gains\nEND\n";

class CommandTable : public Cases {
 protected:
  // What a run says besides the echo of its command and the time that it took.
  std::string said(const RunResult& r, const std::string& command) const {
    std::string text = r.out + r.err + r.message;
    for (auto at = text.find(command); at != std::string::npos; at = text.find(command)) text.erase(at, command.size());
    std::istringstream in(text);
    std::string kept;
    for (std::string line; std::getline(in, line);) {
      if (line.find("Elapsed") == std::string::npos && line.find("CPU") == std::string::npos &&
          line.find("command:") == std::string::npos)
        kept += line + "\n";
    }
    return kept;
  }
};

TEST_F(CommandTable, has_every_command_of_the_language) {
  for (const std::string& name : language) EXPECT_TRUE(find_command(name)) << name;
}

// A setting says of each of its arguments that it acts, or names it when it is used.
TEST_F(CommandTable, names_each_argument_of_a_setting_that_does_not_act) {
  for (const CommandKind& kind : command_catalogue()) {
    if (kind.use != CommandUse::setting) continue;
    for (const ArgumentInfo& a : kind.arguments) {
      if (std::ranges::find(kind.acting, a.name) != kind.acting.end()) continue;
      std::string written;
      RunResult r;
      for (const char* value : {"=1", "", "=ON", "=T:F", "=1,2", "=abc"}) {
        written = std::string(kind.name) + (kind.name == "REQUEST" ? "/1, " : "/") + std::string(a.name) + value;
        r = run(model, written + "\n");
        if (r.status == 0) break;
      }
      EXPECT_EQ(r.status, 0) << written << r.err;
      EXPECT_THAT(r.err, HasSubstr("which is passed over")) << written;
      EXPECT_THAT(r.err, AnyOf(HasSubstr("/" + std::string(a.name)), HasSubstr("REQUEST"))) << written;
    }
  }
}

TEST_F(CommandTable, refuses_what_no_command_takes) {
  for (const CommandKind& kind : command_catalogue()) {
    if (kind.name == "STOP") continue;  // nothing behind it is read, on its line neither
    const std::string written = std::string(kind.name) + "/1, QQQQ=1";
    const RunResult r = run(model, written + "\nSIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 1) << written << r.err;
  }
}

TEST_F(CommandTable, refuses_commands_by_name_and_reason) {
  const RunResult control = run(model, "CONTROL/FUNCTION=USER(1)\n");
  EXPECT_EQ(control.status, 1);
  EXPECT_THAT(control.err, HasSubstr("model.acf:3:1: error: CONTROL is refused: a compiled routine"));
  EXPECT_THAT(run(model, "SYSTEM\n").err, HasSubstr("SYSTEM is refused: a command file runs no programs"));
  for (const char* missing : {"FLEX_BODY/1, DAMPING=1", "FRICTION/1, MU=3", "SENSOR/9, VALUE=1"})
    EXPECT_EQ(run(model, std::string(missing) + "\n").status, 1) << missing;
}

struct Row {
  std::string command, shows;  // in what is printed, in the message file or in a remark
};

TEST_F(CommandTable, commands_act_or_are_named) {
  const std::vector<Row> rows = {
      {"ACCGRAV/KGRAV=-3", "ACCGRAV"},
      {"DEACTIVATE/SPRINGDAMPER, ID=1",
       "   Deactivated SPRINGDAMPER/1, force/torque values will be zero in function-expression references."},
      {"DEACTIVATE/SENSOR, ID=1", "   Deactivated SENSOR/1."},
      {"DEACTIVATE/REQUEST, ID=1", "   Deactivated REQUEST/1."},
      {"ACTIVATE/SENSOR, ID=1", "is active already"},
      {"DEBUG/LIST", "   EPRINT   = NOEPRINT"},
      {"DEBUG/EPRINT, LIST", "   EPRINT   = EPRINT"},
      {"EQUILIBRIUM/ALIMIT=0.5D, ERROR=0.5, MAXIT=20, LIST",
       "Current EQUILIBRIUM settings are:\n   ALIMIT    = 0.008727 (rad)\n   ERROR     = 0.500000\n   IMBALANCE = "
       "0.000100\n   MAXIT     = 20\n"},
      // A limit of zero is none.
      {"EQUILIBRIUM/ALIMIT=0, TLIMIT=0, LIST", "settings are:\n   ALIMIT    = 0.174533 (rad)\n"},
      {"EQUILIBRIUM/TLIMIT=0, LIST", "   TLIMIT    = none\n"},
      {"IC/ALIMIT=0, TLIMIT=0, LIST", "settings are:\n   ALIMIT   = 0.500000 (rad)\n"},
      {"IC/TLIMIT=0, LIST", "   TLIMIT   = none\n"},
      {"KINEMATICS/ALIMIT=0, TLIMIT=0, LIST", "ALIMIT   = 0.523599 (rad)\n"},
      {"EQUILIBRIUM/STABILITY=1E-3, LIST",
       "   MAXIT     = 25\n   PATTERN   = TTTTTTTTTT\n   STABILITY = 0.001000\n   "
       "TLIMIT    = 20.000000\n   METHOD    = ORIGINAL\n"},
      {"EQUILIBRIUM/METHOD=ORIGINAL, MAXIT=7, LIST",
       "   MAXIT     = 7\n   PATTERN   = TTTTTTTTTT\n   STABILITY =    1.000000e-05\n   TLIMIT    = 20.000000\n   "
       "METHOD    = ORIGINAL\n"},
      {"EQUILIBRIUM/METHOD=ADVANCED, STABILITY=1E-3, LIST",
       "   MAXIT     = 500\n   PATTERN   = none\n   STABILITY = without effect\n   TLIMIT    = none\n   METHOD    = "
       "ADVANCED\n"},
      {"EQUILIBRIUM/DYNAMIC, GLOBAL_DAMPING=3, LIST",
       "   GLOBAL_DAMPING       = 3.000000\n   ACCELERATION_ERROR   = "
       "0.010000\n   KINETIC_ENERGY_ERROR = 0.010000\n   "
       "SETTLING_TIME        = none\n"},
      {"EQUILIBRIUM/DYNAMIC, METHOD=ORIGINAL, LIST", "   METHOD               = DYNAMIC\n"},
      {"INTEGRATOR/INTERPOLATE=ON, LIST", "   HMAX        = none\n"},
      {"IC/ERROR=1E-6, LIST", "   VERROR   =    1.000000e-04\n   AERROR   =    1.000000e-04\n"},
      {"INTEGRATOR/HHT, I3, ERROR=1E-5, LIST",
       "Current INTEGRATOR settings are:\n   TYPE        = HHT\n   FORMULATION = I3\n   CORRECTOR   = without effect\n "
       "  "
       "ERROR       =    1.000000e-05\n"},
      {"WSTIFF/HMAX=0.1, LIST", "   TYPE        = WSTIFF"},
      {"GSTIFF/ERROR=1E-4", "GSTIFF"},
      {"IC/ERROR=1E-8, LIST", "   ERROR    =    1.000000e-08"},
      {"KINEMATICS/LIST", "Current KINEMATICS settings are:"},
      {"LSOLVER/UMF, LIST", "   TYPE      = UMF"},
      {"OUTPUT/LIST", "Current OUTPUT settings are:\n   request file  = NOREQSAVE\n   graphics file = NOGRSAVE\n"},
      {"OUTPUT/REQSAVE, DSCALE=2, 3, DEFAULT, LIST", "   request file  = REQSAVE\n"},
      {"OUTPUT/NOREQSAVE, FIXED, YPR, LIST",
       "   request file  = NOREQSAVE\n   graphics file = NOGRSAVE\n   tables        = PRINT where an OUTPUT asks for "
       "anything\n   FIXED         = ON\n   angles        = YPR\n"},
      {"PREFERENCES/SIMEXIT=ON, LIST", "   SIMEXIT                    = ON"},
      {"MARKER/21, LIST", "Current MARKER/21 data are:\n   PART = 2\n   QP   = 0,0,1\n"},
      {"SPRINGDAMPER/1, K=900, LIST", "   K             = 900"},
      {"ACCGRAV/LIST", "   KGRAV = -9.81"},
      {"INFO/DISPLACEMENT, I=20, J=3, RM=1", "    Z     =   2.0000000E+00"},
      {"INFO/DISPLACEMENT, I=0, J=3", "    Z     =   2.0000000E+00"},
      {"INFO/FORCE, I=21, J=3", "    FZ    = "},
      {"SHOW STATISTICS=SIMULATION", "          Simulation Statistics\n          ========== =========="},
      {"sho stat=sim", "Simulations over time"},
      {"TIME", "  The present time is 0.000000000E+00"},
      {"HELP", "HELP is for a session at a prompt"},
      {"MENU", "MENU is for a session at a prompt"},
      {"STRING/1, LIST", "Current STRING/1 data are:\n   STRING = gains"},
      {"ENVIRONMENT/NAME=NOTHING, VALUE=1", "the environment variable NOTHING means nothing here"},
      {"SAVE/STATES, FILE=a.save", "  Saved the states at time"},
  };
  for (const Row& row : rows) {
    const RunResult r = run(model, row.command + "\n");
    EXPECT_EQ(r.status, 0) << row.command << r.err;
    EXPECT_THAT(r.message + r.err, HasSubstr(row.shows)) << row.command;
    ASSERT_EQ(r.json.at("results").size(), 1u) << row.command;
  }
}

TEST_F(CommandTable, what_is_printed_is_in_the_json_file_too) {
  const RunResult r = run(model, "TIME\nMARKER/21, LIST\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.result(0).at("text").get<std::string>(), HasSubstr("present time"));
  EXPECT_THAT(r.result(1).at("text").get<std::string>(), HasSubstr("QP   = 0,0,1"));
}

TEST_F(CommandTable, the_list_of_an_edited_statement_is_what_holds_now) {
  const RunResult r =
      run(model, "MARKER/21, QP=0,&\n ! up\n 0,2\nDEACTIVATE/SENSOR, ID=1\nMARKER/21, LIST\nSENSOR/1, LIST\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.message, HasSubstr("   QP   = 0, 0,2\n"));
  EXPECT_THAT(r.message, HasSubstr("   it is not active\n"));
  EXPECT_EQ(run(model, "MARKER/99, LIST\n").status, 1);
}

// 2 on a spring of 800 under gravity: INFO measures what the point has.
TEST_F(CommandTable, info_measures_the_point) {
  const RunResult r =
      run(model,
          "SIMULATE/STATICS\nINFO/DISPL, I=20, J=1\nINFO/FORCE, I=21, J=3\nINFO/VEL, I=20\nINFO/ACC, I=20, "
          "J=1, RM=1\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.result(1).at("text").get<std::string>(), HasSubstr("Z     =  -2.4525000E-02"));
  EXPECT_THAT(r.result(2).at("text").get<std::string>(), HasSubstr("FZ    =   1.9620000E+01"));
  EXPECT_THAT(r.result(3).at("text").get<std::string>(), HasSubstr("VZ    =   0.0000000E+00"));
  EXPECT_EQ(run(model, "INFO/FORCE, I=99\n").status, 1);
  EXPECT_EQ(run(model, "INFO/FORCE, VELOCITY, I=20\n").status, 1);
}

TEST_F(CommandTable, iterations_are_in_the_message_file_on_request) {
  const RunResult with = run(model, "DEBUG/EPRINT\nSIMULATE/STATICS\n"), without = run(model, "SIMULATE/STATICS\n");
  EXPECT_THAT(with.message, HasSubstr("  Iteration   Imbalance\n"));
  EXPECT_THAT(without.message, Not(HasSubstr("  Iteration   Imbalance\n")));
  // In a dataset as well, until a command ends it.
  std::string stated = model;
  stated.replace(stated.rfind("END\n"), 4, "DEBUG/EPRINT\nEND\n");
  EXPECT_THAT(run(stated, "SIMULATE/STATICS\n").message, HasSubstr("  Iteration   Imbalance\n"));
  EXPECT_THAT(run(stated, "DEBUG/NOEPRINT\nSIMULATE/STATICS\n").message, Not(HasSubstr("  Iteration   Imbalance\n")));
}

TEST_F(CommandTable, shorthands_set_what_integrator_sets) {
  const RunResult r = run(model, "WST/HMAX=0.25\nINTEGRATOR/LIST\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.message, HasSubstr("   TYPE        = WSTIFF"));
  EXPECT_THAT(r.message, HasSubstr("   HMAX        =    2.500000e-01"));
}

}  // namespace
}  // namespace dynalin::cases::command_table_test
