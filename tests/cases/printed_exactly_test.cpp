// What is zero or a name is printed as such.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::printed_exactly_test {
namespace {

using ::testing::HasSubstr;

// Two bodies on bushings with damping that no axis is special to, hanging.
const std::string bodies =
    "Two bodies\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n! "
    "adams_view_name='.model_1.upper.body'\nPART/2, MASS=1.3, CM=20, IP=0.1,0.2,0.3, QG=0.3,-1,0.2\nMARKER/20\n"
    "MARKER/21, QP=0,1,0.1\n! adams_view_name='.model_1.lower_body_with_a_long_name'\nPART/3, MASS=0.7, CM=30, "
    "IP=0.15,0.2,0.25, QG=0.5,-2,0.1\nMARKER/30\nMARKER/31, QP=0.1,0.3,0\nBUSHING/1, I=21, J=1, K=100,220,310, "
    "KT=14,17,19, C=1,2,3, CT=0.1,0.2,0.3\nBUSHING/2, I=31, J=20, K=150,120,110, KT=10,12,13, C=1.5,2.5,3.5, "
    "CT=0.1,0.2,0.3\nEND\n";

class PrintedExactly : public Cases {};

TEST_F(PrintedExactly, real_parts_without_damping_are_zero) {
  const RunResult r = run(bodies, "SIMULATE/STATIC\nLINEAR/EIGENSOL, NODAMPIN\n");
  ASSERT_EQ(r.status, 0) << r.err;
  ASSERT_EQ(r.eigenvalues(1).size(), 24u);
  for (const auto& v : r.eigenvalues(1)) EXPECT_EQ(v.real(), 0.0);
  for (int k = 1; k <= 12; ++k)
    EXPECT_THAT(r.message, HasSubstr("\n" + std::string(k < 10 ? "         " : "        ") + std::to_string(k) +
                                     "              0.00000E+00    +/-"));
}

TEST_F(PrintedExactly, names_are_whole) {
  const RunResult r =
      run(bodies, "SIMULATE/STATIC\nLINEAR/EIGENSOL, KINETIC=1, COORDS=1, STRAIN=1, TABLE_PRECISION=4, NAMES\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string text = r.text("model.txt");
  for (const char* name : {"| .model_1.upper.body\n", "| .model_1.lower_body_with_a_long_name\n"}) {
    std::size_t count = 0;
    for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) ++count;
    EXPECT_EQ(count, 2u) << name;
  }
}

}  // namespace
}  // namespace dynalin::cases::printed_exactly_test
