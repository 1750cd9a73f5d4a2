// The kernels of the linear algebra fit the processor, also one that OpenBLAS does not know.
#include <gmock/gmock.h>

#include "faults/program.h"

namespace dynalin::faults::processor_test {
namespace {

// The kernels of each beginning of the program, as OpenBLAS tells them.
std::vector<std::string> kernels(const Outcome& r) {
  std::vector<std::string> found;
  std::istringstream lines(r.err);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Core: ")) found.push_back(line.substr(6));
  }
  return found;
}

class Processor : public Faults {
 protected:
  Outcome run_with(const char* wanted) const {
    Surroundings telling;
    telling.prepare = [wanted] {
      ::setenv("OPENBLAS_VERBOSE", "2", 1);
      wanted ? ::setenv("OPENBLAS_CORETYPE", wanted, 1) : ::unsetenv("OPENBLAS_CORETYPE");
    };
    return run({"run", "model.acf"}, telling);
  }
};

TEST_F(Processor, has_kernels_of_its_own_kind) {
  const Outcome r = run_with(nullptr);
  EXPECT_EQ(r.status, 0) << r.err;
  const auto found = kernels(r);
  if (found.empty()) GTEST_SKIP() << "not OpenBLAS, or one that does not tell";
#ifdef __x86_64__
  const bool unknown = found.front() == "Prescott" && __builtin_cpu_supports("avx2");
  ASSERT_EQ(found.size(), unknown ? 2u : 1u) << r.err;
  if (unknown) {
    EXPECT_THAT(found.back(), ::testing::AnyOf("SkylakeX", "Haswell"));
  }
#endif
}

TEST_F(Processor, has_those_that_the_user_asks_for) {
  const Outcome r = run_with("Prescott");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_LE(kernels(r).size(), 1u);
}

}  // namespace
}  // namespace dynalin::faults::processor_test
