// Expressions that share what they have in common, and keep what they have not.
#include "expression/program_shape.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "expression/expression_test_support.h"
#include "expression/program.h"

namespace dynalin::expression_test::program_shape_test {
namespace {

// The expressions of a text, one a line.
std::vector<ParsedText> parse_lines(ProgramShapes& shapes, const std::string& text) {
  const auto source = std::make_shared<const SourceText>("test.adm", text);
  Lexer lexer(*source, 0);
  std::vector<Token> tokens;
  std::vector<ParsedText> all;
  while (lexer.next_statement(tokens)) {
    ParsedText& line = all.emplace_back(parse("0"));
    line.source = source;
    line.expression = parse_expression(tokens, *source, line.diagnostics, shapes);
  }
  return all;
}

// Whether two expressions have one list of nodes in memory.
bool share(const ParsedText& a, const ParsedText& b) {
  return a.expression.program().nodes().data() == b.expression.program().nodes().data();
}

TEST(ProgramShape, expressions_that_differ_in_numbers_and_ids_share_it) {
  ProgramShapes shapes;
  const auto both = parse_lines(shapes,
                                "-12.5*(DM(11,12)-100.0)**3+STEP(TIME,0,0,1,2)\n"
                                "-99.5*(DM(21,22)-200.0)**2+STEP(TIME,0,0,1,7)");
  const ParsedText &a = both.at(0), &b = both.at(1);
  ASSERT_FALSE(a.diagnostics.has_errors() || b.diagnostics.has_errors());
  EXPECT_TRUE(share(a, b));
  EXPECT_EQ(a.expression.atoms()[0].argument[0], 11);
  EXPECT_EQ(b.expression.atoms()[0].argument[1], 22);
  EXPECT_DOUBLE_EQ(evaluate<double>(a.expression, {110, 2}).value, -12.5 * 1000 + 2);
  EXPECT_DOUBLE_EQ(evaluate<double>(b.expression, {210, 2}).value, -99.5 * 100 + 7);
  EXPECT_DOUBLE_EQ(evaluate<double>(b.expression, {210, 2}).partial[0], -99.5 * 20);
}

TEST(ProgramShape, expressions_that_differ_otherwise_have_their_own) {
  constexpr std::array texts = {"DX(11,12)+2", "DY(11,12)+2", "DX(11,12)-2", "DX(11,12)+ 2", "DX(11,120)+2",
                                "DX(11,12)*2", "DX(11)+2",    "SIN(TIME)",   "COS(TIME)",    "VARVAL(1)**2"};
  ProgramShapes shapes;
  const auto all = parse_lines(shapes, fmt::format("{}", fmt::join(texts, "\n")));
  ASSERT_EQ(all.size(), texts.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    ASSERT_FALSE(all[k].diagnostics.has_errors()) << texts[k];
    for (std::size_t n = 0; n < k; ++n) EXPECT_FALSE(share(all[k], all[n])) << texts[k] << " and " << texts[n];
  }
}

TEST(ProgramShape, places_are_those_of_each_text) {
  ProgramShapes shapes;
  const auto both = parse_lines(shapes, "1+SQRT(VARVAL(31))\n   1+SQRT(VARVAL(32))");
  const ParsedText &a = both.at(0), &b = both.at(1);
  ASSERT_TRUE(share(a, b));
  for (const ParsedText* p : {&a, &b}) {
    const Atom atom = p->expression.atoms()[0];
    const std::string id = p == &a ? "31" : "32";
    EXPECT_EQ(p->expression.at().text(), "1+SQRT(VARVAL(" + id + "))");
    EXPECT_EQ(atom.at.text(), "VARVAL(" + id + ")");
    EXPECT_EQ(atom.argument_at(0).text(), id);
    EXPECT_EQ(atom.argument_at(0).source, p->source.get());
    const std::vector<double> x = {-1};
    const auto fault = p->expression.find_undefined(std::span<const double>(x), UndefinedSearch::value);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->at.text(), "SQRT(VARVAL(" + id + "))");
  }
}

// Two arguments stand in the place of one number, behind the constants.
TEST(ProgramShape, arguments_of_atoms_are_those_of_each_text) {
  ProgramShapes shapes;
  const auto both = parse_lines(shapes,
                                "0.5*DX(1,2,3)+0.25*VARVAL(2147483647)-DY(4)\n"
                                "7.5*DX(5,6,7)+9.25*VARVAL(2000000008)-DY(9)");
  ASSERT_TRUE(share(both.at(0), both.at(1)));
  const auto ids = [](const ParsedText& p) {
    std::vector<std::int32_t> all;
    for (const Atom& atom : p.expression.atoms())
      all.insert(all.end(), atom.argument.begin(), atom.argument.begin() + atom.argument_count);
    return all;
  };
  EXPECT_EQ(ids(both[0]), (std::vector<std::int32_t>{1, 2, 3, 2147483647, 4}));
  EXPECT_EQ(ids(both[1]), (std::vector<std::int32_t>{5, 6, 7, 2000000008, 9}));
  EXPECT_DOUBLE_EQ(evaluate<double>(both[1].expression, {2, 4, 1}).value, 15 + 37 - 1);
}

// A shape knows its text.
TEST(ProgramShape, expressions_of_different_texts_have_their_own) {
  ProgramShapes shapes;
  const ParsedText a = parse_lines(shapes, "VARVAL(1)+2").at(0), b = parse_lines(shapes, "VARVAL(3)+4").at(0);
  EXPECT_FALSE(share(a, b));
  EXPECT_EQ(a.expression.atoms()[0].at.source, a.source.get());
  EXPECT_EQ(b.expression.atoms()[0].at.source, b.source.get());
  EXPECT_EQ(b.expression.at().text(), "VARVAL(3)+4");
}

// What a shape cannot tell is kept as it is: places in another text, and a DELAY.
TEST(ProgramShape, what_stands_in_another_text_keeps_its_place) {
  const ParsedText outer = parse("   2*VARVAL(1)"), inner = parse("SQRT(VARVAL(7))");
  const Expression e = outer.expression.with_definitions([&](const Atom&) { return inner.expression; });
  const std::vector<double> x = {-4};
  const auto fault = e.find_undefined(std::span<const double>(x), UndefinedSearch::value);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->at.source, inner.source.get());
  EXPECT_EQ(fault->at.text(), "SQRT(VARVAL(7))");
  const Atom atom = e.atoms()[0];
  EXPECT_EQ(atom.at.source, inner.source.get());
  EXPECT_EQ(atom.argument_at(0).text(), "7");
  EXPECT_EQ(e.at().text(), "2*VARVAL(1)");
}

