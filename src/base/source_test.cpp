#include "base/source.h"

#include <gtest/gtest.h>

namespace dynalin::source_test {
namespace {

TEST(source_text, counts_lines_and_columns_from_one) {
  const SourceText source("a.adm", "title\nPART/1\n");
  EXPECT_EQ(source.line_count(), 2u);
  EXPECT_EQ(source.line(2), "PART/1");
  EXPECT_EQ(source.place(0).line, 1u);
  EXPECT_EQ(source.place(0).column, 1u);
  EXPECT_EQ(source.place(10).line, 2u);
  EXPECT_EQ(source.place(10).column, 5u);
}

TEST(source_text, knows_all_three_line_ends) {
  const SourceText source("a.adm", "one\r\ntwo\rthree\nfour");
  ASSERT_EQ(source.line_count(), 4u);
  EXPECT_EQ(source.line(1), "one");
  EXPECT_EQ(source.line(2), "two");
  EXPECT_EQ(source.line(3), "three");
  EXPECT_EQ(source.line(4), "four");
  EXPECT_EQ(source.place(5).line, 2u);
}

TEST(source_text, keeps_empty_lines) {
  const SourceText source("a.adm", "\n\nx\n");
  ASSERT_EQ(source.line_count(), 3u);
  EXPECT_EQ(source.line(1), "");
  EXPECT_EQ(source.line(3), "x");
}

TEST(source_text, takes_a_place_behind_the_text_as_its_end) {
  const SourceText source("a.adm", "one\ntwo\n");
  EXPECT_EQ(source.place(1000).line, 2u);
  EXPECT_EQ(source.place(1000).column, 4u);
}

TEST(source_text, may_be_empty) {
  const SourceText source("a.adm", "");
  EXPECT_EQ(source.line_count(), 1u);
  EXPECT_EQ(source.line(1), "");
  EXPECT_EQ(source.line(2), "");
  EXPECT_EQ(source.place(0).line, 1u);
}

TEST(source_text, drops_a_byte_order_mark) {
  const SourceText source("a.adm", "\xEF\xBB\xBFtitle\n");
  EXPECT_EQ(source.text(), "title\n");
}

TEST(source_text, ends_where_dos_ends_it) {
  EXPECT_EQ(SourceText("a.adm", "title\r\nEND\x1A").text(), "title\r\nEND");
  EXPECT_EQ(SourceText("a.adm", "title\nEND\n\x1A\x1A\x1A").text(), "title\nEND\n");
  EXPECT_EQ(SourceText("a.adm", "\x1A").text(), "");
  EXPECT_EQ(SourceText("a.adm", "a\x1A\n").text(), "a\x1A\n");
}

TEST(span, joins_from_the_start_of_the_first_to_the_end_of_the_last) {
  const SourceText source("a.adm", "SFORCE/12, I=1");
  const Span keyword{&source, 0, 6}, id{&source, 7, 2};
  EXPECT_EQ(join(keyword, id).text(), "SFORCE/12");
  EXPECT_EQ(join(id, keyword).text(), "SFORCE/12");
  EXPECT_EQ(join(Span{}, id).text(), "12");
  EXPECT_EQ(join(id, Span{}).text(), "12");
}

TEST(span, without_source_has_no_text) { EXPECT_EQ(Span{}.text(), ""); }

TEST(span, is_told_on_one_line) {
  const SourceText source("a.adm", "FUNCTION=  DX(1,2)*\n, (3  + ! a comment\r\n ,4)\n!\n, -5 \n");
  const Span all{&source, 9, static_cast<std::uint32_t>(source.text().size()) - 9};
  EXPECT_EQ(on_one_line(all), "DX(1,2)* (3 + 4) -5");
  EXPECT_EQ(on_one_line(all, 8), "DX(1,2)* …");
  EXPECT_EQ(on_one_line({&source, 11, 7}), "DX(1,2)");
}

}  // namespace
}  // namespace dynalin::source_test
