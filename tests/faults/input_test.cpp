// What cannot be read whole is not read at all, and what is too large is an error that says so.
#include <gmock/gmock.h>

#include "program.h"

namespace dynalin::faults::input_test {
namespace {

using ::testing::HasSubstr;

class Inputs : public Faults {
 protected:
  void expect_refused(const Outcome& r, const std::string& name, const std::string& reason) const {
    EXPECT_EQ(r.status, 1) << name << " signal " << r.signal << r.err;
    EXPECT_THAT(r.err, HasSubstr(name));
    EXPECT_THAT(r.err, HasSubstr("cannot be read: " + reason));
  }
  Outcome run_dataset(const std::string& name, const Surroundings& surroundings = {}) const {
    return run({"run", name, "-c", "LINEAR/EIGENSOL"}, surroundings);
  }
};

// An error of the disk ends the reading as the end of the file does; what was read until then is a model as well.
TEST_F(Inputs, a_read_error_is_not_the_end_of_a_file) {
  if (sanitized) GTEST_SKIP();
  write("points", "0 1\n1 2\n2 4\n3 8\n4 16\n5 32\n");
  write("matrix", "ADAMSMAT\nA\nA FULL RORDER 1 1 1 (1E12.4)\n  1.0000E+00\n");
  std::string dataset = pendulum;
  dataset.insert(dataset.rfind("END"), "SPLINE/1, FILE=points\nMATRIX/1, FILE=matrix, NAME=A\n");
  write("model.adm", dataset);
  ASSERT_EQ(run({"run", "model.acf"}).status, 0);
  for (const std::string name : {"model.adm", "model.acf", "points", "matrix"}) {
    for (const std::string bytes : {"0", "14", "20"}) {
      expect_refused(run({"run", "model.acf"}, fault("FAULT_READ", "/" + name, bytes)), name, "Input/output error");
    }
  }
}

TEST_F(Inputs, a_file_that_cannot_be_read_at_any_place_is_refused) {
  fs::create_symlink("/proc/self/mem", folder_ / "memory.adm");
  expect_refused(run_dataset("memory.adm"), "memory.adm", "");
}

TEST_F(Inputs, commands_on_standard_input_are_checked_as_they_are_run) {
  const auto check = [&](const std::string& commands) {
    write("commands", commands);
    return run({"check", "-"}, {{}, [] { redirect(STDIN_FILENO, "commands", O_RDONLY); }});
  };
  const Outcome sound = check("model\nmodel\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_EQ(sound.out, "standard input: no errors\n");
  const Outcome wrong = check("model\nmodel\nLINEAR/EIGENSOLE, RM=99\n");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.err, HasSubstr("standard input:3:8: error:"));
}

// No file is written beside a device.
TEST_F(Inputs, a_dataset_on_a_device_leaves_its_files_where_it_is_run) {
  const Outcome r =
      run({"run", "/dev/stdin", "-c", "LINEAR/EIGENSOL"}, {{}, [] { redirect(STDIN_FILENO, "model.adm", O_RDONLY); }});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("wrote stdin.msg\n"));
  EXPECT_TRUE(fs::exists(folder_ / "stdin.msg"));
}

TEST_F(Inputs, a_value_for_routines_that_is_no_finite_number_is_wrong_usage) {
  for (const std::string value : {"nan", "inf", "-inf", "none"}) {
    const Outcome r = run({"run", "model.adm", "-c", "LINEAR/EIGENSOL", "--user-value", value});
    EXPECT_EQ(r.status, 3) << value << r.err;
    EXPECT_THAT(r.err, HasSubstr("--user-value")) << value;
  }
}

TEST_F(Inputs, words_that_are_neither_subcommands_nor_files_are_named) {
  const Outcome r = run({"linearize"});
  EXPECT_EQ(r.status, 3);
  EXPECT_EQ(r.err, "error: linearize is no subcommand, and there is no such file\n");
}

TEST_F(Inputs, libraries_that_are_not_there_are_missed_whether_they_are_called_or_not) {
  const Outcome r = run({"check", "model.adm", "--user-library", "nosuch.so"});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("nosuch.so cannot be loaded: there is no such file"));
}

