// Runs the program itself as a process of its own, under limits, with broken streams and on a disk that fails.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "places/sanitizers.h"

namespace dynalin::faults {

namespace fs = std::filesystem;

inline std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Outcome {
  int status = -1;  // of the exit, -1 if a signal ended it
  int signal = 0;
  std::string out, err;
  double megabytes = 0;  // the most that was in memory
};

struct Surroundings {
  std::vector<std::pair<std::string, std::string>> faults;  // variables of the shim
  std::function<void()> prepare;                            // in the new process, before it becomes the program
};

inline void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// The process goes on as the program with these arguments, or as another one that the environment names.
[[noreturn]] inline void become_program(const std::vector<std::string>& arguments) {
  const char* other = std::getenv("DYNALIN_PROGRAM");
  std::vector<std::string> words{other ? other : DYNALIN_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  ::execv(list[0], list.data());
  ::_exit(98);
}

class Faults : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "dynalin_faults_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
    folder_ = root_ / "run";
    fs::create_directories(folder_);
    write("model.adm", pendulum);
    write("model.acf", "model\nmodel\nLINEAR/EIGENSOL\nLINEAR/STATEMAT, FILE=m\n");
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string text(const std::string& name) const { return read_text(folder_ / name); }
  bool there(const std::string& name) const { return fs::exists(fs::symlink_status(folder_ / name)); }
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(folder_)) list.push_back(entry.path().filename());
    std::sort(list.begin(), list.end());
    return list;
  }

  pid_t start(const std::vector<std::string>& arguments, const Surroundings& surroundings = {}) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    if (::chdir(folder_.c_str()) != 0) ::_exit(99);
    redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    redirect(STDOUT_FILENO, (root_ / "out").string(), O_WRONLY | O_CREAT | O_TRUNC);
    redirect(STDERR_FILENO, (root_ / "err").string(), O_WRONLY | O_CREAT | O_TRUNC);
    ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
    if (!surroundings.faults.empty()) ::setenv("LD_PRELOAD", FAULT_SHIM, 1);
    for (const auto& [name, value] : surroundings.faults) ::setenv(name.c_str(), value.c_str(), 1);
    constexpr unsigned longest = 30;  // seconds: what hangs is ended and seen as such
    ::alarm(longest);
    if (surroundings.prepare) surroundings.prepare();
    become_program(arguments);
  }
  Outcome finish(pid_t child) const {
    int status = 0;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    Outcome r;
    r.megabytes = static_cast<double>(used.ru_maxrss) / 1024;
    if (WIFEXITED(status)) r.status = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) r.signal = WTERMSIG(status);
    r.out = read_text(root_ / "out"), r.err = read_text(root_ / "err");
    return r;
  }
  Outcome run(const std::vector<std::string>& arguments, const Surroundings& surroundings = {}) const {
    return finish(start(arguments, surroundings));
  }
  static Surroundings fault(const std::string& variable, const std::string& name, const std::string& bytes = "0") {
    return {{{variable, name}, {"FAULT_BYTES", bytes}}, {}};
  }

  static void redirect(int stream, const std::string& path, int flags) {
    const int opened = ::open(path.c_str(), flags, 0600);
    if (opened < 0 || ::dup2(opened, stream) < 0) ::_exit(97);
    if (opened != stream) ::close(opened);
  }

  static constexpr const char* pendulum =
      "pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/10, PART=1\n"
      "PART/2, QG=0,-1,0, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=0,1,0\n"
      "JOINT/1, REVOLUTE, I=21, J=10\nEND\n";

  fs::path root_, folder_;
};

}  // namespace dynalin::faults
