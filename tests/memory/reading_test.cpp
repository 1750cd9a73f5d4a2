// What it costs to read a large dataset into a model with every argument checked, counted and not timed: memory as a
// multiple of the text, a twelfth more than what was measured, where runs differ by less than a hundredth, and
// allocations for each statement, a little more than there were.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <new>
#include <ostream>
#include <string>

#include "elements/catalogue.h"
#include "large_dataset.h"
#include "model/model.h"

namespace {
std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}
}  // namespace

// Not inlined: the compiler would see a pointer of operator new given to free.
[[gnu::noinline]] void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace dynalin {
namespace {

using Kind = LargeDataset::Kind;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_watched = true;  // by what takes memory itself
#else
constexpr bool is_watched = false;
#endif

// MB of this process, now (VmRSS) or at the most so far (VmHWM).
double megabytes(const std::string& which) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(which + ":")) return std::stod(line.substr(which.size() + 1)) * 1024 / 1e6;
  return 0;
}

bool read(std::string text) {
  auto parsed = parse_dataset(std::make_shared<const SourceText>("large.adm", std::move(text)));
  const auto dataset = std::make_shared<Dataset>(std::move(parsed.value));
  const auto built = build_model(dataset, catalogue(), {.read_once = dataset});  // as the program reads
  return !parsed.diagnostics.has_errors() && !built.diagnostics.has_errors();
}

// In a process of its own, whose largest memory is that of the reading. The text counts, which it has from here.
double memory_by_text(Kind kind) {
  constexpr std::size_t size = 10'000'000;
  std::string text = LargeDataset(kind, size).take();
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    read(LargeDataset(kind, size / 100).take());  // what the first time takes
    const double before = megabytes("VmRSS"), length = static_cast<double>(text.size()) / 1e6;
    const double factor = read(std::move(text)) ? 1 + (megabytes("VmHWM") - before) / length : 0;
    _exit(write(ends[1], &factor, sizeof factor) == sizeof factor ? 0 : 1);
  }
  double factor = 0;
  close(ends[1]);
  const bool told = ::read(ends[0], &factor, sizeof factor) == sizeof factor;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return told ? factor : 0;
}

struct Limits {
  Kind kind;
  double memory, allocations;
};
std::ostream& operator<<(std::ostream& out, const Limits& l) {
  return out << LargeDataset::names[static_cast<std::size_t>(l.kind)];
}

class Reading : public ::testing::TestWithParam<Limits> {};

TEST_P(Reading, takes_no_more_memory_than_so_many_times_the_text) {
  if (is_watched) GTEST_SKIP() << "memory is measured without sanitizers";
  const double factor = memory_by_text(GetParam().kind);
  RecordProperty("factor", std::to_string(factor));
  EXPECT_GT(factor, 1) << "it was not read";
  EXPECT_LE(factor, GetParam().memory);
}

TEST_P(Reading, allocates_no_more_often_than_so_for_a_statement) {
  LargeDataset dataset(GetParam().kind, 1'000'000);
  const auto statements = static_cast<double>(dataset.statements());
  std::string text = dataset.take();
  read(text);
  const std::size_t before = allocations;
  EXPECT_TRUE(read(std::move(text)));
  const double each = static_cast<double>(allocations - before) / statements;
  RecordProperty("allocations", std::to_string(each));
  EXPECT_GT(each, 0.1) << "the counter does not count";
  EXPECT_LE(each, GetParam().allocations);
}

INSTANTIATE_TEST_SUITE_P(LargeDatasets, Reading,
                         ::testing::Values(Limits{Kind::exported, 3.5, 5.6}, Limits{Kind::dense, 5.2, 5.6},
                                           Limits{Kind::jointed, 5.2, 2.7}, Limits{Kind::expressions, 6.4, 6.5},
                                           Limits{Kind::tables, 3.1, 9.4}, Limits{Kind::mixed, 4.8, 4.9}),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace dynalin
