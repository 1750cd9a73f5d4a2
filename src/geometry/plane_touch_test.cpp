#include "geometry/plane_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace dynalin::plane_touch_test {
namespace {

using Points = ParametricCurve::Points;

PlaneCurve spline(const Points& points, bool closed = false) {
  using Shape = ParametricCurve::Shape;
  return PlaneCurve::of(std::make_shared<const ParametricCurve>(points, closed ? Shape::closed : Shape::open,
                                                                ParametricCurve::Data::points));
}
// y = f(x) for a cubic f from x = 1 to −1: matter below.
template <class F>
PlaneCurve graph(const F& f, int points = 4) {
  Points p;
  for (int k = 0; k < points; ++k) {
    const double x = 1 - 2.0 * k / (points - 1);
    p.push_back({x, f(x), 0});
  }
  return spline(p);
}
// Nearly an ellipse.
PlaneCurve egg(double a, double b) {
  Points p;
  for (int k = 0; k <= 12; ++k) {
    const double t = 2 * std::numbers::pi * (k % 12) / 12;
    p.push_back({a * std::cos(t) + 0.1 * a * std::sin(t) * std::sin(t), b * std::sin(t), 0});
  }
  return spline(p, true);
}
PlaneCurve circle(double r) { return PlaneCurve::circle(r, 2 * std::numbers::pi); }
PlaneCurve box(double x, double y) {
  return PlaneCurve::polygon({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}, {-x, -y, 0}});
}
// From the right to the left, matter below.
PlaneCurve floor_at(double y) { return PlaneCurve::polygon({{5, y, 0}, {-5, y, 0}}); }

RelativeFrame<double> turned(double x, double y, double angle, const Vector& tilt = {}) {
  const Matrix3 R = rotation_exponential(tilt) * rotation_exponential({0, 0, angle});
  return {{x, y, 0}, R.x, R.y, R.z};
}
using Touches = std::vector<Touch<double>>;
Touches touches(const PlaneCurve& I, const RelativeFrame<double>& f, const PlaneCurve& J, bool I_reversed = false,
                bool J_reversed = false) {
  Touches list(most_plane_touches);
  touch_curves<double>(I, I_reversed, f, J, J_reversed, list);
  return list;
}
Touches closed(Touches list) {
  std::erase_if(list, [](const Touch<double>& t) { return !t.closed(); });
  return list;
}

TEST(plane_touch, of_circles_is_on_the_line_of_their_centres) {
  const auto list = closed(touches(circle(0.5), turned(0.6, 0.8, 1.3), circle(0.6)));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_NEAR(list[0].gap, 1 - 1.1, 1e-14);
  EXPECT_NEAR(list[0].normal.x, 0.6, 1e-14);
  EXPECT_NEAR(list[0].normal.y, 0.8, 1e-14);
  EXPECT_NEAR(list[0].point.x, 0.6 * 0.55, 1e-14);
}

TEST(plane_touch, of_a_circle_in_a_bore_is_on_the_far_side) {
  for (const bool cavity_is_I : {false, true}) {
    const auto list = cavity_is_I ? closed(touches(circle(0.3), turned(0.15, 0.2, 0), circle(0.5), false, true))
                                  : closed(touches(circle(0.5), turned(-0.15, -0.2, 0), circle(0.3), true, false));
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NEAR(list[0].gap, 0.5 - 0.3 - 0.25, 1e-14);
    EXPECT_NEAR(list[0].normal.x, cavity_is_I ? -0.6 : 0.6, 1e-13);
  }
}

TEST(plane_touch, has_no_place_where_circles_have_one_centre) {
  const auto tight = closed(touches(circle(0.52), turned(0, 0, 0), circle(0.5), false, true));
  ASSERT_FALSE(tight.empty());
  EXPECT_FALSE(tight[0].defined);
  EXPECT_TRUE(closed(touches(circle(0.48), turned(0, 0, 0), circle(0.5), false, true)).empty());
}

