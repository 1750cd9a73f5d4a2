#include "elements/controls/structural_matrix.h"

#include <gtest/gtest.h>

namespace dynalin::structural_matrix_test {
namespace {

constexpr double x = -1e99;  // stands for an entry that may be anything

StructuralMatrix matrix(const std::vector<std::vector<double>>& rows) {
  StructuralMatrix m(rows.size(), rows.front().size());
  for (std::size_t r = 0; r < m.rows(); ++r) {
    for (std::size_t c = 0; c < m.columns(); ++c)
      m(r, c) = rows[r][c] == x ? StructuralEntry::any() : StructuralEntry{rows[r][c]};
  }
  return m;
}

TEST(StructuralMatrix, of_numbers_has_their_rank) {
  EXPECT_EQ(matrix({{1, 2}, {2, 4}}).rank(), 1u);
  EXPECT_EQ(matrix({{1, 2}, {2, 5}}).rank(), 2u);
  EXPECT_EQ(matrix({{0.1, 0.2, 0.3}, {1, 1, 1}, {1.1, 1.2, 1.3}}).rank(), 2u) << "but for rounding";
  EXPECT_EQ(matrix({{0, 0}, {0, 0}}).rank(), 0u);
  EXPECT_EQ(matrix({{1e-30, 2e-30, 0}, {0, 1e20, 1e20}}).rank(), 2u);
}

TEST(StructuralMatrix, of_anything_has_the_rank_of_its_places) {
  EXPECT_EQ(matrix({{x, x}, {x, x}}).rank(), 2u);
  EXPECT_EQ(matrix({{x, 0, 0}, {x, 0, 0}, {x, x, x}}).rank(), 2u);
  EXPECT_EQ(matrix({{0, x, 0}, {x, x, x}, {0, x, 0}}).rank(), 2u);
}

TEST(StructuralMatrix, of_both_takes_numbers_as_they_are) {
  EXPECT_EQ(matrix({{1, 2, 0}, {2, 4, x}, {0, 0, x}}).rank(), 2u);
  EXPECT_EQ(matrix({{1, 2, 0}, {2, 4, x}, {x, 0, x}}).rank(), 3u);
  EXPECT_EQ(matrix({{1, 1}, {x, x}}).rank(), 2u);
}

TEST(StructuralMatrix, finds_a_row_for_each_column) {
  std::vector<std::size_t> row_of;
  EXPECT_EQ(matrix({{x, x, 0}, {x, 0, 0}, {0, x, x}}).term_rank(row_of), 3u);
  EXPECT_EQ(row_of, (std::vector<std::size_t>{1, 0, 2}));
}

}  // namespace
}  // namespace dynalin::structural_matrix_test
