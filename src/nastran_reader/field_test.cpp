#include "nastran_reader/field.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dynalin::nastran_reader::field_test {
namespace {

Field field(std::string_view text) { return read_field(text, {}); }

TEST(Field, reals_in_every_written_form) {
  for (const auto text :
       {"7.0", "7.", "+7.", ".7E1", "0.7+1", ".70+1", "7.E+0", "70.-1", "7.0D0", ".7D+1", "7.d0", " 7. "}) {
    const Field f = field(text);
    EXPECT_EQ(f.form, Field::Form::real) << text;
    EXPECT_EQ(f.real, 7.0) << text;
  }
  EXPECT_EQ(field("1.5-7").real, 1.5e-7);
  EXPECT_EQ(field("-.0123456").real, -0.0123456);
  EXPECT_EQ(field("1.23-305").real, 1.23e-305);
  EXPECT_EQ(field("1.-400").real, 0);
  EXPECT_TRUE(field("1.0D0").double_precision);
  EXPECT_FALSE(field("1.0E0").double_precision);
}

TEST(Field, integers_have_no_point) {
  EXPECT_EQ(field("123456").integer, 123456);
  EXPECT_EQ(field("-1").integer, -1);
  EXPECT_EQ(field("+12").integer, 12);
  EXPECT_EQ(field("12.").form, Field::Form::real);
}

TEST(Field, words_begin_with_a_letter) {
  EXPECT_EQ(field("thru").text, "THRU");
  EXPECT_EQ(field("K2").form, Field::Form::word);
  EXPECT_EQ(field("2K").form, Field::Form::wrong);
}

TEST(Field, wrong_forms_are_told) {
  for (const auto text : {"1 2", "1.5 7", "1E5", "1.E", "1.5-", "--1.", "1..", ".", "-", "+", "1.5F3", "1.+400",
                          "99999999999", "E", "1.5E+-3", "0x1.", "nan.", "1,"}) {
    if (std::string_view(text) == "E") {
      EXPECT_EQ(field(text).form, Field::Form::word);
      continue;
    }
    EXPECT_EQ(field(text).form, Field::Form::wrong) << text;
  }
}

// Whatever a number is, each form that has it is read back to the last digit.
TEST(Field, reads_random_reals_back) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int k = 0; k < 20000; ++k) {
    const double x = mantissa(random) * std::pow(10.0, exponent(random));
    const std::string e = fmt::format("{:.17E}", x);
    EXPECT_EQ(field(e).real, x) << e;
    const std::size_t at = e.find('E');
    const std::string digits = e.substr(0, at), power = e.substr(at + 1);
    EXPECT_EQ(field(digits + power).real, x) << digits + power;
    EXPECT_EQ(field(digits + "D" + power).real, x);
    EXPECT_EQ(field(digits + "d" + power).real, x);
    EXPECT_EQ(field("  " + digits + "e" + power + " ").real, x);
    if (std::abs(x) > 1e-5 && std::abs(x) < 1e10) {
      const std::string plain = fmt::format("{:.20f}", x);
      EXPECT_EQ(field(plain).real, std::stod(plain));
    }
  }
}

}  // namespace
}  // namespace dynalin::nastran_reader::field_test
