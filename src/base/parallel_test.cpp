#include "base/parallel.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "places/thread_count.h"

namespace dynalin::parallel_test {
namespace {

class Parallel : public ::testing::Test {
  KeepsThreadCount kept_;
};

TEST_F(Parallel, every_task_is_done_once_whatever_the_number_of_threads) {
  for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
    set_thread_count(threads);
    EXPECT_EQ(thread_count(), threads);
    for (const std::size_t count : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<std::atomic<int>> done(count);
      for (int round = 0; round < 20; ++round) in_parallel(count, [&](std::size_t k) { ++done[k]; });
      for (const auto& d : done) EXPECT_EQ(d, 20);
    }
  }
}

TEST_F(Parallel, the_first_task_is_the_callers) {
  set_thread_count(4);
  for (int round = 0; round < 50; ++round) {
    std::thread::id first;
    in_parallel(8, [&](std::size_t k) {
      if (k == 0) first = std::this_thread::get_id();
    });
    EXPECT_EQ(first, std::this_thread::get_id());
  }
}

// Two tasks that wait for each other can only end side by side.
TEST_F(Parallel, tasks_run_at_the_same_time) {
  set_thread_count(2);
  std::atomic<int> arrived = 0;
  in_parallel(2, [&](std::size_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST_F(Parallel, the_first_error_by_number_is_thrown_when_all_are_done) {
  for (const std::size_t threads : {1u, 4u}) {
    set_thread_count(threads);
    for (int round = 0; round < 20; ++round) {
      std::atomic<int> done = 0;
      try {
        in_parallel(10, [&](std::size_t k) {
          ++done;
          if (k == 3 || k == 8) throw std::runtime_error(std::to_string(k));
        });
        ADD_FAILURE() << "nothing thrown";
      } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "3");
      }
      EXPECT_EQ(done, 10);
    }
  }
}

TEST_F(Parallel, tasks_of_tasks_and_of_other_callers_are_done_as_well) {
  set_thread_count(3);
  std::array<std::atomic<int>, 4> done{};
  {
    std::vector<std::jthread> callers;
    for (std::size_t c = 0; c < done.size(); ++c) {
      callers.emplace_back([&, c] {
        for (int round = 0; round < 20; ++round)
          in_parallel(5, [&](std::size_t) { in_parallel(5, [&](std::size_t) { ++done[c]; }); });
      });
    }
  }
  for (const auto& d : done) EXPECT_EQ(d, 20 * 25);
}

}  // namespace
}  // namespace dynalin::parallel_test
