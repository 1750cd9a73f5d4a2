// Where a run writes, and what it says of it: names are relative to where they are written, in a command file to its
// folder, on the command line to the current one.
#include <gmock/gmock.h>

#include <cstdlib>

#include "cases/run.h"
#include "places/examples.h"

namespace dynalin::cases::output_place_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string slider =
    "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, "
    "TRANSLATIONAL, "
    "I=20, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-DZ(20)\nEND\n";

class OutputPlaces : public Cases {
 protected:
  void SetUp() override {
    Cases::SetUp();
    before_ = fs::current_path();
    fs::create_directories(folder_ / "here/out");
    fs::create_directories(folder_ / "models");
    write("models/model.adm", slider);
    fs::current_path(folder_ / "here");
  }
  void TearDown() override {
    fs::current_path(before_);
    Cases::TearDown();
  }
  struct Ran {
    int status;
    std::string out, err;
  };
  static Ran ran(const SessionOptions& options) {
    std::ostringstream out, err;
    const int status = run_session(options, out, err);
    return {status, out.str(), err.str()};
  }
  fs::path before_;
};

TEST_F(OutputPlaces, of_names_on_the_command_line_are_the_current_folder) {
  SessionOptions options;
  options.file = "../models/model.adm";
  options.commands = {"linear/statemat, file=matrices", "linear/eigensol, coords=1"};
  options.json = "all.json";
  const Ran r = ran(options);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(fs::exists("matrices"));
  EXPECT_TRUE(fs::exists("all.json"));
  // What the run names after the dataset stands beside it.
  EXPECT_TRUE(fs::exists("../models/model.msg"));
  EXPECT_TRUE(fs::exists("../models/model.txt"));
  EXPECT_THAT(r.out,
              HasSubstr("wrote matrices\nwrote ../models/model.txt\nwrote ../models/model.msg\nwrote all.json\n"));
  EXPECT_THAT(r.out, HasSubstr("state matrices of 2 states: matrices\n"));
  EXPECT_THAT(r.out, HasSubstr("the tables of modes are in ../models/model.txt\n"));
  const auto json = nlohmann::json::parse(read_file("all.json"));
  EXPECT_EQ(json.at("files"),
            (std::vector<std::string>{"matrices", "../models/model.txt", "../models/model.msg", "all.json"}));
}

TEST_F(OutputPlaces, of_names_in_a_command_file_are_its_folder) {
  write("models/run.acf", "model\nresults\nLINEAR/STATEMAT, FILE=matrices\nLINEAR/MKB, FILE=mat, FORMAT=MATLAB\n");
  SessionOptions options;
  options.file = "../models/run.acf";
  const Ran r = ran(options);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(fs::exists("../models/matrices"));
  EXPECT_TRUE(fs::exists("../models/matm"));
  EXPECT_TRUE(fs::exists("../models/results.msg"));
  EXPECT_THAT(r.out, AllOf(HasSubstr("state matrices of 2 states: ../models/matrices\n"),
                           HasSubstr("second-order matrices of 1 state: ../models/mat*, a file each\n"),
                           HasSubstr("wrote ../models/matkb\n"), HasSubstr("wrote ../models/results.msg\n")));
  // A prefix on the command line moves what has its name, and leaves what the command file names.
  options.output_prefix = "out/moved";
  const Ran moved = ran(options);
  ASSERT_EQ(moved.status, 0) << moved.err;
  EXPECT_TRUE(fs::exists("out/moved.msg"));
  EXPECT_THAT(moved.out, AllOf(HasSubstr("wrote out/moved.msg\n"), HasSubstr("wrote ../models/matrices\n")));
}

