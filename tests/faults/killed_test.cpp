// Whatever ends the program, and whenever: a file under its name is complete.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <thread>

#include "program.h"

namespace dynalin::faults::killed_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Killed : public Faults {
 protected:
  // Of a kind of file that this run writes, by its own marks.
  void expect_complete(const std::string& name) const {
    const std::string whole = text(name);
    if (name.ends_with(".msg")) {
      EXPECT_THAT(whole, HasSubstr("Elapsed time")) << name;
    } else if (name.ends_with(".res")) {
      EXPECT_TRUE(whole.ends_with("</Results>\n")) << name;
    } else if (name.ends_with(".json") || name.ends_with(".save")) {
      EXPECT_TRUE(whole.starts_with("{") && whole.ends_with("\n}\n")) << name;
    } else if (name.ends_with(".txt") || name == "m") {
      const auto undated = [](const std::string& t) { return t.substr(t.find('\n')); };
      EXPECT_EQ(undated(whole), undated(complete_.at(name))) << name;
    }
  }
  std::map<std::string, std::string> complete_;
};

TEST_F(Killed, leaves_no_file_that_looks_complete_and_is_not) {
  std::string dataset = pendulum;
  dataset.insert(dataset.rfind("END"), "RESULTS/XRF\n");
  write("model.adm", dataset);
  write("model.acf",
        "model\nmodel\nSAVE/SYSTEM, FILE=a.save\nLINEAR/EIGENSOL, COORDS=1\nLINEAR/STATEMAT, FILE=m\n"
        "SIMULATE/DYNAMICS, DURATION=0.2, STEPS=20\nSAVE/STATES, FILE=b.save\nLINEAR/EIGENSOL\n");
  const std::vector<std::string> arguments = {"run", "model.acf", "--json", "r.json"};
  // The shortest of some: beside other work one may take several times as long.
  auto lasts = std::chrono::microseconds::max();
  for (int k = 0; k < 3; ++k) {
    const auto begun = std::chrono::steady_clock::now();
    const Outcome whole = run(arguments);
    ASSERT_EQ(whole.status, 0) << whole.err;
    lasts = std::min(lasts,
                     std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begun));
  }
  const std::vector<std::string> inputs = {"model.acf", "model.adm"};
  for (const std::string& name : names()) complete_[name] = text(name);
  EXPECT_EQ(complete_.size(), 9u) << "two inputs, msg, res, txt, json, m and two files of SAVE";

  std::mt19937 random(4711);
  std::uniform_int_distribution<long> moment(0, 11 * lasts.count() / 10);
  std::size_t unfinished = 0;
  constexpr int times = sanitized ? 10 : 100;
  for (int k = 0; k < times; ++k) {
    if (k % 2 == 0) {  // with files of an earlier run in their places, and without
      for (const std::string& name : names()) {
        if (std::ranges::find(inputs, name) == inputs.end()) fs::remove(folder_ / name);
      }
    }
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(std::chrono::microseconds(moment(random)));
    ::kill(child, SIGKILL);
    unfinished += finish(child).signal == SIGKILL;
    for (const std::string& name : names()) {
      if (!name.starts_with(".dynalin-")) expect_complete(name);
    }
  }
  EXPECT_GT(unfinished, static_cast<std::size_t>(times) / 5);
}

TEST_F(Killed, an_interrupted_simulation_writes_what_it_has) {
  std::string dataset = pendulum;
  dataset.replace(dataset.find("MASS=1"), 6, "MASS=1, WZ=3");  // at rest nothing takes long
  write("model.adm", dataset);
  write("model.acf", "model\nmodel\nLINEAR/EIGENSOL\nSIMULATE/DYNAMICS, END=1E6, STEPS=1000\nLINEAR/EIGENSOL\n");
  const pid_t child = start({"run", "model.acf", "--json", "r.json"});
  std::this_thread::sleep_for(std::chrono::seconds(2));
  ::kill(child, SIGINT);
  const Outcome r = finish(child);
  EXPECT_EQ(r.status, 2) << r.signal << r.err;
  EXPECT_THAT(text("model.msg"), HasSubstr("Ended early: the run was interrupted"));
  EXPECT_THAT(text("r.json"), HasSubstr("SIMULATE/DYNAMICS"));
  for (const std::string& name : names()) EXPECT_THAT(name, Not(HasSubstr(".part")));
}

TEST_F(Killed, a_file_of_save_is_there_at_once_or_names_its_fault) {
  write("model.acf", "model\nmodel\nSIMULATE/INITIAL\nSAVE/STATES, FILE=a.save\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(run({"run", "model.acf"}).status, 0);
  EXPECT_TRUE(there("a.save"));
  const std::string before = text("a.save");
  for (const auto& [variable, name] : {std::pair("FAULT_RENAME", "a.save"), std::pair("FAULT_WRITE", ".dynalin-")}) {
    if (sanitized) break;
    const Outcome r = run({"run", "model.acf"}, fault(variable, name));
    EXPECT_EQ(r.status, 2) << variable;
    EXPECT_THAT(r.err, HasSubstr("a.save")) << variable;
    EXPECT_EQ(text("a.save"), before);
    for (const std::string& file : names()) EXPECT_THAT(file, Not(HasSubstr(".part")));
  }
}

TEST_F(Killed, a_folder_that_must_not_be_written_names_the_file_before_anything_runs) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::create_directory(folder_ / "closed");
  fs::permissions(folder_ / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  write("model.acf", "model\nmodel\nSAVE/STATES, FILE=closed/a.save\n");
  const Outcome r = run({"run", "model.acf"});
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("closed/a.save"));
}

}  // namespace
}  // namespace dynalin::faults::killed_test
