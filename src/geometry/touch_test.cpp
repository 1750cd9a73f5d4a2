#include "geometry/touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "geometry/moved_frame_test_support.h"

namespace dynalin::touch_test {
namespace {

using namespace solid;

struct Pair {
  std::string name;
  Side I, J;
};

const Side ball{Ball{0.3}}, point{Ball{0.0}};
const Side ellipsoid{Ellipsoid{{0.3, 0.5, 0.4}}}, frustum{Frustum{-0.4, 0.5, 0.7, 0.2}};
const Side cylinder{Frustum{-0.6, 0.4, 0.5, 0.4}}, cone{Frustum{0.0, 0.6, 0.8, 0.0}}, torus{Torus{0.6, 0.2}};
const Side box{Box{{-0.3, -0.2, 0.0}, {0.4, 0.5, 0.6}}}, plane{Plane{-1e3, 1e3, -1e3, 1e3}};

Side reversed(Side s) {
  s.reversed = true;
  return s;
}

std::vector<Pair> pairs() {
  std::vector<Pair> list;
  for (const auto& [name, a] : {std::pair<std::string, Side>{"ball", ball}, {"point", point}}) {
    for (const auto& [other, b] : {std::pair<std::string, Side>{"ball", ball},
                                   {"ellipsoid", ellipsoid},
                                   {"frustum", frustum},
                                   {"cylinder", cylinder},
                                   {"cone", cone},
                                   {"torus", torus},
                                   {"box", box},
                                   {"plane", plane}}) {
      list.push_back({name + " and " + other, a, b});
      list.push_back({name + " in " + other, a, reversed(b)});
    }
  }
  for (const auto& [name, a] : {std::pair<std::string, Side>{"ellipsoid", ellipsoid},
                                {"frustum", frustum},
                                {"cone", cone},
                                {"torus", torus},
                                {"box", box}}) {
    list.push_back({name + " on plane", a, plane});
    list.push_back({name + " under plane", a, reversed(plane)});
  }
  list.push_back({"ellipsoids", ellipsoid, {Ellipsoid{{0.6, 0.25, 0.35}}}});
  for (const auto& [name, b] : {std::pair<std::string, Side>{"ellipsoid", ellipsoid},
                                {"frustum", frustum},
                                {"cone", cone},
                                {"box", box},
                                {"torus", {Torus{0.5, 0.1}}}}) {
    list.push_back({"torus and " + name, torus, b});
    if (name != "ellipsoid" && name != "torus") list.push_back({"ellipsoid and " + name, ellipsoid, b});
  }
  const Side hall{Box{{-2, -2.5, -2}, {2.2, 2, 3}}, true}, silo{Frustum{-2, 2.2, 3, 1.6}, true};
  for (const auto& [name, a] : {std::pair<std::string, Side>{"ellipsoid", ellipsoid},
                                {"frustum", frustum},
                                {"cone", cone},
                                {"torus", torus},
                                {"box", box}}) {
    list.push_back({name + " in hall", a, hall});
    list.push_back({name + " in silo", a, silo});
    if (name == "ellipsoid") continue;
    list.push_back({name + " in dome", a, {Ball{2.5}, true}});
    list.push_back({name + " in egg", a, {Ellipsoid{{2.5, 3, 2.2}}, true}});
  }
  return list;
}

// Zero on the surface: an equation of each shape that shares nothing with the formulas of contact.
double implicit(const Side& s, const Vector& p) {
  struct {
    Vector p;
    double operator()(const Ball& b) const { return norm(p) - b.radius; }
    double operator()(const Ellipsoid& e) const {
      return std::hypot(p.x / e.semi_axes.x, p.y / e.semi_axes.y, p.z / e.semi_axes.z) - 1;
    }
    double operator()(const Frustum& f) const {
      const double slope = (f.high_radius - f.low_radius) / (f.high - f.low);
      const double beyond = std::hypot(p.x, p.y) - (f.low_radius + slope * (p.z - f.low));
      return std::max({beyond, p.z - f.high, f.low - p.z});
    }
    double operator()(const Torus& t) const { return std::hypot(std::hypot(p.x, p.y) - t.major, p.z) - t.minor; }
    double operator()(const Box& b) const {
      return std::max({p.x - b.high.x, b.low.x - p.x, p.y - b.high.y, b.low.y - p.y, p.z - b.high.z, b.low.z - p.z});
    }
    double operator()(const Plane&) const { return p.z; }
    // Theirs are in facet_touch_test.cpp, and no solid.
    double operator()(const Polyhedron&) const { return std::numeric_limits<double>::quiet_NaN(); }
    double operator()(const Profile&) const { return std::numeric_limits<double>::quiet_NaN(); }
  } at{p};
  return std::visit(at, s.shape);
}

void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.name; }

class Touches : public ::testing::TestWithParam<Pair> {
 protected:
  static constexpr int draws = 60;

