#include "system/row_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "system/sparse_lu.h"

namespace dynalin::row_matching_test {
namespace {

// How many columns have a row of their own that is in the pattern; every row is given once.
std::size_t pairs(const ColumnMatrix& m) {
  const std::vector<std::int32_t> rows = matched_rows(m);
  EXPECT_EQ(std::set(rows.begin(), rows.end()).size(), static_cast<std::size_t>(m.columns));
  std::size_t n = 0;
  for (std::int32_t c = 0; c < m.columns; ++c)
    for_each_in_column(m, c, [&](std::int32_t r, double) { n += r == rows[static_cast<std::size_t>(c)]; });
  return n;
}

// Columns k and k + 1 in row k, the first column in the last row: with the diagonal taken for as long as there is one,
// the last column is only matched along a path through all of them.
TEST(RowMatching, goes_through_the_whole_of_a_matrix_where_it_must) {
  constexpr std::int32_t n = 50;
  std::vector<Triplet> entries;
  for (std::int32_t k = 0; k + 1 < n; ++k) {
    entries.push_back({k, k, 1});
    entries.push_back({k, k + 1, 1});
  }
  entries.push_back({n - 1, 0, 1});
  EXPECT_EQ(pairs(compressed(n, n, entries)), 50u);
}

TEST(RowMatching, pairs_as_many_as_there_are_in_a_singular_matrix) {
  EXPECT_EQ(pairs(compressed(3, 3, std::vector<Triplet>{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 2, 1}})), 2u);
}

// Of a pattern that has the diagonal: its entries are zero, next to nothing beside their column, or so in units of
// their row alone.
TEST(RowMatching, takes_entries_that_elimination_can_divide_by) {
  const ColumnMatrix m =
      compressed(4, 4,
                 std::vector<Triplet>{
                     {0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1e-3}, {2, 2, 1e6}, {2, 3, 1e9}, {3, 2, 2}, {3, 3, 1}});
  EXPECT_EQ(matched_rows(m), (std::vector<std::int32_t>{1, 0, 3, 2}));
}

// The first two columns have one large entry, both in one row.
TEST(RowMatching, takes_small_entries_and_zeros_where_large_ones_are_not_enough) {
  EXPECT_EQ(pairs(compressed(
                3, 3, std::vector<Triplet>{{0, 0, 1}, {1, 0, 0.01}, {0, 1, 1}, {1, 1, 0.01}, {1, 2, 1}, {2, 2, 1}})),
            3u);
  EXPECT_EQ(pairs(compressed(2, 2, std::vector<Triplet>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}})), 2u);
}

TEST(RowMatching, puts_the_row_of_each_column_first_and_keeps_the_others) {
  // A cycle, so that no row stands first in its column of itself.
  constexpr std::int32_t n = 6;
  std::vector<Triplet> entries;
  for (std::int32_t k = 0; k < n; ++k) {
    entries.push_back({k, (k + 1) % n, 1});
    entries.push_back({0, k, 1});
  }
  const ColumnMatrix m = compressed(n, n, entries);
  const auto matched = matched_rows(m);
  const auto rows = rows_with_matched_first(m);
  for (std::size_t c = 0; c < static_cast<std::size_t>(n); ++c) {
    const auto first = m.start[c], last = m.start[c + 1];
    EXPECT_EQ(rows[static_cast<std::size_t>(first)], matched[c]);
    EXPECT_TRUE(std::is_permutation(rows.begin() + first, rows.begin() + last, m.row.begin() + first));
  }
}

}  // namespace
}  // namespace dynalin::row_matching_test
