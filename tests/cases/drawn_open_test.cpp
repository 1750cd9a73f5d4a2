// What assembly changes of a model as drawn is said where it is more than the digits of a dataset leave open.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::drawn_open_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using DrawnOpen = Cases;

// A hinge about z whose marker on PART/2 stands at the given place.
std::string hinged(const std::string& part, const std::string& more = "") {
  return "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/11, QP=1,0,0\nPART/2, MASS=1, CM=20, IP=1,1,1, " +
         part + "\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n" + more + "END\n";
}

TEST_F(DrawnOpen, joints_are_named_with_the_part_that_moves) {
  for (const char* commands : {"LINEAR/EIGENSOL\n", "SIMULATE/STATICS\n", "SIMULATE/DYNAMICS, END=0.1, STEPS=1\n"}) {
    const RunResult r = run(hinged("QG=0.3,0.4,0"), commands);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr("model.adm:8:1: warning"));
    EXPECT_THAT(r.err, HasSubstr("JOINT/1 does not hold as drawn: of the parts it joins, PART/2 moves most to meet it, "
                                 "assembly moves it by 0.5 [drawn-open]"));
  }
  const RunResult turned = run(hinged("QG=0.3,0,0, REULER=0,30D,0"), "LINEAR/EIGENSOL\n");
  EXPECT_THAT(turned.err, HasSubstr("assembly moves it by 0.3 and turns it by 30 degrees"));
}

TEST_F(DrawnOpen, nothing_is_said_of_digits_or_of_what_is_meant) {
  const auto silent = [&](const std::string& dataset) {
    const RunResult r = run(dataset, "SIMULATE/INITIAL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, Not(HasSubstr("drawn-open"))) << dataset;
  };
  silent(hinged(""));
  silent(hinged("QG=1E-5,0,0"));
  silent(hinged("", "MOTION/1, JOINT=1, ROTATION, FUNCTION=0.5\n"));  // where the MOTION puts it
  silent(
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1, IC=0.5\nEND\n");
}

// Both ends of the bar are held: it cannot stay where EXACT says.
TEST_F(DrawnOpen, coordinates_that_exact_asks_to_keep_are_named) {
  const std::string bar = "QG=0.3,0,0, EXACT=X:Y:PSI";
  const RunResult r = run(hinged(bar), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err,
              HasSubstr("model.adm:6:1: warning: PART/2 cannot keep what EXACT asks for: assembly changes X from "
                        "0.3 to 0 [changed-position]"));
  // Where another part can move instead, it is kept.
  const RunResult kept = run(
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=0.3,0,0, EXACT=X\nMARKER/20\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nJOINT/1, REVOLUTE, I=20, J=30\nJOINT/2, TRANSLATIONAL, I=30, "
      "J=9\nMARKER/9, PART=1, REULER=90D,90D,0\nEND\n",
      "LINEAR/EIGENSOL\n");
  EXPECT_THAT(kept.err, Not(HasSubstr("changed-position"))) << kept.err;
}

}  // namespace
}  // namespace dynalin::cases::drawn_open_test