// The centre is √(x² + y²) from the nearest point of a parabola; found here by halving intervals.
TEST(plane_touch, of_a_wheel_on_a_curve_is_the_foot_of_its_centre) {
  const auto f = [](double x) { return 0.2 * x * x - 0.1 * x * x * x; };
  const auto df = [](double x) { return 0.4 * x - 0.3 * x * x; };
  const PlaneCurve rail = graph(f), wheel = circle(0.5);
  for (const double at : {-0.4, 0.05, 0.3}) {
    const Vector centre{at, f(at) + 0.48, 0};
    double low = -1, high = 1;
    for (int k = 0; k < 200; ++k) {
      const double x = 0.5 * (low + high);
      (x - centre.x + (f(x) - centre.y) * df(x) > 0 ? high : low) = x;
    }
    const Vector foot{low, f(low), 0}, d = centre - foot;
    const auto list = closed(touches(wheel, turned(centre.x, centre.y, 0.7), rail));
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NEAR(list[0].gap, norm(d) - 0.5, 1e-13);
    EXPECT_LT(norm(list[0].normal - d / norm(d)), 1e-12);
    EXPECT_LT(norm(list[0].point - (foot + 0.5 * list[0].gap * list[0].normal)), 1e-12);
  }
}

TEST(plane_touch, of_a_wheel_between_two_hills_are_two) {
  const PlaneCurve valley = graph([](double x) { return 0.8 * x * x; });
  const auto list = closed(touches(circle(0.8), turned(0, 0.81, 0), valley));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_NEAR(list[0].gap, list[1].gap, 1e-13);
  EXPECT_NEAR(list[0].normal.x + list[1].normal.x, 0, 1e-12);
  // The foot (x, a x²) of (0, h): 1 + 2 a (a x² − h) = 0.
  const double square = (0.81 - 1 / 1.6) / 0.8;
  EXPECT_NEAR(list[0].gap, std::hypot(std::sqrt(square), 0.81 - 0.8 * square) - 0.8, 1e-12);
}

// Bumps that are much narrower than what the wheel's own course resolves.
TEST(plane_touch, finds_bumps_that_are_small_beside_the_wheel) {
  Points p;
  for (int k = 0; k <= 200; ++k) {
    const double x = 2 - 4.0 * k / 200;
    p.push_back({x, 0.001 * std::cos(100 * x), 0});
  }
  const auto list = closed(touches(circle(50), turned(0, 50 + 0.001 - 1e-6, 0), spline(p)));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_NEAR(list[0].gap, -1e-6, 1e-9);
}

TEST(plane_touch, of_an_edge_on_a_floor_is_both_corners) {
  const auto list = closed(touches(box(0.4, 0.3), turned(0.2, 0.29, 0), floor_at(0)));
  ASSERT_EQ(list.size(), 2u);
  for (const auto& t : list) {
    EXPECT_NEAR(t.gap, -0.01, 1e-15);
    EXPECT_NEAR(t.normal.y, 1, 1e-15);
    EXPECT_NEAR(std::abs(t.point.x - 0.2), 0.4, 1e-15);
  }
  EXPECT_EQ(closed(touches(floor_at(0), turned(-0.2, -0.29, 0), box(0.4, 0.3))).size(), 2u);
  EXPECT_EQ(closed(touches(box(0.4, 0.3), turned(0.2, 0.29, 0.2), floor_at(0))).size(), 1u);
}

// A wheel that rolls off a box: one place all the way, whose gap and direction never jump.
TEST(plane_touch, goes_on_smoothly_from_an_edge_round_its_corner) {
  double last_gap = 0;
  Vector last{0, 1, 0};
  for (int k = 0; k <= 400; ++k) {
    const double x = 0.3 + 0.0005 * k;
    const auto list = closed(touches(circle(0.5), turned(x, 0.79, 0), box(0.4, 0.3)));
    ASSERT_LE(list.size(), 1u) << x;
    const double gap = x <= 0.4 ? -0.01 : std::hypot(x - 0.4, 0.49) - 0.5;
    if (list.empty()) {
      EXPECT_GT(gap, -1e-12);
      continue;
    }
    EXPECT_NEAR(list[0].gap, gap, 1e-12) << x;
    if (k > 0) {
      EXPECT_LT(norm(list[0].normal - last), 2e-3);
      EXPECT_NEAR(list[0].gap, last_gap, 2e-3);
    }
    last = list[0].normal, last_gap = list[0].gap;
  }
}

