#include "perturbation/perturbation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "linear/linear_system.h"
#include "system/model_test_support.h"

namespace dynalin::perturbation_test {
namespace {

// A link on a ball joint, a second one hinged to it about an oblique axis, a spring and a controller.
Result<Perturbation> links_turning(double rate) {
  const auto system = system_test::system_of(
      fmt::format("PART/2, MASS=2, CM=20, IP=.1,.2,.3, WX={0}, WY={0}, WZ={0}\nMARKER/20, QP=0,0,-.5\nMARKER/21\n"
                  "MARKER/22, QP=0,0,-1, REULER=0.3,1.2,0.1\n"
                  "PART/3, MASS=1, CM=30, IP=.3,.1,.2\nMARKER/30, QP=.1,.2,-1.5\n"
                  "MARKER/31, QP=0,0,-1, REULER=0.3,1.2,0.1\n"
                  "JOINT/1, SPHERICAL, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22, IC=0, {0}\n"
                  "BUSHING/3, I=30, J=1, K=10,20,30, C=1,2,3\nDIFF/4, FUNCTION=WZ(30)-DIF(4)\n"
                  "SFORCE/5, ROTATIONAL, I=31, J=22, FUNCTION=-DIF(4)\n",
                  rate));
  Findings findings;
  const auto op = initial_conditions(*system, findings);
  if (!op) return tl::unexpected(op.error());
  return perturb(*system, *op, {});
}

TEST(Perturbation, holds_no_entry_that_is_zero_and_more_of_them_in_motion) {
  const auto at_rest = links_turning(0), turning = links_turning(1.5);
  ASSERT_TRUE(at_rest) << at_rest.error().message;
  ASSERT_TRUE(turning) << turning.error().message;
  const ColumnMatrix &one = at_rest->equations->products(), &other = turning->equations->products();
  const auto zeros = [](const ColumnMatrix& m) { return std::count(m.value.begin(), m.value.end(), 0.0); };
  EXPECT_EQ(zeros(one), 0);
  EXPECT_EQ(zeros(other), 0);
  EXPECT_LT(one.value.size(), other.value.size()) << "what motion makes is nothing at rest";
}

}  // namespace
}  // namespace dynalin::perturbation_test
