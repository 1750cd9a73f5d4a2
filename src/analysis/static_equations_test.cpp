// The equations of rest: scales, tangents, reactions.
#include "analysis/static_equations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/static_step.h"
#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::static_equations_test {
namespace {

TEST(StaticEquations, the_tangent_is_the_derivative_of_the_residual_and_holding_adds_to_its_diagonal) {
  Search s(pendulum(0.6) + "SPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT=7, CT=1, ANGLE=0\n" + fold);
  const auto residual = [&](Eigen::Index c, double by) -> Eigen::VectorXd {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(s.equations.augmented().size());
    step(c) = by;
    s.equations.evaluate(moved(*s.system, s.op, s.equations.augmented(), step, 1.0, {1.0}), Partials::no);
    return s.equations.residual();
  };
  s.equations.evaluate(s.op, Partials::yes);
  const ColumnMatrix plain = s.equations.tangent(0, 0), held = s.equations.tangent(1e3, 1e2);
  constexpr double h = 2e-3;
  for (std::int32_t c = 0; c < plain.columns; ++c) {
    const auto difference = [&](double d) -> Eigen::VectorXd { return (residual(c, d) - residual(c, -d)) / (2 * d); };
    Eigen::VectorXd expected = (4 * difference(h / 2) - difference(h)) / 3;
    for_each_in_column(plain, c, [&](std::int32_t r, double v) {
      EXPECT_NEAR(v, expected(r), 1e-6) << "row " << r << " column " << c;
      expected(r) = 0;
    });
    EXPECT_LE(expected.cwiseAbs().maxCoeff(), 1e-6);
    // What is added for holding stands on the diagonal, and is of the size of the first tangent.
    double added = 0, own = 0;
    for_each_in_column(held, c, [&](std::int32_t r, double v) {
      if (r == c) added = v;
    });
    for_each_in_column(plain, c, [&](std::int32_t r, double v) {
      if (r == c) own = v;
    });
    added -= own;
    const std::int32_t state = s.equations.augmented().state(0);
    EXPECT_TRUE(c >= 6 && c != state ? added == 0 : added > 0) << "column " << c;
    // A state beside which there is nothing to compare is held by its own coefficient.
    if (c == state) {
      EXPECT_NEAR(added, 1e2 * std::abs(own), 1e-9);
    }
  }
  // damping(step) is that of the diagonal for unit holding
  s.equations.evaluate(s.op, Partials::yes);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(plain.rows);
  step(5) = 2;
  const double one = s.equations.damping(step);
  double on_diagonal = 0;
  for_each_in_column(held, 5, [&](std::int32_t r, double v) { on_diagonal += r == 5 ? v : 0; });
  for_each_in_column(plain, 5, [&](std::int32_t r, double v) { on_diagonal -= r == 5 ? v : 0; });
  EXPECT_NEAR(one, 4 * on_diagonal / 1e3, 1e-9 * one);
  EXPECT_NEAR(s.equations.slope(step), 2 * s.equations.residual()(5), 1e-12);
}

TEST(StaticEquations, the_equation_farthest_from_being_met_is_named) {
  Search s(pendulum(0.6));
  s.equations.evaluate(s.op, Partials::yes);
  EXPECT_EQ(s.equations.worst(20), "the unbalanced force is largest at AZ of PART/2");
  Search f(fold);
  f.equations.evaluate(f.op, Partials::yes);
  EXPECT_EQ(f.equations.worst(1).substr(0, 41), "the state of DIFF/7 does not come to rest");
  EXPECT_EQ(f.equations.equation_text(0), "the state of DIFF/7");
}

TEST(StaticEquations, a_step_is_shortened_as_a_whole_to_the_largest_turn) {
  Search s(pendulum(0.6) + fold);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(s.equations.augmented().size());
  step(5) = -0.5;
  step(s.equations.augmented().state(0)) = 3;
  step(s.equations.augmented().lambda(1)) = 8;
  double taken = 0;
  const OperatingPoint to = moved(*s.system, s.op, s.equations.augmented(), step, 0.5, {0.125}, &taken);
  EXPECT_NEAR(taken, 0.25, 1e-15);
  EXPECT_NEAR(angle_of(to) - angle_of(s.op), -0.125, 1e-14);
  EXPECT_NEAR(to.state[0] - s.op.state[0], 0.75, 1e-14);
  EXPECT_NEAR(to.lambda[1] - s.op.lambda[1], 2, 1e-13);
}

}  // namespace
}  // namespace dynalin::analysis_test::static_equations_test
