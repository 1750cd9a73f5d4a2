#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "dataset/dataset.h"

namespace dynalin::keywords_test {
namespace {

TEST(statement_name, knows_the_documented_short_forms) {
  const std::array<std::pair<std::string_view, std::string_view>, 44> cases{{
      {"M", "MARKER"},        {"ma", "MARKER"},     {"MAR", "MARKER"},     {"MATR", "MATRIX"},
      {"MATE", "MATERIAL"},   {"MO", "MOTION"},     {"MF", "MFORCE"},      {"MR", "MREQUEST"},
      {"J", "JOINT"},         {"JP", "JPRIM"},      {"P", "PART"},         {"pa", "PART"},
      {"POI", "POINT_MASS"},  {"PT", "PTCV"},       {"R", "REQUEST"},      {"RES", "RESULTS"},
      {"result", "RESULTS"},  {"gra", "GRAPHICS"},  {"GF", "GFORCE"},      {"GE", "GEAR"},
      {"GC", "GCON"},         {"sforce", "SFORCE"}, {"SF", "SFORCE"},      {"SPR", "SPRINGDAMPER"},
      {"SPL", "SPLINE"},      {"ST", "STRING"},     {"SE", "SENSOR"},      {"vari", "VARIABLE"},
      {"var", "VARIABLE"},    {"VF", "VFORCE"},     {"VT", "VTORQUE"},     {"LSE", "LSE"},
      {"LS", "LSOLVER"},      {"IC", "IC"},         {"INT", "INTEGRATOR"}, {"ACC", "ACCGRAV"},
      {"AR", "ARRAY"},        {"BE", "BEAM"},       {"BU", "BUSHING"},     {"CON", "CONTACT"},
      {"EQU", "EQUILIBRIUM"}, {"FI", "FIELD"},      {"FL", "FLEX_BODY"},   {"FR", "FRICTION"},
  }};
  for (const auto& [word, full] : cases) EXPECT_EQ(statement_name(word), full) << word;
}

TEST(statement_name, refuses_what_is_ambiguous_or_unknown) {
  for (const std::string_view word : {"G", "S", "FE_", "MAT", "MARKERS", "ADAMS", ""}) {
    EXPECT_EQ(statement_name(word), "") << word;
  }
}

TEST(statement_name, knows_every_name_by_itself) {
  for (const std::string_view name : statement_names()) EXPECT_EQ(statement_name(name), name);
}

TEST(find_keyword, prefers_an_exact_match_to_a_longer_word) {
  const std::array<std::string_view, 3> words{"IPX", "IP", "IPY"};
  EXPECT_EQ(find_keyword("ip", words), 1u);
}

TEST(find_keyword, takes_a_unique_beginning) {
  const std::array<std::string_view, 3> words{"GROUND", "MASS", "CM"};
  EXPECT_EQ(find_keyword("gr", words), 0u);
  EXPECT_EQ(find_keyword("x", words), std::nullopt);
}

TEST(find_keyword, lists_the_candidates_of_a_tie) {
  const std::array<std::string_view, 3> words{"XSCALE", "YSCALE", "XMIN"};
  std::vector<std::string_view> ambiguous;
  EXPECT_EQ(find_keyword("X", words, &ambiguous), std::nullopt);
  EXPECT_EQ(ambiguous, (std::vector<std::string_view>{"XSCALE", "XMIN"}));
  EXPECT_EQ(find_keyword("Z", words, &ambiguous), std::nullopt);
  EXPECT_TRUE(ambiguous.empty());
}

TEST(find_keyword, reads_a_documented_short_form_by_what_is_possible_there) {
  const std::array<std::string_view, 3> part{"MATERIAL", "MASS", "GROUND"};
  EXPECT_EQ(find_keyword("ma", part), 1u);
  const std::array<std::string_view, 3> joint{"CONVEL", "CYLINDRICAL", "REVOLUTE"};
  EXPECT_EQ(find_keyword("C", joint), 1u);
  const std::array<std::string_view, 3> graphics{"RM", "RANGLE", "RADIUS"};
  EXPECT_EQ(find_keyword("r", graphics), 2u);
  const std::array<std::string_view, 3> beam{"CRATIOK", "CRATIO", "CRATIOM"};
  EXPECT_EQ(find_keyword("crat", beam), 1u);
}

TEST(nearest_word, finds_what_was_probably_meant) {
  EXPECT_EQ(nearest_word("SFROCE", statement_names()), "SFORCE");
  EXPECT_EQ(nearest_word("markr", statement_names()), "MARKER");
  EXPECT_EQ(nearest_word("EQUILIBRUM", statement_names()), "EQUILIBRIUM");
}

TEST(nearest_word, finishes_what_was_left_unfinished) {
  EXPECT_EQ(nearest_word("TIM", std::array<std::string_view, 2>{"TM", "TIME"}), "TIME");
}

TEST(nearest_word, finds_nothing_for_strange_words) {
  EXPECT_EQ(nearest_word("displacement", statement_names()), "");
  EXPECT_EQ(nearest_word("", statement_names()), "");
  EXPECT_EQ(nearest_word(std::string(1000, 'M'), statement_names()), "");
}

}  // namespace
}  // namespace dynalin::keywords_test
