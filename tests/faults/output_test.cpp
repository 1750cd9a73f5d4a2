// Results go where they were meant to go, whole or not at all.
#include <gmock/gmock.h>

#include <thread>

#include "program.h"

namespace dynalin::faults::output_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

class Outputs : public Faults {};

TEST_F(Outputs, a_link_to_standard_output_is_written_through_and_stays_a_link) {
  fs::create_symlink("/proc/self/fd/1", folder_ / "screen");
  const Outcome r = run({"run", "model.acf", "--json", "screen"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.out.starts_with("{")) << "nothing but the results, so that another program can read them: " << r.out;
  EXPECT_TRUE(fs::is_symlink(folder_ / "screen"));
}

TEST_F(Outputs, a_dataset_and_its_commands_are_one_file_to_run) {
  const Outcome r = run({"run", "model.adm", "model.acf"});
  EXPECT_EQ(r.status, 3);
  EXPECT_THAT(r.err, HasSubstr("hint: dynalin run model.acf\n      a command file names its dataset itself"));
  EXPECT_THAT(run({"run", "model.adm", "LINEAR/EIGENSOL"}).err,
              HasSubstr("hint: dynalin run model.adm -c \"LINEAR/EIGENSOL\""));
}

TEST_F(Outputs, a_hyphen_is_standard_output) {
  const Outcome r = run({"run", "model.acf", "--json", "-"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.out.starts_with("{"));
  EXPECT_FALSE(there("-"));
  write("model.acf", "model\nmodel\nLINEAR/STATEMAT, FILE=-\n");
  EXPECT_THAT(run({"run", "model.acf", "--quiet"}).out, HasSubstr("MATRIXx"));
  EXPECT_FALSE(there("-"));
  const Outcome saved = run({"run", "model.adm", "-c", "SAVE/STATES, FILE=-"});
  EXPECT_EQ(saved.status, 0) << saved.err;
  EXPECT_TRUE(saved.out.starts_with("{")) << saved.out;
  EXPECT_FALSE(there("-"));
}

TEST_F(Outputs, standard_output_is_one_file) {
  write("model.acf", "model\nmodel\nLINEAR/STATEMAT, FILE=-\n");
  const Outcome both = run({"run", "model.acf", "--json", "-"});
  EXPECT_EQ(both.status, 1) << both.out;
  EXPECT_THAT(both.err, HasSubstr("--json are one file, standard output"));
  write("model.acf", "model\nmodel\nLINEAR/STATEMAT, FILE=-, FORMAT=MATLAB\n");
  const Outcome several = run({"run", "model.acf"});
  EXPECT_EQ(several.status, 1);
  EXPECT_THAT(several.err, HasSubstr("FILE of FORMAT=MATLAB is what the names of its files begin with"));
  EXPECT_THAT(names(), ElementsAre("model.acf", "model.adm"));
}

TEST_F(Outputs, names_are_not_empty) {
  for (const std::string option : {"--json", "--output"}) {
    const Outcome r = run({"run", "model.acf", option, ""});
    EXPECT_EQ(r.status, 3);
    EXPECT_THAT(r.err, HasSubstr(option + ": its name is empty"));
  }
}

TEST_F(Outputs, names_are_no_options) {
  const Outcome r = run({"run", "model.acf", "--json", "--quiet"});
  EXPECT_EQ(r.status, 3);
  EXPECT_THAT(r.err, HasSubstr("--json: --quiet is an option"));
  EXPECT_THAT(names(), ElementsAre("model.acf", "model.adm"));
}

TEST_F(Outputs, go_into_a_folder_under_their_own_names) {
  fs::create_directory(folder_ / "sub");
  EXPECT_EQ(run({"run", "model.acf", "--output", "sub/"}).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "sub" / "model.msg"));
  EXPECT_EQ(run({"run", "model.acf", "--output", "sub/other"}).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "sub" / "other.msg"));
}

