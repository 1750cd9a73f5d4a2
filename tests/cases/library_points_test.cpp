// What programs of others measure at points, and how they write points down and read them again.
#include <dynalin/dynalin.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "cases/as_others_do.h"

namespace library_points_test {
namespace {

using dynalin::Error;
using dynalin::as_others_do::error_of;
using dynalin::as_others_do::study_of;
using ::testing::HasSubstr;

// Of length 1, level at the start.
std::string pendulum(const std::string& turning) {
  return "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, "
         "IP=0.1,0.1,0.1, QG=1,0,0, WZ=" +
         turning +
         "\nMARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nVARIABLE/3, FUNCTION=AZ(21,1)\nEND\n";
}
const std::string swinging = pendulum("2"), resting = pendulum("0");

TEST(LibraryPoints, measures_functions_at_a_point) {
  const auto study = study_of(swinging);
  const auto point = study.initial_conditions();
  const auto values = study.measured(point, {"VY(20,1)", "DX(20,1)+1", "ACCY(20,1)", "JOINT(1,0,3,0)"});
  ASSERT_EQ(values.size(), 4u);
  EXPECT_NEAR(values[0], 2, 1e-13);
  EXPECT_EQ(values[1], 2);
  EXPECT_NEAR(values[2], -9.81 / 1.1, 1e-12);
  EXPECT_NEAR(values[3], point.load({"JOINT", 1}).force[1], 1e-12);
  EXPECT_TRUE(study.measured(point, {}).empty());
  // Of the consistent point, where this one is as drawn; and the model has no further VARIABLE.
  EXPECT_NEAR(study.measured(study.as_drawn(), {"ACCY(20,1)"}).at(0), -9.81 / 1.1, 1e-12);
  EXPECT_THROW(point.variable(5), Error);

  const auto measure = [&](const std::string& function) {
    return [&, function] { study.measured(point, {function}); };
  };
  const Error unknown = error_of(measure("DX(77,1)"));
  EXPECT_EQ(unknown.analysis, "measuring");
  EXPECT_THAT(unknown.what(), HasSubstr("MARKER/77"));
  EXPECT_THAT(error_of(measure("1, IC=5")).what(), HasSubstr("'1, IC=5' is not one function"));
  EXPECT_THAT(error_of(measure("1\nPART/9")).what(), HasSubstr("several lines"));
  for (const char* text : {"1, IC=5", "1\nPART/9"})
    EXPECT_EQ(error_of(measure(text)).problems.at(0).code, "unexpected-text") << text;
  EXPECT_THROW(measure("SIN(")(), Error);
  EXPECT_THROW(measure("")(), Error);
  EXPECT_THROW(study_of(resting).measured(point, {"TIME"}), Error);
}

// Functions are values of the model, and of nothing that measuring them takes.
TEST(LibraryPoints, measures_functions_that_know_nothing_of_each_other) {
  const auto study = study_of(swinging);
  const auto point = study.initial_conditions();
  EXPECT_EQ(study.measured(point, {"VARVAL(3)+1", "7"}), (std::vector<double>{1, 7}));
  for (const std::string id : {"1", "2", "4", "5", "12", "99999998", "99999999", "2147483647"}) {
    const Error error = error_of([&] { study.measured(point, {"7", "VARVAL(" + id + ")", "8"}); });
    ASSERT_EQ(error.problems.size(), 1u) << id;
    EXPECT_EQ(error.problems[0].code, "unknown-element");
    EXPECT_EQ(error.problems[0].file, "functions");
    EXPECT_EQ(error.problems[0].line, 2u);
    EXPECT_EQ(error.problems[0].column, 8u);
    EXPECT_THAT(error.problems[0].message, HasSubstr("VARIABLE/" + id + ", which does not exist"));
    EXPECT_THAT(error.problems[0].hint, ::testing::AnyOf("", "VARIABLE/3 exists"));
  }
  // As many problems as there are, each with its place.
  const Error several = error_of([&] { study.measured(point, {"DX(99,1)", "NOTHING(1)", "TIME", "1+*2"}); });
  ASSERT_EQ(several.problems.size(), 3u);
  std::vector<std::size_t> lines;
  for (const auto& problem : several.problems) {
    lines.push_back(problem.line);
    EXPECT_FALSE(problem.code.empty());
    EXPECT_THAT(problem.message, ::testing::Not(HasSubstr("VARIABLE/")));
  }
  EXPECT_EQ(lines, (std::vector<std::size_t>{1, 2, 4}));
  EXPECT_THAT(several.what(), HasSubstr("functions:1:4: error: the function 'DX(99,1)'"));
  EXPECT_THAT(error_of([&] { study.measured(point, {"1/(TIME-TIME)"}); }).what(), HasSubstr("'1/(TIME-TIME)'"));
}

TEST(LibraryPoints, measures_functions_whatever_ids_the_model_has) {
  auto text = swinging;
  text.replace(text.find("VARIABLE/3, FUNCTION=AZ(21,1)"), 29,
               "VARIABLE/2147483647, FUNCTION=3\nVARIABLE/999999971, FUNCTION=6\nVARIABLE/99999999, "
               "FUNCTION=4\nVARIABLE/99999998, FUNCTION=5");
  const auto study = study_of(text);
  EXPECT_EQ(study.measured(study.initial_conditions(), {"TIME+2", "VARVAL(2147483647)", "VARVAL(99999999)", "1"}),
            (std::vector<double>{2, 3, 4, 1}));
  // An id of which one of theirs is the beginning.
  const Error error = error_of([&] { study.measured(study.initial_conditions(), {"VARVAL(999999972)"}); });
  EXPECT_THAT(error.what(), HasSubstr("refers to VARIABLE/999999972, which does not exist"));
}

TEST(LibraryPoints, saves_points_and_reloads_them) {
  const auto model = dynalin::Model::from_text(swinging);
  const dynalin::Study study(model), again = study_of(swinging);
  const auto end = study.simulate({.end = 0.3}).point;
  const auto back = again.from_saved_text(study.saved_text(end, "on its way"));
  EXPECT_TRUE(back.is_consistent());
  EXPECT_TRUE(back.remarks().empty());
  EXPECT_EQ(back.time(), 0.3);
  EXPECT_EQ(back.part(2).position, end.part(2).position);
  EXPECT_EQ(back.part(2).angular_velocity, end.part(2).angular_velocity);
  EXPECT_EQ(back.marker(20).acceleration, end.marker(20).acceleration);
  EXPECT_EQ(back.load({"JOINT", 1}).force, end.load({"JOINT", 1}).force);
  EXPECT_EQ(back.variable(3), end.variable(3));

  const auto folder = std::filesystem::temp_directory_path() / ("dynalin_save_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "rest.save").string();
  const auto rest = study.static_equilibrium();
  study.save(rest, file);
  const auto found = again.reload(file);
  ASSERT_TRUE(found.is_static());
  EXPECT_EQ(found.static_result().iterations, rest.static_result().iterations);
  EXPECT_EQ(found.part(2).position, rest.part(2).position);

  // In another model: the same place, from which its own forces are found.
  const auto heavier = model.with("PART/2 MASS", 2);
  const auto other = dynalin::Study(heavier).reload(file);
  EXPECT_FALSE(other.is_consistent());
  EXPECT_FALSE(other.is_static());
  EXPECT_TRUE(other.remarks().empty());
  EXPECT_EQ(other.part(2).position, rest.part(2).position);
  const auto there = dynalin::Study(heavier).initial_conditions(other);  // turning at 2 rad/s
  EXPECT_NEAR(there.load({"JOINT", 1}).force[1], 2 * (9.81 + 4), 1e-10);
  dynalin::Study(heavier).save(dynalin::Study(heavier).initial_conditions(), file);
  EXPECT_TRUE(dynalin::Study(model.with("PART/2 MASS", 2)).reload(file).is_consistent());
  EXPECT_FALSE(study.reload(file).is_consistent());

  auto with_another = resting;
  with_another.insert(with_another.find("VARIABLE/3"), "PART/7, MASS=1, CM=70, IP=1,1,1\nMARKER/70\n");
  const auto in_part = study_of(with_another).reload(file);
  EXPECT_FALSE(in_part.is_consistent());
  ASSERT_EQ(in_part.remarks().size(), 1u);
  EXPECT_EQ(in_part.remarks()[0].code, "reloaded-in-part");
  EXPECT_THAT(in_part.remarks()[0].message, HasSubstr("PART/7"));

  std::string altered = study.saved_text(end);
  altered.replace(altered.find("Pendulum"), 8, "pendulum");
  const Error changed = error_of([&] { study.from_saved_text(altered); });
  EXPECT_EQ(changed.problems.at(0).code, "unusable-save");
  EXPECT_THAT(changed.what(), HasSubstr("it was altered after SAVE had written it"));
  EXPECT_THAT(error_of([&] { study.reload((folder / "none").string()); }).what(), HasSubstr("cannot be reloaded"));
  EXPECT_EQ(error_of([&] { study.save(rest, (folder / "none/file").string()); }).problems.at(0).code,
            "unwritable-file");
  EXPECT_THROW(again.saved_text(rest), Error);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace library_points_test
