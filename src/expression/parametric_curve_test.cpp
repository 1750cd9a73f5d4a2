// Curves through points and along control points, against polynomials, the discrete Fourier solution of the periodic
// cubic spline, and Bernstein's form.
#include "expression/parametric_curve.h"

#include <gtest/gtest.h>

#include <numbers>

#include "expression/switch_test_support.h"

namespace dynalin::parametric_curve_test {
namespace {

using Shape = ParametricCurve::Shape;
using Data = ParametricCurve::Data;
using Points = ParametricCurve::Points;
using V = Vec3<double>;

void expect_near(const V& a, const V& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance);
}

Points scattered(std::size_t n) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    p.push_back({std::sin(1.3 * x) + 0.2 * x, std::cos(0.7 * x * x), 0.1 * x - std::sin(2.1 * x)});
  }
  return p;
}
double parameter(std::size_t i, std::size_t n) { return -1 + 2 * static_cast<double>(i) / static_cast<double>(n - 1); }

TEST(ParametricCurve, passes_its_points_at_equal_steps) {
  for (const int order : {4, 5, 6}) {
    for (const Shape shape : {Shape::open, Shape::closed}) {
      Points p = scattered(11);
      if (shape == Shape::closed) p.back() = p.front();
      const ParametricCurve c(p, shape, Data::points, order);
      for (std::size_t i = 0; i < p.size(); ++i) expect_near(c.at(parameter(i, p.size())), p[i], 1e-13);
    }
  }
}

TEST(ParametricCurve, reproduces_polynomials_below_its_order_with_all_derivatives) {
  for (const int order : {4, 5, 6}) {
    for (const std::size_t n : {6u, 7u, 12u}) {
      const auto f = [&](double u) { return V{u, 2 + u - 0.5 * u * u + 1.5 * u * u * u, std::pow(u, order - 1)}; };
      Points p;
      for (std::size_t i = 0; i < n; ++i) p.push_back(f(parameter(i, n)));
      const ParametricCurve c(p, Shape::open, Data::points, order);
      for (const double u : {-1.0, -0.83, -0.2, 0.31, 0.77, 1.0}) {
        expect_near(c.at(u), f(u), 1e-13);
        expect_near(c.at(u, 1), {1, 1 - u + 4.5 * u * u, (order - 1) * std::pow(u, order - 2)}, 1e-11);
        expect_near(c.at(u, 2), {0, -1 + 9 * u, (order - 1) * (order - 2) * std::pow(u, order - 3)}, 1e-9);
      }
    }
  }
}

TEST(ParametricCurve, derivatives_are_those_of_the_scalar_type) {
  const ParametricCurve c(scattered(9), Shape::open, Data::points);
  for (const double u : {-0.9, 0.1, 0.66}) {
    const TimeTaylor<double> along(u, 0.7, -0.3);
    const auto v = c.at(along);
    expect_near({v.x.rate, v.y.rate, v.z.rate}, 0.7 * c.at(u, 1), 1e-12);
    expect_near({v.x.acceleration, v.y.acceleration, v.z.acceleration}, 0.49 * c.at(u, 2) - 0.3 * c.at(u, 1), 1e-11);
    const auto d = c.at(Dual<1>(u, 0), 1);
    expect_near({d.x.partial[0], d.y.partial[0], d.z.partial[0]}, c.at(u, 2), 1e-11);
  }
}

TEST(ParametricCurve, closed_is_periodic_with_two_continuous_derivatives) {
  Points p = scattered(8);
  p.push_back(p.front());
  for (const Data data : {Data::points, Data::control_points}) {
    const ParametricCurve c(p, Shape::closed, data);
    bool third_jumps = false;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double u = parameter(i, p.size()), e = 1e-13;
      for (const int derivative : {0, 1, 2}) expect_near(c.at(u - e, derivative), c.at(u + e, derivative), 1e-9);
      third_jumps = third_jumps || norm(c.at(u - e, 3) - c.at(u + e, 3)) > 1;
    }
    EXPECT_TRUE(third_jumps);  // pieces meet here indeed
    for (const double u : {-1.0, -0.4, 0.9}) {
      for (const int derivative : {0, 1, 2, 3}) {
        expect_near(c.at(u, derivative), c.at(u + 2, derivative), 1e-10);
        expect_near(c.at(u, derivative), c.at(u - 4, derivative), 1e-10);
      }
    }
  }
}

