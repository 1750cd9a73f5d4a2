// Random expressions: whatever is written, the parser ends with a message or a program, and a
// program gives the same on both scalars.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "expression/expression_test_support.h"
#include "expression/functions.h"

namespace dynalin::expression_test::expression_fuzz_test {
namespace {

using Taylor = TimeTaylor<double>;
using Random = std::mt19937;

std::size_t below(Random& random, std::size_t n) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

std::string random_expression(Random& random, int depth) {
  const auto inner = [&] { return random_expression(random, depth - 1); };
  if (depth == 0) {
    const char* leaves[] = {"TIME", "VARVAL(1)", "DX(1,2)", "VX(3,4,5)", "PI", "0", "2", "0.37", "90D", "1.5E-1"};
    return leaves[below(random, std::size(leaves))];
  }
  switch (below(random, 6)) {
    case 0:
      return "(" + inner() + ")";
    case 1:
      return "-" + inner();
    case 2:
      return "IF(" + inner() + ":" + inner() + "," + inner() + "," + inner() + ")";
    case 3: {
      const auto families = {elementary_functions(), contact_functions(), series_functions()};
      const auto family = std::data(families)[below(random, 3)];
      const Function& f = family[below(random, family.size())];
      const std::size_t most = std::min<std::size_t>(f.maximum_arguments, f.minimum_arguments + 6u);
      const std::size_t count = f.minimum_arguments + below(random, most - f.minimum_arguments + 1u);
      std::string text(f.name);
      for (std::size_t k = 0; k < count; ++k) text += (k == 0 ? "(" : ",") + inner();
      return text + ")";
    }
    default: {
      const char* operators[] = {"+", "-", "*", "/", "**"};
      return inner() + operators[below(random, 5)] + inner();
    }
  }
}

// Equal up to rounding, or both without a number.
void expect_same(double a, double b, const std::string& text) {
  if (!std::isfinite(a) || !std::isfinite(b)) return;
  EXPECT_NEAR(a, b, 1e-9 * std::max({1.0, std::fabs(a), std::fabs(b)})) << text;
}

TEST(ExpressionFuzz, both_scalars_agree_on_random_expressions) {
  Random random(20240607);
  std::size_t finite = 0, faults = 0;
  for (int round = 0; round < 3000; ++round) {
    const ParsedText parsed = parse(random_expression(random, 1 + round % 4));
    const std::string text(parsed.source->text());
    for (const Diagnostic& d : parsed.diagnostics.items()) {
      EXPECT_EQ(d.code, "function-domain") << render(d);
    }
    if (parsed.diagnostics.has_errors()) continue;
    const std::size_t n = parsed.expression.atoms().size();
    std::vector<double> x;
    std::vector<Taylor> course;
    for (std::size_t k = 0; k < n; ++k) {
      x.push_back(std::uniform_real_distribution(-2.0, 2.0)(random));
      course.emplace_back(x.back(), 0.3, -0.2);
    }
    const Result<double> plain = evaluate(parsed.expression, x);
    const Result<Taylor> moving = evaluate(parsed.expression, course);
    EXPECT_TRUE(plain.value == moving.value.value ||
                !(std::fabs(plain.value - moving.value.value) > 1e-9 * std::max(1.0, std::fabs(plain.value))))
        << text;
    bool all_finite = std::isfinite(plain.value);
    for (std::size_t k = 0; k < n; ++k) {
      all_finite = all_finite && std::isfinite(plain.partial[k]);
      expect_same(plain.partial[k], moving.partial[k].value, text);
    }
    const auto found =
        parsed.expression.find_undefined(std::span<const double>(x), UndefinedSearch::value_and_partials);
    EXPECT_EQ(found.has_value(), !all_finite) << text;
    EXPECT_TRUE(!found || !found->reason.empty()) << text;
    finite += all_finite;
    faults += !all_finite;
  }
  EXPECT_GT(finite, 500u);
  EXPECT_GT(faults, 50u);
}

TEST(ExpressionFuzz, any_sequence_of_tokens_gives_a_program_or_an_error) {
  const char* pieces[] = {
      "(",       ")",       "[",    "]",    ",",     ":",           "+",   "-",       "*",     "/",    "**",
      "%",       "=",       "\\",   "#",    "'",     "IF(",         "IF",  "SIN(",    "SIN",   "MAX(", "STEP(",
      "DX(",     "DX(1,2)", "TIME", "MODE", "PI",    "FOO(",        "FOO", "AKISPL(", "USER(", "CPU",  "BUSH(",
      "1",       "0",       "2.5",  "30D",  "1e999", "99999999999", "\n,", "&\n",     " ",     "\xff", "JOINT(1,0,2,0)",
      "SQRT(-1)"};
  Random random(11);
  std::size_t programs = 0;
  for (int round = 0; round < 40000; ++round) {
    std::string text;
    const std::size_t length = 1 + below(random, 14);
    for (std::size_t k = 0; k < length; ++k) text += pieces[below(random, std::size(pieces))];
    const ParsedText parsed = parse(text);
    if (parsed.diagnostics.has_errors()) {
      EXPECT_TRUE(parsed.expression.is_constant());
      EXPECT_FALSE(render(parsed.diagnostics).empty());
      continue;
    }
    ++programs;
    const std::vector<double> x(parsed.expression.atoms().size(), 0.5);
    evaluate(parsed.expression, x);
    parsed.expression.find_undefined(std::span<const double>(x), UndefinedSearch::value_and_partials);
  }
  EXPECT_GT(programs, 100u);
}

}  // namespace
}  // namespace dynalin::expression_test::expression_fuzz_test
