// What the tabulator offers at a prompt.
#include "command/completion.h"

#include <gmock/gmock.h>

#include "elements/catalogue.h"
#include "model/model.h"

namespace dynalin::completion_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

class Completions : public ::testing::Test {
 protected:
  std::vector<std::string> of(std::string_view line) const { return completions(line, model_.get()); }
  std::unique_ptr<Model> model_ =
      build_model(
          std::make_shared<const Dataset>(
              parse_dataset(std::make_shared<const SourceText>(
                                "m",
                                "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\n"
                                "MARKER/20\nMARKER/21\nJOINT/7, REVOLUTE, I=20, J=1\nSFORCE/3, ROTATIONAL, I=20, "
                                "J=1, FUNCTION=0\nVARIABLE/5, FUNCTION=1\nPSTATE/9, VARIABLES=5\nEND\n"))
                  .value),
          catalogue())
          .value;
};

TEST_F(Completions, begin_with_names_of_commands) {
  EXPECT_THAT(of("LIN"), ElementsAre("LINEAR/"));
  EXPECT_THAT(of("sim"), ElementsAre("SIMULATE/"));
  EXPECT_THAT(of("SPRI"), ElementsAre("SPRINGDAMPER/"));
  EXPECT_THAT(of(""), Contains("STOP"));
  EXPECT_THAT(of("QQ"), IsEmpty());
}

TEST_F(Completions, go_on_with_arguments) {
  EXPECT_THAT(of("LINEAR/EIG"), ElementsAre("EIGENSOL"));
  EXPECT_THAT(of("lin/eig, NOV"), ElementsAre("NOVECTOR"));
  EXPECT_THAT(of("EQUILIBRIUM/ERROR=1, IMB"), ElementsAre("IMBALANCE"));
  EXPECT_THAT(of("JOINT/7, REV"), ElementsAre("REVOLUTE"));
  EXPECT_THAT(of("NOTHING/A"), IsEmpty());
}

TEST_F(Completions, know_the_ids_of_the_model) {
  EXPECT_THAT(of("MARKER/2"), ElementsAre("20", "21"));
  EXPECT_THAT(of("JOINT/"), ElementsAre("7"));
  EXPECT_THAT(of("LINEAR/EIGENSOL, RM=2"), ElementsAre("20", "21"));
  EXPECT_THAT(of("LINEAR/EIGENSOL, PSTATE="), ElementsAre("9"));
  EXPECT_THAT(of("LINEAR/EIGENSOL, MODAL_RM=2"), ElementsAre("20", "21"));
  EXPECT_THAT(of("JOINT/7, I=2"), ElementsAre("20", "21"));
  EXPECT_THAT(of("MOTION/1, JOINT="), ElementsAre("7"));
  EXPECT_THAT(of("PSTATE/9, VARIABLES="), ElementsAre("5"));
  EXPECT_THAT(of("MARKER/20, PART=2"), ElementsAre("2"));
  EXPECT_THAT(of("MATRIX/1, I="), IsEmpty());  // rows of its values, no markers
  EXPECT_THAT(of("DEACTIVATE/SF"), ElementsAre("SFORCE"));
  EXPECT_THAT(of("DEACTIVATE/SFORCE, ID="), ElementsAre("3"));
  EXPECT_THAT(completions("MARKER/2", nullptr), IsEmpty());
  EXPECT_THAT(completions("LINEAR/EIG", nullptr), ElementsAre("EIGENSOL"));
}

}  // namespace
}  // namespace dynalin::completion_test
