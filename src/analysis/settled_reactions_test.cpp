#include "analysis/settled_reactions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::settled_reactions_test {
namespace {

TEST(SettledReactions, do_no_work_on_what_is_left) {
  Search s(pendulum(0.6));
  s.equations.evaluate(s.op, Partials::yes);
  // Only the moment about the hinge is left: its rows have the weight's, the others are met.
  const Eigen::VectorXd& r = s.equations.residual();
  EXPECT_NEAR(r(5), 20 * std::sin(0.6), 1e-12);
  EXPECT_NEAR(s.equations.imbalance(), std::abs(r(5)) / s.system->length(), 1e-9);
  EXPECT_DOUBLE_EQ(s.equations.force_scale(), 20);
}

// Whatever they were before: those that the weight keeps up stay, those that nothing keeps up vanish without a rest.
TEST(SettledReactions, keep_nothing_of_a_motion) {
  Search weighed(pendulum(0.6));
  const std::vector<double> before = weighed.op.lambda;
  const std::string text = pendulum(0.6);
  Search weightless(text.substr(gravity.size()));
  for (Search* s : {&weighed, &weightless}) {
    std::ranges::fill(s->op.lambda, 1e3);
    settle_after_motion(s->equations, s->op);
  }
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_NEAR(weighed.op.lambda[k], before[k], 1e-12);
    EXPECT_EQ(weightless.op.lambda[k], 0);
  }
}

}  // namespace
}  // namespace dynalin::analysis_test::settled_reactions_test
