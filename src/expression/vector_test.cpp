// Vectors inside expressions, and spline functions as the parser sees them.
#include <gmock/gmock.h>

#include <cmath>

#include "expression/expression_test_support.h"

namespace dynalin::expression_test::vector_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Vectors, constants_follow_the_rules_of_algebra) {
  EXPECT_DOUBLE_EQ(value("[1,2,3]*[4,5,6]"), 32);
  EXPECT_DOUBLE_EQ(value("MAG([3,0,4])"), 5);
  EXPECT_DOUBLE_EQ(value("([1,2,3]%[4,5,6])*[1,0,0]"), -3);
  EXPECT_DOUBLE_EQ(value("([1,2,3]%[4,5,6])*[0,1,0]"), 6);
  EXPECT_DOUBLE_EQ(value("([1,2,3]%[4,5,6])*[0,0,1]"), -3);
  EXPECT_DOUBLE_EQ(value("(2*[1,2,3]-[1,1,1]*3+[0,0,8]/4)*[1,10,100]"), -1 + 10 + 500);
  EXPECT_DOUBLE_EQ(value("-[1,2,3]*+[1,1,1]"), -6);
  EXPECT_DOUBLE_EQ(value("UV([0,3,4])*[0,1,0]"), 0.6);
  EXPECT_DOUBLE_EQ(value("[1,2,3]*([1,0,0]%[0,1,0]) + MAG([1,2,2])**2"), 12);
}

TEST(Vectors, functions_of_markers_are_three_atoms) {
  const ParsedText parsed = parse("DXYZ(1,2)*VXYZ(1,2,3,4)+MAG(FXYZ(7,0,9))");
  ASSERT_THAT(parsed.problems(), IsEmpty());
  std::vector<std::string> names;
  for (const Atom& a : parsed.expression.atoms()) names.emplace_back(a.function->name);
  EXPECT_THAT(names, ElementsAre("DX", "DY", "DZ", "VX", "VY", "VZ", "FX", "FY", "FZ"));
  const auto r = evaluate<double>(parsed.expression, {1, 2, 3, 4, 5, 6, 2, 3, 6});
  EXPECT_DOUBLE_EQ(r.value, 32 + 7);
  EXPECT_THAT(r.partial, ElementsAre(4, 5, 6, 1, 2, 3, 2.0 / 7, 3.0 / 7, 6.0 / 7));
}

TEST(Vectors, transformed_components_use_nine_direction_cosines) {
  const ParsedText parsed = parse("TRANS([1,2,3],5,6)*[1,10,100]");
  ASSERT_THAT(parsed.problems(), IsEmpty());
  ASSERT_EQ(parsed.expression.atoms().size(), 9u);
  EXPECT_EQ(parsed.expression.atoms()[4].function->name, "UVY.Y");
  EXPECT_EQ(parsed.expression.atoms()[4].argument[0], 5);
  EXPECT_EQ(parsed.expression.atoms()[4].argument[1], 6);
  // Rows of the matrix: x = e_y, y = e_z, z = e_x.
  EXPECT_DOUBLE_EQ(evaluate<double>(parsed.expression, {0, 1, 0, 0, 0, 1, 1, 0, 0}).value, 2 + 30 + 100);
}

TEST(Vectors, a_component_used_twice_keeps_its_whole_derivative) {
  const ParsedText parsed = parse("MAG(DXYZ(1,2,3))");
  const auto r = evaluate<double>(parsed.expression, {2, 3, 6});
  EXPECT_DOUBLE_EQ(r.value, 7);
  EXPECT_DOUBLE_EQ(r.partial[1], 3.0 / 7);
  const auto u = evaluate("[1,10,100]*UV(DXYZ(1,2,3))", {2, 3, 6});
  EXPECT_DOUBLE_EQ(u.value, 632.0 / 7);
  EXPECT_NEAR(u.partial[0], 1.0 / 7 - 2 * 632.0 / 343, 1e-15);
  EXPECT_NEAR(u.partial[2], 100.0 / 7 - 6 * 632.0 / 343, 1e-14);
}

TEST(Vectors, sizes_of_measures_are_measures) {
  const struct {
    const char* text;
    const char* size;
    std::array<std::int32_t, 5> arguments;
  } rows[] = {
      {"MAG(DXYZ(1,2))", "DM", {1, 2}},
      {"MAG(DXYZ(1,2,1))", "DM", {1, 2}},
      {"MAG(VXYZ(1,2,2,4))", "VM", {1, 2, 4}},
      {"MAG(VXYZ(1))", "VM", {1}},
      {"MAG(ACCXYZ(1,2,0,4))", "ACCM", {1, 2, 4}},
      {"MAG(WXYZ(1,2))", "WM", {1, 2}},
      {"MAG(WDTXYZ(1,2,1,4))", "WDTM", {1, 2, 4}},
      {"MAG(FXYZ(1,2))", "FM", {1, 2}},
      {"MAG(TXYZ(1))", "TM", {1}},
  };
  for (const auto& row : rows) {
    const ParsedText parsed = parse(row.text);
    ASSERT_THAT(parsed.problems(), IsEmpty()) << row.text;
    ASSERT_EQ(parsed.expression.atoms().size(), 1u) << row.text;
    EXPECT_EQ(parsed.expression.atoms()[0].function->name, row.size) << row.text;
    EXPECT_EQ(parsed.expression.atoms()[0].argument, row.arguments) << row.text;
    EXPECT_EQ(parsed.expression.atoms()[0].at.text(), row.text);
  }
  // Axes of a marker that the size would not read, and what is no vector of measures.
  for (const char* text :
       {"MAG(DXYZ(1,2,3))", "MAG(-DXYZ(1,2))", "MAG([DX(1),DY(1),DX(1)])", "MAG([DX(1),DY(1),DZ(2)])", "MAG(UVX(1))"})
    EXPECT_NE(parse(text).expression.atoms().size(), 1u) << text;
  EXPECT_EQ(parse("MAG([DX(1),DY(1),DZ(1)])+DX(1)").expression.atoms().size(), 2u);
}

