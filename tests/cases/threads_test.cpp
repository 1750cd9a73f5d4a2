// What a run writes does not depend on how many threads have worked on it.
#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/run.h"
#include "places/thread_count.h"

namespace dynalin::cases::threads_test {
namespace {

class ThreadCount : public Cases {
 protected:
  // Links that hang on springs and hinges, askew, so that all of their coordinates take part.
  static std::string links(int count, const std::string& damping) {
    std::string s = "Links\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n";
    for (int k = 1; k <= count; ++k) {
      const int before = k == 1 ? 1 : 10 * (k - 1) + 2;
      s += fmt::format(
          "PART/{0}, MASS=1, CM={1}0, IP=0.01,0.02,0.03, QG=0,0,{2}\nMARKER/{1}0, QP=0,0,-0.1\n"
          "MARKER/{1}1, QP=0,0,0, REULER={3},1.5707963267948966,0\nMARKER/{1}2, QP=0,0,-0.2, "
          "REULER={3},1.5707963267948966,0\n"
          "JOINT/{1}, UNIVERSAL, I={1}1, J={4}9\nMARKER/{4}9, PART={5}, QP=0,0,{6}, REULER={7},1.5707963267948966,0\n"
          "MARKER/{4}8, PART={5}, QP=0,0,{6}\nBUSHING/{1}, I={1}0, J={4}8, K=100,200,300, KT=4,5,6, {8}\n",
          k + 1, k, -0.2 * (k - 1), 0.1 * k, before, k, k == 1 ? 0.0 : -0.2, 0.1 * k + 1.5707963267948966, damping);
    }
    return s + "END\n";
  }
  std::string json_by(std::size_t threads, const std::string& dataset, const std::string& commands) {
    set_thread_count(threads);
    const RunResult r = run(dataset, commands);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.json.dump();
  }

 private:
  KeepsThreadCount kept_;
};

TEST_F(ThreadCount, changes_no_digit_of_selected_modes_of_all_modes_and_of_motions) {
  const std::string rigid = links(130, "C=0,0,0"), damped = links(130, "C=1,2,3, CT=0.1,0.1,0.1"),
                    few = links(30, "C=1,2,3");
  const std::vector<std::pair<std::string, std::string>> runs = {
      {rigid, "LINEAR/EIGENSOL, NMODES=7\n"},
      {damped, "SIMULATE/STATIC\nLINEAR/EIGENSOL, NMODES=7\n"},
      {few, "SIMULATE/STATIC\nLINEAR/EIGENSOL\nLINEAR/STATEMAT, FILE=matrices\n"},
      {damped, "SIMULATE/DYNAMIC, END=0.005, STEPS=1\n"},
  };
  // Of the BLAS there are several, too, where it can be told.
  using Set = void (*)(int);
  if (const auto set = reinterpret_cast<Set>(::dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(2);
  for (const auto& [dataset, commands] : runs) {
    const std::string alone = json_by(1, dataset, commands);
    for (const std::size_t threads : {2u, 5u}) EXPECT_EQ(json_by(threads, dataset, commands), alone) << commands;
  }
}

}  // namespace
}  // namespace dynalin::cases::threads_test
