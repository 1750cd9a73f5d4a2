#include "dataset/matrix_file.h"

#include <gtest/gtest.h>

#include "dataset/fortran_format.h"
#include "dataset/test_reading.h"

namespace dynalin::testing::matrix_file_test {
namespace {

using Values = std::vector<double>;

class File {
 public:
  explicit File(std::string text) : source_("in.mat", std::move(text)) {}
  std::optional<MatrixData> read(std::string_view name) { return read_matrix(source_, name, Span{}, diagnostics_); }
  Texts found() const { return problems(diagnostics_); }
  const Diagnostic& first() const { return diagnostics_.items().at(0); }
  const SourceText& source() const { return source_; }

 private:
  SourceText source_;
  Diagnostics diagnostics_;
};

// The values of a matrix that is read without complaint.
Values values(const std::string& text, std::string_view name) {
  File file(text);
  const auto matrix = file.read(name);
  EXPECT_EQ(file.found(), Texts{});
  return matrix ? matrix->values : Values{};
}

const std::string fsave =
    "MATRIXx                      VERSION   700    3    2024-04-21 19:31:36\n"
    "A              2    3BC             3    1LONGNAME10    1    1\n"
    "A              2    3    0(3(1PE25.17))\n"
    "  1.00000000000000000e+00 -2.00000000000000000e+00  3.00000000000000000e+00\n"
    "  4.00000000000000000e+00  5.00000000000000000e+00  6.50000000000000000e-01\n"
    "BC             3    1    0(3(1PE25.17))\n"
    "  1.00000000000000000e+00  0.00000000000000000e+00  1.00000000000000000e+03\n"
    "LONGNAME10    1    1    0(1P3E25.17)\n"
    "  7.00000000000000000D+00\n";

TEST(fsave, holds_its_values_column_by_column) {
  File file(fsave);
  const auto matrix = file.read("A");
  ASSERT_TRUE(matrix);
  EXPECT_EQ(matrix->rows, 2);
  EXPECT_EQ(matrix->columns, 3);
  EXPECT_EQ(matrix->values, (Values{1, -2, 3, 4, 5, 0.65}));
}

TEST(fsave, finds_names_in_any_case) {
  EXPECT_EQ(values(fsave, "bc"), (Values{1, 0, 1000}));
  EXPECT_EQ(values(fsave, "LongName10"), Values{7});
}

TEST(fsave, keeps_directory_entries_apart_that_touch) {
  const std::string text =
      "MATRIXx VERSION 700 3 04-OCT-91 15:27\nAC 1 2BC 2 1CC1 1 1\n"
      "AC 1 2 0(1P3E25.17)\n1.0E+00 2.0E+00\nBC 2 1 0(1P3E25.17)\n3.0 4.0\nCC1 1 1 "
      "0(1P3E25.17)\n5.0\n";
  EXPECT_EQ(values(text, "AC"), (Values{1, 2}));
  EXPECT_EQ(values(text, "BC"), (Values{3, 4}));
  EXPECT_EQ(values(text, "CC1"), Values{5});
}

TEST(fsave, reads_fields_that_touch_by_their_columns) {
  EXPECT_EQ(values("MATRIXx VERSION 700 1\nA 2 2\nA             2    2    0(3(1PE10.3))\n"
                   "-1.000E+00-2.000E+00-3.000E+00\n 4.000E+00\n",
                   "A"),
            (Values{-1, -2, -3, 4}));
}

TEST(fsave, gives_the_only_matrix_when_no_name_is_asked_for) {
  EXPECT_EQ(values("MATRIXx\nA 1 1\nA 1 1 0(1P3E25.17)\n 5.\n", ""), Values{5});
  File file(fsave);
  EXPECT_FALSE(file.read(""));
  EXPECT_EQ(file.found(), Texts{"1:1 matrix-missing"});
}

TEST(fsave, without_the_matrix_lists_those_it_has) {
  File file(fsave);
  EXPECT_FALSE(file.read("CC"));
  EXPECT_EQ(file.found(), Texts{"1:1 matrix-missing"});
  EXPECT_EQ(file.first().message, "in.mat has no matrix CC");
  EXPECT_EQ(file.first().hint, "the file holds A, BC and LONGNAME10");
}

TEST(fsave, points_at_the_statement_that_asks_for_a_missing_matrix) {
  const SourceText file("in.mat", fsave), deck("a.adm", "x\nNAME=CC\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(read_matrix(file, "CC", {&deck, 7, 2}, diagnostics));
  EXPECT_EQ(problems(diagnostics), Texts{"2:6 matrix-missing"});
}

TEST(fsave, that_is_cut_short_says_how_many_values_are_there) {
  File file(fsave.substr(0, fsave.find("BC             3    1    0")));
  EXPECT_TRUE(file.read("A"));
  EXPECT_FALSE(file.read("BC"));
  EXPECT_EQ(file.found(), Texts{"2:22 matrix-truncated"});
  File values(fsave.substr(0, fsave.find("  4.000")));
  EXPECT_FALSE(values.read("A"));
  EXPECT_EQ(values.found(), Texts{"4:76 matrix-truncated"});
  EXPECT_EQ(values.first().message, "A needs 6 values, 3 found before the file ends");
}

TEST(fsave, reports_the_wrong_number_of_values) {
  const std::string start = "MATRIXx\nA 2 1B 1 1\nA 2 1 0(1P3E25.17)\n";
  File few(start + "1.0\nB 1 1 0(1P3E25.17)\n2.0\n");
  EXPECT_FALSE(few.read("A"));
  EXPECT_EQ(few.found(), Texts{"4:4 matrix-count"});
  File many(start + "1.0 2.0\n 3.0\nB 1 1 0(1P3E25.17)\n2.0\n");
  EXPECT_FALSE(many.read("A"));
  EXPECT_EQ(many.found(), Texts{"5:2 matrix-count"});
}

TEST(fsave, reports_text_among_the_values) {
  File file("MATRIXx\nA 2 1\nA 2 1 0(1P3E25.17)\n1.0 x\n");
  EXPECT_FALSE(file.read("A"));
  EXPECT_EQ(file.found(), Texts{"4:5 matrix-number"});
}

TEST(fsave, refuses_complex_matrices) {
  File file("MATRIXx\nA 1 1\nA 1 1 1(1P3E25.17)\n1.0\n2.0\n");
  EXPECT_FALSE(file.read("A"));
  EXPECT_EQ(file.found(), Texts{"3:1 matrix-complex"});
}

TEST(fsave, reports_an_incomplete_header) {
  File file("MATRIXx\nB 1 1\nA 1 1 0\n1.0\n");
  EXPECT_FALSE(file.read("A"));
  EXPECT_EQ(file.found(), Texts{"3:1 matrix-header"});
}

TEST(fsave, reserves_no_memory_for_values_that_cannot_be_there) {
  File file("MATRIXx\nA 9999999999\nA 99999 99999 0(1P3E25.17)\n1.0\n");
  EXPECT_FALSE(file.read("A"));
  EXPECT_EQ(file.found(), Texts{"3:1 matrix-truncated"});
}

TEST(fsave, may_hold_an_empty_matrix) {
  File file("MATRIXx\nA 0 3\nA 0 3 0(1P3E25.17)\n");
  const auto matrix = file.read("A");
  ASSERT_TRUE(matrix);
  EXPECT_EQ(matrix->columns, 3);
  EXPECT_TRUE(matrix->values.empty());
}

TEST(matsave, is_read_when_it_looks_like_fsave) {
  EXPECT_EQ(values("MATSAVE\nA 1 1\nA 1 1 0(1P3E25.17)\n 5.\n", "A"), Values{5});
}

const std::string adamsmat =
    "ADAMSMAT   Floating platform\n3\nTRF VALK STL\n"
    "TRF FULL RORDER 2 3 6 ( 3F8.5 )\n 1.36400 0.00000 2.00000\n-3.44000-1.50000 0.25000\n"
    "VALK FULL CORDER 2 2 4 ( 3F6.3 )\n 0.000-3.440 1.500\n 2.000\n"
    "STL SPARSE 3 2 2 ( 2I8, 1E14.6 )\n       1       2  1.500000E+00\n       3       1 "
    "-2.500000D+01\n";

TEST(adamsmat, is_read_row_by_row) {
  File file(adamsmat);
  const auto matrix = file.read("trf");
  ASSERT_TRUE(matrix) << file.found()[0];
  EXPECT_EQ(matrix->rows, 2);
  EXPECT_EQ(matrix->columns, 3);
  EXPECT_EQ(matrix->values, (Values{1.364, -3.44, 0, -1.5, 2, 0.25}));
}

TEST(adamsmat, is_read_column_by_column) { EXPECT_EQ(values(adamsmat, "VALK"), (Values{0, -3.44, 1.5, 2})); }

TEST(adamsmat, fills_sparse_matrices) { EXPECT_EQ(values(adamsmat, "STL"), (Values{0, 0, -25, 1.5, 0, 0})); }

TEST(adamsmat, mixes_whole_numbers_and_others) {
  EXPECT_EQ(values("ADAMSMAT\n1\nSELMOD\nSELMOD FULL RORDER 2 2 4 ( 1I8, 1E14.6 )\n"
                   "       1  0.200000E+01\n       3  0.400000E+01\n",
                   "SELMOD"),
            (Values{1, 3, 2, 4}));
}

TEST(adamsmat, reports_sparse_entries_outside_or_twice) {
  const std::string head = "ADAMSMAT\n1\nS\nS SPARSE 2 2 2 (2I4,E12.4)\n";
  File outside(head + "1 1 5.0\n3 1 5.0\n");
  EXPECT_FALSE(outside.read("S"));
  EXPECT_EQ(outside.found(), Texts{"4:1 matrix-entry"});
  File twice(head + "1 1 5.0\n1 1 6.0\n");
  EXPECT_FALSE(twice.read("S"));
  EXPECT_EQ(twice.found(), Texts{"4:1 matrix-entry"});
}

TEST(adamsmat, reports_a_header_that_contradicts_itself) {
  File file("ADAMSMAT\n1\nT\nT FULL RORDER 2 2 5 (5F8.3)\n1. 2. 3. 4. 5.\n");
  EXPECT_FALSE(file.read("T"));
  EXPECT_EQ(file.found(), Texts{"4:1 matrix-header"});
}

TEST(adamsmat, warns_where_fortran_would_imply_a_point) {
  File file("ADAMSMAT\n1\nT\nT FULL RORDER 1 2 2 (2F8.3)\n0 1500\n");
  EXPECT_EQ(file.read("T")->values, (Values{0, 1500}));
  EXPECT_EQ(file.found(), Texts{"5:3 matrix-implied-point"});
}

// FORTRAN reads 150 in F4.2 as 1.50; what has a point, and whole numbers in I, stay as they are.
TEST(adamsmat, implies_points_in_columns) {
  File file("ADAMSMAT\n1\nT\nT FULL RORDER 2 2 4 (2F4.2)\n 150 2.5\n   0-300\n");
  EXPECT_EQ(file.read("T")->values, (Values{1.5, 0, 2.5, -3}));
  EXPECT_EQ(file.found(), Texts{"5:2 matrix-implied-point"});
  File sparse("ADAMSMAT\n1\nS\nS SPARSE 2 2 1 (2I4,E8.2)\n   1   2  5.0E+0\n");
  EXPECT_EQ(sparse.read("S")->values, (Values{0, 0, 5, 0}));
  EXPECT_EQ(sparse.found(), Texts{});
  File exponent("ADAMSMAT\n1\nT\nT FULL RORDER 1 1 1 (E8.2)\n   150E2\n");
  EXPECT_EQ(exponent.read("T")->values, Values{150});
  File free("ADAMSMAT\n1\nT\nT FULL RORDER 1 1 1 (E8.2)\n150\n");
  EXPECT_EQ(free.read("T")->values, Values{150});
  EXPECT_EQ(free.found(), Texts{"5:1 matrix-implied-point"});
}

std::string by_rows(const std::string& format, const std::string& lines) {
  return "ADAMSMAT\n1\nA\nA FULL RORDER 2 2 4 (" + format + ")\n" + lines;
}

// Behind kP a number without exponent is 10^k times what it stands for.
TEST(scale_factor, divides_numbers_without_exponent) {
  const std::string lines = "-136.00-200.00\n 250.00-125.00\n";
  const Values hundredth = {-1.36, 2.5, -2, -1.25};
  for (const char* format : {"2P2F7.2", "2P,2F7.2", "+2P,2F7.2", "2(2PF7.2)", "2P,2(F7.2)", " 2 P 2 F 7.2 "})
    EXPECT_EQ(values(by_rows(format, lines), "A"), hundredth) << format;
  EXPECT_EQ(values(by_rows("-2P,2F7.2", lines), "A"), (Values{-13600, 25000, -20000, -12500}));
  EXPECT_EQ(values(by_rows("0P,2F7.2", lines), "A"), (Values{-136, 250, -200, -125}));
  // Until the next one, across records.
  EXPECT_EQ(values(by_rows("F7.2,2PF7.2", lines), "A"), (Values{-136, 2.5, -2, -1.25}));
  EXPECT_EQ(values(by_rows("2PF7.2,0PF7.2", lines), "A"), (Values{-1.36, 2.5, -200, -125}));
  // Blanks between the numbers leave them in their columns.
  EXPECT_EQ(values(by_rows("2P,3F8.2", " -136.00 -200.00  250.00\n -125.00\n"), "A"), hundredth);
  EXPECT_EQ(values(by_rows("2P,3F8.2", "-136.00 -200.00 250.00  \n-125.00 \n"), "A"), hundredth);
}

TEST(scale_factor, leaves_whole_numbers_and_exponents_as_they_are) {
  EXPECT_EQ(values(by_rows("2P,2F9.2", "-1.36E+00-2.00D+00\n 2.50+000-1.25E+00\n"), "A"),
            (Values{-1.36, 2.5, -2, -1.25}));
  EXPECT_EQ(values("ADAMSMAT\n1\nS\nS SPARSE 2 2 1 (2P,2I4,F8.2)\n   1   2  150.00\n", "S"), (Values{0, 0, 1.5, 0}));
}

TEST(scale_factor, is_remarked_where_fortran_writes_an_exponent) {
  File file(by_rows("1P2E8.2", "  0.0000  1.5E+0\n  1.5000  1.5E+0\n"));
  EXPECT_EQ(file.read("A")->values, (Values{0, 0.15, 1.5, 1.5}));
  EXPECT_EQ(file.found(), Texts{"6:3 matrix-scale-factor"});
}

TEST(scale_factor, counts_in_columns_only) {
  File file(by_rows("2P,2F8.2", "1.5E0 2.5\n3.5 4.5\n"));
  EXPECT_EQ(file.read("A")->values, (Values{1.5, 3.5, 2.5, 4.5}));
  EXPECT_EQ(file.found(), Texts{"5:7 matrix-scale-factor"});
}

TEST(columns, without_a_number_are_zero) {
  File file(by_rows("2F7.2", "       -200.00\n 250.00       \n"));
  EXPECT_EQ(file.read("A")->values, (Values{0, 250, -200, 0}));
  EXPECT_EQ(file.found(), Texts{"5:1 matrix-empty-column"});
  // A line that ends before its columns do lacks a number.
  File cut(by_rows("2F7.2", "       -200.00\n 250.00\n"));
  EXPECT_FALSE(cut.read("A"));
  EXPECT_EQ(cut.found(), Texts{"6:8 matrix-truncated"});
}

TEST(exponents, need_no_letter) {
  const Values expected = {1.36, -2.5e10, -0.2, 1e-100};
  EXPECT_EQ(values(by_rows("1P2E10.3", " 1.360+00 -2.000-01 \n-2.500+10 1.000-100 \n"), "A"), expected);
  EXPECT_EQ(values(by_rows("1P2E10.3", "1.360+00 -2.000-01\n-2.500+10 1.000-100\n"), "A"), expected);
}

TEST(matrix_file, of_an_unknown_type_is_refused) {
  for (const char* text : {"", "matrixx\n", "1 2 3\n", "HELLO"}) {
    File file(text);
    EXPECT_FALSE(file.read("A"));
    EXPECT_EQ(file.found(), Texts{"1:1 matrix-file-type"});
  }
}

TEST(matrix_file, reports_numbers_that_are_too_large) {
  File file("MATRIXx\nA 1 1\nA 1 1 0(1P3E25.17)\n 1E999\n");
  EXPECT_FALSE(file.read("A"));
  EXPECT_EQ(file.found(), Texts{"3:1 number-overflow"});
}

TEST(fortran_format, writes_out_repetitions) {
  EXPECT_EQ(parse_fortran_format("(3(1PE25.17))")->items.size(), 6u);
  EXPECT_EQ(parse_fortran_format("(1P3E25.17)")->items.size(), 4u);
  EXPECT_EQ(parse_fortran_format("(-2P,F8.2)")->items[0].power, -2);
  EXPECT_EQ(parse_fortran_format("( 1I8, 1E14.6 )")->items[1].width, 14u);
  EXPECT_EQ(parse_fortran_format("(2(I4,2(F5.1,2X)),/,D9.2)")->items.size(), 12u);
}

TEST(fortran_format, goes_on_with_its_last_group) {
  EXPECT_EQ(parse_fortran_format("(I4,2(F5.1))")->again, 1u);
  EXPECT_EQ(parse_fortran_format("(I4,F5.1)")->again, 0u);
}

TEST(fortran_format, refuses_what_it_does_not_know) {
  for (const char* text :
       {"", "(", "()", "(A10)", "(3X)", "(3F)", "(F0.3)", "3F8.2", "(-2F8.2)", "(200PF8.2)", "(9999(9999(F8.2)))",
        "((((((((((((((((((((((((F8.2))))))))))))))))))))))))", "(99999999999F8.2)"}) {
    EXPECT_FALSE(parse_fortran_format(text)) << text;
  }
}

}  // namespace
}  // namespace dynalin::testing::matrix_file_test