  static bool may_be_too_deep() {
    const std::string& name = GetParam().name;
    return name == "ellipsoids" || name.starts_with("ellipsoid and") || name.starts_with("torus and");
  }
  // Where one reaches the medial surface of the other, no place is nearer than another.
  static bool too_deep(double gap, bool defined) {
    if (!defined) {
      EXPECT_TRUE(may_be_too_deep() && gap < -0.2) << GetParam().name << ' ' << gap;
    }
    return !defined;
  }

  RelativeFrame<double> pose() {
    std::normal_distribution<double> n;
    const Matrix3 R = rotation_exponential({n(random_), n(random_), n(random_)});
    // Deep in each other two bodies have several common normals.
    const double far = may_be_too_deep() ? 1.5 : 0.5;
    return {{far * n(random_), far * n(random_), far * n(random_)}, R.x, R.y, R.z};
  }
  static std::vector<Touch<double>> touches(const Side& I, const Side& J, const RelativeFrame<double>& f) {
    std::vector<Touch<double>> list(touch_count(I, J));
    find_touches<double>(I, J, f, list);
    return list;
  }
  static std::vector<Touch<Dual<12>>> seeded(const Side& I, const Side& J, const RelativeFrame<double>& f) {
    const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
    const auto s = path::seeded<12>({along(f.p), along(f.x), along(f.y), along(f.z)});
    const auto values = [](const auto& v) { return Vec3<Dual<12>>{v.x.value, v.y.value, v.z.value}; };
    std::vector<Touch<Dual<12>>> list(touch_count(I, J));
    find_touches<Dual<12>>(I, J, {values(s.p), values(s.x), values(s.y), values(s.z)}, list);
    return list;
  }

  std::mt19937_64 random_{7};
};

// Half a gap along the normal from the point of contact are both surfaces.
TEST_P(Touches, lie_half_way_between_both_surfaces) {
  const auto& [name, I, J] = GetParam();
  for (int k = 0; k < draws; ++k) {
    const auto f = pose();
    const auto list = touches(I, J, f);
    const auto nearest =
        std::min_element(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
    for (const Touch<double>& t : list) {
      if (too_deep(t.gap, t.defined)) continue;
      EXPECT_NEAR(norm(t.normal), 1, 1e-12);
      const Vector on_I = t.point + 0.5 * t.gap * t.normal, on_J = t.point - 0.5 * t.gap * t.normal;
      const Vector arm = on_I - f.p;
      EXPECT_NEAR(implicit(I, {dot(f.x, arm), dot(f.y, arm), dot(f.z, arm)}), 0, 1e-9) << name;
      // Each face of a cavity goes on beyond its edges, where no ball that is in it comes.
      if (list.size() > 1 && J.reversed && !std::holds_alternative<Plane>(J.shape)) {
        if (&t != &*nearest || implicit(J, f.p) >= 0) continue;
      }
      EXPECT_NEAR(implicit(J, on_J), 0, 1e-9) << name;
    }
  }
}

// The gap grows by the motion of I's surface along the normal: the normal is that of both surfaces.
TEST_P(Touches, have_the_gap_that_grows_along_the_normal) {
  const auto& [name, I, J] = GetParam();
  for (int k = 0; k < draws; ++k) {
    const auto f = pose();
    for (const Touch<Dual<12>>& t : seeded(I, J, f)) {
      if (too_deep(t.gap.value, t.defined)) continue;
      const auto plain = [](const Vec3<Dual<12>>& v) { return Vector{v.x.value, v.y.value, v.z.value}; };
      const Vector n = plain(t.normal), turn = cross(plain(t.point) - f.p, n);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(t.gap.partial[c], n[c], 1e-9) << name;
        EXPECT_NEAR(t.gap.partial[3 + c], turn[c], 1e-9) << name;
        EXPECT_EQ(t.gap.partial[6 + c], 0) << name;
      }
    }
  }
}

TEST_P(Touches, have_the_derivatives_of_differences) {
  const auto& [name, I, J] = GetParam();
  constexpr double h = 1e-5;
  for (int k = 0; k < draws; ++k) {
    const auto f = pose();
    const auto exact = seeded(I, J, f);
    for (std::size_t c = 0; c < 6; ++c) {
      const auto far = touches(I, J, moved(f, c, h)), near = touches(I, J, moved(f, c, -h));
      const auto wide = touches(I, J, moved(f, c, 2 * h)), back = touches(I, J, moved(f, c, -2 * h));
      for (std::size_t t = 0; t < exact.size(); ++t) {
        if (too_deep(exact[t].gap.value, exact[t].defined)) continue;
        for (std::size_t x = 0; x < 3; ++x) {
          const auto check = [&](Vec3<double> Touch<double>::*of, const Dual<12>& d) {
            const double two = (far[t].*of)[x] - (near[t].*of)[x], four = (wide[t].*of)[x] - (back[t].*of)[x];
            // A step across an edge has no derivative.
            if (std::abs(four - 2 * two) > 1e-6 * h) return;
            EXPECT_NEAR(d.partial[c], (8 * two - four) / (12 * h), 1e-6 * (1 + std::abs(d.partial[c])))
                << GetParam().name;
          };
          check(&Touch<double>::normal, exact[t].normal[x]), check(&Touch<double>::point, exact[t].point[x]);
        }
      }
    }
  }
}

TEST_P(Touches, are_the_same_from_the_other_side) {
  const auto& [name, I, J] = GetParam();
  for (int k = 0; k < draws; ++k) {
    const auto f = pose();
    const auto from = [&](const Vector& v) { return Vector{dot(f.x, v), dot(f.y, v), dot(f.z, v)}; };
    const RelativeFrame<double> back{-from(f.p), {f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}};
    const auto there = touches(I, J, f), here = touches(J, I, back);
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t t = 0; t < there.size(); ++t) {
      if (too_deep(there[t].gap, there[t].defined)) continue;
      EXPECT_NEAR(there[t].gap, here[t].gap, 1e-9) << name;
      EXPECT_LT(norm(from(there[t].normal) + here[t].normal), 1e-6) << name;
      EXPECT_LT(norm(from(there[t].point - f.p) - here[t].point), 1e-6) << name;
    }
  }
}