TEST_F(Outputs, a_pipe_is_written_to_and_stays_a_pipe) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const int reader = ::open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  const Outcome r = run({"run", "model.acf", "--json", "pipe"});
  std::string bytes(65536, '\0');
  const ssize_t count = ::read(reader, bytes.data(), bytes.size());
  ::close(reader);
  EXPECT_EQ(r.status, 0) << r.err;
  ASSERT_GT(count, 0);
  EXPECT_EQ(bytes[0], '{');
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

TEST_F(Outputs, a_link_to_a_device_stays_a_link) {
  fs::create_symlink("/dev/null", folder_ / "nothing");
  fs::create_symlink("/dev/null", folder_ / "m");
  EXPECT_EQ(run({"run", "model.acf", "--json", "nothing"}).status, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "nothing"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "m"));
}

TEST_F(Outputs, a_link_to_a_file_stays_a_link_to_the_new_file) {
  fs::create_directory(root_ / "elsewhere");
  std::ofstream(root_ / "elsewhere" / "old") << "old";
  fs::create_symlink("../elsewhere/old", folder_ / "m");
  fs::create_symlink("../elsewhere/new", folder_ / "results");
  EXPECT_EQ(run({"run", "model.acf", "--json", "results"}).status, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "m"));
  EXPECT_THAT(read_text(root_ / "elsewhere" / "old"), HasSubstr("MATRIXx"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "results"));
  EXPECT_TRUE(read_text(root_ / "elsewhere" / "new").starts_with("{"));
}

TEST_F(Outputs, files_that_are_replaced_keep_their_permissions) {
  write("m", "old");
  fs::permissions(folder_ / "m", static_cast<fs::perms>(0640));
  EXPECT_EQ(run({"run", "model.acf"}).status, 0);
  EXPECT_EQ(fs::status(folder_ / "m").permissions(), static_cast<fs::perms>(0640));
}

TEST_F(Outputs, new_files_have_the_permissions_that_the_user_chose) {
  Surroundings strict;
  strict.prepare = [] { ::umask(027); };
  EXPECT_EQ(run({"run", "model.acf"}, strict).status, 0);
  EXPECT_EQ(fs::status(folder_ / "model.msg").permissions(), static_cast<fs::perms>(0640));
}

// Every file that a run reads, named in every way that leads to it.
TEST_F(Outputs, no_file_that_the_run_reads_is_overwritten) {
  write("points", "0 1\n1 2\n2 4\n3 8\n4 16\n");
  write("matrix", "ADAMSMAT\nA\nA FULL RORDER 1 1 1 (1E12.4)\n  1.0000E+00\n");
  std::string dataset = pendulum;
  dataset.insert(dataset.rfind("END"), "SPLINE/1, FILE=points\nMATRIX/1, FILE=matrix, NAME=A\n");
  write("model.adm", dataset);
  fs::create_symlink("model.adm", folder_ / "other_name");
  for (const std::string name :
       {"model.adm", "./model.adm", "../run/model.adm", "other_name", "model.acf", "points", "matrix"}) {
    const std::string commands = "model\nout\nLINEAR/STATEMAT, FILE=" + name + "\n";
    write("model.acf", commands);
    const Outcome r = run({"run", "model.acf"});
    EXPECT_EQ(r.status, 1) << name << r.out << r.err;
    EXPECT_THAT(r.err, HasSubstr("model.acf:3:23: error: FILE of LINEAR/STATEMAT, FILE=" + name + " would overwrite "));
    EXPECT_THAT(r.err, HasSubstr("[file-in-use]"));
    EXPECT_EQ(text("model.adm"), dataset) << name;
    EXPECT_EQ(text("model.acf"), commands) << name;
    EXPECT_FALSE(there("out.msg")) << "nothing runs";
  }
  const Outcome r = run({"run", "model.adm", "-c", "LINEAR/EIGENSOL", "--json", "other_name"});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("--json would overwrite model.adm, which the run reads"));
  EXPECT_EQ(text("model.adm"), dataset);
}

