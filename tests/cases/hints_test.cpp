// What a message says besides what is wrong: how to go on, who is to blame, and all of it in one run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::hints_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Hints : public Cases {
 protected:
  std::string said(const std::string& model, const std::string& commands) const { return run(model, commands).err; }
};

const std::string ground = "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
const std::string hinge = ground + "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n";

TEST_F(Hints, syntax_hides_nothing_else) {
  const std::string err = said(hinge + "END\n",
                               "PART/2, MASS=\nMARKER/20, QP=1,2\nPART/2, IP=-1,1,1\nPART/7, MASS=1\n"
                               "FOO\n");
  for (const char* text : {"missing-value", "wrong-count", "PART/7 does not exist", "unknown-command"})
    EXPECT_THAT(err, HasSubstr(text));
  const std::string of_linear = said(hinge + "END\n", "PART/2, MASS=\nLINEAR/STATEMAT, FILE=a, PINPUT=3\n");
  for (const char* text : {"missing-value", "refers to PINPUT/3"}) EXPECT_THAT(of_linear, HasSubstr(text));
}

TEST_F(Hints, a_marker_that_is_missing_hides_no_wrong_count) {
  const std::string bushing = "MARKER/21\nBUSHING/1, I=21, J=1, K=1,1,1\nEND\n";
  const std::string err = said(hinge + bushing, "BUSHING/1, I=99\nBUSHING/1, K=1,2\n");
  for (const char* text : {"MARKER/99, which does not exist", "K of BUSHING/1 takes 3 values, here are 2"})
    EXPECT_THAT(err, HasSubstr(text));
}

}  // namespace
}  // namespace dynalin::cases::hints_test
