#include "base/shared_chain.h"

#include <gtest/gtest.h>

namespace dynalin::shared_chain_test {
namespace {

TEST(shared_chain, earlier_states_live_on) {
  SharedChain<int> one;
  EXPECT_TRUE(one.empty());
  one.add(1);
  SharedChain<int> two = one, other = one;
  two.add(2), other.add(3), other.add(4);
  EXPECT_EQ(one.list(), std::vector<int>({1}));
  EXPECT_EQ(two.list(), std::vector<int>({1, 2}));
  EXPECT_EQ(other.list(), std::vector<int>({1, 3, 4}));
  EXPECT_EQ(other.back(), 4);
}

// As deep as no stack is.
TEST(shared_chain, a_long_one_ends_and_leaves_what_others_share) {
  SharedChain<int> kept;
  {
    SharedChain<int> longest;
    for (int k = 0; k < 1'000'000; ++k) {
      longest.add(k);
      if (k == 2) kept = longest;
    }
    EXPECT_EQ(longest.size(), 1'000'000u);
  }
  EXPECT_EQ(kept.list(), std::vector<int>({0, 1, 2}));
}

}  // namespace
}  // namespace dynalin::shared_chain_test