// Files that statements and options name besides: shapes that are drawn later, libraries, saved points.
TEST_F(Outputs, no_further_file_of_the_run_is_overwritten) {
  std::string dataset = pendulum;
  dataset.insert(dataset.rfind("END"), "GRAPHICS/1, EXTERNAL, RM=20, FILE=shape.stl, ELEMENT=all\n");
  write("model.adm", dataset);
  const std::string shape =
      "solid all\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid all\n";
  write("shape.stl", shape);
  const auto expect_refused = [&](const std::vector<std::string>& arguments, const std::string& file,
                                  const std::string& content) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 1) << r.out << r.err;
    EXPECT_THAT(r.err, HasSubstr("would overwrite " + file));
    EXPECT_EQ(text(file), content);
  };
  expect_refused({"run", "model.acf", "--json", "shape.stl"}, "shape.stl", shape);
  write("routines.so", "no library");
  expect_refused({"run", "model.acf", "--user-library", "routines.so", "--json", "routines.so"}, "routines.so",
                 "no library");
  ASSERT_EQ(run({"run", "model.adm", "-c", "SAVE/STATES, FILE=s.save", "-c", "SAVE/SYSTEM, FILE=y.save"}).status, 0);
  const std::string states = text("s.save"), system = text("y.save");
  expect_refused({"run", "model.adm", "-c", "RELOAD/STATES, FILE=s.save", "-c", "LINEAR/STATEMAT, FILE=./s.save"},
                 "s.save", states);
  expect_refused({"run", "model.adm", "-c", "RELOAD/SYSTEM, FILE=y.save", "-c", "LINEAR/EIGENSOL", "--json", "y.save"},
                 "y.save", system);
  // What the run has saved itself is its own.
  const std::string save = "SAVE/STATES, FILE=own.save";
  EXPECT_EQ(run({"run", "model.adm", "-c", save, "-c", "RELOAD/STATES, FILE=own.save", "-c", save}).status, 0);
}

TEST_F(Outputs, no_file_of_a_deck_or_a_reduction_is_overwritten) {
  const std::string more =
      "EIGC,1,CLAN,,,,,4\nGRID,1\nCELAS2,1,100.,1,1\nCONM2,2,1,,2.\nSPC1,1,23456,1\nPARAM,GRDPNT,0\n";
  write("deck.dat", "SOL 107\nCEND\nCMETHOD = 1\nSPC = 1\nBEGIN BULK\nINCLUDE 'more.bdf'\nENDDATA\n");
  write("more.bdf", more);
  ASSERT_EQ(run({"nastran", "solve", "deck.dat", "--json", "fresh"}).status, 0) << text("more.bdf");
  for (const std::string name : {"deck.dat", "./more.bdf"}) {
    const std::string before = text(name);
    const Outcome r = run({"nastran", "solve", "deck.dat", "--json", name});
    EXPECT_EQ(r.status, 1) << r.out;
    EXPECT_THAT(r.err, HasSubstr("--json would overwrite "));
    EXPECT_EQ(text(name), before);
  }
  const std::string matrix = "%%MatrixMarket matrix coordinate real general\n3 3 3\n1 1 4\n2 2 4\n3 3 4\n";
  write("k.mtx", matrix), write("m.mtx", matrix), write("k.dof", "1.1\n1.2\n1.3\n"), write("nodes", "1, 0, 0, 0\n");
  for (const std::string name : {"k.mtx", "m.mtx", "k.dof", "./nodes"}) {
    const std::string before = text(name);
    const Outcome r = run({"reduce", "--stiffness", "k.mtx", "--mass", "m.mtx", "--nodes", "nodes", "--interface", "1",
                           "--translations-only", "--output", name});
    EXPECT_EQ(r.status, 1) << r.out;
    EXPECT_THAT(r.err, HasSubstr("--output would overwrite ")) << name;
    EXPECT_EQ(text(name), before);
  }
}