TEST_F(Inputs, folders_pipes_and_devices_are_no_datasets) {
  fs::create_directory(folder_ / "folder.adm");
  expect_refused(run_dataset("folder.adm"), "folder.adm", "it is a directory");
  ASSERT_EQ(::mkfifo((folder_ / "pipe.adm").c_str(), 0600), 0);
  expect_refused(run_dataset("pipe.adm"), "pipe.adm", "it is a pipe");
  for (const auto device : {"/dev/zero", "/dev/null", "/dev/tty"}) {
    fs::remove(folder_ / "device.adm");
    fs::create_symlink(device, folder_ / "device.adm");
    const Outcome r = run_dataset("device.adm");
    EXPECT_EQ(r.status, 1);
    EXPECT_THAT(r.err, HasSubstr("device.adm cannot be read: "));
  }
  // The terminal of the last one may not be there at all.
  fs::remove(folder_ / "device.adm");
  fs::create_symlink("/dev/zero", folder_ / "device.adm");
  for (const std::string name : {"folder", "pipe", "device"}) {
    write("model.acf", name + ".adm\nout\nLINEAR/EIGENSOL\n");
    const Outcome r = run({"run", "model.acf"});
    EXPECT_EQ(r.status, 1);
    EXPECT_THAT(r.err, HasSubstr("model.acf:1:1: error: the dataset " + name + ".adm cannot be read: it is a"));
  }
}

TEST_F(Inputs, folders_pipes_and_devices_are_no_files_of_numbers) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "endless");
  for (const std::string name : {"..", "pipe", "endless"}) {
    for (const std::string& statement :
         std::vector<std::string>{"SPLINE/1, FILE=" + name, "MATRIX/1, NAME=A, FILE=" + name}) {
      std::string dataset = pendulum;
      dataset.insert(dataset.rfind("END"), statement + "\n");
      write("model.adm", dataset);
      const Outcome r = run({"run", "model.acf"});
      EXPECT_EQ(r.status, 1) << statement << r.signal;
      EXPECT_THAT(r.err, HasSubstr("cannot be read: it is a")) << statement;
      EXPECT_THAT(r.err, HasSubstr("[unreadable-file]")) << statement;
    }
  }
}

TEST_F(Inputs, a_dataset_longer_than_any_is_refused_before_it_is_read) {
  write("long.adm", pendulum);
  fs::resize_file(folder_ / "long.adm", 5ULL << 30);  // a hole: no disk is needed
  expect_refused(run_dataset("long.adm"), "long.adm", "it is longer than 4 GiB");
}

// --- memory

class Memory : public Faults {
 protected:
  void SetUp() override {
    Faults::SetUp();
    if (sanitized) GTEST_SKIP();
  }
  Outcome run_within(rlim_t bytes) const {
    Surroundings little;
    little.prepare = [bytes] { limit(RLIMIT_AS, bytes); };
    return run({"run", "model.acf", "--json", "results"}, little);
  }
  void expect_out_of_memory(const Outcome& r) const {
    EXPECT_EQ(r.status, 2) << "signal " << r.signal << r.err;
    EXPECT_THAT(r.err, HasSubstr("error: out of memory"));
    EXPECT_FALSE(there("results"));
    for (const std::string& name : names()) EXPECT_EQ(name.find(".part"), std::string::npos);
  }
  static constexpr rlim_t megabyte = 1 << 20;
};

TEST_F(Memory, too_little_for_the_dataset_is_an_error) {
  std::string dataset = pendulum;
  dataset.insert(dataset.rfind("END"), "MATRIX/1, SPARSE, ROWS=9000, COLUMNS=9000, I=1, J=1, VALUES=1\n");  // 648 MB
  write("model.adm", dataset);
  expect_out_of_memory(run_within(400 * megabyte));
}

TEST_F(Memory, too_little_for_the_file_is_an_error) {
  write("model.adm", pendulum);
  fs::resize_file(folder_ / "model.adm", 1ULL << 30);
  expect_out_of_memory(run_within(400 * megabyte));
}

// A chain in rows: as many states as need matrices of 100 MB each.
TEST_F(Memory, too_little_for_the_matrices_is_an_error) {
  std::string dataset = "many\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 2; k < 402; ++k) {
    const std::string id = std::to_string(k);
    dataset += "PART/" + id + ", MASS=1, CM=" + id + ", IP=1,1,1\nMARKER/" + id + "\n";
  }
  write("model.adm", dataset + "END\n");
  write("model.acf", "model\nmodel\nLINEAR/STATEMAT, FILE=m\nLINEAR/EIGENSOL\n");
  expect_out_of_memory(run_within(400 * megabyte));
  EXPECT_FALSE(there("m"));
}