TEST(plane_touch, of_a_notch_holds_a_corner) {
  // A V in the floor: matter below.
  const PlaneCurve notch = PlaneCurve::polygon({{1, 1, 0}, {0, 0, 0}, {-1, 1, 0}});
  const auto ball = closed(touches(circle(0.2), turned(0, 0.2 * std::sqrt(2.0) - 0.01, 0), notch));
  ASSERT_EQ(ball.size(), 2u);
  EXPECT_NEAR(ball[0].gap, -0.01 / std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(std::abs(ball[0].normal.x), std::sqrt(0.5), 1e-14);
}

TEST(plane_touch, ends_where_an_open_curve_ends) {
  const PlaneCurve track = PlaneCurve::polygon({{1, 0, 0}, {-1, 0, 0}}), arc = PlaneCurve::circle(1, std::numbers::pi);
  const auto inside = [](const Touches& list) { return list[0].inside; };
  EXPECT_NEAR(inside(touches(circle(0.5), turned(0.8, 0.49, 0), track)), 0.2, 1e-14);
  EXPECT_NEAR(inside(touches(circle(0.5), turned(1.1, 0.49, 0), track)), -0.1, 1e-14);
  EXPECT_TRUE(closed(touches(circle(0.5), turned(1.1, 0.49, 0), track)).empty());
  EXPECT_NEAR(inside(touches(circle(0.5), turned(0, 1.49, 0), arc)), std::numbers::pi / 2, 1e-13);
  EXPECT_NEAR(inside(touches(circle(0.5), turned(1.49 * std::cos(0.1), -1.49 * std::sin(0.1), 0), arc)), -0.1, 1e-13);
}

TEST(plane_touch, does_not_reach_through_a_body) {
  for (const double height : {0.75, 0.79, 0.81}) {
    const auto list = closed(touches(circle(0.5), turned(0.1, height, 0), box(0.4, 0.3)));
    EXPECT_EQ(list.size(), height < 0.8 ? 1u : 0u) << height;
  }
}

TEST(plane_touch, says_where_curves_are_too_deep_in_each_other) {
  const auto deep = closed(touches(circle(0.5), turned(0.2, 0, 0), circle(0.6)));
  ASSERT_FALSE(deep.empty());
  EXPECT_FALSE(deep[0].defined);
}

// Half-way between two sides no direction is the one.
TEST(plane_touch, has_no_place_where_two_edges_are_as_near) {
  const PlaneCurve square = box(0.4, 0.4);
  EXPECT_FALSE(touch_point<double>({0.35, 0.35, 0}, square, false).defined);
  EXPECT_TRUE(touch_point<double>({0.35, 0.351, 0}, square, false).defined);
  EXPECT_TRUE(touch_point<double>({0.45, 0.45, 0}, square, false).defined);
  const auto tips = closed(touches(square, turned(0.78, 0.78, 0), square));
  ASSERT_FALSE(tips.empty());
  EXPECT_FALSE(tips[0].defined);
}

TEST(plane_touch, of_a_point_is_the_nearest_place) {
  const PlaneCurve square = box(0.4, 0.3);
  const auto at = [&](double x, double y, bool reversed = false) {
    return touch_point<double>({x, y, 0.7}, square, reversed);
  };
  EXPECT_NEAR(at(0.1, 0.29).gap, -0.01, 1e-15);
  EXPECT_NEAR(at(0.1, 0.29, true).gap, 0.01, 1e-15);
  EXPECT_NEAR(at(0.7, 0.7).gap, 0.5, 1e-15);
  EXPECT_NEAR(at(0.7, 0.7).normal.x, 0.6, 1e-15);
  EXPECT_NEAR(at(0.1, 0.29).point.z, 0.7, 0);
  EXPECT_FALSE(touch_point<double>({0, 0, 0}, circle(1), false).defined);
}

// --- any two curves anywhere

struct Pair {
  std::string name;
  PlaneCurve I, J;
  bool J_reversed = false;
};
std::vector<Pair> pairs() {
  const PlaneCurve rail = graph([](double x) { return 0.2 * x * x - 0.3 * x * x * x; }, 7);
  return {{"circles", circle(0.3), circle(0.5)},
          {"eggs", egg(0.3, 0.4), egg(0.5, 0.6)},
          {"egg on rail", egg(0.3, 0.4), rail},
          {"rail on egg", rail, egg(0.3, 0.4)},
          {"arc on rail", PlaneCurve::circle(0.4, -5), rail},
          {"box on rail", box(0.3, 0.2), rail},
          {"rail on box", rail, box(0.3, 0.2)},
          {"egg on box", egg(0.3, 0.2), box(0.5, 0.4)},
          {"boxes", box(0.3, 0.2), box(0.5, 0.4)},
          {"circle in egg", circle(0.3), egg(0.7, 0.8), true},
          {"box in egg", box(0.3, 0.2), egg(0.7, 0.8), true}};
}

// From a curve to a point, by many points of it.
double away(const PlaneCurve& c, const Vector& p) {
  double least = 1e300;
  for (const auto& piece : c.pieces()) {
    const double from = piece.from - (piece.start_free ? 9 : 0), to = piece.to + (piece.end_free ? 9 : 0);
    Vector before = c.at(piece, from);
    for (int k = 1; k <= 4000; ++k) {
      const Vector here = c.at(piece, from + (to - from) * k / 4000), along = here - before;
      const double share = std::clamp(dot(p - before, along) / dot(along, along), 0.0, 1.0);
      least = std::min(least, norm(p - before - share * along));
      before = here;
    }
  }
  return least;
}

class PlaneTouches : public ::testing::TestWithParam<Pair> {
 protected:
  // Not deep in each other: there no place need be the deepest.
  RelativeFrame<double> pose(double tilt) {
    for (;;) {
      const auto f = drawn(tilt);
      const auto list = touches(GetParam().I, f, GetParam().J, false, GetParam().J_reversed);
      if (list[0].gap > -0.08) return f;
    }
  }
  RelativeFrame<double> drawn(double tilt) {
    std::normal_distribution<double> n;
    return turned(0.6 * n(random_), 0.6 * n(random_), 3 * n(random_), {tilt * n(random_), tilt * n(random_), 0});
  }
  static std::vector<Touch<Dual<12>>> seeded(const Pair& pair, const RelativeFrame<double>& f) {
    const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
    const auto s = path::seeded<12>({along(f.p), along(f.x), along(f.y), along(f.z)});
    const auto values = [](const auto& v) { return Vec3<Dual<12>>{v.x.value, v.y.value, v.z.value}; };
    std::vector<Touch<Dual<12>>> list(most_plane_touches);
    touch_curves<Dual<12>>(pair.I, false, {values(s.p), values(s.x), values(s.y), values(s.z)}, pair.J, pair.J_reversed,
                           list);
    return list;
  }
  std::mt19937_64 random_{11};
};

TEST_P(PlaneTouches, lie_half_way_between_both_curves) {
  const Pair& pair = GetParam();
  int seen = 0, lost = 0;
  for (int k = 0; k < 100; ++k) {
    const auto f = pose(0);
    for (const Touch<double>& t : closed(touches(pair.I, f, pair.J, false, pair.J_reversed))) {
      // Ends of open curves that stand in each other have none.
      if (!t.defined && pair.name == "arc on rail" && ++lost < 5) continue;
      ASSERT_TRUE(t.defined);
      ++seen;
      EXPECT_NEAR(norm(t.normal), 1, 1e-12);
      const Vector on_I = t.point + 0.5 * t.gap * t.normal - f.p, on_J = t.point - 0.5 * t.gap * t.normal;
      EXPECT_LT(away(pair.I, {dot(f.x, on_I), dot(f.y, on_I), 0}), 1e-5);
      EXPECT_LT(away(pair.J, on_J), 1e-5);
    }
  }
  EXPECT_GE(seen, 5);
}

// With planes that incline, too.
TEST_P(PlaneTouches, have_the_gap_that_grows_along_the_normal) {
  const Pair& pair = GetParam();
  for (int k = 0; k < 100; ++k) {
    const auto f = pose(0.2);
    for (const Touch<Dual<12>>& t : seeded(pair, f)) {
      if (!t.closed() || !t.defined) continue;
      const auto plain = [](const Vec3<Dual<12>>& v) { return Vector{v.x.value, v.y.value, v.z.value}; };
      const Vector n = plain(t.normal), turn = cross(plain(t.point) - f.p, n);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(t.gap.partial[c], n[c], 1e-9);
        EXPECT_NEAR(t.gap.partial[3 + c], turn[c], 1e-9);
      }
    }
  }
}