TEST_F(Outputs, two_results_are_not_written_to_one_file) {
  write("model.acf", "model\nout\nLINEAR/STATEMAT, FILE=out.msg\n");
  EXPECT_THAT(run({"run", "model.acf"}).err, HasSubstr("and the message file are one file"));
  write("model.acf", "model\nout\nLINEAR/STATEMAT, FILE=m\n");
  EXPECT_THAT(run({"run", "model.acf", "--json", "./m"}).err, HasSubstr("and --json are one file"));
  EXPECT_THAT(names(), UnorderedElementsAre("model.acf", "model.adm"));
}

TEST_F(Outputs, a_file_that_two_commands_name_differently_holds_what_the_last_one_wrote) {
  fs::create_symlink("m", folder_ / "link");
  std::string dataset = pendulum;
  dataset.insert(dataset.rfind("END"), "VARIABLE/1, FUNCTION=1\nPOUTPUT/1, VARIABLES=1\n");
  write("model.adm", dataset);
  write("model.acf",
        "model\nout\nLINEAR/STATEMAT, FILE=m, POUTPUT=1\nLINEAR/STATEMAT, FILE=./m, POUTPUT=1\n"
        "LINEAR/STATEMAT, FILE=link\n");
  EXPECT_EQ(run({"run", "model.acf"}).status, 0);
  EXPECT_THAT(text("m"), Not(HasSubstr("POUTPUT")));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_THAT(names(), UnorderedElementsAre("link", "m", "model.acf", "model.adm", "out.msg"));
}

TEST_F(Outputs, names_that_cannot_be_written_are_refused_before_anything_runs) {
  fs::create_directory(folder_ / "folder");
  for (const auto& [name, reason] : {std::pair("folder", "it is a directory"), std::pair("nowhere/x", "no folder")}) {
    const Outcome r = run({"run", "model.acf", "--json", name});
    EXPECT_EQ(r.status, 1);
    EXPECT_THAT(r.err, HasSubstr(reason));
    EXPECT_THAT(r.err, HasSubstr("[unwritable-file]"));
    EXPECT_EQ(r.out, "");
  }
}

// --- streams that are closed or full

TEST_F(Outputs, nothing_of_closed_streams_ends_up_in_files) {
  Outcome whole = run({"run", "model.acf", "--json", "results"});
  ASSERT_EQ(whole.status, 0) << whole.err;
  const std::string json = text("results");
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    fs::remove(folder_ / "results");
    Surroundings closed;
    closed.prepare = [stream] { ::close(stream); };
    const Outcome r = run({"run", "model.acf", "--json", "results"}, closed);
    EXPECT_EQ(r.status, stream == STDOUT_FILENO ? 2 : 0) << stream << r.err;
    EXPECT_EQ(text("results"), json) << stream;
    EXPECT_TRUE(text("m").starts_with("MATRIXx")) << stream;
  }
}

TEST_F(Outputs, a_full_or_closed_standard_output_is_an_error) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", "model.acf"},
                                                    {"run", "model.acf", "--json", "-"},
                                                    {"check", "model.acf"},
                                                    {"help"},
                                                    {"explain", "bad-id"},
                                                    {"--help"},
                                                    {"--version"}}) {
    Surroundings full;
    full.prepare = [] { redirect(STDOUT_FILENO, "/dev/full", O_WRONLY); };
    const Outcome r = run(arguments, full);
    EXPECT_EQ(r.status, 2) << arguments[0];
    EXPECT_THAT(r.err, HasSubstr("standard output cannot be written: No space left on device")) << arguments[0];
    Surroundings closed;
    closed.prepare = [] { ::close(STDOUT_FILENO); };
    EXPECT_EQ(run(arguments, closed).status, 2) << arguments[0];
  }
}

TEST_F(Outputs, a_reader_that_has_gone_is_an_error_and_no_sudden_end) {
  Surroundings gone;
  gone.prepare = [] {
    int ends[2];
    if (::pipe(ends) != 0) ::_exit(97);
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]), ::close(ends[1]);
  };
  const Outcome r = run({"run", "model.acf"}, gone);
  EXPECT_EQ(r.status, 2) << r.signal;
  EXPECT_THAT(r.err, HasSubstr("standard output cannot be written: Broken pipe"));
  EXPECT_TRUE(there("model.msg"));
}

