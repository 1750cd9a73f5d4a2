#include <gtest/gtest.h>

#include <array>

#include "dataset/dataset.h"
#include "dataset/test_reading.h"

namespace dynalin::testing::statements_test {
namespace {

// "MARKER/5" for each statement: full name and id.
Texts heads(const Parsed<Dataset>& parsed) {
  Texts result;
  for (const Statement& statement : parsed.value.statements) {
    std::string text(statement.name);
    if (statement.id) text += fmt::format("/{}", *statement.id);
    result.push_back(text);
  }
  return result;
}

TEST(dataset, begins_with_its_title) {
  const auto parsed = read_whole("ADAMS/View model name: car, 1/2 ! title  \nPART/1, GROUND\nEND\n");
  EXPECT_EQ(parsed.value.title, "ADAMS/View model name: car, 1/2 ! title");
  EXPECT_EQ(heads(parsed), Texts{"PART/1"});
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
}

TEST(dataset, keeps_80_bytes_of_the_title_and_no_part_of_a_character) {
  EXPECT_EQ(read_whole(std::string(100, 'x') + "\nEND").value.title, std::string(80, 'x'));
  EXPECT_EQ(read_whole(std::string(79, 'x') + "é\nEND").value.title, std::string(79, 'x'));
}

TEST(dataset, takes_a_statement_in_the_place_of_the_title_with_a_warning) {
  for (const char* first :
       {"UNITS/FORCE=NEWTON", "PART/1, GROUND", "pa/99", "UNITS/\n, FORCE=NEWTON", "result/format"}) {
    const auto parsed = read_whole(std::string(first) + "\nMARKER/1\nEND\n");
    EXPECT_EQ(parsed.value.statements.size(), 2u) << first;
    EXPECT_EQ(problems(parsed.diagnostics), Texts{"1:1 missing-title"}) << first;
  }
}

TEST(dataset, takes_a_title_that_only_resembles_a_statement_as_title) {
  for (const char* first :
       {"P/N 1234, rear axle", "R/C", "PART of a car", "Linear/1", "JOINT/1.5", "! x", "", "M/5 5", "PART/-1"}) {
    const auto parsed = read_whole(std::string(first) + "\nMARKER/1\nEND\n");
    EXPECT_EQ(heads(parsed), Texts{"MARKER/1"}) << first;
    EXPECT_EQ(parsed.value.title, first);
    EXPECT_EQ(problems(parsed.diagnostics), Texts{}) << first;
  }
}

TEST(dataset, ends_with_END) {
  const auto parsed = read_whole("title\nPART/1\n end ! done\ngarbage (((\n, x\n");
  EXPECT_EQ(heads(parsed), Texts{"PART/1"});
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
}

TEST(dataset, whose_END_has_an_id_is_wrong_and_ends_all_the_same) {
  for (const char* end : {"END/5", "END/FOO", "end / 1, X=2"}) {
    const auto parsed = read_whole(std::string("title\nPART/1, GROUND\n") + end + "\nPART/2\nEND\n");
    EXPECT_EQ(heads(parsed), Texts{"PART/1"}) << end;
    ASSERT_EQ(parsed.diagnostics.error_count(), 1u) << end;
    EXPECT_EQ(parsed.diagnostics.items().front().code, "unexpected-text") << end;
  }
}

// A word of the other language is no slip of the keyboard.
TEST(keywords_of_commands, are_named_as_such_in_datasets) {
  const auto hint = [](const std::string& text) { return read(text).diagnostics.items().front().hint; };
  EXPECT_EQ(hint("SIMULATE/STATICS"), "SIMULATE is a command: it belongs in a command file, or behind -c");
  EXPECT_EQ(hint("lin/eig"), "LINEAR is a command: it belongs in a command file, or behind -c");
  EXPECT_EQ(hint("STOP"), "STOP is a command: it belongs in a command file, or behind -c");
  EXPECT_EQ(hint("SFROCE/1"), "did you mean SFORCE?");
  EXPECT_EQ(hint("grav/1"), "did you mean ACCGRAV?");
  EXPECT_EQ(hint("DAMPER/1"), "did you mean SPRINGDAMPER?");
  EXPECT_EQ(hint("ORCE/1"), "");  // of several
}

TEST(dataset, without_END_gets_a_warning_at_its_end) {
  const auto parsed = read_whole("title\nPART/1, GROUND\n\n");
  EXPECT_EQ(heads(parsed), Texts{"PART/1"});
  EXPECT_EQ(problems(parsed.diagnostics), Texts{"2:15 missing-end"});
  EXPECT_FALSE(parsed.diagnostics.has_errors());
}

TEST(dataset, does_not_end_with_a_comment_that_begins_with_the_word) {
  const auto parsed = read("End of the springs\nPART/1");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{"2:1 not-a-statement"});
  EXPECT_EQ(heads(parsed), Texts{"PART/1"});
}

TEST(dataset, that_is_empty_is_an_error) {
  EXPECT_EQ(problems(read_whole("").diagnostics), Texts{"1:1 empty-dataset"});
  EXPECT_EQ(problems(read_whole(" \r\n\t\n").diagnostics), Texts{"1:1 empty-dataset"});
}

TEST(dataset, may_lack_the_last_line_end) {
  EXPECT_EQ(heads(read_whole("title\nPART/1, GROUND\nEND")), Texts{"PART/1"});
  EXPECT_EQ(arguments(read_whole("title\nPART/1, CM=12")), Texts{"CM=12"});
}

TEST(dataset, reads_all_line_ends_alike) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const auto parsed = read_whole("title" + end + "PART/1" + end + ", GROUND" + end + "END" + end);
    EXPECT_EQ(parsed.value.title, "title");
    EXPECT_EQ(arguments(parsed), Texts{"GROUND"});
    EXPECT_EQ(problems(parsed.diagnostics), Texts{});
  }
}

