#include "dataset/arguments.h"

#include <gtest/gtest.h>

#include "dataset/test_reading.h"

namespace dynalin::testing::arguments_test {
namespace {

// The arguments of one statement that is read without any complaint.
Texts split(const std::string& text) {
  const Parsed<Dataset> parsed = read(text);
  EXPECT_EQ(problems(parsed.diagnostics), Texts{}) << render(parsed.diagnostics);
  EXPECT_EQ(parsed.value.statements.size(), 1u);
  return parsed.value.statements.empty() ? Texts{} : arguments(parsed);
}

// Its arguments together with what is wrong.
struct Faulty {
  Texts arguments, problems;
};
Faulty split_faulty(const std::string& text) {
  const Parsed<Dataset> parsed = read(text);
  EXPECT_EQ(parsed.value.statements.size(), 1u);
  return {arguments(parsed), problems(parsed.diagnostics)};
}

TEST(arguments, separate_at_commas) {
  EXPECT_EQ(split("JOINT/1, REVOLUTE, I=22, J = 2"), (Texts{"REVOLUTE", "I=22", "J=2"}));
}

TEST(arguments, keep_lists_whole) {
  EXPECT_EQ(split("MARKER/2, QP=1,0,-5, ZP=0,0,1, USEXP"), (Texts{"QP=1 , 0 , - 5", "ZP=0 , 0 , 1", "USEXP"}));
}

TEST(arguments, keep_lists_of_words_whole) {
  EXPECT_EQ(split("PART/2, EXACT=X:Y: PSI, MASS=1"), (Texts{"EXACT=X : Y : PSI", "MASS=1"}));
}

TEST(arguments, take_a_continuation_mark_as_the_comma_of_a_list) {
  EXPECT_EQ(split("PART/2, IP = 1, 2\n, 3\n, MASS=1"), (Texts{"IP=1 , 2 <,> 3", "MASS=1"}));
  EXPECT_EQ(split("PART/2, IP = 1, 2,\n, 3"), (Texts{"IP=1 , 2 , <,> 3"}));
}

TEST(arguments, merge_a_mark_with_the_comma_or_slash_before_it) {
  EXPECT_EQ(split("PART/1\n, GROUND"), Texts{"GROUND"});
  EXPECT_EQ(split("PART/1,\n, GROUND"), Texts{"GROUND"});
  EXPECT_EQ(split("UNITS/\n, FORCE = NEWTON\n, MASS=KILOGRAM"), (Texts{"FORCE=NEWTON", "MASS=KILOGRAM"}));
  EXPECT_EQ(split("ACCGRAV/\n, JGRAV = -9806.65"), Texts{"JGRAV=- 9806.65"});
}

TEST(arguments, may_follow_the_slash_directly) {
  EXPECT_EQ(split("result/format"), Texts{"format"});
  EXPECT_EQ(split("accgrav/i=0,j=0,k=-1"), (Texts{"i=0", "j=0", "k=- 1"}));
}

TEST(arguments, let_an_expression_run_over_lines) {
  EXPECT_EQ(split("SFORCE/1, FUNCTION = -1.2E-2*(DM(5,6)-291.5)\n, - 2.9E-3*VR(5,6)\n, + 0.0"),
            Texts{"FUNCTION=- 1.2E-2 * ( DM ( 5 , 6 ) - 291.5 ) <,> - 2.9E-3 * VR ( 5 , 6 ) <,> + 0.0"});
  EXPECT_EQ(split("VARIABLE/3\n, FUNCTION = (DX(5,6) +\n, DY(5,6))/\n, DM(5,6)"),
            Texts{"FUNCTION=( DX ( 5 , 6 ) + <,> DY ( 5 , 6 ) ) / <,> DM ( 5 , 6 )"});
  EXPECT_EQ(split("VARIABLE/3, FUNCTION=2*\n, PI\n, *3"), Texts{"FUNCTION=2 * <,> PI <,> * 3"});
}

TEST(arguments, end_an_expression_where_a_word_follows_an_operand) {
  EXPECT_EQ(split("MOTION/1, FUNCTION=DX(1)\n, ROTATION"), (Texts{"FUNCTION=DX ( 1 )", "ROTATION"}));
  EXPECT_EQ(split("MOTION/1, FUNCTION=2*PI, ICDISP=0"), (Texts{"FUNCTION=2 * PI", "ICDISP=0"}));
}

TEST(arguments, keep_an_expression_open_behind_an_operator) {
  EXPECT_EQ(split("VARIABLE/3, FUNCTION=DX(1) +\n, TIME"), Texts{"FUNCTION=DX ( 1 ) + <,> TIME"});
}

TEST(arguments, keep_the_colon_and_commas_of_IF_inside_its_parentheses) {
  EXPECT_EQ(split("VARIABLE/3, FUNCTION=IF(TIME-1: 0, 0,\n, -5*X), IC=2"),
            (Texts{"FUNCTION=IF ( TIME - 1 : 0 , 0 , <,> - 5 * X )", "IC=2"}));
}

TEST(arguments, end_expressions_at_a_backslash) {
  EXPECT_EQ(split("GFORCE/89, FX=20\\FY=40\\FZ=60, JFLOAT=5"), (Texts{"FX=20", "FY=40", "FZ=60", "JFLOAT=5"}));
  EXPECT_EQ(split("REQUEST/4\n, F2=DX(1,2)\\\n, F3=DY(1,2)\\"), (Texts{"F2=DX ( 1 , 2 )", "F3=DY ( 1 , 2 )"}));
  EXPECT_EQ(split("GFORCE/1, FX = 0\\ FY = 0\\"), (Texts{"FX=0", "FY=0"}));
}

TEST(arguments, may_lack_the_comma_between_them) {
  EXPECT_EQ(split("MARKER/1, PART=1 QP=1,0,0 ZP=0,0,1"), (Texts{"PART=1", "QP=1 , 0 , 0", "ZP=0 , 0 , 1"}));
  EXPECT_EQ(split("MATRIX/1, FULL RORDER, ROWS=4"), (Texts{"FULL", "RORDER", "ROWS=4"}));
  EXPECT_EQ(split("JOINT/1, I=1 REVOLUTE"), (Texts{"I=1", "REVOLUTE"}));
  EXPECT_EQ(split("PART/1 GROUND"), Texts{"GROUND"});
}

TEST(arguments, take_a_word_that_begins_with_digits_as_a_value) {
  EXPECT_EQ(split("FE_PART/1, TYPE=3DBEAM, MATERIAL=1"), (Texts{"TYPE=3 DBEAM", "MATERIAL=1"}));
}

TEST(arguments, may_begin_their_value_on_the_next_line) {
  EXPECT_EQ(split("VARIABLE/1, FUNCTION=\n, DM(1,2)"), Texts{"FUNCTION=DM ( 1 , 2 )"});
  EXPECT_EQ(split("VARIABLE/1, FUNCTION = &\nDM(1,2)"), Texts{"FUNCTION=DM ( 1 , 2 )"});
}

TEST(arguments, take_file_names_as_raw_text) {
  const Parsed<Dataset> parsed = read(
      "FLEX_BODY/5, MNF_FILE=C:\\my dir\\a(1.mnf, QG=1,0,0\n"
      "MATRIX/1, FILE=../data/in-1.mat NAME=ac\n"
      "MATRIX/2,\n,file=\"a, b.mat\", name=ac");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
  const auto value = [&](std::size_t statement, std::size_t argument) {
    return std::string(parsed.value.statements.at(statement).arguments.at(argument).value_span().text());
  };
  EXPECT_EQ(value(0, 0), "C:\\my dir\\a(1.mnf");
  EXPECT_EQ(parsed.value.statements[0].arguments.size(), 2u);
  EXPECT_EQ(value(1, 0), "../data/in-1.mat");
  EXPECT_EQ(value(1, 1), "ac");
  EXPECT_EQ(value(2, 0), "\"a, b.mat\"");
}

TEST(arguments, give_a_comment_the_rest_of_its_line) {
  const Parsed<Dataset> parsed = read("REQUEST/1, F2=DX(1)\\C=Peter's force: x, y (left, ! note\n, F3=1");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
  const Statement& request = parsed.value.statements.at(0);
  ASSERT_EQ(request.arguments.size(), 3u);
  EXPECT_EQ(request.arguments[1].value_span().text(), "Peter's force: x, y (left,");
  EXPECT_EQ(request.arguments[2].name.text(), "F3");
}

TEST(arguments, may_follow_a_comment_on_its_line) {
  EXPECT_EQ(split("REQUEST/1, D, COMMENT=cm position, I=20, J=1"), (Texts{"D", "COMMENT=cm position", "I=20", "J=1"}));
  EXPECT_EQ(split("REQUEST/1, COMMENT=\n, DISPLACEMENT"), (Texts{"COMMENT=", "DISPLACEMENT"}));
}

TEST(arguments, read_C_as_comment_only_where_it_is_one) {
  EXPECT_EQ(split("SPRINGDAMPER/1, TRAN, K=1, C=2, L=5"), (Texts{"TRAN", "K=1", "C=2", "L=5"}));
}

TEST(arguments, span_their_value_from_first_to_last_token) {
  const Parsed<Dataset> parsed = read("MARKER/2, QP= 1 , 0, 2 , PART=1");
  EXPECT_EQ(parsed.value.statements.at(0).arguments.at(0).value_span().text(), "1 , 0, 2");
}

// --- faults
// ---------------------------------------------------------------------------------------------

TEST(arguments, report_a_parenthesis_that_is_never_closed) {
  const Faulty found = split_faulty("SFORCE/1, I=5, FUNCTION=-2*(DM(5,6)-291.5, J=6");
  EXPECT_EQ(found.problems, Texts{"2:28 unbalanced-parenthesis"});
  EXPECT_EQ(found.arguments.size(), 3u);
  EXPECT_EQ(found.arguments.back(), "J=6");
}

TEST(arguments, report_a_parenthesis_that_closes_nothing) {
  const Faulty found = split_faulty("SFORCE/1, FUNCTION=DM(5,6)), J=6");
  EXPECT_EQ(found.problems, Texts{"2:27 unbalanced-parenthesis"});
  EXPECT_EQ(found.arguments.back(), "J=6");
}

TEST(arguments, report_an_unclosed_parenthesis_once) {
  const Faulty found = split_faulty("SFORCE/1, FUNCTION=STEP(TIME,0,(1,TIME,3, J=6");
  EXPECT_EQ(found.problems.size(), 1u);
  EXPECT_EQ(found.arguments.back(), "J=6");
}

TEST(arguments, report_brackets_that_do_not_match) {
  EXPECT_EQ(split_faulty("SFORCE/1, FUNCTION=MAG([1,2,3)").problems, Texts{"2:23 unbalanced-parenthesis"});
}

TEST(arguments, report_stray_equals_signs) {
  EXPECT_EQ(split_faulty("PART/1, MASS==5, CM=2").problems, Texts{"2:14 stray-equals"});
  EXPECT_EQ(split_faulty("PART/1, MASS=1=5, CM=2").problems, Texts{"2:15 stray-equals"});
  EXPECT_EQ(split_faulty("PART/1, =5, CM=2").problems, Texts{"2:9 stray-equals"});
  EXPECT_EQ(split_faulty("SFORCE/1, FUNCTION=IF(A=B:1,2,3), I=1").problems, Texts{"2:24 stray-equals"});
  EXPECT_EQ(split_faulty("PART/1, MASS=1=5, CM=2").arguments.back(), "CM=2");
}

TEST(arguments, report_a_missing_value) {
  EXPECT_EQ(split_faulty("PART/1, MASS=, CM=2").problems, Texts{"2:13 missing-value"});
  EXPECT_EQ(split_faulty("PART/1, CM=2, MASS=").problems, Texts{"2:19 missing-value"});
  EXPECT_EQ(split_faulty("PART/1, MASS=\n, CM=2").problems, Texts{"2:13 missing-value"});
  EXPECT_EQ(split_faulty("GFORCE/1, FX=\\FY=2").problems, Texts{"2:13 missing-value"});
  EXPECT_EQ(split_faulty("MATRIX/1, FILE=, NAME=x").problems, Texts{"2:15 missing-value"});
}

TEST(arguments, report_text_that_is_no_argument) {
  const Faulty found = split_faulty("PART/1, 5, 6, MASS=2");
  EXPECT_EQ(found.problems, Texts{"2:9 unexpected-text"});
  EXPECT_EQ(found.arguments, Texts{"MASS=2"});
  EXPECT_EQ(split_faulty("PART/1, GROUND(5), MASS=2").problems, Texts{"2:15 unexpected-text"});
  EXPECT_EQ(split_faulty("PART/1/2, MASS=2").problems, Texts{"2:7 unexpected-text"});
  EXPECT_EQ(split_faulty("PART/1, #, MASS=2").problems, Texts{"2:9 bad-character"});
}

TEST(arguments, warn_about_two_commas) {
  const Faulty found = split_faulty("PART/1,, MASS=2");
  EXPECT_EQ(found.problems, Texts{"2:8 empty-argument"});
  EXPECT_EQ(found.arguments, Texts{"MASS=2"});
}

TEST(arguments, mark_what_is_damaged) {
  const Parsed<Dataset> parsed = read("SFORCE/1, I=5, FUNCTION=(1, J=6\nPART/1, GROUND");
  EXPECT_TRUE(parsed.value.statements[0].damaged);
  EXPECT_FALSE(parsed.value.statements[0].arguments[0].damaged);
  EXPECT_TRUE(parsed.value.statements[0].arguments[1].damaged);
  EXPECT_FALSE(parsed.value.statements[1].damaged);
}

TEST(arguments, report_numbers_that_are_too_large) {
  EXPECT_EQ(split_faulty("PART/1, MASS=1E999, CM=1").problems, Texts{"2:14 number-overflow"});
}

TEST(arguments, warn_of_numbers_that_are_too_small) {
  EXPECT_EQ(split_faulty("PART/1, MASS=1e-400, CM=1").problems, Texts{"2:14 number-underflow"});
  EXPECT_EQ(split_faulty("VARIABLE/1, FUNCTION=2*1E-999").problems, Texts{"2:24 number-underflow"});
  EXPECT_EQ(split("PART/1, MASS=0E-400, CM=1"), (Texts{"MASS=0E-400", "CM=1"}));
  EXPECT_EQ(split("PART/1, MASS=5E-324"), Texts{"MASS=5E-324"});
}

TEST(arguments, warn_of_quotes_that_are_not_closed) {
  EXPECT_EQ(split_faulty("REQUEST/1, CNAMES=\"a\", \"b").problems, Texts{"2:24 bad-character"});
  EXPECT_EQ(split_faulty("MATRIX/1, FILE='a").problems, Texts{"2:16 bad-character"});
  EXPECT_EQ(split_faulty("REQUEST/1, TITLE=don't").problems, Texts{});
}

TEST(arguments, warn_when_D_looks_like_an_exponent) {
  EXPECT_EQ(split_faulty("VARIABLE/1, FUNCTION=2*1.0D+02").problems, Texts{"2:24 degrees-not-exponent"});
  EXPECT_EQ(split_faulty("VARIABLE/1, FUNCTION=3D+2").problems, Texts{"2:22 degrees-not-exponent"});
  EXPECT_EQ(split_faulty("MARKER/1, REULER=3D+2, 0, 0").problems, Texts{"2:18 degrees-not-exponent"});
  EXPECT_EQ(split_faulty("VARIABLE/1, FUNCTION=1.0D+02*TIME").problems, Texts{"2:22 degrees-not-exponent"});
  EXPECT_EQ(split("VARIABLE/1, FUNCTION=30D - 5"), Texts{"FUNCTION=30D - 5"});
  EXPECT_EQ(split("VARIABLE/1, FUNCTION=30D+2*TIME"), Texts{"FUNCTION=30D + 2 * TIME"});
}

}  // namespace
}  // namespace dynalin::testing::arguments_test
