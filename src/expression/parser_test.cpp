// Grammar and messages of function expressions.
#include "expression/parser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "expression/expression_test_support.h"

namespace dynalin::expression_test::parser_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Precedence {
  const char* text;
  double value;
};

TEST(ExpressionParser, operators_bind_as_the_language_says) {
  const double a = 2, b = 3, c = 0.5;
  const Precedence table[] = {
      {"1+2*3", 7},
      {"1+FXMODE*3", 1},  // 0 but for CRATIO of a FLEX_BODY
      {"1-2-3", -4},
      {"8/4/2", 1},
      {"8/4*2", 4},
      {"1/2", 0.5},
      {"2**3**2", 512},
      {"-2**2", -4},
      {"(-2)**2", 4},
      {"(-2)**3", -8},
      {"2**-1", 0.5},
      {"2*-3", -6},
      {"2*-3*4", -24},
      {"2--3", 5},
      {"- - 3", 3},
      {"+3-+2", 1},
      {"-+-3", 3},
      {"2**-3*4", 0.5},
      {"-2*3+4", -2},
      {"4-2**2*3", -8},
      {"2**+3", 8},
      {"2 * * 3", 8},
      {"0**0", 1},
      {"-VARVAL(1)**-VARVAL(2)", -std::pow(a, -b)},
      {"-VARVAL(1)**-VARVAL(2)**-VARVAL(3)", -std::pow(a, -std::pow(b, -c))},
      {"VARVAL(1)*-VARVAL(2)**VARVAL(3)", a * -std::pow(b, c)},
      {"VARVAL(1)/VARVAL(2)/VARVAL(3)", a / b / c},
      {"VARVAL(1)-VARVAL(2)-VARVAL(3)", a - b - c},
      {"VARVAL(1)**VARVAL(2)**VARVAL(3)", std::pow(a, std::pow(b, c))},
  };
  for (const Precedence& row : table) {
    const ParsedText parsed = parse(row.text);
    ASSERT_THAT(parsed.problems(), IsEmpty()) << row.text;
    const std::vector<double> all{a, b, c};
    const std::vector<double> atoms(all.begin(),
                                    all.begin() + static_cast<std::ptrdiff_t>(parsed.expression.atoms().size()));
    EXPECT_DOUBLE_EQ(evaluate(parsed.expression, atoms).value, row.value) << row.text;
  }
}