TEST(ProgramShape, a_delay_keeps_what_it_is_made_of) {
  ProgramShapes shapes;
  const ParsedText p = parse_lines(shapes, "DX(1)+DELAY(VARVAL(3),0.5,1)").at(0);
  ASSERT_FALSE(p.diagnostics.has_errors());
  ASSERT_EQ(p.expression.atoms().size(), 2u);
  EXPECT_EQ(p.expression.atoms()[0].argument[0], 1);
  const Atom delay = p.expression.atoms()[1];
  ASSERT_TRUE(delay.delayed);
  EXPECT_EQ(delay.delayed->value.atoms()[0].argument[0], 3);
}

// More shapes than are kept at a time are read as well.
TEST(ProgramShape, any_number_of_them_may_be_read) {
  ProgramShapes shapes;
  const ParsedText first = parse_lines(shapes, "TIME+1").at(0);
  for (int k = 0; k < 5000; ++k) {
    const ParsedText p = parse_lines(shapes, "(" + std::string(static_cast<std::size_t>(k), ' ') + "TIME)+1").at(0);
    ASSERT_DOUBLE_EQ(evaluate<double>(p.expression, {2}).value, 3);
  }
  EXPECT_DOUBLE_EQ(evaluate<double>(first.expression, {2}).value, 3);
}

}  // namespace
}  // namespace dynalin::expression_test::program_shape_test