TEST_F(OutputPlaces, are_not_named_where_nothing_is_to_be_said) {
  SessionOptions options;
  options.file = "../models/model.adm";
  options.commands = {"linear/eigensol"};
  options.quiet = true;
  EXPECT_EQ(ran(options).out, "");
  // Warnings and errors are said, whatever fails, and nothing besides.
  options.commands = {"info/disp, i=20", "time", "lsolver/umf", "equilibrium/list", "simulate/dynamics, end=-1"};
  const Ran failed = ran(options);
  EXPECT_EQ(failed.status, 2);
  EXPECT_EQ(failed.out, "");
  EXPECT_THAT(failed.err, AllOf(HasSubstr("warning: nothing here acts on LSOLVER/UMF"),
                                HasSubstr("error: simulate/dynamics, end=-1 failed"), Not(HasSubstr("wrote"))));
  options.commands = {"linear/eigensol"};
  options.quiet = false;
  options.json = "-";
  EXPECT_THAT(ran(options).out, AllOf(HasSubstr("{\n \"results\""), Not(HasSubstr("wrote"))));
}

TEST_F(OutputPlaces, a_dataset_without_commands_says_what_to_do) {
  SessionOptions options;
  options.file = "../models/model.adm";
  const Ran r = ran(options);
  EXPECT_EQ(r.status, 3);
  EXPECT_THAT(r.err,
              AllOf(HasSubstr("error: ../models/model.adm states a model, and no command says what to do with it"),
                    HasSubstr("hint: dynalin run ../models/model.adm -c simulate/statics -c linear/eigensol")));
  EXPECT_FALSE(fs::exists("../models/model.msg"));
  // What is wrong with it comes first.
  write("models/model.adm", "t\nPART/1, GROUND\nPART/1\nEND\n");
  EXPECT_EQ(ran(options).status, 1);
  write("models/run.acf", "model\nmodel\nLINEAR/EIGENSOL\n");
  options.file = "../models/run.acf";
  options.commands = {"linear/eigensol"};
  const Ran both = ran(options);
  EXPECT_EQ(both.status, 1);
  EXPECT_THAT(both.err, HasSubstr("-c gives commands for a dataset"));
}

TEST_F(OutputPlaces, frequencies_have_the_unit_of_the_dataset) {
  const auto head = [&](const std::string& units) {
    std::string text = slider;
    text.replace(text.find("UNITS/SYSTEM=MKS"), 16, units);
    write("models/model.adm", text);
    SessionOptions options;
    options.file = "../models/model.adm";
    options.commands = {"linear/eigensol"};
    options.bounds = true;
    const std::string out = ran(options).out;
    const auto second = out.find('\n', out.find("mode ")) + 1;
    return out.substr(second, out.find('\n', second) - second);
  };
  EXPECT_THAT(head("UNITS/SYSTEM=MKS"), AllOf(HasSubstr("cycles/s "), Not(HasSubstr("time"))));
  const std::string of = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=";
  EXPECT_THAT(head(of + "SECOND"), HasSubstr("cycles/s "));
  EXPECT_THAT(head(of + "MILLISECONDS"), HasSubstr("cycles/ms "));
  EXPECT_THAT(head(of + "MINUTE"), HasSubstr("cycles/min "));
  EXPECT_THAT(head("UNITS/UCF=1"), HasSubstr("cycles/time"));
  EXPECT_THAT(head("UNITS/SYSTEM=NONE"), HasSubstr("cycles/time"));
}

// In a checkout: what running the examples writes is ignored.
TEST_F(OutputPlaces, of_examples_leave_nothing_that_git_would_add) {
  const fs::path examples = examples_folder(), copy = folder_ / "checkout";
  fs::create_directories(copy);
  fs::copy(examples, copy / "examples", fs::copy_options::recursive);
  fs::copy_file(examples.parent_path() / ".gitignore", copy / ".gitignore");
  fs::current_path(copy);
  if (std::system("git init -q . 2>/dev/null && git add -A") != 0) GTEST_SKIP() << "git is not here";
  std::size_t runs = 0;
  for (const fs::path& file : files_of_examples("examples", ".acf")) {
    SessionOptions options;
    options.file = file.string();
    const Ran r = ran(options);
    EXPECT_EQ(r.status, 0) << options.file << r.err;
    ++runs;
  }
  EXPECT_GE(runs, 5u);
  ASSERT_EQ(std::system("git ls-files --others --exclude-standard > ../untracked"), 0);
  EXPECT_EQ(read_file("../untracked"), "");
}

}  // namespace
}  // namespace dynalin::cases::output_place_test
