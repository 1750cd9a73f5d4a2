// Evaluation with a workspace in use allocates nothing. Counts through the global operator new of
// the test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "expression/expression_test_support.h"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

// Not inlined: the compiler would see a pointer of operator new given to free.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

namespace dynalin::expression_test::expression_allocation_test {
namespace {

template <class T>
std::size_t allocations_of_second_evaluation(const Expression& e) {
  std::vector<T> x(e.atoms().size(), T(0.3)), partial(e.atoms().size());
  x.front() += T(0.1);
  ExpressionWorkspace<T> workspace;
  e.evaluate(std::span<const T>(x), std::span<T>(partial), workspace);
  const std::size_t before = allocations;
  for (double step : {0.1, -0.7}) {
    x.front() += T(step);
    e.evaluate(std::span<const T>(x), std::span<T>(partial), workspace);
  }
  return allocations - before;
}

TEST(ExpressionAllocation, evaluation_allocates_nothing_after_the_first) {
  const ParsedText parsed = parse(
      "IF(VARVAL(1): SIN(VARVAL(2))**2, STEP(VARVAL(1),VARVAL(2),1,2,3), VARVAL(1)**VARVAL(2)"
      "+FORCOS(VARVAL(1),VARVAL(2),1,2,3,4,VARVAL(1),6,7,8,9))*IMPACT(VARVAL(1),VARVAL(2),1,2,3,4,"
      "5)");
  ASSERT_FALSE(parsed.diagnostics.has_errors());
  const std::size_t before = allocations;
  // Called as a function: an optimizer may leave out a new expression that is deleted at once.
  ::operator delete(::operator new(1));
  ASSERT_EQ(allocations, before + 1) << "the counter does not count";
  EXPECT_EQ(allocations_of_second_evaluation<double>(parsed.expression), 0u);
  EXPECT_EQ(allocations_of_second_evaluation<TimeTaylor<double>>(parsed.expression), 0u);
}

TEST(ExpressionAllocation, switches_allocate_nothing_after_the_first) {
  const ParsedText parsed =
      parse("IF(VARVAL(1): ABS(VARVAL(1)), 1, MAX(VARVAL(1),VARVAL(2),2))+STEP(VARVAL(1),0,0,VARVAL(2),1)");
  const std::vector<double> x = {0.4, 0.3};
  ExpressionWorkspace<double> workspace;
  SwitchList list;
  parsed.expression.switches(x, workspace, list);
  const std::size_t before = allocations, count = list.value.size();
  list.clear();
  parsed.expression.switches(x, workspace, list);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(list.value.size(), count);
}

}  // namespace
}  // namespace dynalin::expression_test::expression_allocation_test
