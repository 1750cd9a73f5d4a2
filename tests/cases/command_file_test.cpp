// Command files as they come: shapes, line ends, bytes that are no text, files written twice.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::command_file_test {
namespace {

using ::testing::HasSubstr;

class CommandFiles : public Cases {
 protected:
  void SetUp() override {
    Cases::SetUp();
    write("model.adm",
          "pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/10, PART=1\n"
          "PART/2, QG=0,-1,0, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=0,1,0\n"
          "JOINT/1, REVOLUTE, I=21, J=10\nVARIABLE/1, FUNCTION=VARVAL(2)\nVARIABLE/2, FUNCTION=0\nPINPUT/1, "
          "VARIABLES=2\nPOUTPUT/1, VARIABLES=1\nEND\n");
  }
  RunResult commands(const std::string& text) const {
    write("run.acf", text);
    return run_file("run.acf");
  }
};

TEST_F(CommandFiles, lines_may_end_with_carriage_returns_alone) {
  const RunResult r = commands("model\rout\rLINEAR/EIGENSOL\rSTOP\r");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.eigenvalues(0).size(), 2u);
  EXPECT_TRUE(r.wrote("out.msg"));
}

TEST_F(CommandFiles, comments_stand_on_the_first_lines_as_everywhere) {
  const RunResult above = commands("! the pendulum\n!\nmodel ! as drawn\nout! ! its files\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(above.status, 0) << above.err;
  EXPECT_EQ(above.eigenvalues(0).size(), 2u);
  EXPECT_TRUE(above.wrote("out!.msg"));
  const RunResult in_place = commands("model\n! no prefix\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(in_place.status, 0) << in_place.err;
  EXPECT_TRUE(in_place.wrote("model.msg"));
  const RunResult between = commands("model\n! the prefix:\n  ! two lines\no7\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(between.status, 0) << between.err;
  EXPECT_TRUE(between.wrote("o7.msg"));
  EXPECT_EQ(between.eigenvalues(0).size(), 2u);
  const RunResult setting = commands("model\n! no prefix\nEQUILIBRIUM/ERROR=1E-6\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(setting.status, 0) << setting.err;
  const RunResult alone = commands("! nothing\n! else\n");
  EXPECT_EQ(alone.status, 1);
  EXPECT_THAT(alone.err, HasSubstr("the command file names no model"));
}

TEST_F(CommandFiles, with_words_of_datasets_say_where_they_belong) {
  EXPECT_THAT(commands("model\nout\nUNITS/SYSTEM=MKS\n").err,
              HasSubstr("hint: UNITS is a statement: it belongs in the dataset"));
  EXPECT_THAT(commands("model\nout\nRESULTS/XRF\n").err,
              HasSubstr("hint: RESULTS is a statement: it belongs in the dataset"));
}

TEST_F(CommandFiles, names_may_stand_in_quotes_and_commands_on_several_lines) {
  std::filesystem::copy(folder_ / "model.adm", folder_ / "my model.adm");
  write("model.acf", "\"my model.adm\"\n'my run'\nLINEAR / EIGENSOL , &\n  , COORDS = 1\nSTOP\n");
  const RunResult r = run_file("model.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.wrote("my run.txt"));
  EXPECT_EQ(r.result(0).at("command"), "LINEAR / EIGENSOL , COORDS = 1");
}

TEST_F(CommandFiles, name_models_with_a_dot_and_without_their_extension) {
  std::filesystem::copy(folder_ / "model.adm", folder_ / "model_0.2.adm");
  EXPECT_EQ(commands("model_0.2\nout\nLINEAR/EIGENSOL\n").status, 0);
  EXPECT_EQ(commands("FILE/MODEL=model_0.2\nLINEAR/EIGENSOL\n").status, 0);
  EXPECT_THAT(commands("model_0.3\nout\nLINEAR/EIGENSOL\n").err, HasSubstr("model_0.3 cannot be read"));
}

TEST_F(CommandFiles, bytes_that_are_no_text_do_not_end_the_run) {
  const RunResult r = commands("model\nout\nLINEAR/EIGENSOL ! \xC4\xE9\n");
  EXPECT_NE(r.status, -1);
  const RunResult in_command = commands("model\nout\nSHOW/\xE9\nLINEAR/EIGENSOL\n");
  EXPECT_NE(in_command.status, -1);
}

TEST_F(CommandFiles, a_file_named_twice_holds_what_the_last_command_wrote) {
  const RunResult r = commands("model\nout\nLINEAR/STATEMAT, FILE=m\nLINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("m"), HasSubstr("B "));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    files += entry.path().string().find(".part") != std::string::npos;
  }
  EXPECT_EQ(files, 0u);
}

TEST_F(CommandFiles, a_command_before_the_model_is_an_error_at_its_place) {
  const RunResult r = commands("LINEAR/EIGENSOL\nFILE/MODEL=model\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("run.acf:1:1: error: LINEAR/EIGENSOL needs a model, and none is named before it"));
  EXPECT_THAT(r.err, HasSubstr("[missing-model]"));
  EXPECT_FALSE(r.wrote("run.msg"));
}

TEST_F(CommandFiles, a_model_that_is_not_there_is_named_at_its_place) {
  EXPECT_THAT(commands("nowhere\nout\nLINEAR/EIGENSOL\n").err, HasSubstr("run.acf:1:1: error"));
  EXPECT_THAT(commands("! no model\nLINEAR/EIGENSOL\n").err, HasSubstr("[missing-model]"));
}

}  // namespace
}  // namespace dynalin::cases::command_file_test
