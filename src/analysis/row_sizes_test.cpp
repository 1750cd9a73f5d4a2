// What coordinates outside bodies count from, and how they weigh, is a question of what they are and not of their type.
#include "analysis/row_sizes.h"

#include <gtest/gtest.h>

#include "analysis/outside_weight.h"

namespace dynalin::row_sizes_test {
namespace {

TEST(RowSizes, outside_bodies_are_told_by_their_role_alone) {
  const ElementLabel label{"FLEX_BODY", 7, {}, {}};
  for (const StateType type : {StateType::flex_body, StateType::fe_part, StateType{99}}) {
    Layout layout;
    layout.add_extra(label, {type, ExtraRole::shape}, {{"Q1"}, {"Q2"}});
    layout.add_extra(label, {type, ExtraRole::nodal}, {{"SX"}});
    layout.add_extra(label, {type}, {{"U"}});
    OperatingPoint op;
    op.extra = {-1e-6, 0, 0.25, 3};
    EXPECT_EQ(coordinate_sizes(layout, op), (std::vector<double>{1e-6, 0, 1, 3}));
    EXPECT_EQ(outside_weight(layout.extras[0]), deformation_weight);
    EXPECT_EQ(outside_weight(layout.extras[1]), 1);
    EXPECT_EQ(outside_weight(layout.extras[2]), follower_weight);
  }
}

// An angle that was turned a thousand times is rounded as one that is so large.
TEST(RowSizes, rounding_is_that_of_all_terms) {
  const std::vector<ConstraintRows::Entry> row = {{.column = 0, .c = {.g = -2}}};
  const double alone = row_rounding({1.0}, row, {});
  EXPECT_GT(alone, 0);
  RowTerms turned;
  turned.size = 6;
  EXPECT_DOUBLE_EQ(row_rounding({1.0}, row, turned), 4 * alone);
}

}  // namespace
}  // namespace dynalin::row_sizes_test
