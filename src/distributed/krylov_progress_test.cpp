#include "distributed/krylov_progress.h"

#include <gtest/gtest.h>

namespace dynalin::krylov_progress_test {
namespace {

using Value = KrylovProgress::Value;

TEST(KrylovProgress, a_value_is_found_when_nothing_but_rounding_is_left_of_it_or_of_the_largest) {
  EXPECT_TRUE(KrylovProgress::is_found({1, 0.9e-11}, 1));
  EXPECT_FALSE(KrylovProgress::is_found({1, 1.1e-11}, 1));
  EXPECT_TRUE(KrylovProgress::is_found({1e-9, 8e-16}, 1));
  EXPECT_FALSE(KrylovProgress::is_found({1e-9, 9e-16}, 1));
}

TEST(KrylovProgress, ends_with_the_last_value_that_is_wanted_or_exists) {
  KrylovProgress progress(3, 0);
  progress.look(2, 9, 1, Value{0.5, 0.1});
  EXPECT_FALSE(progress.has_reached_its_end());
  progress.look(3, 9, 1, Value{0.5, 0.1});
  EXPECT_TRUE(progress.has_reached_its_end());
  KrylovProgress few(3, 0);
  few.look(2, 2, 1, std::nullopt);
  EXPECT_TRUE(few.has_reached_its_end());
}

TEST(KrylovProgress, ends_with_a_value_below_the_least_or_one_to_come_that_is_surely_below) {
  KrylovProgress progress(9, 1);
  progress.look(0, 9, 0, Value{0.5, 0.06});  // may be anything yet
  EXPECT_FALSE(progress.has_reached_its_end());
  progress.look(0, 9, 0, Value{0.89, 0.02});  // 0.91: not surely
  EXPECT_FALSE(progress.has_reached_its_end());
  progress.look(1, 9, 1.1, Value{0.5, 0.04});
  EXPECT_TRUE(progress.has_reached_its_end());
  progress.look(1, 9, 1.1, Value{0.95, 0.3});
  EXPECT_FALSE(progress.has_reached_its_end());
  progress.look(2, 9, 0.95, Value{0.94, 0.3});
  EXPECT_TRUE(progress.has_reached_its_end());
}

TEST(KrylovProgress, stands_still_after_twelve_restarts_that_change_nothing_small) {
  KrylovProgress progress(9, 0);
  const auto repeat = [&](int times, double rest) {
    for (int k = 0; k < times; ++k) progress.look(0, 9, 0, Value{2, rest});
  };
  repeat(30, 2e-3);  // far from rounding: slow, but under way
  EXPECT_FALSE(progress.stands_still());
  repeat(12, 1e-8);  // the first is progress
  EXPECT_FALSE(progress.stands_still());
  repeat(1, 1e-8);
  EXPECT_TRUE(progress.stands_still());
  repeat(1, 1e-9);
  EXPECT_FALSE(progress.stands_still());
}

}  // namespace
}  // namespace dynalin::krylov_progress_test
