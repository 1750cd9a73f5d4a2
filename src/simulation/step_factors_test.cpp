#include "simulation/step_factors.h"

#include <gtest/gtest.h>

#include <array>

#include "system/sparse_lu.h"

namespace dynalin::step_factors_test {
namespace {

// 3 × 3 with all entries, those that are zero as well.
ColumnMatrix full(const std::array<double, 9>& by_rows) {
  std::vector<Triplet> entries;
  for (std::int32_t r = 0; r < 3; ++r) {
    for (std::int32_t c = 0; c < 3; ++c) entries.push_back({r, c, by_rows[static_cast<std::size_t>(3 * r + c)]});
  }
  return compressed(3, 3, entries);
}

void expect_solved(StepFactors& factors, const ColumnMatrix& m) {
  ASSERT_TRUE(factors.factor(m));
  const std::vector<double> expected = {1, -2, 3};
  std::vector<double> x(3, 0.0);
  m.multiply_add(expected, x);
  factors.solve(x);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(x[k], expected[k], 1e-12);
}

TEST(StepFactors, solve_with_entries_that_appear_and_go) {
  StepFactors factors;
  expect_solved(factors, full({2, 0, 0, 0, 3, 0, 0, 0, 4}));
  EXPECT_EQ(factors.entries(), 6u);  // both diagonals
  expect_solved(factors, full({2, 1, 0, 0, 3, 5, 7, 0, 4}));
  EXPECT_EQ(factors.analyses(), 2);
  expect_solved(factors, full({2, 0, 0, 0, 3, 5, 0, 0, 4}));
  expect_solved(factors, full({1, 1, 0, 0, 9, 5, 7, 0, 1}));
  EXPECT_EQ(factors.analyses(), 2);
}

// The pivots of the first would make entries of 1e20 from 1.
TEST(StepFactors, choose_pivots_anew_where_old_ones_would_not_do) {
  StepFactors factors;
  expect_solved(factors, full({1, 1, 2, 1, 3, 1, 1, 1, 1}));
  expect_solved(factors, full({1e-20, 1, 2, 1, 1e-20, 1, 1, 1, 1e-20}));
  EXPECT_EQ(factors.analyses(), 1);
}

TEST(StepFactors, say_that_a_matrix_is_singular_and_go_on_after_it) {
  StepFactors factors;
  EXPECT_FALSE(factors.factor(full({1, 1, 0, 1, 1, 0, 0, 0, 1})));
  expect_solved(factors, full({1, 1, 0, 1, 2, 0, 0, 0, 1}));
  EXPECT_FALSE(factors.factor(full({1, 1, 0, 1, 1, 0, 0, 0, 1})));
}

}  // namespace
}  // namespace dynalin::step_factors_test
