#include "base/diagnostics.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace dynalin::diagnostics_test {
namespace {

constexpr std::string_view any_code = "unexpected-text";

Span find(const SourceText& source, std::string_view text) {
  return {&source, static_cast<std::uint32_t>(source.text().find(text)), static_cast<std::uint32_t>(text.size())};
}

TEST(render, shows_the_line_and_a_caret_under_the_place) {
  const SourceText source("car.adm", std::string(40, '\n') + "SPRINGDAMPER/4, I = 12, J=121, K=4.0E4\n");
  Diagnostics diagnostics;
  diagnostics.error("wrong-count", find(source, "121"), "SPRINGDAMPER/4 refers to MARKER/121, which does not exist",
                    "MARKER/112 and MARKER/1211 exist");
  EXPECT_EQ(render(diagnostics.items()[0]),
            "car.adm:41:27: error: SPRINGDAMPER/4 refers to MARKER/121, which does not exist "
            "[wrong-count]\n"
            "   41 | SPRINGDAMPER/4, I = 12, J=121, K=4.0E4\n"
            "      |                           ^~~\n"
            "hint: MARKER/112 and MARKER/1211 exist\n");
}

TEST(render, without_source_shows_only_the_message) {
  Diagnostics diagnostics;
  diagnostics.error(any_code, Span{}, "the model has no ground");
  EXPECT_EQ(render(diagnostics), "error: the model has no ground [unexpected-text]\n");
}

TEST(render, keeps_tabs_above_the_caret) {
  const SourceText source("a.adm", "\tK\t= x\n");
  Diagnostics diagnostics;
  diagnostics.warning(any_code, find(source, "x"), "m");
  EXPECT_EQ(render(diagnostics),
            "a.adm:1:6: warning: m [unexpected-text]\n"
            "    1 | \tK\t= x\n"
            "      | \t \t  ^\n");
}

TEST(render, counts_a_character_of_several_bytes_as_one_column) {
  const SourceText source("a.adm", "é = x\n");
  Diagnostics diagnostics;
  diagnostics.error(any_code, find(source, "x"), "m");
  EXPECT_NE(render(diagnostics).find("      |     ^\n"), std::string::npos);
}

TEST(render, replaces_bytes_that_no_terminal_shows) {
  const SourceText source("a.adm", std::string("A\0B\x1B\xFF x", 7));
  Diagnostics diagnostics;
  diagnostics.error(any_code, find(source, "x"), "m");
  EXPECT_NE(render(diagnostics).find("    1 | A?B?? x\n      |       ^\n"), std::string::npos);
}

TEST(render, cuts_long_lines_around_the_caret) {
  const SourceText source("a.adm", std::string(1'000'000, 'a') + "x" + std::string(1'000'000, 'b'));
  Diagnostics diagnostics;
  diagnostics.error(any_code, {&source, 1'000'000, 1}, "m");
  EXPECT_EQ(render(diagnostics),
            "a.adm:1:1000001: error: m [unexpected-text]\n"
            "    1 | ..." +
                std::string(60, 'a') + "x" + std::string(39, 'b') + "...\n      |    " + std::string(60, ' ') + "^\n");
}

TEST(render, marks_a_span_over_several_lines_on_its_first_line_only) {
  const SourceText source("a.adm", "PART/1\n, GROUND\n");
  Diagnostics diagnostics;
  diagnostics.error(any_code, {&source, 5, 10}, "m");
  EXPECT_NE(render(diagnostics).find("    1 | PART/1\n      |      ^\n"), std::string::npos);
}

TEST(render, puts_the_caret_behind_the_line_for_a_place_at_its_end) {
  const SourceText source("a.adm", "K=\n");
  Diagnostics diagnostics;
  diagnostics.error(any_code, {&source, 2, 0}, "m");
  EXPECT_NE(render(diagnostics).find("    1 | K=\n      |   ^\n"), std::string::npos);
}

TEST(render, shows_notes_with_their_own_place) {
  const SourceText source("a.adm", "MARKER/12\nMARKER/12\n");
  Diagnostics diagnostics;
  diagnostics.error(any_code, {&source, 10, 9}, "MARKER/12 is defined twice")
      .notes.push_back({{&source, 0, 9}, "the first one is here"});
  EXPECT_EQ(render(diagnostics),
            "a.adm:2:1: error: MARKER/12 is defined twice [unexpected-text]\n"
            "    2 | MARKER/12\n"
            "      | ^~~~~~~~~\n"
            "a.adm:1:1: note: the first one is here\n"
            "    1 | MARKER/12\n"
            "      | ^~~~~~~~~\n");
}

TEST(render, orders_by_place_and_counts_what_the_limit_hides) {
  const SourceText source("a.adm", "a b c d");
  Diagnostics diagnostics;
  diagnostics.error(any_code, {&source, 4, 1}, "third");
  diagnostics.error(any_code, {&source, 0, 1}, "first");
  diagnostics.warning(any_code, {&source, 6, 1}, "fourth");
  diagnostics.error(any_code, {&source, 2, 1}, "second");
  const std::string text = render(diagnostics, 1);
  EXPECT_TRUE(text.starts_with("a.adm:1:1: error: first"));
  EXPECT_TRUE(text.ends_with("2 more errors of the kind [unexpected-text]\n"));
  EXPECT_NE(text.find("warning: fourth"), std::string::npos);
  EXPECT_LT(render(diagnostics).find("second"), render(diagnostics).find("third"));
}

TEST(diagnostics, count_errors_and_not_warnings) {
  Diagnostics first, second;
  first.warning(any_code, Span{}, "w");
  EXPECT_FALSE(first.has_errors());
  second.error(any_code, Span{}, "e");
  first.append(second);
  EXPECT_EQ(first.error_count(), 1u);
  EXPECT_EQ(first.items().size(), 2u);
}

TEST(explanation, exists_for_listed_codes_only) {
  ASSERT_TRUE(find_explanation("unknown-statement"));
  EXPECT_FALSE(find_explanation("unknown-statement")->text.empty());
  EXPECT_FALSE(find_explanation("no-such-code"));
}

TEST(explanation, is_listed_once_for_each_code) {
  std::set<std::string_view> codes;
  for (const Explanation& e : explanations()) {
    EXPECT_TRUE(codes.insert(e.code).second) << e.code;
    EXPECT_FALSE(e.text.empty()) << e.code;
  }
}

// Advice is more than the line that it stands under, and fits a terminal.
TEST(explanation, advises) {
  for (const Explanation& e : explanations()) {
    EXPECT_GT(e.advice.size(), 80u) << e.code;
    EXPECT_NE(e.advice.find_first_not_of(" \n"), std::string_view::npos) << e.code;
    EXPECT_FALSE(e.advice.starts_with('\n') || e.advice.ends_with('\n')) << e.code;
    EXPECT_EQ(e.advice.find(e.text), std::string_view::npos) << e.code;
    for (std::size_t begin = 0; begin < e.advice.size();) {
      const std::size_t end = std::min(e.advice.find('\n', begin), e.advice.size());
      EXPECT_LE(end - begin, 121u) << e.code;
      begin = end + 1;
    }
  }
}

#ifndef NDEBUG
TEST(diagnostics_death, catches_a_code_that_is_not_listed) {
  Diagnostics diagnostics;
  EXPECT_DEATH(diagnostics.error("no-such-code", Span{}, "m"), "diagnostics.def");
}
#endif

}  // namespace
}  // namespace dynalin::diagnostics_test