TEST(Vectors, that_are_zero_are_named_as_they_are_written) {
  const UndefinedOperation none = fault("3*UV(2*DXYZ(1,2))*[1,0,0]", {0, 0, 0}).value();
  EXPECT_EQ(none.function, "UV");
  EXPECT_EQ(none.reason, "UV(2*DXYZ(1,2)) has no value where its vector is zero");
  EXPECT_EQ(parse("UV([0,0,0])*[1,0,0]").first().message, "this has no finite value: UV of a vector that is zero");
  // A size has a value there and, but along a motion, a slope of 0.
  EXPECT_FALSE(fault("MAG(2*DXYZ(1,2))", {0, 0, 0}).has_value());
  const ParsedText size = parse("3*MAG(2*DXYZ(1,2))");
  const std::vector<TimeTaylor<double>> rests(3), leaves = {{0, 1, 0}, {}, {}};
  const auto slope = size.expression.find_undefined<TimeTaylor<double>>(rests, UndefinedSearch::value_and_partials);
  EXPECT_EQ(slope.value().reason, "MAG(2*DXYZ(1,2)) has no derivative where it is 0");
  EXPECT_FALSE(size.expression.find_undefined<TimeTaylor<double>>(rests, UndefinedSearch::value));
  const auto rate = size.expression.find_undefined<TimeTaylor<double>>(leaves, UndefinedSearch::value);
  EXPECT_EQ(rate.value().reason, "MAG(2*DXYZ(1,2)) has no derivative where it is 0");
}

TEST(Vectors, numbers_and_vectors_are_told_apart_at_their_place) {
  const struct {
    const char* text;
    const char* problem;
  } rows[] = {
      {"[1,2,3]", "vector-mismatch 1:1"},
      {"1+[1,2,3]", "vector-mismatch 1:2"},
      {"SIN(DXYZ(1))", "vector-mismatch 1:5"},
      {"2**DXYZ(1)", "vector-mismatch 1:2"},
      {"1/DXYZ(1)", "vector-mismatch 1:2"},
      {"MAG(3)", "vector-mismatch 1:5"},
      {"[1,2]*[1,2,3]", "wrong-count 1:1"},
      {"IF(DXYZ(1):1,2,3)", "vector-mismatch 1:4"},
      {"IF(TIME:1,DXYZ(1),3)", "vector-mismatch 1:11"},
      {"[1,[1,2,3],3]*[1,2,3]", "vector-mismatch 1:4"},
      {"UV(DXYZ(1),2)*[1,2,3]", "wrong-argument-count 1:1"},
      {"TRANS([1,2,3],TIME)*[1,1,1]", "expected-integer 1:15"},
      {"AKISPL(TIME,0)", "wrong-argument-count 1:1"},
      {"AKISPL(TIME,0,1.5)", "expected-integer 1:15"},
      {"CUBSPL(TIME,0,7,3)", "argument-range 1:17"},
      {"INTERP(TIME,2,7)", "argument-range 1:13"},
      {"AKISPL(DXYZ(1),0,7)", "vector-mismatch 1:8"},
      {"[1,2,3]*[4,5,6]%[1,2,3]", "vector-mismatch 1:16"},
  };
  for (const auto& row : rows) EXPECT_THAT(parse(row.text).problems(), ElementsAre(row.problem)) << row.text;
}

TEST(SplineFunctions, have_no_value_until_their_curves_are_attached) {
  const ParsedText parsed = parse("2*AKISPL(TIME,0,7)+CUBSPL(1.5,VARVAL(1),8,1)");
  ASSERT_THAT(parsed.problems(), IsEmpty());
  ASSERT_EQ(parsed.expression.splines().size(), 2u);
  EXPECT_EQ(parsed.expression.splines()[1].id, 8);
  EXPECT_EQ(parsed.expression.splines()[1].derivative, 1);
  EXPECT_EQ(parsed.expression.splines()[1].id_at.text(), "8");
  EXPECT_TRUE(std::isnan(evaluate<double>(parsed.expression, {1, 1}).value));
  const Expression attached = parsed.expression.with_curves([](SplineUse& use) {
    SplineData d{{0, 1, 2, 3}, {}, {{0, 1, 2, 3}}, false};
    if (use.id == 8) d.z = {0, 1}, d.y.push_back({0, 3, 6, 9});
    use.curves = std::make_shared<const SplineCurves>(std::make_shared<const SplineData>(d), use.method);
  });
  const auto r = evaluate<double>(attached, {1.25, 0.5});
  EXPECT_NEAR(r.value, 2.5 + 2, 1e-14);
  EXPECT_NEAR(r.partial[0], 2, 1e-14);
  EXPECT_NEAR(r.partial[1], 2, 1e-14);
}

}  // namespace
}  // namespace dynalin::expression_test::vector_test
