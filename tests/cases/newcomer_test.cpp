// What people do who know the language and not the program: the message must lead them on.
#include <gmock/gmock.h>

#include <algorithm>

#include "cases/run.h"

namespace dynalin::cases::newcomer_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Newcomer : public Cases {
 protected:
  RunResult check(const std::string& statements) const {
    return run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n" +
                   statements + "\nEND\n",
               "LINEAR/EIGENSOL\n");
  }
  RunResult run_with(const std::string& file, const std::vector<std::string>& commands) const {
    SessionOptions options;
    options.file = (folder_ / file).string();
    options.commands = commands;
    std::ostringstream out, err;
    RunResult r;
    r.status = run_session(options, out, err);
    r.out = out.str(), r.err = err.str(), r.folder = folder_;
    return r;
  }
  static std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
};

const std::string pendulum =
    "pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/10, PART=1\n"
    "PART/2, QG=0,-1,0, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=0,1,0\n"
    "JOINT/1, REVOLUTE, I=21, J=10\nEND\n";

TEST_F(Newcomer, writes_a_type_that_does_not_exist) {
  const RunResult r = check("JOINT/1, HINGE, I=20, J=1");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, AllOf(HasSubstr(":7:10: error: HINGE is no type of JOINT [missing-variant]"),
                           HasSubstr("one of REVOLUTE, TRANSLATIONAL")));
  EXPECT_THAT(check("JOINT/1, I=20, J=1").err, HasSubstr(":7:1: error: JOINT needs its type"));
  EXPECT_THAT(check("JOINT/1, S, I=20, J=1").err, AllOf(HasSubstr(":7:10: error: S may mean several types of JOINT"),
                                                        HasSubstr("hint: it could be SPHERICAL or SCREW")));
}

TEST_F(Newcomer, writes_units_behind_numbers) {
  const RunResult r = check("PART/3, MASS=1kg, CM=30, IP=1,1,1\nMARKER/30");
  EXPECT_THAT(r.err, AllOf(HasSubstr(":7:15: error: MASS takes plain numbers, found 'kg'"),
                           HasSubstr("hint: units are not written behind numbers; UNITS states them")));
}

TEST_F(Newcomer, shortens_a_unit_too_much) {
  EXPECT_THAT(run("t\nUNITS/FORCE=POUND, MASS=SLUG, LENGTH=FOOT, TIME=SECOND\nPART/1, GROUND\nEND\n", "").err,
              AllOf(HasSubstr("POUND may mean several units of FORCE"), HasSubstr("POUND_FORCE or POUNDAL")));
}

TEST_F(Newcomer, forgets_parentheses_of_a_function) {
  EXPECT_THAT(check("REQUEST/1, F2=SIN TIME").err,
              HasSubstr("hint: an operator or parentheses are missing before it if it belongs to F2"));
}

TEST_F(Newcomer, draws_a_bushing_at_right_angles) {
  write("model.adm",
        "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
        "MARKER/21, XP=0,0,-1, ZP=0,1,0\nBUSHING/1, I=21, J=1, K=1,1,1, KT=1,1,1\nEND\n");
  const RunResult r = run_with("model.adm", {"LINEAR/EIGENSOL"});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err,
              HasSubstr(":8:1: warning: BUSHING/1 reads the angle AY of MARKER/21 in MARKER/1, which is not "
                        "defined as drawn: the z axis of MARKER/21 is along the y axis of MARKER/1 [skew-axes]"));
  EXPECT_THAT(r.err,
              HasSubstr("BUSHING/1: the angle AY is not defined where the z axis of I is along the y axis of J"));
}

TEST_F(Newcomer, writes_lists_in_parentheses) {
  EXPECT_THAT(check("MARKER/30, PART=1, QP=(1,2,3)").err, HasSubstr("hint: lists have no parentheses: QP=1, 2, 3"));
}

TEST_F(Newcomer, forgets_the_prefix) {
  write("model.adm", pendulum);
  write("run.acf", "model\n  lin/eig\nstop\n");
  const RunResult r = run_file("run.acf");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, AllOf(HasSubstr("run.acf:2:3: error: the line behind the model is the prefix of the output files"),
                           HasSubstr("[missing-prefix]"), HasSubstr("an empty line")));
  // A folder may be called like a command.
  std::filesystem::create_directory(folder_ / "lin");
  write("run.acf", "model\nlin/first\nlin/eig\nstop\n");
  EXPECT_EQ(run_file("run.acf").status, 0);
  EXPECT_TRUE(r.wrote("lin/first.msg"));
}

