#include "simulation/order_trial.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace dynalin::order_trial_test {
namespace {

// Steps to the end of a run in which each largest order makes steps of one length.
struct Passage {
  std::array<std::int64_t, 6> steps{};  // of each largest order
  std::vector<int> changes;

  Passage(double end, int highest, const std::array<double, 6>& length) {
    OrderTrial trial(highest);
    int order = highest;
    for (double t = 0; t < end;) {
      const double h = length[static_cast<std::size_t>(order)];
      t += h;
      ++steps[static_cast<std::size_t>(order)];
      if (const auto other = trial.after_step(h, end - t)) changes.push_back(order = *other);
    }
  }
};

TEST(OrderTrial, longer_steps_of_order_two_are_kept) {
  const Passage run(1000, 5, {0, 0, 1e-1, 0, 0, 1e-3});
  EXPECT_EQ(run.changes.front(), 2);
  EXPECT_LT(run.steps[2], 10000);
  EXPECT_LT(run.steps[5], 3000);
}

TEST(OrderTrial, shorter_ones_are_not_and_are_tried_ever_more_rarely) {
  const Passage run(1000, 5, {0, 0, 5e-4, 0, 0, 1e-3});
  ASSERT_GE(run.changes.size(), 2u);
  EXPECT_EQ(run.changes[0], 2);
  EXPECT_EQ(run.changes[1], 5);
  EXPECT_LT(static_cast<double>(run.steps[2]), 0.01 * static_cast<double>(run.steps[5]));
}

TEST(OrderTrial, what_is_over_soon_and_what_has_no_higher_order_is_let_be) {
  EXPECT_TRUE(Passage(5, 5, {0, 0, 1e-1, 0, 0, 1e-3}).changes.empty());
  EXPECT_TRUE(Passage(1000, 2, {0, 0, 1e-3, 0, 0, 0}).changes.empty());
}

}  // namespace
}  // namespace dynalin::order_trial_test