TEST(dataset, takes_tabs_as_blanks) { EXPECT_EQ(arguments(read("\tPART\t/\t1\n\t,\tMASS\t=\t2")), Texts{"MASS=2"}); }

TEST(dataset, drops_a_byte_order_mark) {
  const auto parsed = read_whole("\xEF\xBB\xBFtitle\nPART/1\nEND");
  EXPECT_EQ(parsed.value.title, "title");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
}

TEST(dataset, refuses_binary_files_and_UTF16_with_one_error) {
  EXPECT_EQ(problems(read_whole(std::string("\xFF\xFEt\0i\0", 6)).diagnostics), Texts{"1:1 not-text"});
  EXPECT_EQ(problems(read_whole(std::string(5000, '\0')).diagnostics), Texts{"1:1 not-text"});
}

TEST(statements, share_a_line_with_semicolons) {
  const auto parsed = read("PART/1,MASS=40,CM=1; MARKER/1;;\n;MARKER/2");
  EXPECT_EQ(heads(parsed), (Texts{"PART/1", "MARKER/1", "MARKER/2"}));
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
}

TEST(statements, have_comments_anywhere) {
  const auto parsed = read(
      "! one\nPART/2, MASS=1 ! two, X=5\n\n  ! three\n, CM=3 ! four\n!\n, IP=1,\n! five\n, 2, "
      "3\n!");
  EXPECT_EQ(arguments(parsed), (Texts{"MASS=1", "CM=3", "IP=1 , <,> 2 , 3"}));
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
}

TEST(statements, keep_an_exclamation_mark_in_quotes) {
  const auto parsed = read("STRING/1, STRING='a ! b' ! c");
  EXPECT_EQ(parsed.value.statements.at(0).arguments.at(0).value_span().text(), "'a ! b'");
}

TEST(statements, continue_behind_an_ampersand) {
  const auto parsed = read("PART/2, &\nMASS=1, & ! note\n\n, CM=3 &\n   ! note\nIP=1,2,3");
  EXPECT_EQ(arguments(parsed), (Texts{"MASS=1", "CM=3", "IP=1 , 2 , 3"}));
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
}

TEST(statements, take_their_name_from_the_comment_before_them) {
  const auto parsed = read(
      "!              adams_view_name='ground'\nPART/1\n, GROUND\n! a\n!adams_view_name = 'A.B c' "
      "x\n\n"
      "MARKER/4 ! adams_view_name='last'\n, PART=1\nMARKER/5\nMARKER/6");
  ASSERT_EQ(parsed.value.statements.size(), 4u);
  EXPECT_EQ(parsed.value.statements[0].view_name(), "ground");
  EXPECT_EQ(parsed.value.statements[1].view_name(), "A.B c");
  EXPECT_EQ(parsed.value.statements[2].view_name(), "last");
  EXPECT_EQ(parsed.value.statements[3].view_name(), "");
}

TEST(statements, are_found_by_their_short_forms) {
  EXPECT_EQ(heads(read("pa/99, ground\nma/1\nM/2\nJ/3\nvari/4\naccgrav/kg=-1")),
            (Texts{"PART/99", "MARKER/1", "MARKER/2", "JOINT/3", "VARIABLE/4", "ACCGRAV"}));
}