// --- disks that are full or broken

class Disks : public Faults {
 protected:
  void SetUp() override {
    Faults::SetUp();
    if (sanitized) GTEST_SKIP();
    write("m", "old matrices");
  }
  // Exit status, name of the file, reason; and everything is as it was before the run.
  void expect_untouched(const Outcome& r, const std::string& message) const {
    EXPECT_EQ(r.status, 2) << r.signal << r.err;
    EXPECT_THAT(r.err, HasSubstr(message));
    EXPECT_THAT(names(), ElementsAre("m", "model.acf", "model.adm"));
    EXPECT_EQ(text("m"), "old matrices");
  }
};

TEST_F(Disks, a_full_disk_leaves_no_file_half_written) {
  for (const std::string bytes : {"0", "10", "1000"}) {
    expect_untouched(run({"run", "model.acf"}, fault("FAULT_WRITE", "/.dynalin-", bytes)), "No space left on device");
  }
}

TEST_F(Disks, a_limit_on_the_size_of_files_is_an_error_that_names_the_file) {
  Surroundings limited;
  limited.prepare = [] { limit(RLIMIT_FSIZE, 300); };
  const Outcome r = run({"run", "model.acf", "--quiet"}, limited);
  EXPECT_EQ(r.status, 2) << r.signal;
  EXPECT_THAT(r.err, HasSubstr("error: cannot write "));
  EXPECT_THAT(r.err, HasSubstr("File too large"));
  EXPECT_THAT(names(), ElementsAre("m", "model.acf", "model.adm"));
}

TEST_F(Disks, a_device_that_is_full_is_an_error_and_no_other_file_appears) {
  expect_untouched(run({"run", "model.acf", "--json", "/dev/full"}),
                   "error: cannot write /dev/full: No space left on device");
}

TEST_F(Disks, what_cannot_be_synced_is_not_taken_as_written) {
  expect_untouched(run({"run", "model.acf"}, fault("FAULT_SYNC", "/.dynalin-")), "Input/output error");
}

TEST_F(Disks, a_file_that_cannot_be_renamed_takes_the_others_back) {
  expect_untouched(run({"run", "model.acf"}, fault("FAULT_RENAME", "model.msg")), "error: cannot write ");
  expect_untouched(run({"run", "model.acf", "--json", "results"}, fault("FAULT_RENAME", "results")),
                   "error: cannot write results: Input/output error");
}

TEST_F(Disks, the_files_of_a_run_that_succeeds_are_all_there_and_nothing_else) {
  EXPECT_EQ(run({"run", "model.acf", "--json", "results"}).status, 0);
  EXPECT_THAT(names(), ElementsAre("m", "model.acf", "model.adm", "model.msg", "results"));
  EXPECT_THAT(text("m"), HasSubstr("MATRIXx"));
}

TEST_F(Disks, a_linear_command_that_fails_leaves_nothing_of_its_result) {
  write("model.adm",
        "Sleigh\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, VX=1\nMARKER/20\n"
        "JOINT/1, PLANAR, I=20, J=1\nGCON/1, FUNCTION=VY(20,0,20)\nRESULTS/XRF\nEND\n");
  write("model.acf", "model\nmodel\nLINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n");
  EXPECT_EQ(run({"run", "model.acf", "--json", "results"}).status, 2);
  EXPECT_THAT(text("model.msg"), Not(HasSubstr("E I G E N V A L U E S")));
  EXPECT_THAT(text("results"), Not(HasSubstr("eigenvalues")));
  EXPECT_THAT(text("model.res"), Not(HasSubstr("dl:Mode")));
  EXPECT_FALSE(there("model.txt"));
}

// --- files that grow as the run goes on