TEST_P(PlaneTouches, have_the_derivatives_of_differences) {
  const Pair& pair = GetParam();
  constexpr double h = 1e-5;
  int compared = 0;
  for (int k = 0; k < 100; ++k) {
    const auto f = pose(0.2);
    const auto exact = seeded(pair, f);
    for (std::size_t c = 0; c < 6; ++c) {
      const auto moved = [&](double by) {
        if (c < 3) {
          RelativeFrame<double> g = f;
          g.p[c] += by;
          return touches(pair.I, g, pair.J, false, pair.J_reversed);
        }
        const Matrix3 turn = rotation_exponential(by * unit_vectors[c - 3]);
        return touches(pair.I, {f.p, turn * f.x, turn * f.y, turn * f.z}, pair.J, false, pair.J_reversed);
      };
      const auto far = moved(h), near = moved(-h), wide = moved(2 * h), back = moved(-2 * h);
      for (std::size_t t = 0; t < exact.size() && exact[t].closed(); ++t) {
        if (!exact[t].defined) continue;
        for (std::size_t x = 0; x < 3; ++x) {
          const auto check = [&](Vec3<double> Touch<double>::*of, const Dual<12>& d) {
            const double two = (far[t].*of)[x] - (near[t].*of)[x], four = (wide[t].*of)[x] - (back[t].*of)[x];
            // A step to another place, or across a knot, where the third derivative jumps.
            if (std::abs(four - 2 * two) > 1e-5 * h * (1 + std::abs(d.partial[c]))) return;
            ++compared;
            EXPECT_NEAR(d.partial[c], (8 * two - four) / (12 * h), 1e-5 * (1 + std::abs(d.partial[c])));
          };
          check(&Touch<double>::normal, exact[t].normal[x]), check(&Touch<double>::point, exact[t].point[x]);
        }
      }
    }
  }
  EXPECT_GT(compared, 200);
}