TEST(statements, span_keyword_and_id) {
  const auto parsed = read("  SFORCE / 12, I=1\nIC/");
  EXPECT_EQ(parsed.value.statements.at(0).at.text(), "SFORCE / 12");
  EXPECT_EQ(parsed.value.statements.at(0).keyword().text(), "SFORCE");
  EXPECT_EQ(parsed.value.statements.at(1).at.text(), "IC");
}

TEST(ids, may_have_leading_zeros) {
  EXPECT_EQ(heads(read("MARKER/0101\nMARKER/0000000000007")), (Texts{"MARKER/101", "MARKER/7"}));
}

TEST(ids, beyond_eight_digits_get_a_warning) {
  const auto parsed = read("MARKER/123456789");
  EXPECT_EQ(heads(parsed), Texts{"MARKER/123456789"});
  EXPECT_EQ(problems(parsed.diagnostics), Texts{"2:8 long-id"});
}

TEST(ids, are_positive_whole_numbers) {
  for (const char* id : {"0", "-5", "+5", "1.5", "5D", "1E3", "12abc", "99999999999999999999", "3000000000", "5'x'"}) {
    const auto parsed = read(std::string("MARKER/") + id + ", PART=1");
    EXPECT_EQ(problems(parsed.diagnostics), Texts{"2:8 bad-id"}) << id;
    EXPECT_EQ(arguments(parsed), Texts{"PART=1"}) << id;
    EXPECT_TRUE(parsed.value.statements[0].damaged);
    EXPECT_FALSE(parsed.value.statements[0].id);
  }
}

TEST(unknown_statements, are_reported_with_the_nearest_name_and_nothing_else) {
  const auto parsed = read("SFROCE/1, I=((, =\nPART/1");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{"2:1 unknown-statement"});
  EXPECT_EQ(parsed.diagnostics.items()[0].hint, "did you mean SFORCE?");
  EXPECT_EQ(heads(parsed), (Texts{"/1", "PART/1"}));
}

TEST(unknown_statements, may_be_a_title_that_comes_too_late) {
  const auto parsed = read("! comment\nADAMS/View model name: rig\nPART/1");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{"3:1 unknown-statement"});
  EXPECT_EQ(parsed.diagnostics.items()[0].hint, "a title is the first line of the file, of whatever kind");
}

TEST(unknown_statements, that_are_ambiguous_list_what_they_could_be) {
  const auto parsed = read("MAT/1");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{"2:1 ambiguous-keyword"});
  EXPECT_EQ(parsed.diagnostics.items()[0].hint, "it could be MATERIAL or MATRIX");
}

TEST(lines_without_statement, are_reported_and_skipped) {
  const auto parsed = read("Displacement integrator\n  \n, x\ntfsiso/2, num=1\n5, 6\n(1)");
  EXPECT_EQ(problems(parsed.diagnostics), (Texts{"2:1 not-a-statement", "6:1 not-a-statement", "7:1 not-a-statement"}));
  EXPECT_EQ(parsed.diagnostics.items()[0].at.text(), "Displacement integrator");
  EXPECT_EQ(heads(parsed), Texts{"TFSISO/2"});
}

TEST(lines_without_statement, have_hints_that_fit) {
  const auto parsed = read("SFORCE/1, I=1,\nJ=2\nPART 5, GROUND");
  ASSERT_EQ(problems(parsed.diagnostics), (Texts{"3:1 not-a-statement", "4:1 not-a-statement"}));
  EXPECT_EQ(parsed.diagnostics.items()[0].hint, "begin the line with a comma if it continues SFORCE/1");
  EXPECT_EQ(parsed.diagnostics.items()[1].hint, "write PART/5");
}

TEST(lines_without_statement, may_continue_nothing) {
  EXPECT_EQ(problems(read(", GROUND\nPART/1").diagnostics), Texts{"2:1 stray-continuation"});
  EXPECT_EQ(problems(read("PART/1;\n, GROUND").diagnostics), Texts{"3:1 stray-continuation"});
}

TEST(garbage_bytes, are_reported_where_they_stand) {
  using namespace std::string_literals;
  EXPECT_EQ(problems(read("PART/1, MASS=\0, CM=2"s).diagnostics), Texts{"2:14 bad-character"});
  EXPECT_EQ(problems(read("PART/1, \x01, CM=2"s).diagnostics), Texts{"2:9 bad-character"});
  EXPECT_EQ(problems(read("\0\0\nPART/1"s).diagnostics), Texts{"2:1 bad-character"});
  EXPECT_EQ(problems(read("MATRIX/1, FILE=a\0b"s).diagnostics), Texts{"2:17 bad-character"});
}