class GrowingFiles : public Disks {
 protected:
  void SetUp() override {
    Disks::SetUp();
    if (sanitized) return;
    std::string dataset = pendulum;
    dataset.insert(dataset.rfind("END"), "OUTPUT/REQSAVE, GRSAVE\nRESULTS/XRF\nREQUEST/1, VELOCITY, I=20\n");
    write("model.adm", dataset);
  }
  std::size_t temporary_files() const {
    const auto all = names();
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const std::string& n) { return n.starts_with(".dynalin-"); }));
  }
  // The program has written all and waits for a reader of the pipe.
  pid_t started() const {
    EXPECT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    const pid_t child = start({"run", "model.acf", "--json", "pipe"});
    for (int k = 0; k < 500 && temporary_files() < 6; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(temporary_files(), 6u);
    return child;
  }
};

TEST_F(GrowingFiles, are_all_there_at_the_end) {
  EXPECT_EQ(run({"run", "model.acf"}).status, 0);
  EXPECT_THAT(names(), ElementsAre("m", "model.acf", "model.adm", "model.gra", "model.msg", "model.out", "model.req",
                                   "model.res"));
}

TEST_F(GrowingFiles, have_no_name_of_the_run_after_a_kill) {
  const pid_t child = started();
  ::kill(child, SIGKILL);
  EXPECT_EQ(finish(child).signal, SIGKILL);
  for (const std::string& name : names())
    EXPECT_TRUE(name.starts_with(".dynalin-") || name == "m" || name == "model.acf" || name == "model.adm" ||
                name == "pipe")
        << name;
  EXPECT_EQ(text("m"), "old matrices");
}

TEST_F(GrowingFiles, go_with_a_signal) {
  const pid_t child = started();
  ::kill(child, SIGTERM);
  EXPECT_EQ(finish(child).signal, SIGTERM);
  EXPECT_THAT(names(), ElementsAre("m", "model.acf", "model.adm", "pipe"));
}

TEST_F(GrowingFiles, of_a_full_disk_are_not_there) {
  for (const std::string bytes : {"0", "300", "1500", "4000"}) {
    expect_untouched(run({"run", "model.acf"}, fault("FAULT_WRITE", "/.dynalin-", bytes)), "No space left on device");
  }
}

// --- signals

TEST_F(Disks, a_signal_takes_the_temporary_files_with_it) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1, SIGALRM}) {
    // The program waits for a reader when all else is on the disk under temporary names.
    const pid_t child = start({"run", "model.acf", "--json", "pipe"});
    for (int k = 0; k < 500 && names().size() < 6; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(names().size(), 6u);
    ::kill(child, signal);
    EXPECT_EQ(finish(child).signal, signal);
    EXPECT_THAT(names(), ElementsAre("m", "model.acf", "model.adm", "pipe"));
    EXPECT_EQ(text("m"), "old matrices");
  }
}

// The second one may come while the first is seen to, and to another thread.
TEST_F(Disks, two_signals_take_the_temporary_files_with_them) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  Surroundings threads;
  threads.prepare = [] { ::unsetenv("OPENBLAS_NUM_THREADS"); };
  for (int times = 0; times < 10; ++times) {
    const pid_t child = start({"run", "model.acf", "--json", "pipe"}, threads);
    for (int k = 0; k < 500 && names().size() < 6; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(child, SIGTERM), ::kill(child, SIGTERM), ::kill(child, SIGINT);
    finish(child);
    EXPECT_THAT(names(), ElementsAre("m", "model.acf", "model.adm", "pipe"));
  }
}

TEST_F(Disks, a_signal_that_is_ignored_ends_nothing) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  Surroundings ignoring;
  ignoring.prepare = [] { ::signal(SIGHUP, SIG_IGN); };
  const pid_t child = start({"run", "model.acf", "--json", "pipe"}, ignoring);
  for (int k = 0; k < 500 && names().size() < 6; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(child, SIGHUP);
  const int reader = ::open((folder_ / "pipe").c_str(), O_RDONLY);  // the program goes on
  std::string bytes(65536, '\0');
  while (::read(reader, bytes.data(), bytes.size()) > 0) {
  }
  ::close(reader);
  EXPECT_EQ(finish(child).status, 0);
}

}  // namespace
}  // namespace dynalin::faults::output_test
