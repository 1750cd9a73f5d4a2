#include <gtest/gtest.h>

#include <numbers>

#include "base/degree.h"
#include "dataset/dataset.h"
#include "dataset/test_reading.h"

namespace dynalin::testing::values_test {
namespace {

// One argument of PART/2 and what reading it reports; the value begins in column 11.
class Written {
 public:
  explicit Written(const std::string& value) : parsed_(read("PART/2, X" + value)) {}
  const WrittenArgument& argument() const { return parsed_.value.statements.at(0).arguments.at(0); }
  const SourceText& source() const { return *parsed_.value.source; }
  Diagnostics& diagnostics() { return diagnostics_; }
  Texts found() const { return problems(diagnostics_); }

 private:
  Parsed<Dataset> parsed_;
  Diagnostics diagnostics_;
};

std::optional<double> real(const std::string& text) {
  Written x("=" + text);
  const auto value = read_real(x.argument(), x.source(), x.diagnostics());
  EXPECT_EQ(value.has_value(), !x.diagnostics().has_errors());
  return value;
}

Texts real_problems(const std::string& value) {
  Written x(value);
  EXPECT_EQ(read_real(x.argument(), x.source(), x.diagnostics()), std::nullopt);
  return x.found();
}

TEST(read_real, knows_the_ways_to_write_a_number) {
  EXPECT_EQ(real("12"), 12.0);
  EXPECT_EQ(real("1."), 1.0);
  EXPECT_EQ(real(".5"), 0.5);
  EXPECT_EQ(real("0012"), 12.0);
  EXPECT_EQ(real("-1.5E-3"), -1.5e-3);
  EXPECT_EQ(real("+ 2e+005"), 2e5);
  EXPECT_EQ(real("1.E2"), 100.0);
  EXPECT_EQ(real("123456789012"), 123456789012.0);
  EXPECT_EQ(real("1E-999"), 0.0);
  EXPECT_EQ(real("0.000000E+999"), 0.0);
}

TEST(read_real, converts_degrees) {
  EXPECT_EQ(real("90D"), 90 * degree);
  EXPECT_EQ(real("-45.5d"), -45.5 * degree);
  EXPECT_EQ(real("1E1D"), 10 * degree);
}

TEST(read_real, reports_what_is_no_number) {
  EXPECT_EQ(real_problems("=abc"), Texts{"2:11 expected-number"});
  EXPECT_EQ(real_problems("=-abc"), Texts{"2:12 expected-number"});
  EXPECT_EQ(real_problems("=2*3"), Texts{"2:12 expected-number"});
  EXPECT_EQ(real_problems("=1.2.3"), Texts{"2:14 expected-comma"});
  EXPECT_EQ(real_problems("=-"), Texts{"2:11 missing-value"});
  EXPECT_EQ(real_problems("='5'"), Texts{"2:11 expected-number"});
}

TEST(read_real, wants_one_number) {
  EXPECT_EQ(real_problems("=1,2"), Texts{"2:11 wrong-count"});
  EXPECT_EQ(real_problems(""), Texts{"2:9 missing-value"});
}

TEST(read_real, is_silent_about_what_was_reported_before) {
  EXPECT_EQ(real_problems("="), Texts{});
  EXPECT_EQ(real_problems("=1E999"), Texts{});
  EXPECT_EQ(real_problems("=(5"), Texts{});
}

std::optional<std::vector<double>> reals(const std::string& text, std::size_t count = 0) {
  Written x("=" + text);
  return read_reals(x.argument(), x.source(), x.diagnostics(), count);
}

Texts reals_problems(const std::string& text, std::size_t count = 0) {
  Written x("=" + text);
  EXPECT_EQ(read_reals(x.argument(), x.source(), x.diagnostics(), count), std::nullopt);
  return x.found();
}

TEST(read_reals, reads_lists_over_lines) {
  EXPECT_EQ(reals("1, -2\n, 3"), (std::vector<double>{1, -2, 3}));
  EXPECT_EQ(reals("1, -2,\n, 3"), (std::vector<double>{1, -2, 3}));
  EXPECT_EQ(reals("1, &\n -2, 3"), (std::vector<double>{1, -2, 3}));
  EXPECT_EQ(reals("90D, 0, 0D", 3), (std::vector<double>{90 * degree, 0, 0}));
}

TEST(read_reals, reports_the_wrong_count) {
  Written x("=1,2");
  read_reals(x.argument(), x.source(), x.diagnostics(), 3);
  EXPECT_EQ(x.found(), Texts{"2:11 wrong-count"});
  EXPECT_EQ(x.diagnostics().items()[0].message, "X takes 3 numbers, found 2");
}

TEST(read_reals, reports_gaps_and_missing_commas) {
  EXPECT_EQ(reals_problems("1,,3"), Texts{"2:13 missing-value"});
  EXPECT_EQ(reals_problems("1 2 3"), Texts{"2:13 expected-comma"});
  EXPECT_EQ(reals_problems("1, 2 -3"), Texts{"2:16 expected-number"});
}

TEST(read_integer, reads_whole_numbers) {
  Written x("= -0012");
  const auto value = read_integer(x.argument(), x.source(), x.diagnostics());
  ASSERT_TRUE(value);
  EXPECT_EQ(value->value, -12);
  EXPECT_EQ(value->at.text(), "-0012");
  Written y("=5.0");
  EXPECT_EQ(read_integer(y.argument(), y.source(), y.diagnostics())->value, 5);
}

TEST(read_integer, refuses_fractions_and_degrees) {
  for (const char* text : {"=1.5", "=5D", "=1E300"}) {
    Written x(text);
    EXPECT_FALSE(read_integer(x.argument(), x.source(), x.diagnostics()));
    EXPECT_EQ(x.found(), Texts{"2:11 expected-integer"});
  }
}

TEST(read_integers, keeps_the_place_of_each) {
  Written x("=1, 22");
  const auto values = read_integers(x.argument(), x.source(), x.diagnostics());
  ASSERT_TRUE(values);
  ASSERT_EQ(values->size(), 2u);
  EXPECT_EQ((*values)[1].value, 22);
  EXPECT_EQ(x.source().place((*values)[1].at.offset).column, 14u);
}

TEST(read_word, gives_the_word_as_written) {
  Written x("=Rorder");
  EXPECT_EQ(read_word(x.argument(), x.source(), x.diagnostics())->text(), "Rorder");
  Written y("=3DBEAM");
  EXPECT_EQ(read_word(y.argument(), y.source(), y.diagnostics())->text(), "3DBEAM");
}

TEST(read_word, refuses_numbers_and_several_words) {
  Written x("=5");
  EXPECT_FALSE(read_word(x.argument(), x.source(), x.diagnostics()));
  EXPECT_EQ(x.found(), Texts{"2:11 expected-word"});
  Written y("=A:B");
  EXPECT_FALSE(read_word(y.argument(), y.source(), y.diagnostics()));
  EXPECT_EQ(y.found(), Texts{"2:12 expected-word"});
}

TEST(read_words, reads_words_between_colons) {
  for (const char* text : {"=T:F : T", "=T:F:\n, T", "=T:F\n, :T"}) {
    Written x(text);
    const auto words = read_words(x.argument(), x.source(), x.diagnostics());
    ASSERT_TRUE(words) << text;
    ASSERT_EQ(words->size(), 3u);
    EXPECT_EQ((*words)[1].text(), "F");
  }
}

TEST(read_words, reports_a_missing_word) {
  Written x("=T:");
  EXPECT_FALSE(read_words(x.argument(), x.source(), x.diagnostics()));
  EXPECT_EQ(x.found(), Texts{"2:12 missing-value"});
  Written y("=T::F");
  EXPECT_FALSE(read_words(y.argument(), y.source(), y.diagnostics()));
  EXPECT_EQ(y.found(), Texts{"2:13 expected-word"});
}

TEST(read_text, keeps_file_names_as_they_are) {
  const Parsed<Dataset> parsed = read("MATRIX/1, FILE = ./In-1.MAT , NAME='A c'");
  const Statement& matrix = parsed.value.statements.at(0);
  Diagnostics diagnostics;
  EXPECT_EQ(read_text(matrix.arguments[0], *parsed.value.source, diagnostics), "./In-1.MAT");
  EXPECT_EQ(read_text(matrix.arguments[1], *parsed.value.source, diagnostics), "A c");
  EXPECT_FALSE(diagnostics.has_errors());
}

}  // namespace
}  // namespace dynalin::testing::values_test