TEST(errors, stop_the_reading_when_there_are_very_many) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "no statement\n";
  const auto parsed = read(text);
  EXPECT_EQ(parsed.diagnostics.error_count(), 1001u);
  EXPECT_EQ(parsed.diagnostics.items().back().code, "too-many-errors");
}

TEST(values, stay_where_they_are_when_the_dataset_moves) {
  auto parsed = read("MARKER/1, QP=1,2,3\nMARKER/2, QP=4,5,6");
  const Dataset moved = std::move(parsed.value);
  const WrittenArgument& qp = moved.statements.at(1).arguments.at(0);
  EXPECT_EQ(value_text(qp, *moved.source), "4 , 5 , 6");
}

// --- commands
// -------------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 7> keywords{"SIMULATE", "LINEAR", "SHOW", "STOP", "MARKER", "MOTION", "FILE"};

Parsed<Dataset> read_commands(const std::string& text, std::uint32_t start = 0) {
  return parse_statements(std::make_shared<SourceText>("a.acf", text), keywords, start);
}

TEST(commands, need_neither_title_nor_END) {
  const auto parsed = read_commands(
      "\n! Insert commands here:\nsim/stat\nLINEAR/EIGENSOL, &\n! note\n  NODAMPIN, "
      "COORDS=1,25\nstop\n");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
  EXPECT_EQ(heads(parsed), (Texts{"SIMULATE", "LINEAR", "STOP"}));
  EXPECT_EQ(arguments(parsed, 1), (Texts{"EIGENSOL", "NODAMPIN", "COORDS=1 , 25"}));
}

TEST(commands, may_lack_the_slash) {
  const auto parsed = read_commands("sho stat=sim\nMARKER/12, QP=1,2,3");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
  EXPECT_EQ(heads(parsed), (Texts{"SHOW", "MARKER/12"}));
  EXPECT_EQ(arguments(parsed, 0), Texts{"stat=sim"});
}

TEST(commands, may_lack_a_comma) {
  const auto parsed = read_commands("LINEAR/STATEMAT, PINPUT=10, POUTPUT=20\n, FORMAT=MATRIXX FILE=STATES.MAT");
  EXPECT_EQ(problems(parsed.diagnostics), Texts{});
  EXPECT_EQ(arguments(parsed), (Texts{"STATEMAT", "PINPUT=10", "POUTPUT=20", "FORMAT=MATRIXX", "FILE=STATES . MAT"}));
}

TEST(commands, begin_behind_the_lines_that_name_the_model) {
  const std::string text = "car.adm\nout\nfoo/1\nSTOP/\nnothing of this (is read\n";
  const auto parsed = read_commands(text, 12);
  EXPECT_EQ(heads(parsed), (Texts{"/1", "STOP"}));
  EXPECT_EQ(problems(parsed.diagnostics), Texts{"3:1 unknown-command"});
}

TEST(commands, that_are_no_commands_are_reported) {
  EXPECT_EQ(problems(read_commands("5\nM/5\nS/1").diagnostics),
            (Texts{"1:1 not-a-statement", "3:1 ambiguous-keyword"}));
}

TEST(commands, may_be_none) { EXPECT_EQ(problems(read_commands("").diagnostics), Texts{}); }

// As the model reads them: those behind stay, also where blocks of tokens end between them.
TEST(statements, give_their_arguments_back_one_after_the_other) {
  std::string text;
  for (int k = 1; k <= 2000; ++k)
    text += "MARKER/" + std::to_string(k) + ", QP=" + std::to_string(k) + ",0,0, FLOATING\n";
  auto parsed = read(text);
  ASSERT_TRUE(parsed.diagnostics.items().empty());
  Dataset& dataset = parsed.value;
  for (std::size_t k = 0; k < dataset.statements.size(); ++k) {
    ASSERT_EQ(arguments(dataset.statements[k], *dataset.source).front(), "QP=" + std::to_string(k + 1) + " , 0 , 0");
    dataset.release_arguments(dataset.statements[k]);
    EXPECT_TRUE(dataset.statements[k].arguments.empty());
    EXPECT_EQ(dataset.statements[k].id, static_cast<std::int64_t>(k + 1));
  }
}

}  // namespace
}  // namespace dynalin::testing::statements_test
