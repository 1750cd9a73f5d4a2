// Whose results are whose: what takes results of a linear model takes those of no other; what an instant of a
// simulation hands out; what is said of elements that have no result.
#include <dynalin/dynalin.h>
#include <gmock/gmock.h>

#include <optional>
#include <string>

#include "cases/as_others_do.h"

namespace library_results_test {
namespace {

using dynalin::Error;
using dynalin::as_others_do::error_of;
using dynalin::as_others_do::study_of;
using ::testing::HasSubstr;

std::string chain(const std::string& units = "MKS") {
  return "Chain\nUNITS/SYSTEM=" + units +
         "\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1, "
         "QG=0,0,1\nMARKER/30\nJOINT/1, TRANSLATIONAL, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=30, J=20\nBUSHING/1, I=20, "
         "J=1, K=0,0,40\nSPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=10, LENGTH=1\nVARIABLE/1, "
         "FUNCTION=0\nVARIABLE/2, "
         "FUNCTION=0\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=VARVAL(1)\nPINPUT/1, "
         "VARIABLES=1\nPINPUT/2, VARIABLES=2\nPSTATE/1, VARIABLES=2\nEND\n";
}
const dynalin::ModalTableRequest kinetic{.modes = {{"KINETIC", dynalin::ModeRange::all()}}, .markers = {}};

class LinearResults : public ::testing::Test {
 protected:
  const dynalin::Model model = dynalin::Model::from_text(chain());
  const dynalin::LinearModel linear = dynalin::Study(model).linearize();
  const dynalin::LinearModel heavier = dynalin::Study(model.with("PART/3 MASS", 4)).linearize();
};

TEST_F(LinearResults, are_taken_by_their_own_model_alone) {
  EXPECT_EQ(linear.tables(linear.modes(), kinetic).tables.size(), 4u);
  const Error other = error_of([&] { linear.tables(heavier.modes(), kinetic); });
  EXPECT_THAT(other.what(), HasSubstr("the modes are those of another linear model"));
  // The same equations once more are as good, some of the modes as well.
  const dynalin::LinearModel again = study_of(chain()).linearize();
  EXPECT_EQ(linear.tables(again.modes(), kinetic).tables.size(), 4u);
  EXPECT_EQ(linear.tables(again.modes(dynalin::NearestModes{1}), kinetic).tables.size(), 2u);
  EXPECT_THROW(linear.tables(heavier.modes(dynalin::NearestModes{1}), kinetic), Error);
  // Names of states count, those of what is in none of them do not.
  const auto joint = chain().find("JOINT/2");
  const auto renamed = study_of(chain().replace(joint, 7, "JOINT/9"));
  EXPECT_NO_THROW(linear.tables(renamed.linearize().modes(), kinetic));
  std::string numbered = chain();
  for (std::size_t at = numbered.find("PART/3"); at != std::string::npos; at = numbered.find("PART/3"))
    numbered.replace(at, 6, "PART/7");
  EXPECT_THROW(linear.tables(study_of(numbered).linearize().modes(), kinetic), Error);
  EXPECT_THROW(linear.tables(dynalin::EigenSolution(), kinetic), Error);
}

TEST_F(LinearResults, have_the_same_mark_in_all_forms) {
  const auto mark = linear.modes().of_equations;
  EXPECT_NE(mark, 0u);
  EXPECT_EQ(linear.state_space().of_equations, mark);
  EXPECT_EQ(linear.second_order().of_equations, mark);
  EXPECT_EQ(linear.descriptor_form().of_equations, mark);
  EXPECT_EQ(linear.tables(linear.modes(), kinetic).of_equations, mark);
  EXPECT_NE(heavier.modes().of_equations, mark);
  const dynalin::Study study(model);
  EXPECT_EQ(study.linearize().modes().of_equations, mark);
  EXPECT_NE(study.linearize({.pinput = 1}).modes().of_equations, mark);
  EXPECT_NE(study.linearize({.pinput = 1}).modes().of_equations, study.linearize({.pinput = 2}).modes().of_equations);
  EXPECT_NE(study.linearize({.rm = 20}).modes().of_equations, mark);
  EXPECT_NE(study.linearize(study.simulate({.end = 0.5}).point).modes().of_equations, mark);
}

TEST_F(LinearResults, are_recorded_beside_their_own_model) {
  dynalin::Record record(model);
  EXPECT_NO_THROW(record.add("modes", linear, linear.modes(), linear.tables(linear.modes(), kinetic)));
  const auto refused = [&](const auto& result) {
    return std::string(error_of([&] { record.add("other", linear, result); }).what());
  };
  for (const std::string& said : {refused(heavier.modes()), refused(heavier.state_space()),
                                  refused(heavier.second_order()), refused(heavier.descriptor_form())})
    EXPECT_THAT(said, HasSubstr("record: the result is one of another linear model"));
  EXPECT_THAT(
      error_of([&] { record.add("other", linear, linear.modes(), heavier.tables(heavier.modes(), kinetic)); }).what(),
      HasSubstr("the tables are of modes of another linear model"));
  // A study of a parameter is in one record, as long as its numbers are in the same units.
  EXPECT_NO_THROW(record.add("heavier", heavier, heavier.modes()));
  const auto inches = study_of(chain("IPS"));
  const dynalin::LinearModel in_inches = inches.linearize();
  for (const Error& error : {error_of([&] { record.add("point", inches.static_equilibrium()); }),
                             error_of([&] { record.add("modes", in_inches, in_inches.modes()); }),
                             error_of([&] { record.add("motion", inches.simulate({.end = 0.1})); })})
    EXPECT_THAT(error.what(), HasSubstr("the result is in other units than the model of the record"));
  const std::string json = record.to_json();
  EXPECT_THAT(json, HasSubstr("\"heavier\""));
  EXPECT_THAT(json, ::testing::Not(HasSubstr("\"other\"")));
}

TEST(SimulationInstants, last_as_long_as_the_call) {
  const auto study = study_of(chain());
  std::optional<dynalin::SimulationProgress> kept;
  std::optional<dynalin::OperatingPoint> point;
  const auto run = study.simulate({.end = 0.5, .steps = 2, .watch = [&](const dynalin::SimulationProgress& now) {
                                     if (kept) {
                                       EXPECT_THROW(kept->point(), Error);
                                     }
                                     kept = now;
                                     if (now.output) point = kept->point();
                                     return true;
                                   }});
  EXPECT_EQ(point->time(), 0.5);
  EXPECT_EQ(point->part(3).position, run.point.part(3).position);
  EXPECT_THAT(error_of([&] { kept->point(); }).what(), HasSubstr("simulation: the instant is over"));
  // Also where the watcher ended it by throwing.
  EXPECT_THROW(study.simulate({.end = 0.5,
                               .watch = [&](const dynalin::SimulationProgress& now) -> bool {
                                 kept = now;
                                 throw std::runtime_error("enough");
                               }}),
               std::runtime_error);
  EXPECT_THROW(kept->point(), Error);
}

TEST(ResultsOfElements, are_there_or_it_is_said_why_not) {
  const auto point = study_of(chain()).initial_conditions();
  EXPECT_EQ(point.load({"BUSHING", 1}).element.text(), "BUSHING/1");
  EXPECT_EQ(point.load({"bush", 1}).element.text(), "BUSHING/1");
  EXPECT_EQ(point.load({"SPRI", 2}).element.text(), "SPRINGDAMPER/2");
  const auto why = [&](const std::string& statement, std::int64_t id) {
    return std::string(error_of([&] { point.load({statement, id}); }).what());
  };
  EXPECT_THAT(why("PART", 2), HasSubstr("PART/2 exerts no force and torque on a marker"));
  EXPECT_THAT(why("MARKER", 20), HasSubstr("MARKER/20 exerts no force and torque on a marker"));
  EXPECT_THAT(why("PART", 9), HasSubstr("PART/9 does not exist"));
  EXPECT_THAT(why("MARKER", 9), HasSubstr("MARKER/9 does not exist"));
  EXPECT_THAT(why("BUSHNG", 1), HasSubstr("'BUSHNG' is no statement of a dataset; did you mean BUSHING?"));
  EXPECT_THAT(why("", 0), HasSubstr("'' is no statement of a dataset"));
  EXPECT_THAT(error_of([&] { point.part(1); }).what(), HasSubstr("PART/1 is the ground, which does not move"));
  EXPECT_THAT(error_of([&] { point.part(4); }).what(), HasSubstr("PART/4 does not exist"));
}

}  // namespace
}  // namespace library_results_test
