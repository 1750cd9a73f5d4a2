// Utilities that are called where no routine is at work.
#include "routine/routine_context.h"

#include <gmock/gmock.h>

#include <latch>
#include <thread>

namespace dynalin::routine_context_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RoutineContext, calls_from_elsewhere_fail_whoever_is_at_work) {
  RoutineContext alone, one, other, later;
  const auto from_elsewhere = [] { std::thread([] { EXPECT_EQ(RoutineContext::current(), nullptr); }).join(); };
  from_elsewhere();
  {
    const RoutineContext::Scope scope(alone, "the first");
    EXPECT_EQ(RoutineContext::current(), &alone);
    from_elsewhere();
  }
  EXPECT_THAT(alone.failure, AllOf(HasSubstr("it calls a utility from a thread of its own"), Not(HasSubstr("first"))));
  {
    const RoutineContext::Scope scope(one, "the second");
    std::latch begun(1), called(1);
    std::thread thread([&] {
      const RoutineContext::Scope beside(other, "the third");
      begun.count_down();
      called.wait();
    });
    begun.wait();
    from_elsewhere();
    called.count_down();
    thread.join();
  }
  EXPECT_THAT(one.failure, AllOf(HasSubstr("the third"), Not(HasSubstr("the second"))));
  EXPECT_THAT(other.failure, AllOf(HasSubstr("the second"), Not(HasSubstr("the third"))));
  { const RoutineContext::Scope scope(later, "the last"); }
  EXPECT_EQ(later.failure, "");
}

}  // namespace
}  // namespace dynalin::routine_context_test
