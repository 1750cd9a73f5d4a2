#include "expression/spline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/functions.h"
#include "expression/switch_test_support.h"

namespace dynalin::spline_test {
namespace {

SplineUse use(SplineMethod method, SplineData data, int derivative = 0) {
  SplineUse u;
  u.method = method;
  u.derivative = derivative;
  u.curves = std::make_shared<const SplineCurves>(std::make_shared<const SplineData>(std::move(data)), method);
  return u;
}

const std::vector<double> x = {-1, 0, 0.5, 2, 3, 4.5};

SplineData through(double (*f)(double)) {
  SplineData d{x, {}, {{}}, false};
  for (const double p : x) d.y[0].push_back(f(p));
  return d;
}

TEST(Spline, passes_through_its_points) {
  for (const SplineMethod m : {SplineMethod::akima, SplineMethod::cubic, SplineMethod::linear}) {
    const SplineUse s = use(m, through([](double p) { return std::sin(p); }));
    for (const double p : x) EXPECT_NEAR(s.evaluate(p, 0.0), std::sin(p), 1e-15);
  }
}

TEST(Spline, a_cubic_is_reproduced_by_cubspl_and_a_line_by_all) {
  const auto cubic = [](double p) { return 1 - 2 * p + 0.5 * p * p + 0.3 * p * p * p; };
  const SplineUse s = use(SplineMethod::cubic, through(+cubic));
  for (const double p : {-0.7, 0.1, 1.3, 2.5, 4.4}) {
    EXPECT_NEAR(s.evaluate(p, 0.0), cubic(p), 1e-13);
  }
  EXPECT_NEAR(use(SplineMethod::cubic, through(+cubic), 1).evaluate(1.3, 0.0), -2 + 1.3 + 0.9 * 1.69, 1e-13);
  EXPECT_NEAR(use(SplineMethod::cubic, through(+cubic), 2).evaluate(1.3, 0.0), 1 + 1.8 * 1.3, 1e-12);
  for (const SplineMethod m : {SplineMethod::akima, SplineMethod::cubic, SplineMethod::linear}) {
    const SplineUse line = use(m, through([](double p) { return 3 - 2 * p; }));
    for (const double p : {-4.0, -0.2, 1.0, 3.3, 9.0}) EXPECT_NEAR(line.evaluate(p, 0.0), 3 - 2 * p, 1e-13);
  }
}

TEST(Spline, akima_takes_the_published_slopes) {
  // Slopes 0 0 0 1 2 2 of unit pieces: at the kink the weighted mean of both neighbours.
  SplineData d{{0, 1, 2, 3, 4, 5, 6}, {}, {{0, 0, 0, 0, 1, 3, 5}}, false};
  const SplineUse slope = use(SplineMethod::akima, d, 1);
  EXPECT_DOUBLE_EQ(slope.evaluate(1.0, 0.0), 0);
  EXPECT_DOUBLE_EQ(slope.evaluate(2.0, 0.0), 0);  // flat to the left
  EXPECT_DOUBLE_EQ(slope.evaluate(3.0, 0.0), 0);  // |2−1| · 0 + |0−0| · 1 over 1
  EXPECT_DOUBLE_EQ(slope.evaluate(4.0, 0.0), 2);  // |2−2| · 1 + |1−0| · 2 over 1
}

TEST(Spline, the_second_derivative_of_cubspl_is_continuous) {
  const SplineUse bend = use(SplineMethod::cubic, through([](double p) { return std::exp(-p); }), 2);
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    EXPECT_NEAR(bend.evaluate(x[k] - 1e-9, 0.0), bend.evaluate(x[k], 0.0), 1e-7);
  }
}

TEST(Spline, goes_on_as_a_parabola_or_a_line) {
  SplineData d = through([](double p) { return p * p * p; });
  const SplineUse s = use(SplineMethod::akima, d);
  // The parabola through (2, 8), (3, 27), (4.5, 91.125).
  const double t = 6, L2 = (t - 3) * (t - 4.5) / ((2 - 3.0) * (2 - 4.5)),
               L3 = (t - 2) * (t - 4.5) / ((3 - 2.0) * (3 - 4.5)), L45 = (t - 2) * (t - 3) / ((4.5 - 2) * (4.5 - 3));
  EXPECT_NEAR(s.evaluate(t, 0.0), 8 * L2 + 27 * L3 + 91.125 * L45, 1e-11);
  d.linear_extrapolation = true;
  const SplineUse line = use(SplineMethod::akima, d);
  EXPECT_NEAR(line.evaluate(t, 0.0), 91.125 + 1.5 * (91.125 - 27) / 1.5, 1e-11);
  EXPECT_NEAR(line.evaluate(-3.0, 0.0), -1 - 2 * 1, 1e-13);
}

TEST(Spline, a_family_is_linear_between_its_curves_and_beyond) {
  SplineData d{{0, 1, 2, 3}, {1, 2, 4}, {{0, 1, 2, 3}, {0, 2, 4, 6}, {0, 3, 6, 9}}, false};
  const SplineUse s = use(SplineMethod::cubic, d);
  EXPECT_NEAR(s.evaluate(1.5, 1.5), 2.25, 1e-14);
  EXPECT_NEAR(s.evaluate(1.5, 3.0), 3.75, 1e-14);
  EXPECT_NEAR(s.evaluate(1.5, 0.0), 0.0, 1e-14);
  EXPECT_NEAR(s.evaluate(1.5, 6.0), 6.0, 1e-14);
}

TEST(Spline, partial_derivatives_are_those_of_the_piece) {
  SplineData d{{0, 1, 2, 3}, {1, 2}, {{0, 1, 5, 3}, {2, -2, 4, 6}}, false};
  for (const SplineMethod m : {SplineMethod::akima, SplineMethod::cubic}) {
    const SplineUse s = use(m, d);
    for (const double p : {-0.5, 0.3, 1.7, 3.4}) {
      const Seeded r = s.evaluate(Seeded(p, 0), Seeded(1.3, 1));
      const double h = 1e-6;
      EXPECT_NEAR(r.partial[0], (s.evaluate(p + h, 1.3) - s.evaluate(p - h, 1.3)) / (2 * h), 1e-8);
      EXPECT_NEAR(r.partial[1], (s.evaluate(p, 1.3 + h) - s.evaluate(p, 1.3 - h)) / (2 * h), 1e-8);
    }
  }
}

// Where switches of a use change their sign along x, or along z at x = 0.1.
std::vector<double> changes(const SplineUse& s, double from, double to, bool along_z = false) {
  const auto at = [&](double p) {
    SwitchList list;
    along_z ? s.switches(0.1, p, list) : s.switches(p, 0.0, list);
    return list;
  };
  return expression_test::sign_changes(at, from, to);
}

using Places = std::vector<double>;
void expect_places(const Places& found, const Places& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-12);
}

