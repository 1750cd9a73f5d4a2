#include "nastran_reader/bulk.h"

#include <gtest/gtest.h>

namespace dynalin::nastran_reader::bulk_test {
namespace {

struct Read {
  DeckLines lines;
  std::vector<Card> cards;
  Diagnostics diagnostics;
};
Read read(const std::string& text) {
  Read r;
  r.lines = deck_lines_of_text("test.bdf", text, r.diagnostics);
  r.cards = read_bulk(r.lines.lines, r.diagnostics);
  return r;
}

void expect_grid(const Read& r) {
  EXPECT_FALSE(r.diagnostics.has_errors()) << render(r.diagnostics);
  ASSERT_EQ(r.cards.size(), 1u);
  const Card& c = r.cards[0];
  EXPECT_EQ(c.name, "GRID");
  EXPECT_EQ(c.field(0, 2).integer, 12);
  EXPECT_TRUE(c.field(0, 3).blank());
  EXPECT_EQ(c.field(0, 4).real, 1.5);
  EXPECT_EQ(c.field(0, 5).real, -2e-7);
  EXPECT_EQ(c.field(0, 6).real, 3);
  EXPECT_EQ(c.field(0, 7).integer, 4);
  EXPECT_EQ(c.field(0, 8).integer, 123456);
}

TEST(Bulk, small_large_and_free_field_are_the_same_card) {
  expect_grid(read("GRID    12              1.5     -2.-7   3.      4       123456\n"));
  expect_grid(read("grid,12,,1.5,-2.-7,3.,4,123456\n"));
  expect_grid(read("GRID , 12, , 1.5 , -2.E-7, 3., 4, 123456\r\n"));
  expect_grid(
      read("GRID*                 12                             1.5           -2.-7\n"
           "*                     3.               4          123456\n"));
  expect_grid(
      read("GRID*   12                              1.5             -2.-7           *A\n"
           "*A      3.              4               123456\n"));
  expect_grid(read("GRID*,12,,1.5,-2.0E-7\n*,3.,4,123456\n"));
  expect_grid(read("GRID\t12\t\t1.5\t-2.-7\t3.\t4\t123456\n"));
}

TEST(Bulk, comments_and_blank_lines_are_nothing) {
  expect_grid(read("$ a grid, with 1 comma\n\nGRID,12,,1.5,-2.-7,3.,4,123456 $ here\n   \n$\n"));
}

TEST(Bulk, continuations_by_place_and_by_tag) {
  for (const auto text : {
           "RBE2    1       2       123     3       4       5       6       7\n        8       9\n",
           "RBE2    1       2       123     3       4       5       6       7       +\n+       8       9\n",
           "RBE2    1       2       123     3       4       5       6       7       +AB\n+AB     8       9\n",
           "RBE2,1,2,123,3,4,5,6,7\n,8,9\n",
           "RBE2,1,2,123,3,4,5,6,7,+X\n+X,8,9\n",
           "RBE2,1,2,123,3,4,5,6,7,+\n+,8,9\n",
           "RBE2*,1,2,123,3\n*,4,5,6,7\n*,8,9\n",
           // Sorted decks keep rows apart.
           "+Q      8       9\nRBE2    1       2       123     3       4       5       6       7       +Q\n",
       }) {
    const Read r = read(text);
    EXPECT_FALSE(r.diagnostics.has_errors()) << text << render(r.diagnostics);
    ASSERT_EQ(r.cards.size(), 1u) << text;
    EXPECT_EQ(r.cards[0].field(0, 9).integer, 7) << text;
    EXPECT_EQ(r.cards[0].field(1, 2).integer, 8) << text;
    EXPECT_EQ(r.cards[0].field(1, 3).integer, 9) << text;
  }
}

TEST(Bulk, rows_without_a_card_are_told_at_their_place) {
  for (const auto text : {"+X,1\n", "GRID,1,,,,,,,,+A\n+B,1\n", "        1.5\n", "+A,1,,,,,,,+B\n+B,1,,,,,,,+A\n"}) {
    const Read r = read(text);
    ASSERT_TRUE(r.diagnostics.has_errors()) << text;
    EXPECT_EQ(r.diagnostics.items()[0].code, "lost-continuation");
  }
}

TEST(Bulk, long_values_in_free_field_and_lines_with_too_many) {
  EXPECT_EQ(read("GRID,1,,1.23456789\n").diagnostics.items().at(0).code, "field-overflow");
  EXPECT_FALSE(read("GRID*,1,,1.23456789\n").diagnostics.has_errors());
  EXPECT_EQ(read("RBE2,1,2,3,4,5,6,7,8,,10\n").diagnostics.items().at(0).code, "field-overflow");
}

}  // namespace
}  // namespace dynalin::nastran_reader::bulk_test