// Threads of the linear algebra wait for their memory for ever: where there is little the program works and ends
// without them.
TEST_F(Memory, too_little_for_threads_is_an_error_or_enough_without_them) {
  // Of so many parts our own threads share the products.
  std::string chain = "chain\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 2; k < 102; ++k) {
    const std::string id = std::to_string(k), above = k == 2 ? "1" : std::to_string(k - 1) + "3";
    chain += "PART/" + id + ", MASS=1, CM=" + id + "2, IP=1,1,1, QG=0," + std::to_string(2 - k) + ",0\nMARKER/" + id +
             "2\nMARKER/" + id + "1\nMARKER/" + id + "3, QP=0,-1,0\nJOINT/" + id + ", REVOLUTE, I=" + id +
             "1, J=" + above + "\n";
  }
  write("chain.adm", chain + "ACCGRAV/JGRAV=-9.81\nEND\n");
  struct Work {
    std::string model, command;
  };
  for (const rlim_t megabytes : {130u, 170u, 210u, 250u, 300u, 400u, 500u}) {
    for (const auto& [model, command] : {Work{"model.adm", "SIMULATE/STATICS"}, Work{"model.adm", "LINEAR/EIGENSOL"},
                                         Work{"chain.adm", "LINEAR/EIGENSOL"}}) {
      Surroundings little;
      little.prepare = [&] {
        ::unsetenv("OPENBLAS_NUM_THREADS");
        limit(RLIMIT_AS, megabytes * megabyte);
      };
      const Outcome r = run({"run", model, "-c", command, "--threads", "4"}, little);
      EXPECT_EQ(r.signal, 0) << megabytes << " MB: " << r.err;
      const bool must_do = megabytes >= 500;
      EXPECT_TRUE(r.status == 0 || (!must_do && r.err.find("error: out of memory") != std::string::npos))
          << megabytes << " MB: " << r.err;
    }
  }
}