// All that a convex shape reaches to, or nearly.
std::vector<Vector> outermost_points(const Side& s) {
  std::vector<Vector> list;
  constexpr int n = 60;
  for (int k = 0; k < n; ++k) {
    const double a = 2 * M_PI * k / n;
    if (const auto* f = std::get_if<Frustum>(&s.shape)) {
      list.push_back({f->low_radius * std::cos(a), f->low_radius * std::sin(a), f->low});
      list.push_back({f->high_radius * std::cos(a), f->high_radius * std::sin(a), f->high});
    } else if (const auto* b = std::get_if<Box>(&s.shape)) {
      list.push_back({k & 1 ? b->high.x : b->low.x, k & 2 ? b->high.y : b->low.y, k & 4 ? b->high.z : b->low.z});
    } else {
      const auto* round = std::get_if<Ball>(&s.shape);
      const auto* tube = std::get_if<Torus>(&s.shape);
      const Vector size = round  ? Vector{round->radius, round->radius, round->radius}
                          : tube ? Vector{}
                                 : std::get<Ellipsoid>(s.shape).semi_axes;
      for (int i = 0; i < n; ++i) {
        const double b2 = 2 * M_PI * i / n;
        if (tube) {
          const double r = tube->major + tube->minor * std::cos(b2);
          list.push_back({r * std::cos(a), r * std::sin(a), tube->minor * std::sin(b2)});
        } else {
          const Vector u{std::cos(a) * std::sin(b2 / 2), std::sin(a) * std::sin(b2 / 2), std::cos(b2 / 2)};
          list.push_back({size.x * u.x, size.y * u.y, size.z * u.z});
        }
      }
    }
  }
  return list;
}

