// Headers of Matrix Market that do not fit, told as what they are.
#include "reduction/coordinate_matrix.h"

#include <gmock/gmock.h>

namespace dynalin::reduction::coordinate_matrix_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string said(const std::string& text) {
  const SourceText file("m.mtx", text);
  Diagnostics diagnostics;
  const auto matrix = read_coordinate_matrix(file, 2, diagnostics);
  EXPECT_EQ(matrix.has_value(), !diagnostics.has_errors());
  return render(diagnostics);
}

TEST(CoordinateMatrix, has_as_many_entries_as_its_header_says) {
  const std::string begin = "%%MatrixMarket matrix coordinate real symmetric\n";
  EXPECT_EQ(said(begin + "2 2 2\n1 1 3\n2 2 4\n"), "");
  const std::string few = said(begin + "2 2 2\n1 1 3\n");
  EXPECT_THAT(few, HasSubstr("promises 2 entries, and 1 is there"));
  EXPECT_THAT(few, HasSubstr("cut off"));
  const std::string many = said(begin + "2 2 1\n1 1 3\n2 2 4\n2 1 1\n");
  EXPECT_THAT(many, HasSubstr("m.mtx:4:1: error: the header promises 1 entry, and 3 are there"));
  EXPECT_THAT(many, Not(HasSubstr("cut off")));
}

TEST(CoordinateMatrix, begins_with_two_signs) {
  for (const char* const begin : {"%", "", "%%%", "% ", "%% "}) {
    EXPECT_THAT(said(begin + std::string("MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 1 3\n")),
                HasSubstr("m.mtx:1:1: error: the header of Matrix Market begins with two %"));
  }
  EXPECT_EQ(said("% any other comment\n1 1 3\n2 2 4\n"), "");
}

}  // namespace
}  // namespace dynalin::reduction::coordinate_matrix_test
