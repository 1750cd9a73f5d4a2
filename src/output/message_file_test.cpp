#include "output/message_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace dynalin::message_file_test {
namespace {

std::string table_of_real_value(double bound) {
  EigenSolution solution;
  EigenMode& mode = solution.modes.emplace_back();
  mode.eigenvalue_hz = -0.5;
  mode.is_real = true;
  mode.error_bound_hz = bound;
  std::ostringstream out;
  write_eigen_table(out, solution, "cycles/s", false);
  return out.str();
}

TEST(eigen_table, marks_that_a_value_is_real_where_it_has_no_bound) {
  const std::string unknown = table_of_real_value(std::numeric_limits<double>::infinity());
  for (const char* const marked : {" 0.5?", " 1.00000?", " -0.5?", " 0?"})
    EXPECT_NE(unknown.find(marked), std::string::npos) << marked << "\n" << unknown;
  EXPECT_EQ(table_of_real_value(1e-15).find('?'), std::string::npos);
}

}  // namespace
}  // namespace dynalin::message_file_test
