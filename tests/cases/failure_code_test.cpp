// Why an analysis has no result: a code that `dynalin explain` knows, on the terminal, in the message file and in JSON.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "cases/run.h"

namespace dynalin::cases::failure_code_test {
namespace {

using ::testing::HasSubstr;

struct Failing {
  const char* code;
  std::string dataset;
  const char* commands;
};

const std::string head = "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=1,0,0\n";
const std::string bar = head + "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=1,0,0\n";
const std::string point = head + "POINT_MASS/2, MASS=1, CM=20, QG=3,4,0\nMARKER/20, POINT_MASS=2\n";
const std::string hinge = bar + "JOINT/1, REVOLUTE, I=20, J=1\n";
const std::string sprung = hinge + "SPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=1\n";

const std::vector<Failing>& table() {
  static const std::vector<Failing> rows = {
      {"contradicting-constraints", point + "GCON/1, FUNCTION=DX(20,1)-1\nGCON/2, FUNCTION=DX(20,1)-2\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"contradicting-constraints", point + "GCON/1, FUNCTION=DX(20,1)-TIME\nGCON/2, FUNCTION=DX(20,1)-2*TIME\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"contradicting-constraints",
       point + "GCON/1, FUNCTION=DX(20,1)-TIME**2\nGCON/2, FUNCTION=DX(20,1)-2*TIME**2\nEND\n", "LINEAR/EIGENSOL\n"},
      {"curved-velocity-constraints",
       point + "POINT_MASS/3, MASS=1, CM=30, VX=0.3\nMARKER/30, POINT_MASS=3\nGCON/6, FUNCTION=VX(30)**2+1\nEND\n",
       "SIMULATE/INITIAL\n"},
      {"not-assembled", point + "GCON/5, FUNCTION=DX(20,1)**2+DY(20,1)**2+1\nEND\n", "SIMULATE/INITIAL\n"},
      {"undefined-value", point + "GCON/5, FUNCTION=SQRT(DX(20,1)-9)\nEND\n", "SIMULATE/INITIAL\n"},
      {"undefined-value", sprung + "SFORCE/1, ROTATION, I=20, J=1, FUNCTION=LOG(AZ(20,1)-1)\nEND\n",
       "SIMULATE/INITIAL\n"},
      {"undetermined-accelerations", head + "PART/2\nMARKER/20\nEND\n", "SIMULATE/INITIAL\n"},
      {"unsolved-equations", sprung + "VARIABLE/1, IC=1, FUNCTION=COS(VARVAL(1))\nIC/AMAXIT=2\nEND\n",
       "SIMULATE/INITIAL\n"},
      {"no-equilibrium", bar + "ACCGRAV/KGRAV=-10\nEND\n", "SIMULATE/STATICS\n"},
      {"motion-at-rest", sprung + "MOTION/1, JOINT=1, VELOCITY, FUNCTION=2\nEND\n", "SIMULATE/STATICS\n"},
      {"motion-at-rest", sprung + "GCON/1, FUNCTION=WZ(20,1)-0.5*(TIME+1)\nEND\n", "SIMULATE/STATICS\n"},
      {"freedoms-in-kinematics", hinge + "END\n", "SIMULATE/KINEMATICS, END=1, STEPS=2\n"},
      {"end-of-simulation", hinge + "END\n",
       "SIMULATE/DYNAMICS, END=0.1, STEPS=2\nSIMULATE/DYNAMICS, END=0.1, STEPS=2\n"},
      {"outputs-too-close", hinge + "END\n", "SIMULATE/DYNAMICS, END=1, DTOUT=1E-18\n"},
      {"outputs-too-close", sprung + "END\n", "SIMULATE/STATICS, END=1, DTOUT=1E-300\n"},
      {"too-many-outputs", hinge + "END\n", "SIMULATE/DYNAMICS, END=1, DTOUT=1E-12\n"},
      {"outputs-too-close", hinge + "SENSOR/1, FUNCTION=TIME, VALUE=0.5, GE, DT=1E-300\nEND\n",
       "SIMULATE/DYNAMICS, END=1, STEPS=2\n"},
      {"too-many-outputs", hinge + "SENSOR/1, FUNCTION=TIME, VALUE=0, GE, DT=1E-12\nEND\n",
       "SIMULATE/DYNAMICS, END=1, STEPS=2\n"},
      {"too-many-outputs", sprung + "SENSOR/1, FUNCTION=TIME, VALUE=0.5, GE, DT=1E-12\nEND\n",
       "SIMULATE/STATICS, END=1, STEPS=2\n"},
      {"end-out-of-reach",
       hinge + "ACCGRAV/JGRAV=-9.81\nMARKER/22, PART=2, QP=1,0,0\nMOTION/1, JOINT=1, FUNCTION=TIME\nEND\n",
       "SIMULATE/KINEMATICS, END=1E30\n"},
      {"undefined-derivative", sprung + "SFORCE/1, ROTATION, I=20, J=1, FUNCTION=SQRT(WZ(20,1))\nEND\n",
       "LINEAR/EIGENSOL\n"},
      {"no-second-order",
       point +
           "GCON/1, FUNCTION=VX(20,1)+VY(20,1)*DX(20,1)\nSFORCE/1, TRANSLATION, I=20, J=1, FUNCTION=-DM(20,1)\nEND\n",
       "LINEAR/MKB, FILE=m\n"},
  };
  return rows;
}

class FailureCodes : public Cases, public ::testing::WithParamInterface<std::size_t> {};

TEST_P(FailureCodes, stand_behind_the_message_and_are_explained) {
  const Failing& f = table()[GetParam()];
  SCOPED_TRACE(f.dataset);
  const RunResult r = run(f.dataset, f.commands);
  EXPECT_EQ(r.status, 2);
  const std::string code = "[" + std::string(f.code) + "]";
  EXPECT_THAT(r.err, HasSubstr(code));
  EXPECT_THAT(r.message, HasSubstr(code));
  ASSERT_FALSE(r.json.at("errors").empty());
  EXPECT_EQ(r.json.at("errors").back().value("code", ""), f.code);
  EXPECT_NE(find_explanation(f.code), nullptr);
}
INSTANTIATE_TEST_SUITE_P(table, FailureCodes, ::testing::Range<std::size_t>(0, table().size()));

}  // namespace
}  // namespace dynalin::cases::failure_code_test
