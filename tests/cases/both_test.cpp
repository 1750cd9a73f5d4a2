// Where program and library once differed.
#include "cases/both.h"

#include <gmock/gmock.h>

namespace dynalin::cases::both_test {
namespace {

using ::testing::HasSubstr;

class Both : public ProgramAndLibrary {
 protected:
  // As drawn it lies level, and hangs when it rests.
  static std::string pendulum(const std::string& more = "", const std::string& units = "UNITS/SYSTEM=MKS\n") {
    return "Pendulum\n" + units +
           "ACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG=1,0,0, WZ=0.5\n"
           "MARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nVARIABLE/3, FUNCTION=DX(20,1)\n"
           "PSTATE/1, VARIABLES=3\n" +
           more + "END\n";
  }
};

TEST_F(Both, initial_conditions_after_statics_stay_where_statics_ended) {
  for (const char* statics : {"SIMULATE/STATIC\n", "SIMULATE/STATIC\nSIMULATE/INITIAL\n"}) {
    const RunResult r = run(pendulum(), statics + std::string("LINEAR/EIGENSOL\nLINEAR/MKB, FILE=a\n"));
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NEAR(r.eigenvalues(r.json["results"].size() - 2)[0].imag(), 0.4753, 1e-4);
  }
}

TEST_F(Both, original_takes_statics_as_they_were_found_until_another_analysis) {
  const RunResult r = run(pendulum(),
                          "SIM/STAT\nLINEAR/EIGENSOL, ORIGINAL\nLINEAR/STATEMAT, FILE=a, ORIGINAL\n"
                          "SIM/INIT\nLINEAR/EIGENSOL, ORIGINAL, RM=20\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(1)["operating_point"]["bodies"][0]["angular_velocity"][2], 0);
  EXPECT_NE(r.result(4)["operating_point"]["bodies"][0]["angular_velocity"][2], 0);
}

TEST_F(Both, variables_of_the_environment_have_a_flag_each) {
  for (const char* name : {"MSC_LINEAR_PBCS_STATES", "MSC_ADAMS_SOLVER_NODAMP_DIFF",
                           "MSC_ADAMS_LINEAR_NO_CHECKS_FOR_CONSISTENCY", "MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES"}) {
    const RunResult r = run(pendulum("DIFF/1, FUNCTION=-DIF(1)+VX(20,1)\n"),
                            "ENVIRONMENT/NAME=" + std::string(name) +
                                ", VALUE=1\nSIM/STAT\nLINEAR/EIGENSOL, NODAMPIN\nLINEAR/STATEMAT, FILE=a\n");
    ASSERT_EQ(r.status, 0) << r.err;
  }
}

TEST_F(Both, a_model_without_states_fails_with_all_remarks) {
  const RunResult r = run(pendulum("JOINT/2, FIXED, I=20, J=2\nMARKER/2, PART=1, QP=1,0,0\n", ""), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.json["errors"][0]["message"].get<std::string>(), HasSubstr("no states"));
  EXPECT_EQ(r.json["warnings"][0]["code"], "no-units");
}

TEST_F(Both, redundant_rows_and_remarks_have_code_and_place) {
  const RunResult r = run(pendulum("MARKER/2, PART=1, QP=0,0,1\nMARKER/22, PART=2, QP=-1,0,1\n"
                                   "JOINT/2, REVOLUTE, I=22, J=2\nINTEGRATOR/FIXIT=1\n"),
                          "SIM/INIT\nLINEAR/EIGENSOL, PSTATE=1\nLINEAR/EIGENSOL, RM=20, NOVECTOR\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::size_t redundant = 0;
  for (const auto& row : r.result(0)["operating_point"]["constraints"]) redundant += row["redundant"] == true;
  EXPECT_EQ(redundant, 5u);
  EXPECT_EQ(r.json["warnings"][0]["code"], "passed-over");
}

TEST_F(Both, tables_of_modes_are_values_in_json) {
  const RunResult r = run(pendulum("SPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT=2, CT=0.1\nMARKER/4, PART=2, QP=1,0,0\n"),
                          "SIM/STAT\nLINEAR/EIGENSOL, COORDS=1, KINETIC=1,3, FSTRAIN=0.1,9, DISSIPAT=1, MLIST=20,4, "
                          "MRANGE=1, ENERGY_PER_MODE=ALL, MASS_PER_MODE=1, MODAL_RM=20\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::map<std::string, nlohmann::json> tables;
  for (const auto& table : r.result(1)["tables"]) tables[table["table"]] = table;
  EXPECT_EQ(tables.size(), 9u);
  EXPECT_EQ(tables["STRAIN"]["rows"][0]["element"], "SPRINGDAMPER/1");
  EXPECT_EQ(tables["STRAIN"]["rows"][0]["values"].size(), tables["STRAIN"]["columns"].size());
  EXPECT_NEAR(tables["KINETIC"]["rows"][0]["values"][9].get<double>(), 100, 1e-10);
  EXPECT_EQ(tables["MRANGE"]["rows"].size(), 2u);
  EXPECT_EQ(tables["COORDS"]["rows"][0]["values"][0].size(), 2u);
  EXPECT_EQ(tables["EFFECTIVE_MASS"]["rows"][0]["mode"], 1);
  EXPECT_EQ(r.json["warnings"].back()["code"], "missing-mode");
}

TEST_F(Both, settings_of_equilibrium_act_from_dataset_and_command) {
  const RunResult r = run(pendulum("EQUILIBRIUM/ALIMIT=0.5D\n"), "SIM/STAT\nEQUILIBRIUM/ALIMIT=20D\nSIM/STAT\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_GT(r.result(0)["iterations"], 3 * r.result(2)["iterations"].get<int>());
}

// A weight of its own, a spring taken out and in again, a place and a velocity stated anew: the point goes on.
TEST_F(Both, edits_by_command_change_the_same) {
  const RunResult r =
      run(pendulum("SPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT=2, CT=0.1\nREQUEST/1, F2=VARVAL(3)\n"
                   "DIFF/1, FUNCTION=VX(20,1)-DIF(1), IC=0.3\n"),
          "SIM/STAT\nLINEAR/EIGENSOL\nDEACTIVATE/SPRING, ID=1\nACCGRAV/JGRAV=-20\nLINEAR/EIGENSOL\n"
          "PART/2, MASS=3, QG=0.8,0.6,0\nACTIVATE/SPRING, ID=1\nPART/2, WZ=2\nSIM/INITIAL\nLINEAR/STATEMAT, FILE=a\n"
          "DIFF/1, IC=0.7\nSIM/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.json["results"].back()["operating_point"]["states"][0]["value"], 0.7);
}

TEST_F(Both, redundant_constraints_may_disagree_as_far_as_IC_says) {
  const RunResult r = run(pendulum("MARKER/2, PART=1, QP=0,0,1\nMARKER/22, PART=2, QP=-1,0,1.00001\n"
                                   "JOINT/2, REVOLUTE, I=22, J=2\n"),
                          "IC/ERROR=1E-3\nSIM/INITIAL\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(1)["operating_point"]["constraints"].size(), 10u);
}

// What is searched in vain says the same on both sides.
TEST_F(Both, failures_have_the_same_account) {
  const RunResult r =
      run(pendulum("VFORCE/1, I=20, JFLOAT=3, RM=1, FX=0\\FY=9.81+1E3\\FZ=0\nMARKER/3, PART=1, FLOATING\n"
                   "SFORCE/2, ROTATIONAL, ACTIONONLY, I=20, J=20, FUNCTION=5000\n"),
          "SIM/STAT\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_FALSE(r.json["errors"].empty());
}

}  // namespace
}  // namespace dynalin::cases::both_test