TEST_P(PlaneTouches, are_the_same_from_the_other_side) {
  const Pair& pair = GetParam();
  for (int k = 0; k < 100; ++k) {
    const auto f = pose(0);
    const auto from = [&](const Vector& v) { return Vector{dot(f.x, v), dot(f.y, v), dot(f.z, v)}; };
    const RelativeFrame<double> back{-from(f.p), {f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}};
    const auto there = closed(touches(pair.I, f, pair.J, false, pair.J_reversed));
    const auto here = closed(touches(pair.J, back, pair.I, pair.J_reversed, false));
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t t = 0; t < there.size(); ++t) {
      if (!there[t].defined && !here[t].defined) continue;
      EXPECT_NEAR(there[t].gap, here[t].gap, 1e-9);
      EXPECT_LT(norm(from(there[t].normal) + here[t].normal), 1e-6);
      EXPECT_LT(norm(from(there[t].point - f.p) - here[t].point), 1e-6);
    }
  }
}

void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.name; }
std::string test_name(const ::testing::TestParamInfo<Pair>& info) {
  std::string name = info.param.name;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}
INSTANTIATE_TEST_SUITE_P(pairs, PlaneTouches, ::testing::ValuesIn(pairs()), test_name);

}  // namespace
}  // namespace dynalin::plane_touch_test
