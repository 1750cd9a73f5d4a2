// Command files within command files, and several models in one run.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::nested_files_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string oscillator(double stiffness) {
  return "oscillator\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
         "MARKER/21, PART=2, QP=0,0,1\nMARKER/3, PART=1, QP=0,0,-2\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
         "SPRINGDAMPER/1, TRANSLATIONAL, I=21, J=3, LENGTH=3, K=" +
         std::to_string(stiffness) + "\nEND\n";
}

class NestedFiles : public Cases {
 protected:
  void SetUp() override {
    Cases::SetUp();
    std::filesystem::create_directories(folder_ / "inner");
    write("model.adm", oscillator(8));
    write("inner/other.adm", oscillator(50));
  }
  RunResult commands(const std::string& text) const {
    write("run.acf", text);
    return run_file("run.acf");
  }
  static double omega(const RunResult& r, std::size_t k) {
    return std::abs(r.eigenvalues(k).at(0)) * 6.283185307179586;
  }
};

TEST_F(NestedFiles, run_in_the_place_where_they_are_named_and_name_files_from_their_folder) {
  write("inner/edits.acf", "SPRINGDAMPER/1, K=32\nLINEAR/STATEMAT, FILE=matrix\nFILE/COMMAND=more\n");
  write("inner/more.acf", "\n! a comment\nSPRINGDAMPER/1, K=72\n");
  const RunResult r = commands("model\nout\nLINEAR/EIGENSOL\nFILE/COMMAND=inner/edits.acf\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.wrote("inner/matrix"));
  const auto& results = r.json.at("results");
  std::vector<std::string> ran;
  for (const auto& result : results) ran.push_back(result.at("command"));
  EXPECT_EQ(ran, (std::vector<std::string>{"LINEAR/EIGENSOL", "SPRINGDAMPER/1, K=32", "LINEAR/STATEMAT, FILE=matrix",
                                           "SPRINGDAMPER/1, K=72", "LINEAR/EIGENSOL"}));
  EXPECT_NEAR(omega(r, 0), 2, 1e-11);
  EXPECT_NEAR(omega(r, 4), 6, 1e-11);
  EXPECT_THAT(r.text("out.msg"), HasSubstr(" command: FILE/COMMAND=inner/edits.acf"));
}

TEST_F(NestedFiles, that_stop_end_the_run) {
  write("inner/stop.acf", "LINEAR/EIGENSOL\nSTOP\n");
  const RunResult r = commands("model\nout\nFILE/COMMAND=inner/stop\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.json.at("results").size(), 1u);
}

TEST_F(NestedFiles, that_call_themselves_are_an_error_with_the_chain) {
  write("inner/a.acf", "LINEAR/EIGENSOL\nFILE/COMMAND=b.acf\n");
  write("inner/b.acf", "LINEAR/EIGENSOL\n  FILE/COMMAND=../inner/a.acf\n");
  const RunResult r = commands("model\nout\nFILE/COMMAND=inner/a.acf\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("inner/b.acf:2:8: error: the command file ../inner/a.acf is called by itself"));
  EXPECT_THAT(r.err, HasSubstr("run.acf calls "));
  EXPECT_THAT(r.err, HasSubstr("inner/a.acf calls "));
  EXPECT_THAT(r.err, HasSubstr("[command-file-cycle]"));
  EXPECT_FALSE(r.wrote("out.msg"));
  EXPECT_EQ(commands("model\nout\nFILE/COMMAND=run.acf\n").status, 1);
}

TEST_F(NestedFiles, have_their_errors_at_their_own_lines) {
  write("inner/wrong.acf", "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, RM=99\nSPRINGDAMPER/1, KK=3\n");
  const RunResult r = commands("model\nout\nFILE/COMMAND=inner/wrong\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("inner/wrong.acf:3:17: error"));
  write("inner/wrong.acf", "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, RM=99\n");
  EXPECT_THAT(commands("model\nout\nFILE/COMMAND=inner/wrong\n").err, HasSubstr("inner/wrong.acf:2:21: error"));
  EXPECT_THAT(commands("model\nout\nFILE/COMMAND=nowhere\n").err, HasSubstr("run.acf:3:6: error: the command file"));
}

TEST_F(NestedFiles, a_further_model_begins_with_files_of_its_own) {
  const RunResult r = commands(
      "\nfile/model=model\nLINEAR/EIGENSOL\nSPRINGDAMPER/1, K=18\nLINEAR/EIGENSOL\nfile/model=inner/other, "
      "output_prefix=second\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(omega(r, 0), 2, 1e-11);
  EXPECT_NEAR(omega(r, 2), 3, 1e-11);
  EXPECT_EQ(r.result(3).at("model"), "oscillator");
  EXPECT_TRUE(r.result(3).contains("units"));
  EXPECT_NEAR(omega(r, 4), 5, 1e-11);
  EXPECT_TRUE(r.wrote("model.msg"));
  EXPECT_THAT(r.text("second.msg"), HasSubstr(" command: file/model=inner/other, output_prefix=second"));
  EXPECT_THAT(r.text("second.msg"), ::testing::ContainsRegex("Finished -----\nElapsed time = [0-9.]+s,  CPU time = "
                                                             "[0-9.]+s,  [0-9.]+%\n"));
}

TEST_F(NestedFiles, two_models_do_not_write_to_one_file) {
  const RunResult r = commands("FILE/MODEL=model\nLINEAR/EIGENSOL\nFILE/MODEL=model\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("[file-in-use]"));
  EXPECT_THAT(r.err, HasSubstr("OUTPUT_PREFIX"));
  EXPECT_THAT(r.err, HasSubstr("error: the message file would be written twice, to "));
}

TEST_F(NestedFiles, file_says_what_it_lacks) {
  EXPECT_THAT(commands("model\nout\nFILE\n").err, HasSubstr("FILE needs COMMAND= or MODEL="));
  EXPECT_THAT(commands("model\nout\nFILE/OUTPUT_PREFIX=x\n").err, HasSubstr("[missing-option]"));
}

TEST_F(NestedFiles, settings_may_stand_before_the_model) {
  const RunResult r =
      commands("PREFERENCES/SOLVER=CXX\nENVIRONMENT/NAME=MSC_LINEAR_PBCS_STATES\nFILE/MODEL=model\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(2).at("command"), "LINEAR/EIGENSOL");
}

TEST_F(NestedFiles, standard_input_is_a_command_file) {
  SessionOptions options;
  options.file = (folder_ / "model.adm").string();
  options.standard_input = "LINEAR/EIGENSOL\nSTOP\n";
  options.output_prefix = (folder_ / "piped").string();
  std::ostringstream out, err;
  EXPECT_EQ(run_session(options, out, err), 0) << err.str();
  EXPECT_THAT(out.str(), HasSubstr("0.3183099"));
  options.standard_input = "LINEAR/EIGENSOL, RM=99\n";
  EXPECT_EQ(run_session(options, out, err), 1);
  EXPECT_THAT(err.str(), HasSubstr("standard input:1:21: error"));
}

TEST_F(NestedFiles, a_first_line_that_names_no_file_is_told_what_it_should_be) {
  EXPECT_THAT(commands("model create model_name=car\nout\nLINEAR/EIGENSOL\n").err,
              HasSubstr("hint: the first line of a command file is the name of its dataset"));
  EXPECT_THAT(commands("Time\nLINEAR/EIGENSOL\n").err,
              HasSubstr("is the name of its dataset; behind an empty line Time is a command\n"));
  EXPECT_THAT(commands("timer\n").err, HasSubstr("is the name of its dataset\n"));
}

// What a file is, is told by what it holds.
TEST_F(NestedFiles, a_dataset_is_one_whatever_its_name) {
  const std::filesystem::path misnamed = folder_ / "misnamed.acf";
  std::filesystem::copy_file(folder_ / "model.adm", misnamed);
  SessionOptions options;
  options.file = misnamed.string();
  std::ostringstream out, err;
  EXPECT_EQ(check_file(options, out, err), 0) << err.str();
  options.commands = {"LINEAR/EIGENSOL"};
  options.output_prefix = (folder_ / "named").string();
  EXPECT_EQ(run_session(options, out, err), 0) << err.str();
  EXPECT_THAT(out.str(), HasSubstr("0.3183099"));
}

// The extension counts before the content, which may be nothing but definitions.
TEST_F(NestedFiles, a_command_file_that_defines_the_ground_anew_is_one) {
  for (const std::string first : {"model\nout\n", "\nFILE/MODEL=model, OUTPUT_PREFIX=out\n"}) {
    const RunResult r = commands(first + "PART/1, GROUND\nSPRINGDAMPER/1, K=18\n");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_TRUE(r.wrote("out.msg")) << r.err;
  }
}

TEST_F(NestedFiles, a_dataset_on_standard_input_is_refused_with_what_to_do) {
  SessionOptions options;
  options.file = "-";
  options.standard_input = read_file(folder_ / "model.adm");
  std::ostringstream out, err;
  EXPECT_EQ(check_file(options, out, err), 1);
  EXPECT_THAT(err.str(), HasSubstr("standard input holds a dataset"));
  EXPECT_THAT(err.str(), HasSubstr("hint: name the file of the dataset"));
}

}  // namespace
}  // namespace dynalin::cases::nested_files_test
