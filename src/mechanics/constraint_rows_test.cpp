#include <gtest/gtest.h>

#include "mechanics/equations.h"
#include "mechanics/paths_test_support.h"

namespace dynalin::mechanics_test::constraint_rows_test {

// What cancels to nothing has the size of what was added up, by which its rounding is measured.
TEST(ConstraintRows, entries_keep_the_size_of_what_was_added) {
  const Paths p;
  ConstraintRows rows;
  rows.resize(p.layout, 1);
  rows.begin();
  rows.add(0, 3, {.g = 2, .v = 1, .a1 = 5, .a0 = 7});
  rows.add(0, 3, {.g = -2, .v = 3, .a1 = 1, .a0 = -4});
  const auto row = rows.row(0);
  ASSERT_EQ(row.size(), 1u);
  EXPECT_EQ(row[0].column, 3);
  EXPECT_EQ(row[0].c.g, 0);
  EXPECT_EQ(row[0].c.v, 4);
  EXPECT_EQ(row[0].c.a1, 6);
  EXPECT_EQ(row[0].c.a0, 3);
  EXPECT_EQ(row[0].size_of_g, 4);
  rows.drop(0);
  EXPECT_EQ(rows.row(0)[0].size_of_g, 0);
}

TEST(ConstraintRows, settling_drops_places_that_hold_nothing) {
  const Paths p;
  ConstraintRows rows;
  rows.resize(p.layout, 2);
  rows.begin();
  rows.add(0, 3, {.g = 2});
  rows.add(0, 3, {.g = -2});
  rows.add(0, 4, {});
  rows.add(0, 5, {.a0 = 1});
  rows.add(1, 0, {});
  rows.settle();
  const auto row = rows.row(0);
  ASSERT_EQ(row.size(), 2u);
  EXPECT_EQ(row[0].column, 3);
  EXPECT_EQ(row[0].size_of_g, 4);
  EXPECT_EQ(row[1].column, 5);
  EXPECT_EQ(row[1].c.a0, 1);
  EXPECT_TRUE(rows.row(1).empty());
}

}  // namespace dynalin::mechanics_test::constraint_rows_test