TEST(ParametricCurve, closed_cubic_through_a_circle_is_the_fourier_solution) {
  // Of points exp(i w k) the periodic cubic spline on the unit grid is exp(i w k) Σ_m e^{iwm} N(x − m) / Σ_m e^{iwm}
  // N(−m) with the cardinal B-spline N: N(0) = 2/3, N(±1) = 1/6, N(±1/2) = 23/48, N(±3/2) = 1/48.
  const std::size_t n = 12;
  const double w = 2 * std::numbers::pi / static_cast<double>(n), scale = (2 + std::cos(w)) / 3;
  Points p;
  for (std::size_t k = 0; k <= n; ++k) {
    p.push_back({std::cos(w * static_cast<double>(k % n)), std::sin(w * static_cast<double>(k % n)), 0});
  }
  const ParametricCurve c(p, Shape::closed, Data::points);
  const double per_step = static_cast<double>(n) / 2;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = parameter(k, n + 1), a = w * static_cast<double>(k), middle = a + w / 2;
    expect_near(c.at(u, 1), per_step * std::sin(w) / scale * V{-std::sin(a), std::cos(a), 0}, 1e-12);
    expect_near(c.at(u, 2), per_step * per_step * (2 * std::cos(w) - 2) / scale * V{std::cos(a), std::sin(a), 0},
                1e-11);
    const double radius = (23 * std::cos(w / 2) + std::cos(3 * w / 2)) / 24 / scale;
    expect_near(c.at(u + 0.5 / per_step), radius * V{std::cos(middle), std::sin(middle), 0}, 1e-13);
  }
}

TEST(ParametricCurve, four_control_points_are_bernsteins_cubic) {
  const Points p = scattered(4);
  const ParametricCurve c(p, Shape::open, Data::control_points);
  for (const double u : {-1.0, -0.3, 0.5, 1.0}) {
    const double s = (u + 1) / 2, r = 1 - s;
    expect_near(c.at(u), r * r * r * p[0] + 3 * r * r * s * p[1] + 3 * r * s * s * p[2] + s * s * s * p[3], 1e-14);
  }
  // More control points: the ends are met along the first and last leg.
  const Points q = scattered(9);
  const ParametricCurve d(q, Shape::open, Data::control_points);
  expect_near(d.at(-1.0), q.front(), 1e-14);
  expect_near(d.at(1.0), q.back(), 1e-14);
  EXPECT_NEAR(norm(cross(d.at(-1.0, 1), q[1] - q[0])), 0, 1e-13);
}

TEST(ParametricCurve, goes_on_along_its_tangent_where_it_does_not_reach) {
  const ParametricCurve c(scattered(6), Shape::open, Data::points);
  EXPECT_TRUE(c.reaches(1.0 + 1e-12));
  EXPECT_FALSE(c.reaches(-1.001));
  expect_near(c.at(1.5), c.at(1.0) + 0.5 * c.at(1.0, 1), 1e-13);
  expect_near(c.at(-2.0, 1), c.at(-1.0, 1), 1e-13);
  expect_near(c.at(-2.0, 2), {}, 1e-13);
}

TEST(ParametricCurve, finds_the_nearest_point) {
  Points p;
  for (std::size_t k = 0; k <= 40; ++k) {
    const double a = 2 * std::numbers::pi * static_cast<double>(k % 40) / 40;
    p.push_back({2 * std::cos(a), std::sin(a), 0});
  }
  const ParametricCurve c(p, Shape::closed, Data::points);
  for (const V& from : {V{3, 0, 1}, V{2.5, -0.01, 0}, V{0.3, 2, 0}, V{-1, -2, -1}, V{0.1, 0.1, 4}}) {
    const double u = c.nearest(from);
    EXPECT_NEAR(dot(c.at(u) - from, c.at(u, 1)), 0, 1e-11);
    for (int i = 0; i < 500; ++i) EXPECT_GE(norm(c.at(-1 + i / 250.0) - from), norm(c.at(u) - from) - 1e-12);
  }
  EXPECT_NEAR(c.difference(0.95, -0.95), -0.1, 1e-14);
}

std::vector<double> changes(const ParametricCurve& c, int derivative, double from, double to) {
  const auto at = [&](double u) {
    SwitchList list;
    c.switches(u, derivative, list);
    return list;
  };
  return expression_test::sign_changes(at, from, to);
}

TEST(ParametricCurve, switches_at_corners_and_ends) {
  const auto expect = [](const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-12);
  };
  const Points open = scattered(5);
  Points closed = scattered(4);
  closed.back() = closed.front();
  expect(changes(ParametricCurve(open, Shape::open, Data::points, 4), 0, -1.5, 1.5), {-1, 1});
  expect(changes(ParametricCurve(open, Shape::open, Data::points, 4), 1, -1.5, 1.5), {-1, 1});
  expect(changes(ParametricCurve(open, Shape::open, Data::points, 2), 0, -1.5, 1.5), {-0.5, 0, 0.5});
  // Three corners a turn, at −1 + 2 k / 3.
  expect(changes(ParametricCurve(closed, Shape::closed, Data::points, 2), 0, -1.5, 3.5),
         {-1, -1.0 / 3, 1.0 / 3, 1, 5.0 / 3, 7.0 / 3, 3});
  expect(changes(ParametricCurve(closed, Shape::closed, Data::points, 2), 1, -1.2, 0.9), {-1, -1.0 / 3, 1.0 / 3});
}

}  // namespace
}  // namespace dynalin::parametric_curve_test