TEST(Spline, switches_where_the_value_or_its_slope_jumps_and_where_data_end) {
  const auto curved = [](double p) { return std::sin(p) + p * p * p; };
  const Places ends = {x.front(), x.back()}, inner(x.begin() + 1, x.end() - 1);
  expect_places(changes(use(SplineMethod::linear, through(+curved)), -3, 6), x);
  expect_places(changes(use(SplineMethod::akima, through(+curved)), -3, 6), ends);
  expect_places(changes(use(SplineMethod::akima, through(+curved), 1), -3, 6), x);
  expect_places(changes(use(SplineMethod::cubic, through(+curved), 1), -3, 6), ends);
  expect_places(changes(use(SplineMethod::cubic, through(+curved), 2), -3, 6), x);
  SplineData line = through(+curved);
  line.linear_extrapolation = true;
  expect_places(changes(use(SplineMethod::linear, line), -3, 6), inner);
  expect_places(changes(use(SplineMethod::akima, line), -3, 6), ends);
}

TEST(Spline, switches_between_the_curves_of_a_family) {
  SplineData family{x, {0, 1, 2, 4}, {x, x, x, x}, false};
  for (std::size_t k = 0; k < 4; ++k) family.y[k][2] += static_cast<double>(k * k);
  expect_places(changes(use(SplineMethod::cubic, family), -1, 6, true), {1, 2});
}

// The part of a step that may be made, up to the bump at 4 … 6 or away from it.
TEST(Spline, steps_do_not_pass_over_what_is_between_points) {
  const SplineData bump = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {}, {{0, 0, 0, 0, 0, 1, 0, 0, 0, 0}}, false};
  const auto reach = [&](SplineMethod method, double from, double to) {
    StepReach r(1e-3);
    use(method, bump).look_ahead(from, 0, to, 0, r);
    return from + r.share() * (to - from);
  };
  for (const SplineMethod m : {SplineMethod::akima, SplineMethod::linear}) {
    EXPECT_EQ(reach(m, 0.5, 2.9), 2.9);
    EXPECT_EQ(reach(m, 7.1, 20), 20);
    EXPECT_NEAR(reach(m, 0.5, 8.5), 4, 1);
    EXPECT_NEAR(reach(m, 8.5, 0.5), 6, 1);
    EXPECT_GE(reach(m, 0.5, 8.5), 3);
    EXPECT_LT(reach(m, 4, 8.5), 5.01);  // into it
    EXPECT_EQ(reach(m, 0.5, 0.5), 0.5);
  }
  // Two points alike and a bulge between.
  const SplineData bulge = {{0, 1, 2, 3, 4, 5}, {}, {{-2, -1, 0, 0, -1, -2}}, false};
  StepReach r(1e-3);
  use(SplineMethod::cubic, bulge).look_ahead(2, 0, 3.2, 0, r);
  EXPECT_NEAR(r.share(), 0.5 / 1.2, 1e-3);
  StepReach family(1e-3);
  use(SplineMethod::linear, {{0, 1, 2, 3, 4}, {0, 1}, {{0, 0, 0, 0, 0}, {0, 0, 1, 0, 0}}, false})
      .look_ahead(0.5, 0, 3.5, 1, family);
  EXPECT_LT(family.share(), 0.6);
}

}  // namespace
}  // namespace dynalin::spline_test