// As pre-processors write it: an argument a line, names in comments. What the program takes for any dataset is left
// out.
TEST_F(Memory, of_a_large_dataset_is_at_most_six_times_its_size) {
  if (sanitized) GTEST_SKIP() << "a sanitizer keeps memory of its own";
  const double of_any = run({"check", "model.adm"}).megabytes;
  std::string dataset = "large\nUNITS/SYSTEM=MKS\nPART/1\n, GROUND\nMARKER/1\n, PART = 1\n";
  constexpr std::size_t size = 12'000'000;
  for (int k = 2; dataset.size() < size; ++k) {
    const std::string id = std::to_string(k), own = std::to_string(10 * k),
                      other = k > 2 ? std::to_string(10 * k - 8) : "1";
    const auto statement = [&](const std::string& name, const std::string& number, const std::string& arguments) {
      dataset += "!\n!                              adams_view_name='" + name + "_" + number + "'\n" + name + "/" +
                 number + "\n, " + arguments + "\n";
    };
    const std::string place =
        "QP = 388.746920, 501.100624, 790.430031\n, REULER = 32.674587D, -732.958541D, 544.963506D";
    statement("PART", id,
              "QG = -669.375994, 778.603250, 894.932655\n, REULER = -186.154693D, -475.039843D, 898.272928D\n"
              ", MASS = 1.2345\n, CM = " +
                  own + "\n, IP = 1.0E+003, 1.1E+003, 1.2E+003");
    statement("MARKER", own, "PART = " + id + "\n, QP = 0, 0, 0");
    for (int n = 1; n <= 3; ++n) statement("MARKER", std::to_string(10 * k + n), "PART = " + id + "\n, " + place);
    const std::string i = std::to_string(10 * k + 1), pair = "I = " + i + "\n, J = " + other;
    statement("BUSHING", id,
              pair +
                  "\n, C = 1.0, 1.0, 1.0\n, K = 1.0E+005, 1.0E+005, 1.0E+005\n, CT = 10, 10, 10\n"
                  ", KT = 1.0E+006, 1.0E+006, 1.0E+006");
    const std::string measured = "(" + i + "," + other + ")";
    statement("SFORCE", id,
              "TRANSLATIONAL\n, " + pair + "\n, FUNCTION = -12.5*(DM" + measured + "-100.0)\n, -0.35*VR" + measured);
    statement("REQUEST", id, "DISPLACEMENT\n, " + pair + "\n, RM = 1\n, COMMENT = displacement of part " + id);
    statement("GRAPHICS", id, "CYLINDER\n, CM = " + own + "\n, LENGTH = 12.5\n, RADIUS = 3.0");
  }
  write("large.adm", dataset + "END\n");
  const Outcome r = run({"check", "large.adm"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_LE((r.megabytes - of_any) * 1024 * 1024, 6 * size);
}

// --- sizes and counts that make no sense

TEST_F(Memory, absurd_sizes_are_refused_at_their_place) {
  const std::vector<std::string> numbers = {"0",   "-1", "2147483647", "1E300", "-1E300", "9007199254740992",
                                            "0.5", "NAN"};
  for (const std::string& n : numbers) {
    for (const std::string& argument : std::vector<std::string>{
             "EIGENSOL, COORDS=1, TABLE_PRECISION=" + n, "EIGENSOL, COORDS=" + n + "," + n,
             "EIGENSOL, MLIST=" + n + ", MRANGE=1", "EIGENSOL, MLIST=20, MRANGE=" + n, "EIGENSOL, ENERGY_PER_MODE=" + n,
             "EIGENSOL, MASS_PER_MODE=1, MODAL_RM=" + n, "EIGENSOL, RM=" + n, "EIGENSOL, PSTATE=" + n,
             "STATEMAT, FILE=m, PINPUT=" + n, "EIGENSOL, FCOORDS=" + n + "," + n}) {
      write("model.acf", "model\nmodel\nLINEAR/" + argument + "\n");
      const Outcome r = run({"run", "model.acf"});
      const bool may_run = argument.find("COORDS") != std::string::npos ||
                           argument.find("MRANGE=2147483647") != std::string::npos ||
                           argument.find("MRANGE=9007199254740992") != std::string::npos ||
                           argument.find("ENERGY_PER_MODE=") != std::string::npos;
      if (r.status != 0 || !may_run) {
        EXPECT_EQ(r.status, 1) << argument << " signal " << r.signal << r.err;
      }
      if (r.status == 1) {
        EXPECT_THAT(r.err, HasSubstr("model.acf:3:")) << argument;
      }
    }
  }
}

TEST_F(Memory, absurd_sizes_of_statements_are_refused_at_their_place) {
  const std::vector<std::string> numbers = {"0", "-1", "2147483647", "1E300", "9007199254740992", "0.5", "NAN"};
  for (const std::string& n : numbers) {
    for (const std::string& statement : std::vector<std::string>{
             "RESULTS/XRF, DECIMALPLACES=" + n, "RESULTS/DECIMALPLACES=" + n, "ARRAY/1, IC, NUMBERS=1,2, SIZE=" + n,
             "MATRIX/1, FULL=RORDER, ROWS=" + n + ", COLUMNS=" + n + ", VALUES=1,2",
             "MATRIX/1, FULL=CORDER, ROWS=4294967296, COLUMNS=" + n + ", VALUES=1,2",
             "MATRIX/1, SPARSE, ROWS=" + n + ", COLUMNS=" + n + ", I=1, J=1, VALUES=2.5",
             "MATRIX/1, SPARSE, I=" + n + ", J=" + n + ", VALUES=2.5", "SPLINE/1, FILE=points, CHANNEL=" + n,
             "CURVE/1, MATRIX=2, ORDER=" + n, "CURVE/1, MATRIX=2, INTERPOLATION_ORDER=" + n,
             "CURVE/1, MATRIX=2, CONTROL_POINTS=" + n, "VARIABLE/1, FUNCTION=ARYVAL(9," + n + ")",
             "VARIABLE/1, FUNCTION=POLY(TIME,0," + n + ")", "VARIABLE/1, FUNCTION=CHEBY(TIME,0,1," + n + ")",
             "VARIABLE/1, FUNCTION=DX(" + n + ")", "VARIABLE/1, FUNCTION=TIME**" + n,
             "JOINT/" + n + ", FIXED, I=20, J=10"}) {
      write("points", "0 1 3\n1 2 2\n2 4 1\n3 8 5\n4 16 7\n");
      std::string dataset = pendulum;
      dataset.insert(dataset.rfind("END"),
                     statement +
                         "\nMATRIX/2, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=0,0,0,1,0,0,2,1,0,3,1,0,4,2,0\n"
                         "ARRAY/9, IC, NUMBERS=1,2,3\n");
      write("model.adm", dataset);
      const Outcome r = run({"check", "model.acf"});
      EXPECT_TRUE(r.status == 0 || r.status == 1)
          << statement << " status " << r.status << " signal " << r.signal << r.err;
      if (r.status == 1) {
        EXPECT_THAT(r.err, HasSubstr("model.adm:10:")) << statement;
      }
      if (n == "1E300" && statement.find("FUNCTION") == std::string::npos) {
        EXPECT_EQ(r.status, 1) << statement << ": nobody can mean that";
      }
    }
  }
}

}  // namespace
}  // namespace dynalin::faults::input_test
