#include "elements/controls/signature_method.h"

#include <gmock/gmock.h>

#include <random>

namespace dynalin::signature_method_test {
namespace {

using ::testing::ElementsAre;
constexpr std::nullopt_t no = std::nullopt;

// x″ = −x λ, y″ = −y λ − g, x² + y² = 1.
TEST(SignatureMethod, pendulum_has_index_three_and_two_freedoms) {
  const auto found = structural_index({{2, no, 0}, {no, 2, 0}, {0, 0, no}});
  ASSERT_TRUE(found);
  EXPECT_THAT(found->differentiated, ElementsAre(0, 0, 2));
  EXPECT_THAT(found->highest, ElementsAre(2, 2, 0));
  EXPECT_EQ(found->freedoms, 2);
}

TEST(SignatureMethod, explicit_equations_are_not_differentiated) {
  const auto found = structural_index({{1, 0}, {0, 1}});
  ASSERT_TRUE(found);
  EXPECT_THAT(found->differentiated, ElementsAre(0, 0));
  EXPECT_EQ(found->freedoms, 2);
}

// z₁′ + z₂′ = …, and a condition on z₂ alone: its rate is found by differentiating it once.
TEST(SignatureMethod, condition_on_a_rate_that_is_read_is_differentiated_once) {
  const auto found = structural_index({{1, 1}, {no, 0}});
  ASSERT_TRUE(found);
  EXPECT_THAT(found->equation, ElementsAre(0u, 1u));
  EXPECT_THAT(found->differentiated, ElementsAre(0, 1));
  EXPECT_EQ(found->freedoms, 1);
}

TEST(SignatureMethod, too_few_equations_for_some_unknowns_are_no_structure) {
  EXPECT_FALSE(structural_index({{1, 0, 0}, {0, no, no}, {1, no, no}}));
  EXPECT_FALSE(structural_index({{no}}));
}

// Against all transversals of small random signatures.
TEST(SignatureMethod, transversal_is_the_best_and_offsets_fit) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t n = 2 + random() % 4;
    Signature s(n, std::vector<std::optional<int>>(n));
    for (auto& row : s) {
      for (auto& entry : row) {
        if (random() % 3 != 0) entry = static_cast<int>(random() % 3);
      }
    }
    std::optional<int> best;
    std::vector<std::size_t> order(n);
    for (std::size_t k = 0; k < n; ++k) order[k] = k;
    do {
      int sum = 0;
      bool all = true;
      for (std::size_t j = 0; j < n && all; ++j) {
        all = s[order[j]][j].has_value();
        if (all) sum += *s[order[j]][j];
      }
      if (all) best = std::max(best.value_or(sum), sum);
    } while (std::next_permutation(order.begin(), order.end()));
    const auto found = structural_index(s);
    ASSERT_EQ(found.has_value(), best.has_value());
    if (!found) continue;
    EXPECT_EQ(found->freedoms, *best);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_GE(found->differentiated[i], 0);
      for (std::size_t j = 0; j < n; ++j) {
        if (s[i][j]) {
          EXPECT_GE(found->highest[j] - found->differentiated[i], *s[i][j]);
        }
      }
    }
    for (std::size_t j = 0; j < n; ++j)
      EXPECT_EQ(found->highest[j] - found->differentiated[found->equation[j]], *s[found->equation[j]][j]);
  }
}

}  // namespace
}  // namespace dynalin::signature_method_test
