// What STATEMAT, MKB and EIGENSOL leave behind in the results file, the message file and the JSON.
#include <gmock/gmock.h>

#include <algorithm>

#include "cases/run.h"

namespace dynalin::cases::matrix_output_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string model =
    "oscillator\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
    "JOINT/1, TRANSLATIONAL, I=20, J=1\nBUSHING/1, I=20, J=1, K=0,0,8, C=0,0,6\nVARIABLE/1, FUNCTION=0\nVARIABLE/2, "
    "FUNCTION=3*DZ(20,1)\nVARIABLE/3, FUNCTION=DZ(20,1)\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, "
    "FUNCTION=4*VARVAL(1)\nDIFF/1, FUNCTION=-DIF(1)\nPINPUT/5, VARIABLES=1\nPOUTPUT/6, VARIABLES=2\nPSTATE/7, "
    "VARIABLES=3\nRESULTS/XRF\nEND\n";

class MatrixOutput : public Cases {};

TEST_F(MatrixOutput, results_file_has_the_second_order_matrices_with_options_and_channels) {
  const RunResult r = run(model, "LINEAR/MKB, PINPUT=5, POUTPUT=6, PSTATE=7, RM=1, NODAMPIN, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string res = r.text("model.res");
  EXPECT_THAT(res, HasSubstr("<dl:Linear option=\"MKB\" time=\"0\" rm=\"1\" pstate=\"7\" pinput=\"5\" poutput=\"6\" "
                             "damping=\"0\" original=\"0\">"));
  EXPECT_THAT(res, HasSubstr("<dl:Input id=\"1\" variable=\"1\" name=\"VARIABLE/1\" />"));
  EXPECT_THAT(res, HasSubstr("<dl:Output id=\"1\" variable=\"2\" name=\"VARIABLE/2\" />"));
  for (const char* name : {"M", "KB", "P", "C"})
    EXPECT_THAT(res, HasSubstr(std::string("<dl:Matrix name=\"") + name + "\""));
  EXPECT_THAT(res, HasSubstr("<dl:Matrix name=\"KB\" rows=\"2\" columns=\"4\" order=\"column\">"));
}

TEST_F(MatrixOutput, results_file_has_the_state_matrices_with_options_and_channels) {
  const RunResult r = run(model, "LINEAR/STATEMAT, PINPUT=5, POUTPUT=6, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string res = r.text("model.res");
  EXPECT_THAT(res,
              HasSubstr("<dl:Linear option=\"STATEMAT\" time=\"0\" rm=\"0\" pstate=\"0\" pinput=\"5\" poutput=\"6\""));
  EXPECT_THAT(res, HasSubstr("<dl:Inputs>"));
  EXPECT_THAT(run(model, "LINEAR/STATEMAT, FILE=m\n").text("model.res"), Not(HasSubstr("<dl:Inputs>")));
}

// NODAMPIN takes damping out of forces. An output sees velocities all the same, through other VARIABLEs too; one that
// is an input as well is independent of everything.
TEST_F(MatrixOutput, outputs_see_velocities_that_damp_nothing) {
  const std::string seen =
      "seen\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nVARIABLE/5, FUNCTION=-6*DZ(20)-VZ(20)+4\nVARIABLE/6, FUNCTION=2*VARVAL(7)\n"
      "VARIABLE/7, FUNCTION=3*VARVAL(8)+DZ(20)\nVARIABLE/8, FUNCTION=VZ(20)\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-8*DZ(20)-VARVAL(8)+VARVAL(5)\n"
      "PINPUT/5, VARIABLES=5\nPOUTPUT/6, VARIABLES=5,6,8\nEND\n";
  const RunResult r = run(seen, "LINEAR/MKB, PINPUT=5, POUTPUT=6, NODAMPIN, FILE=m\nLINEAR/EIGENSOL, NODAMPIN\n");
  ASSERT_EQ(r.status, 0) << r.err;
  auto C = r.matrix(0, "C");
  ASSERT_EQ(C.size(), 3u);
  for (auto& row : C) std::sort(row.begin(), row.end());
  EXPECT_THAT(C[0], ::testing::Each(0.0));
  EXPECT_EQ(C[1], (std::vector<double>{2, 6}));
  EXPECT_EQ(C[2], (std::vector<double>{0, 1}));
  EXPECT_EQ(r.eigenvalues(1)[0].real(), 0);
}

TEST_F(MatrixOutput, json_of_the_second_order_form_has_stiffness_and_damping_side_by_side) {
  const RunResult r = run(model, "LINEAR/MKB, PINPUT=5, POUTPUT=6, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto M = r.matrix(0, "M"), KB = r.matrix(0, "KB"), K = r.matrix(0, "K"), B = r.matrix(0, "B");
  const auto P = r.matrix(0, "P"), C = r.matrix(0, "C");
  ASSERT_EQ(KB.size(), M.size());
  for (std::size_t i = 0; i < KB.size(); ++i) {
    ASSERT_EQ(KB[i].size(), 2 * M.size());
    for (std::size_t j = 0; j < M.size(); ++j) {
      EXPECT_EQ(KB[i][j], K[i][j]);
      EXPECT_EQ(KB[i][M.size() + j], B[i][j]);
    }
  }
  EXPECT_NEAR(KB[0][0] / M[0][0], 4, 1e-12);
  EXPECT_NEAR(KB[0][2] / M[0][0], 3, 1e-12);
  EXPECT_NEAR(P[0][0] / M[0][0], 2, 1e-12);
  EXPECT_NEAR(C[0][0], 3, 1e-12);
}

TEST_F(MatrixOutput, message_file_lists_the_states_of_matrices) {
  for (const std::string option : {"STATEMAT", "MKB"}) {
    const RunResult r = run(model, "LINEAR/" + option + ", FILE=m, RM=1\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.message, HasSubstr("  Option RM=1 was used.\n"));
    EXPECT_THAT(r.message, HasSubstr("        2 kinematic states (displacement and velocities)\n"
                                     "        1 differential states (DIFFs, LSEs, etc.)\n"));
    EXPECT_THAT(r.message, HasSubstr("        1 Relative displacement DZ(BCS,1,1)   PART/2\n"));
  }
  const RunResult chosen = run(model, "LINEAR/STATEMAT, FILE=m, PSTATE=7\n");
  EXPECT_THAT(chosen.message, HasSubstr("  Option PSTATE=7 was used.\n"));
}

TEST_F(MatrixOutput, message_file_names_the_eigensolver_and_its_time) {
  const RunResult r = run(model, "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.message, HasSubstr("Using: QR eigen solver for 3 values\n\n  EigenSolution computation started.\n"));
  EXPECT_THAT(r.message,
              ::testing::ContainsRegex("  Simulation CPU time for eigenSolution computation = [0-9.E+-]+ seconds.\n\n  "
                                       "Eigensolution computation finished."));
}

TEST_F(MatrixOutput, a_table_of_modes_that_are_not_there_is_worth_a_warning) {
  const RunResult r = run(model, "LINEAR/EIGENSOL, COORDS=1,25, KINETIC=9\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("COORDS asks for modes up to 25, the eigensolution has 2 modes"));
  EXPECT_THAT(r.err, HasSubstr("KINETIC asks for mode 9, the eigensolution has 2 modes"));
  EXPECT_THAT(run(model, "LINEAR/EIGENSOL, COORDS=1,2, ENERGY_PER_MODE=ALL\n").err, Not(HasSubstr("asks for")));
}

TEST_F(MatrixOutput, energies_of_a_model_at_rest_are_explained) {
  const RunResult at_rest = run(model, "SIMULATE/STATIC\nLINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n");
  ASSERT_EQ(at_rest.status, 0) << at_rest.err;
  EXPECT_THAT(at_rest.text("model.txt"),
              HasSubstr("  The model is at rest: kinetic energy and dissipated power are zero"));
  std::string moving = model;
  moving.replace(moving.find("IP=1,1,1"), 8, "IP=1,1,1, VZ=3");
  const RunResult r = run(moving, "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("model.txt"), Not(HasSubstr("at rest")));
}

// A force u up at the end of an arm that is built in: the joint bears −u, and u/2 about y.
const std::string arm =
    "arm\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
    "MARKER/21, QP=0.5,0,0\nJOINT/1, FIXED, I=20, J=1\nVARIABLE/1, FUNCTION=0\n"
    "VARIABLE/2, FUNCTION=JOINT(1,0,4,1)\nVARIABLE/3, FUNCTION=JOINT(1,0,7,1)\n"
    "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=21, J=1, FUNCTION=VARVAL(1)\nPINPUT/1, VARIABLES=1\n"
    "POUTPUT/1, VARIABLES=2,3\nRESULTS/XRF\nEND\n";

TEST_F(MatrixOutput, of_a_model_without_states_is_D_alone) {
  for (const char* option : {"STATEMAT", "MKB"}) {
    const std::string command = std::string("LINEAR/") + option + ", PINPUT=1, POUTPUT=1, FILE=m";
    const RunResult r = run(arm, command + "\n" + command + "t, FORMAT=MATLAB\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto D = r.matrix(0, "D");
    ASSERT_EQ(D.size(), 2u);
    EXPECT_NEAR(D[0][0], -1, 1e-12);
    EXPECT_NEAR(D[1][0], 0.5, 1e-12);
    EXPECT_TRUE(r.labels(0).empty());
    EXPECT_THAT(r.out, HasSubstr("matrices of 0 states"));
    EXPECT_THAT(r.text("m"), HasSubstr("D             2    1"));
    EXPECT_THAT(r.text("mtd"), HasSubstr("-1.0000000000000"));
    EXPECT_EQ(r.text("mtc"), "\n\n");
    EXPECT_THAT(r.text("model.res"), HasSubstr("<dl:Matrix name=\"D\" rows=\"2\" columns=\"1\""));
  }
}

TEST_F(MatrixOutput, of_a_model_without_states_and_without_D_is_refused) {
  for (const char* command : {"LINEAR/STATEMAT, PINPUT=1, FILE=m\n", "LINEAR/MKB, POUTPUT=1, FILE=m\n",
                              "LINEAR/STATEMAT, FILE=m\n", "LINEAR/EIGENSOL\n"}) {
    const RunResult r = run(arm, command);
    EXPECT_EQ(r.status, 2);
    EXPECT_THAT(r.err, HasSubstr("the model has no states"));
  }
}

}  // namespace
}  // namespace dynalin::cases::matrix_output_test
