// Expressions that share what they have in common, and keep what they have not.
#include "expression/program_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "expression/expression_test_support.h"
#include "expression/program.h"

namespace dynalin::expression_test::program_shape_test {
namespace {

ParsedText parse_with(ProgramShapes& shapes, std::string text) {
  ParsedText result = parse("0");
  result.source = std::make_shared<const SourceText>("test.adm", std::move(text));
  Lexer lexer(*result.source, 0);
  std::vector<Token> tokens;
  lexer.next_statement(tokens);
  result.expression = parse_expression(tokens, *result.source, result.diagnostics, shapes);
  return result;
}

// Whether two expressions have one list of nodes in memory.
bool share(const ParsedText& a, const ParsedText& b) {
  return a.expression.program().nodes().data() == b.expression.program().nodes().data();
}

TEST(ProgramShape, expressions_that_differ_in_numbers_and_ids_share_it) {
  ProgramShapes shapes;
  const ParsedText a = parse_with(shapes, "-12.5*(DM(11,12)-100.0)**3+STEP(TIME,0,0,1,2)");
  const ParsedText b = parse_with(shapes, "-99.5*(DM(21,22)-200.0)**2+STEP(TIME,0,0,1,7)");
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
  std::vector<ParsedText> all;
  for (const char* text : texts) all.push_back(parse_with(shapes, text));
  for (std::size_t k = 0; k < all.size(); ++k) {
    ASSERT_FALSE(all[k].diagnostics.has_errors()) << texts[k];
    for (std::size_t n = 0; n < k; ++n) EXPECT_FALSE(share(all[k], all[n])) << texts[k] << " and " << texts[n];
  }
}

TEST(ProgramShape, places_are_those_of_each_text) {
  ProgramShapes shapes;
  const ParsedText a = parse_with(shapes, "1+SQRT(VARVAL(31))"), b = parse_with(shapes, "   1+SQRT(VARVAL(32))");
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
  const ParsedText p = parse_with(shapes, "DX(1)+DELAY(VARVAL(3),0.5,1)");
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
  const ParsedText first = parse_with(shapes, "TIME+1");
  for (int k = 0; k < 5000; ++k) {
    const ParsedText p = parse_with(shapes, "(" + std::string(static_cast<std::size_t>(k), ' ') + "TIME)+1");
    ASSERT_DOUBLE_EQ(evaluate<double>(p.expression, {2}).value, 3);
  }
  EXPECT_DOUBLE_EQ(evaluate<double>(first.expression, {2}).value, 3);
}

}  // namespace
}  // namespace dynalin::expression_test::program_shape_test
