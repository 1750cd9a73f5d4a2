// What several processes find is what one finds: values within their bounds, counts, output. What ends one ends all.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <complex>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "hanging_chain.h"
#include "mass_lattice.h"

namespace distributed_test {
namespace {

namespace fs = std::filesystem;
using Complex = std::complex<double>;
using Words = std::vector<std::string>;

std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Bounds are rounded as the processes happen to share the work.
std::string without_bounds(const std::string& printed) {
  std::istringstream in(printed);
  std::string rest;
  for (std::string line; std::getline(in, line);) {
    if (line.find(" within ") == std::string::npos) rest += line + '\n';
  }
  return rest;
}

// Springs and dampers at the hinges of a hanging chain.
std::string damped_chain(int n) {
  std::string text = hanging_chain(n);
  text.resize(text.rfind("END"));
  for (int k = 1; k <= n; ++k) {
    text += fmt::format("SPRINGDAMPER/{0}, ROTATIONAL, I={1}1, J={2}, KT=10, CT=0.01\n", k, k + 1,
                        k == 1 ? std::string("1") : fmt::format("{}2", k));
  }
  return text + "END\n";
}

class Distributed : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "dynalin_distributed_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
    folder_ = root_ / "run";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  static Words of_processes(int count, Words words) {
    if (count == 0) return words;
    Words all{MPIRUN, "--oversubscribe", "--mca", "mpi_yield_when_idle", "1", "-n", std::to_string(count)};
    if (::geteuid() == 0) all.insert(all.begin() + 1, "--allow-run-as-root");
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }
  pid_t start(const Words& words) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    if (::chdir(folder_.c_str()) != 0) ::_exit(99);
    for (const auto& [stream, name] : {std::pair(STDOUT_FILENO, "out"), std::pair(STDERR_FILENO, "err")}) {
      const int opened = ::open((root_ / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (opened < 0 || ::dup2(opened, stream) < 0) ::_exit(97);
    }
    ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
    std::vector<char*> list;
    for (const std::string& word : words) list.push_back(const_cast<char*>(word.c_str()));
    list.push_back(nullptr);
    ::execv(list[0], list.data());
    ::_exit(98);
  }
  // The exit status, −1 if it was ended by a signal.
  static int finish(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int run(int processes, const Words& words) const { return finish(start(of_processes(processes, words))); }
  std::string out() const { return read_text(root_ / "out"); }
  std::string err() const { return read_text(root_ / "err"); }

  // The modes of model.adm; `processes` 0 is the program without mpirun.
  nlohmann::json modes(int processes, const std::string& selection) const {
    const int status = run(processes, {DYNALIN_PROGRAM, "run", "model.adm", "-c", "LINEAR/EIGENSOL, " + selection,
                                       "--dense-up-to", "0", "--json", "model.json"});
    EXPECT_EQ(status, 0) << err();
    return nlohmann::json::parse(read_text(folder_ / "model.json"))["results"][0];
  }
  void expect_same(const std::string& selection) const {
    const auto alone = modes(0, selection);
    const std::string printed = without_bounds(out());
    ASSERT_FALSE(alone["modes"].empty());
    for (const int processes : {1, 2, 4}) {
      SCOPED_TRACE(processes);
      const auto together = modes(processes, selection);
      EXPECT_EQ(without_bounds(out()), printed);
      EXPECT_EQ(together["selected"]["complete"], true);
      EXPECT_EQ(together["selected"]["counted"], alone["selected"]["counted"]);
      ASSERT_EQ(together["modes"].size(), alone["modes"].size());
      for (std::size_t k = 0; k < alone["modes"].size(); ++k) {
        const auto &a = alone["modes"][k], &b = together["modes"][k];
        const Complex of_a(a["real_hz"], a["imag_hz"]), of_b(b["real_hz"], b["imag_hz"]);
        const double bounds = a["error_bound_hz"].get<double>() + b["error_bound_hz"].get<double>();
        EXPECT_LE(std::abs(of_a - of_b), bounds) << of_a;
        EXPECT_LE(bounds, 1e-7 * std::abs(of_a)) << of_a;
      }
    }
  }

  fs::path root_, folder_;
};

TEST_F(Distributed, FactorsAndIterationAreShared) {
  EXPECT_EQ(run(0, {TEAM_CHECK}), 0) << out() << err();
  EXPECT_EQ(run(1, {TEAM_CHECK}), 0) << out() << err();
  for (const int processes : {2, 3, 4}) EXPECT_EQ(run(processes, {TEAM_CHECK, "several"}), 0) << out() << err();
}

TEST_F(Distributed, LowestModesOfALattice) {
  write("model.adm", mass_lattice(5, 6, 8));
  expect_same("NMODES=6");
}

TEST_F(Distributed, ModesOfADampedChainInABand) {
  write("model.adm", damped_chain(200));
  expect_same("BAND=0.2,3");
}

// The others print nothing, touch no file, and end with its status.
TEST_F(Distributed, ErrorOfTheFirstEndsAll) {
  write("model.adm", "wrong\nPART/1, GROUND\nNONSENSE/1\nEND\n");
  const Words words{DYNALIN_PROGRAM, "run", "model.adm", "-c", "LINEAR/EIGENSOL, NMODES=3"};
  const int alone = run(0, words);
  const std::string printed = out(), complaint = err();
  EXPECT_NE(alone, 0);
  EXPECT_EQ(run(3, words), alone);
  EXPECT_EQ(out(), printed);
  EXPECT_EQ(err().substr(0, complaint.size()), complaint);
}

TEST_F(Distributed, DeathOfOneEndsAll) {
  write("model.adm", mass_lattice(12, 12, 12));
  const pid_t mpirun = start(of_processes(
      3, {DYNALIN_PROGRAM, "run", "model.adm", "-c", "LINEAR/EIGENSOL, NMODES=20", "--json", "model.json"}));
  pid_t second = 0;
  for (int tries = 0; tries < 600 && second == 0; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::istringstream children(read_text(fmt::format("/proc/{0}/task/{0}/children", mpirun)));
    for (pid_t child; children >> child;) {
      const std::string environment = read_text(fmt::format("/proc/{}/environ", child));
      if (environment.find("OMPI_COMM_WORLD_RANK=1") != std::string::npos) second = child;
    }
  }
  ASSERT_GT(second, 0);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  ::kill(second, SIGKILL);
  EXPECT_NE(finish(mpirun), 0);
  EXPECT_FALSE(fs::exists(folder_ / "model.json"));
  for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_EQ(entry.path().filename(), "model.adm");
}

}  // namespace
}  // namespace distributed_test
