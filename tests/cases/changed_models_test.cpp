// Models that the library makes of others by edits.
#include <gmock/gmock.h>

#include "cases/study_of.h"

namespace dynalin::cases::changed_models_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Of the model before nothing is said again, not even that its units are missing.
TEST(ChangedModels, say_what_the_change_has_brought_about) {
  const auto codes_of = [](const library::Model& model) {
    std::vector<std::string> codes;
    for (const auto& remark : model.remarks()) codes.push_back(remark.code + " " + std::to_string(remark.line));
    return codes;
  };
  const auto door = library::Model::from_text(
      "t\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, PART=2, REULER=0,9D,0\n"
      "JOINT/1, SPHERICAL, I=20, J=1\nSFORCE/1, ROTATION, I=20, J=1, FUNCTION=-AZ(20,1)\n"
      "SFORCE/2, ROTATION, I=21, J=1, FUNCTION=-AZ(20,1)\nEND\n");
  EXPECT_THAT(codes_of(door), ElementsAre(StartsWith("skew-axes 9"), StartsWith("no-units")));
  const auto leaning = door.edited("MARKER/20, REULER=0,10D,0");
  EXPECT_THAT(codes_of(leaning), ElementsAre(StartsWith("skew-axes 8")));
  EXPECT_THAT(codes_of(leaning.with({{"PART/2 MASS", 2}})), IsEmpty());
  EXPECT_THAT(codes_of(leaning.edited("MARKER/20, REULER=0,0,0").edited("MARKER/20, REULER=0,10D,0")), IsEmpty());
}

}  // namespace
}  // namespace dynalin::cases::changed_models_test