// Nothing of either side comes nearer: between convex shapes that are apart lie two planes across the normal, and a
// shape in a cavity lies behind the one at its deepest place.
TEST_P(Touches, are_where_the_sides_are_nearest) {
  const auto& [name, I, J] = GetParam();
  const bool convex = name.find("torus") == std::string::npos || (J.reversed && name.starts_with("torus"));
  if (!convex || std::holds_alternative<Plane>(J.shape)) return;
  int seen = 0;
  for (int k = 0; k < draws; ++k) {
    const auto f = pose();
    const auto list = touches(I, J, f);
    const auto t =
        std::min_element(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
    if (!t->defined || (!J.reversed && t->gap <= 0)) continue;
    ++seen;
    const Vector on_I = t->point + 0.5 * t->gap * t->normal, on_J = t->point - 0.5 * t->gap * t->normal;
    for (const Vector& p : outermost_points(I))
      EXPECT_GE(dot(t->normal, f.p + f.x * p.x + f.y * p.y + f.z * p.z - on_I), -1e-9) << name;
    if (J.reversed) continue;
    for (const Vector& p : outermost_points(J)) EXPECT_LE(dot(t->normal, p - on_J), 1e-9) << name;
  }
  EXPECT_GT(seen, 5) << name;
}

// A torus is nowhere nearer than its place of contact, as balls along its circle tell.
TEST_P(Touches, of_a_torus_are_those_of_its_nearest_ball) {
  const auto& [name, I, J] = GetParam();
  const auto* t = std::get_if<Torus>(&I.shape);
  if (!t || std::holds_alternative<Plane>(J.shape)) return;
  for (int k = 0; k < draws; ++k) {
    const auto f = pose();
    const auto found = touches(I, J, f);
    std::vector<double> least(found.size(), std::numeric_limits<double>::infinity());
    for (int i = 0; i < 2000; ++i) {
      const double a = 2 * M_PI * i / 2000;
      const Vector at = f.p + t->major * (std::cos(a) * f.x + std::sin(a) * f.y);
      const auto of_ball = touches({Ball{t->minor}}, J, {at, f.x, f.y, f.z});
      for (std::size_t w = 0; w < least.size(); ++w) least[w] = std::min(least[w], of_ball[w].gap);
    }
    for (std::size_t w = 0; w < least.size(); ++w) {
      if (!found[w].defined) continue;
      EXPECT_LE(found[w].gap, least[w] + 1e-12) << name;
      EXPECT_GE(found[w].gap, least[w] - 1e-4) << name;
    }
  }
}

std::string test_name(const ::testing::TestParamInfo<Pair>& info) {
  std::string name = info.param.name;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}
INSTANTIATE_TEST_SUITE_P(pairs, Touches, ::testing::ValuesIn(pairs()), test_name);

TEST(touch, of_a_plane_ends_at_its_edge) {
  std::array<Touch<double>, 1> t;
  const Side patch{Plane{-1, 2, -3, 4}};
  const auto at = [&](double x, double y) {
    find_touches<double>(ball, patch, {{x, y, 0.2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, t);
    return t[0].inside;
  };
  EXPECT_DOUBLE_EQ(at(0, 0), 1);
  EXPECT_DOUBLE_EQ(at(1.5, 0), 0.5);
  EXPECT_DOUBLE_EQ(at(2.5, 0), -0.5);
  EXPECT_DOUBLE_EQ(at(0, -2.75), 0.25);
  EXPECT_DOUBLE_EQ(at(0, 4.5), -0.5);
  EXPECT_FALSE(t[0].closed());
}

TEST(touch, has_no_place_where_a_circle_is_as_near) {
  const RelativeFrame<double> on_axis{{0, 0, 0.1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::array<Touch<double>, 3> in_cone;
  find_touches<double>(ball, reversed(cone), on_axis, in_cone);
  EXPECT_FALSE(in_cone[0].defined);
  EXPECT_TRUE(in_cone[1].defined);
}

// Of equal axes none is the shortest, and where one coordinate is zero another one leads to the surface.
TEST(touch, of_a_spheroid_is_found_in_its_planes_of_symmetry) {
  std::array<Touch<double>, 1> t;
  for (const Vector& axes : {Vector{0.2, 0.2, 0.3}, {0.3, 0.2, 0.2}, {0.2, 0.2, 0.2}, {0.2, 0.3, 0.2}}) {
    for (const Vector& at : {Vector{0, 0.25, 0}, {0, 0.1, 0.3}, {0.3, 0, 0.1}, {0, 0, 0.4}, {0.4, 0, 0}}) {
      find_touches<double>(point, {Ellipsoid{axes}}, {at, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, t);
      ASSERT_TRUE(t[0].defined);
      EXPECT_NEAR(implicit({Ellipsoid{axes}}, at - t[0].gap * t[0].normal), 0, 1e-12);
      EXPECT_NEAR(norm(t[0].normal), 1, 1e-12);
    }
  }
}

TEST(touch, has_pairs_without_a_formula) {
  EXPECT_EQ(touch_count(reversed(torus), box), 0u);
  EXPECT_EQ(touch_count(ellipsoid, reversed(ball)), 0u);
  EXPECT_EQ(touch_count(cylinder, reversed(torus)), 0u);
  EXPECT_EQ(touch_count(plane, plane), 0u);
  EXPECT_EQ(touch_count(reversed(ball), plane), 0u);
  EXPECT_EQ(touch_count(reversed(ball), reversed(ball)), 0u);
  EXPECT_EQ(touch_count(reversed(ball), ball), 1u);
}

}  // namespace
}  // namespace dynalin::touch_test