TEST(ExpressionParser, constants_and_degrees_are_numbers) {
  EXPECT_DOUBLE_EQ(value("pi"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(value("180*DTOR"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(value("Rtod*Pi"), 180);
  EXPECT_DOUBLE_EQ(value("SIN(30D)"), 0.5);
  EXPECT_DOUBLE_EQ(value("1.5e-3 + .5"), 0.5015);
}

TEST(ExpressionParser, constant_parts_are_folded_also_inside_of_functions) {
  const ParsedText parsed = parse("STEP(1, 0, 2*3, 1, MAX(1, SIN(0))) + IF(-1: 5, VARVAL(1), VX(2))");
  EXPECT_TRUE(parsed.expression.is_constant());
  EXPECT_DOUBLE_EQ(evaluate<double>(parsed.expression, {}).value, 6);
}

TEST(ExpressionParser, continuation_marks_are_no_commas) {
  EXPECT_DOUBLE_EQ(value("2*(3-1)\n, -4"), 0);
  EXPECT_DOUBLE_EQ(value("MAX(2,\n, 7) ! the comma before the line end separates\n, + 1"), 8);
}

TEST(ExpressionParser, identical_atoms_are_stored_once) {
  const ParsedText parsed = parse("DX(1,2)+dx(1,2,0)*DX (0001, 2)-DX(2,1)+TIME*TIME");
  ASSERT_THAT(parsed.problems(), IsEmpty());
  ASSERT_EQ(parsed.expression.atoms().size(), 3u);
  const Atom& atom = parsed.expression.atoms()[0];
  EXPECT_EQ(atom.function->name, "DX");
  EXPECT_EQ(atom.argument[1], 2);
  EXPECT_EQ(atom.argument_count, 2);
  EXPECT_EQ(atom.at.text(), "DX(1,2)");
  EXPECT_EQ(atom.argument_at(1).text(), "2");
  EXPECT_EQ(parsed.expression.atoms()[2].function->family, AtomFamily::time);
  EXPECT_EQ(parsed.expression.at().text().size(), parsed.source->text().size());
}

TEST(ExpressionParser, every_atom_function_is_read_with_its_fewest_and_most_arguments) {
  for (const AtomFunction& f : atom_functions()) {
    if (f.name.find('.') != std::string_view::npos) continue;  // a component of UVX … has no name of its own
    for (const int count : {f.minimum_arguments, f.maximum_arguments}) {
      std::string text(f.name);
      for (int k = 0; k < count; ++k) text += k == 0 ? "(1" : ",1";
      if (count > 0) text += ")";
      const ParsedText parsed = parse(text);
      if (f.built) {
        EXPECT_THAT(parsed.problems(), IsEmpty()) << text;
        EXPECT_EQ(parsed.expression.atoms().size(), 1u);
      } else {
        EXPECT_THAT(parsed.problems(), ElementsAre("function-not-built 1:1")) << text;
        EXPECT_THAT(parsed.first().message, HasSubstr(std::string(f.name)));
      }
      if (count == 0) continue;
      const ParsedText longer = parse(text.substr(0, text.size() - 1) + ",1,1,1,1,1)");
      EXPECT_EQ(longer.first().code, f.built ? "wrong-argument-count" : "function-not-built");
    }
  }
}

TEST(ExpressionParser, references_are_classified) {
  EXPECT_EQ(reference_class(*find_atom_function("VX"), 3), ReferenceClass::marker);
  EXPECT_EQ(reference_class(*find_atom_function("SPDP"), 0), ReferenceClass::element);
  EXPECT_EQ(find_atom_function("SPDP")->statement, "SPRINGDAMPER");
  EXPECT_EQ(reference_class(*find_atom_function("SPDP"), 2), ReferenceClass::index);
  EXPECT_EQ(reference_class(*find_atom_function("SPDP"), 3), ReferenceClass::marker);
  EXPECT_EQ(reference_class(*find_atom_function("ARYVAL"), 1), ReferenceClass::index);
}

struct Wrong {
  const char* text;
  std::vector<std::string> problems;
};

TEST(ExpressionParser, errors_point_at_their_places) {
  const Wrong table[] = {
      {"", {"empty-expression 1:1"}},
      {"1+", {"missing-operand 1:2"}},
      {"1+*2", {"missing-operand 1:3"}},
      {"*2", {"missing-operand 1:1"}},
      {"()", {"missing-operand 1:2"}},
      {"(1+)", {"missing-operand 1:4"}},
      {"SIN(,1)", {"missing-operand 1:5"}},
      {"MAX(1,)", {"missing-operand 1:7"}},
      {"2 3", {"missing-operator 1:3"}},
      {"2 DX(1,2)", {"missing-operator 1:3"}},
      {"(2)(3)", {"missing-operator 1:4"}},
      {"PI(3)", {"missing-operator 1:3"}},
      {"(1+2", {"unbalanced-parenthesis 1:1"}},
      {"3*SIN(1+2", {"unbalanced-parenthesis 1:3"}},
      {"SIN(", {"unbalanced-parenthesis 1:1"}},
      {"2+DX(1,2", {"unbalanced-parenthesis 1:3"}},
      {"1+2)", {"unbalanced-parenthesis 1:4"}},
      {"1,2", {"misplaced-separator 1:2"}},
      {"(1,2)", {"misplaced-separator 1:3"}},
      {"1:2", {"misplaced-separator 1:2"}},
      {"IF(1,2,3,4)", {"misplaced-separator 1:5"}},
      {"IF(1:2:3,4)", {"misplaced-separator 1:7"}},
      {"IF(TIME:2,3)", {"wrong-argument-count 1:1"}},
      {"IF(TIME:2,3,4,5)", {"wrong-argument-count 1:14"}},
      {"IF(TIME)", {"wrong-argument-count 1:8"}},
      {"1+SINN(2)", {"unknown-function 1:3"}},
      {"1+FOO", {"unknown-function 1:3"}},
      {"SIN+1", {"missing-arguments 1:1"}},
      {"DX+1", {"missing-arguments 1:1"}},
      {"SIN()", {"wrong-argument-count 1:1"}},
      {"SIN(1,2)", {"wrong-argument-count 1:1"}},
      {"2*STEP(TIME,0,1,2)", {"wrong-argument-count 1:3"}},
      {"MAX(1)", {"wrong-argument-count 1:1"}},
      {"DX()", {"wrong-argument-count 1:1"}},
      {"DX(1,2,3,4)", {"wrong-argument-count 1:1"}},
      {"DX(1+1,2)", {"expected-integer 1:4"}},
      {"DX(1,2.)", {"expected-integer 1:6"}},
      {"DX(1,TIME)", {"expected-integer 1:6"}},
      {"DX(-1,2)", {"expected-integer 1:4"}},
      {"DX(9999999999,2)", {"expected-integer 1:4"}},
      {"DX(1,,2)", {"missing-operand 1:6"}},
      {"DX(1,2,)", {"missing-operand 1:8"}},
      {"FX(0,2)", {"argument-range 1:4"}},
      {"JOINT(1,2,2,0)", {"argument-range 1:9"}},
      {"JOINT(1,1,9,0)", {"argument-range 1:11"}},
      {"ARYVAL(1,0)", {"argument-range 1:10"}},
      {"TIME%TIME", {"vector-mismatch 1:5"}},
      {"CURVE(1,3,1,3)", {"argument-range 1:9"}},
      {"CURVE(1,0,4,3)", {"argument-range 1:11"}},
      {"CURVE(1,0,1,TIME)", {"expected-integer 1:13"}},
      {"INVPSD(TIME,1,0,5,9,0)", {"wrong-argument-count 1:1"}},
      {"INVPSD(TIME,TIME,0,5,9,0,1)", {"expected-integer 1:13"}},
      {"INVPSD(TIME,1,TIME,5,9,0,1)", {"expected-number 1:15"}},
      {"INVPSD(TIME,1,-1,5,9,0,1)", {"argument-range 1:15"}},
      {"INVPSD(TIME,1,2,2,9,0,1)", {"argument-range 1:17"}},
      {"INVPSD(TIME,1,2,5,1,0,1)", {"argument-range 1:19"}},
      {"INVPSD(TIME,1,2,5,200,0,1)", {"argument-range 1:19"}},
      {"INVPSD(TIME,1,2,5,9.5,2,1)", {"argument-range 1:19", "argument-range 1:23"}},
      {"INVPSD([1,2,3],1,2,5,9,0,1)", {"vector-mismatch 1:8"}},
      {"SENVAL(0)", {"argument-range 1:8"}},
      {"1+DELAY(TIME,1)", {"wrong-argument-count 1:3"}},
      {"DELAY(TIME,1,0,3,4)", {"wrong-argument-count 1:1"}},
      {"DELAY()", {"wrong-argument-count 1:1"}},
      {"DELAY(TIME,,0)", {"missing-operand 1:12"}},
      {"DELAY(TIME,1,", {"unbalanced-parenthesis 1:1"}},
      {"DELAY(TIME,FOO(MAX(1,2)),SIN(1,2))", {"unknown-function 1:12", "wrong-argument-count 1:26"}},
      {"DELAY(TIME,1,DX(1,2))", {"function-of-state 1:14"}},
      {"DELAY(TIME,1,0,1.5)", {"expected-integer 1:16"}},
      {"DELAY(DXYZ(1),1,0)", {"vector-mismatch 1:7"}},
      {"DELAY(2*DELAY(TIME,1,0),1,0)", {"function-not-built 1:9"}},
      {"SENVAL(1,2)", {"wrong-argument-count 1:1"}},
      {"FXFREQ*2", {"function-not-built 1:1"}},
      {"2*USER(1,2,3)", {"routine-in-expression 1:3"}},
      {"[1,2", {"unbalanced-parenthesis 1:1"}},
      {"[1)", {"unbalanced-parenthesis 1:3"}},
      {"(1]", {"unbalanced-parenthesis 1:3"}},
      {"1 # 2", {"bad-character 1:3"}},
      {"# 2", {"bad-character 1:1"}},
      {"1 = 2", {"bad-character 1:3"}},
      {"1/0", {"function-domain 1:1"}},
      {"DX(1,2)/0", {"function-domain 1:1"}},
      {"1+SQRT(-3)", {"function-domain 1:3"}},
      {"LOG(0)+ACOS(2)", {"function-domain 1:1", "function-domain 1:8"}},
      {"(-2)**.5", {"function-domain 1:1"}},
      {"0**-1", {"function-domain 1:1"}},
      {"EXP(1000)", {"function-domain 1:1"}},
      {"1+STEP(TIME,1,0,2-1,5)", {"function-domain 1:3"}},
      {"IF(TIME:0,0,STEP(TIME,1,0,1,5))", {"function-domain 1:13"}},
      {"IMPACT(DX(1,2),VX(1,2),1,-1,1,1,.1)", {"function-domain 1:1"}},
      {"BISTOP(TIME,1,5,4,1,1,1,.1)", {"function-domain 1:1"}},
      {"SWEEP(TIME,1,5,4,1,1,1)", {"function-domain 1:1"}},
      // Several mistakes, one message each.
      {"FOO(SQRT(-1))+\n, BAR(DX(1.5))/0",
       {"unknown-function 1:1", "function-domain 1:5", "unknown-function 2:3", "expected-integer 2:10"}},
  };
  for (const Wrong& row : table) {
    const ParsedText parsed = parse(row.text);
    EXPECT_THAT(parsed.problems(), ::testing::UnorderedElementsAreArray(row.problems)) << row.text;
    EXPECT_TRUE(parsed.expression.is_constant());
    EXPECT_EQ(evaluate<double>(parsed.expression, {}).value, 0.0);
  }
}

TEST(ExpressionParser, messages_say_what_was_found_and_what_could_be_meant) {
  EXPECT_EQ(parse("SQTR(2)").first().hint, "SQRT exists");
  EXPECT_EQ(parse("STEP(TIME,1,2)").first().message, "STEP takes 5 arguments, here are 3");
  EXPECT_EQ(parse("DX(1,2,3,4)").first().message, "DX takes 1 to 3 arguments, here are 4");
  EXPECT_THAT(parse("SPDP(TIME,1,2,0)").first().message, HasSubstr("the id of a SPRINGDAMPER"));
  EXPECT_THAT(parse("SQRT(-3)").first().message, HasSubstr("SQRT of -3"));
  EXPECT_THAT(parse("ORIENT(13,2,1)").first().message, HasSubstr("ORIENT with the system 13 is not available yet"));
}

TEST(ExpressionParser, errors_keep_their_places_within_a_dataset) {
  const auto source = std::make_shared<const SourceText>("model.adm",
                                                         "a title\n"
                                                         "VARIABLE/1, IC=2, FUNCTION=DX(1,2)*(2\n"
                                                         ",   +STEPP(TIME,0,1,2,3))\n"
                                                         "END\n");
  const Parsed<Dataset> dataset = parse_dataset(source);
  ASSERT_FALSE(dataset.diagnostics.has_errors());
  const WrittenArgument& function = dataset.value.statements.at(0).arguments.at(1);
  Diagnostics diagnostics;
  parse_expression(function.value(), *source, diagnostics);
  EXPECT_THAT(render(diagnostics), HasSubstr("model.adm:3:6: error: STEPP is no function"));
}

TEST(ExpressionParser, a_branch_that_may_never_be_taken_may_hold_a_constant_without_value) {
  EXPECT_THAT(parse("IF(TIME: 1/0, SQRT(-1), 3)").problems(), IsEmpty());
  EXPECT_EQ(value("IF(1: 1/0, SQRT(-1), 3)"), 3);
}

TEST(ExpressionParser, nesting_has_no_limit) {
  constexpr int depth = 20000;
  std::string parentheses, chain, functions, signs;
  for (int k = 0; k < depth; ++k) {
    parentheses += "(1+";
    chain += "IF(TIME-" + std::to_string(k) + ": 1, 2,";
    functions += "SIN(";
    signs += "-";
  }
  const std::string closing(depth, ')');
  EXPECT_EQ(value(parentheses + "TIME" + closing, {1}), depth + 1);
  EXPECT_EQ(evaluate(chain + "TIME" + closing, {1e6}).partial[0], 1);
  EXPECT_EQ(value(chain + "TIME" + closing, {7.0}), 2);
  EXPECT_NEAR(value(functions + "TIME" + closing, {1}), std::sqrt(3.0 / depth), 1e-4);
  EXPECT_EQ(value(signs + "TIME", {2}), 2);
  EXPECT_EQ(parse(parentheses).diagnostics.error_count(), 1u);
}

}  // namespace
}  // namespace dynalin::expression_test::parser_test
