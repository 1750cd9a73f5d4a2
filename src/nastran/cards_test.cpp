#include "nastran/cards.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <regex>

namespace dynalin::nastran::cards_test {
namespace {

// As Nastran reads it, or NaN: a point there must be, an exponent has a sign or a letter.
double read_real(const std::string& text) {
  static const std::regex form(R"(([+-]?(?:\d+\.\d*|\.\d+))(?:([DE])([+-]?\d+)|([+-]\d+))?)");
  std::smatch m;
  if (!std::regex_match(text, m, form)) return std::nan("");
  const std::string power = m[3].matched ? m[3].str() : m[4].matched ? m[4].str() : "0";
  return std::strtod((m[1].str() + "e" + power).c_str(), nullptr);
}

// Digits that a number of this magnitude has at least in so many columns without its sign.
int digits_promised(double magnitude, int columns, Exponent exponent) {
  const int e = static_cast<int>(std::floor(std::log10(magnitude)));
  const bool D = exponent == Exponent::letter_D;
  const int fixed_columns = columns - (D ? 3 : 1);
  const int fixed = e >= 0 && e < fixed_columns ? fixed_columns : e == -1 ? fixed_columns : 0;
  const int power_digits = std::abs(e) < 10 ? 1 : std::abs(e) < 100 ? 2 : 3;
  const int scientific = columns - 1 - (D && e >= 0 ? 1 : D ? 2 : 1) - power_digits;
  return std::max(fixed, scientific);
}

TEST(real_text, keeps_the_digits_that_fit_whatever_the_number) {
  std::mt19937_64 draw(3);
  for (const FieldWidth width : {FieldWidth::small, FieldWidth::large}) {
    for (const Exponent exponent : {Exponent::bare, Exponent::letter_D}) {
      const double range = exponent == Exponent::bare ? 37 : 300;
      for (int k = 0; k < 40000; ++k) {
        double power = std::uniform_real_distribution<double>(-range, range)(draw);
        if (k % 2) power = std::uniform_real_distribution<double>(-8, 17)(draw);
        double x = std::pow(10.0, power);
        if (k % 7 == 0) x = std::round(x);
        if (k % 11 == 0) x = std::nextafter(std::pow(10.0, std::round(power)), 0);  // a carry
        if (x == 0) continue;
        for (const double value : {x, -x}) {
          const std::string text = real_text(value, width, exponent);
          ASSERT_FALSE(text.empty()) << value;
          ASSERT_LE(text.size(), static_cast<std::size_t>(width)) << text;
          ASSERT_EQ(text.find('D') != std::string::npos, exponent == Exponent::letter_D) << text;
          const double read = read_real(text);
          const int digits = std::min(15, digits_promised(x, static_cast<int>(width) - (value < 0), exponent));
          const double half_digit = 0.5 * std::pow(10.0, std::floor(std::log10(x)) + 1 - digits);
          ASSERT_LE(std::abs(read - value), half_digit + 4e-16 * x) << value << " became " << text;
        }
      }
    }
  }
}

struct Written {
  double value;
  FieldWidth width;
  Exponent exponent;
  const char* text;
};

TEST(real_text, writes_the_forms_of_the_card_reference) {
  constexpr auto small = FieldWidth::small, large = FieldWidth::large;
  constexpr auto bare = Exponent::bare, D = Exponent::letter_D;
  for (const Written& w : {
           Written{0.0, small, bare, "0."},
           {-0.0, large, bare, "0."},
           {-0.0, large, D, "0.D0"},
           {1.0, small, bare, "1."},
           {1.0, large, D, "1.D0"},
           {-1.0, small, bare, "-1."},
           {7.25, small, bare, "7.25"},
           {0.5, small, bare, ".5"},
           {-0.5, small, bare, "-.5"},
           {1.5e-7, small, bare, "1.5-7"},
           {1.5e-7, large, D, "1.5D-7"},
           {9.9999999, small, bare, "10."},
           {99999999.0, small, bare, "1.+8"},
           {999999.96, small, bare, "1.+6"},
           {-0.99999999, small, bare, "-1."},
           {1.0 / 3, small, bare, ".3333333"},
           {-1.0 / 3, small, bare, "-.333333"},
           {1.0 / 3, large, bare, ".333333333333333"},
           {2.0 / 3e5, small, bare, "6.6667-6"},
           {2.0 / 3e12, small, bare, "6.667-13"},
           {1.23456789e12, small, bare, "12346.+8"},
           {1.23456789e-10, small, bare, ".12346-9"},
           {100.0, small, bare, "100."},
           {1234567.0, small, bare, "1234567."},
           {1e-40, large, bare, "0."},
           {1.25e-305, large, D, "1.25D-305"},
           {1e39, large, bare, ""},
           {std::numeric_limits<double>::infinity(), large, D, ""},
           {std::nan(""), small, bare, ""},
       })
    EXPECT_EQ(real_text(w.value, w.width, w.exponent), w.text) << w.value;
}

std::string text_of(const Card& card) {
  std::string text;
  card.append_to(text);
  return text;
}

TEST(Card, has_ten_fields_of_eight_columns) {
  const Card card =
      Card("GRID", FieldWidth::small).integer(7).blank().real(1.5).real(-2).real(0).reference(4).word("456");
  EXPECT_EQ(text_of(card), "GRID    7               1.5     -2.     0.      4       456\n");
}

TEST(Card, goes_on_in_the_next_row) {
  Card card("RBE2", FieldWidth::small);
  card.integer(1).integer(2).word("123456");
  for (int k = 10; k < 17; ++k) card.integer(k);
  EXPECT_EQ(text_of(card),
            "RBE2    1       2       123456  10      11      12      13      14\n"
            "+       15      16\n");
}

TEST(Card, has_large_rows_of_two_lines_always) {
  const Card mass = Card("CONM2", FieldWidth::large).integer(1).integer(2).reference(0).real(3);
  EXPECT_EQ(text_of(mass), "CONM2*  1               2                               3.\n*\n");
  const Card eigc = Card("EIGC", FieldWidth::large).integer(101).word("CLAN").row().real(1).real(2).integer(5);
  EXPECT_EQ(text_of(eigc), "EIGC*   101             CLAN\n*\n*       1.              2.              5\n*\n");
}

TEST(Card, names_what_does_not_fit) {
  EXPECT_EQ(Card("GRID", FieldWidth::small).integer(99'999'999).real(1).problem(), "");
  EXPECT_EQ(Card("GRID", FieldWidth::large).integer(100'000'000).problem(),
            "the number 100000000 does not fit into eight columns");
  EXPECT_EQ(Card("GRID", FieldWidth::large).real(std::nan("")).problem(), "a value is not finite");
  EXPECT_THAT(Card("GRID", FieldWidth::large).real(1e200).problem(), ::testing::HasSubstr("beyond single precision"));
  EXPECT_THAT(Card("DMIG", FieldWidth::large).word("KSTEERING").problem(), ::testing::HasSubstr("KSTEERING"));
}

// Its line is none that anybody reads, but there is one.
TEST(Card, has_a_line_with_what_does_not_fit) {
  for (const std::int64_t wide : {100'000'000LL, 123'456'789'012'345'678LL}) {
    const Card card = Card("GRID", FieldWidth::small).integer(wide).integer(7).blank().integer(8);
    EXPECT_EQ(card.problem(), "the number " + std::to_string(wide) + " does not fit into eight columns");
    EXPECT_TRUE(card.has_wide_number());
    EXPECT_EQ(text_of(card).substr(8, std::to_string(wide).size() + 1), std::to_string(wide) + "7");
  }
  EXPECT_FALSE(Card("GRID", FieldWidth::small).integer(7).has_wide_number());
}

TEST(Card, of_parameters_is_free) { EXPECT_EQ(parameter_card("POST", "0"), "PARAM,POST,0\n"); }

}  // namespace
}  // namespace dynalin::nastran::cards_test