TEST_F(Newcomer, runs_a_dataset_of_another_extension) {
  write("model.dat", pendulum);
  const RunResult r = run_with("model.dat", {"LINEAR/EIGENSOL"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("moves most"));
  const RunResult alone = run_with("model.dat", {});
  EXPECT_EQ(alone.status, wrong_usage);
  EXPECT_THAT(alone.err, HasSubstr("model.dat states a model, and no command says what to do with it"));
  SessionOptions options;
  options.file = (folder_ / "model.dat").string();
  std::ostringstream out, err;
  EXPECT_EQ(check_file(options, out, err), done) << err.str();
  // Commands alone are none.
  write("run.txt", "FILE/MODEL=model.dat\nPART/2, MASS=2\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(run_with("run.txt", {}).status, 0);
}

// A check warns of what a run would say before its first command, and a run says it once.
TEST_F(Newcomer, hears_of_missing_units_from_a_check) {
  write("model.adm", "t\nPART/1, GROUND\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nEND\n");
  SessionOptions options;
  options.file = (folder_ / "model.adm").string();
  std::ostringstream out, err;
  EXPECT_EQ(check_file(options, out, err), done);
  EXPECT_THAT(err.str(), HasSubstr("the dataset states no UNITS"));
  const RunResult r = run_with("model.adm", {"LINEAR/EIGENSOL"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("[no-units]"));
  EXPECT_EQ(r.err.find("[no-units]"), r.err.rfind("[no-units]")) << r.err;
}

TEST_F(Newcomer, gives_commands_to_a_command_file) {
  write("model.adm", pendulum);
  write("run.acf", "model\nout\nLINEAR/EIGENSOL\n");
  const RunResult r = run_with("run.acf", {"SIMULATE/STATICS"});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("error: -c gives commands for a dataset"));
}

TEST_F(Newcomer, leaves_the_extension_out) {
  write("model.adm", pendulum);
  const RunResult r = run_with("model", {});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("model.adm exists"));
}

// Links that cannot reach each other: the terminal has the beginning and the end, the message file all of it.
TEST_F(Newcomer, draws_what_cannot_be_assembled) {
  const RunResult r =
      run("four bars\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/10\nMARKER/11, QP=9,0,0\n"
          "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\nMARKER/22, QP=0,1,0\n"
          "PART/3, MASS=3, CM=30, IP=1,1,1, QG=0,1,0\nMARKER/30\nMARKER/32, QP=4,1,0\n"
          "PART/4, MASS=2.5, CM=40, IP=1,1,1, QG=4,0,0\nMARKER/40\nMARKER/42, QP=0,2,0\n"
          "JOINT/1, REVOLUTE, I=20, J=10\nJOINT/2, REVOLUTE, I=30, J=22\nJOINT/3, REVOLUTE, I=32, J=42\n"
          "JOINT/4, REVOLUTE, I=40, J=11\nEND\n",
          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err,
              AllOf(HasSubstr("could not be assembled"), HasSubstr("drawn too far"), HasSubstr("more lines in")));
  EXPECT_LT(lines(r.err), 16);
  EXPECT_GT(lines(r.message), 50);
  EXPECT_THAT(r.message, Not(HasSubstr("more lines in")));
}

// Every line that is printed refers to something: the legend of a mark stands where a mark stands.
TEST_F(Newcomer, sees_the_legend_of_a_mark_only_with_the_mark) {
  for (const auto& [folder, file] :
       {std::pair{"rotating_slider", "rotating_slider.acf"}, std::pair{"spring_pendulum", "spring_pendulum.acf"}}) {
    const RunResult r = run_example(folder, file);
    ASSERT_EQ(r.status, 0) << r.err;
    for (const std::string& text : {r.out, r.message}) {
      const auto legend = text.find("? the error bound");
      const auto mark = text.find("?");
      EXPECT_EQ(legend != std::string::npos, mark != legend) << text;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::newcomer_test
