// All marker measures in all forms of their arguments, with their derivatives in time and their partials, against what
// their definitions say with 50 digits: components that an observer differentiates in its own axes, angular velocities
// read off R′Rᵀ. Markers are on bodies that turn and accelerate, some of them almost where an angle has no gradient.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <numbers>

#include "mechanics/binding_test_support.h"
#include "places/draws.h"
#include "precision/precise.h"

namespace dynalin::precision::measure_test {
namespace {

using mechanics_test::SmallSystem;

// A series in time up to t²/2, each coefficient with its part of first order in the size of a variation.
struct Series {
  struct Coefficient {
    Real value = 0, varied = 0;
  };
  std::array<Coefficient, 3> c{};

  Series() = default;
  Series(const Real& constant) { c[0].value = constant; }  // NOLINT
  Series(double constant) : Series(Real(constant)) {}      // NOLINT

  Series& operator+=(const Series& b) {
    for (std::size_t k = 0; k < 3; ++k) c[k].value += b.c[k].value, c[k].varied += b.c[k].varied;
    return *this;
  }
  Series& operator-=(const Series& b) { return *this += b * Series(-1.0); }
  friend Series operator+(Series a, const Series& b) { return a += b; }
  friend Series operator-(Series a, const Series& b) { return a -= b; }
  friend Series operator-(const Series& a) { return a * Series(-1.0); }
  friend Series operator*(const Series& a, const Series& b) {
    Series p;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t n = 0; n + k < 3; ++n) {
        p.c[k + n].value += a.c[k].value * b.c[n].value;
        p.c[k + n].varied += a.c[k].value * b.c[n].varied + a.c[k].varied * b.c[n].value;
      }
    }
    return p;
  }
  // d/dt; the last coefficient is not known any more.
  Series derivative() const {
    Series d;
    d.c[0] = c[1];
    d.c[1] = {2 * c[2].value, 2 * c[2].varied};
    return d;
  }
  // All but the value, of which the fourth power vanishes.
  Series rest() const {
    Series d = *this;
    d.c[0].value = 0;
    return d;
  }
};

Series sqrt(const Series& x) {
  const Real root = sqrt(x.c[0].value);
  const Series d = x.rest() * Series(1 / x.c[0].value);
  return Series(root) * (Series(1.0) + d * Series(0.5) - d * d * Series(0.125) + d * d * d * Series(0.0625));
}
Series inverse(const Series& x) {
  const Series d = x.rest() * Series(1 / x.c[0].value);
  return Series(1 / x.c[0].value) * (Series(1.0) - d + d * d - d * d * d);
}
Series atan2(const Series& y, const Series& x) {
  const Real x0 = x.c[0].value, y0 = y.c[0].value;
  const Series z = (y * Series(x0) - x * Series(y0)) * inverse(x * Series(x0) + y * Series(y0));
  return Series(Real(atan2(y0, x0))) + z - z * z * z * Series(Real(1) / 3);
}

using V = std::array<Series, 3>;
V operator+(const V& a, const V& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
V operator-(const V& a, const V& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
V operator*(const V& a, const Series& s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Series dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
V cross(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Series size(const V& v) { return sqrt(dot(v, v)); }
V derivative(const V& v) { return {v[0].derivative(), v[1].derivative(), v[2].derivative()}; }
V exact(const Vector& v) { return {Series(v.x), Series(v.y), Series(v.z)}; }

// x(t) = a + b t + c t²/2
V course(const Vector& a, const Vector& b, const Vector& c) {
  V v = exact(a);
  for (std::size_t k = 0; k < 3; ++k) v[k].c[1].value = b[k], v[k].c[2].value = Real(c[k]) / 2;
  return v;
}

struct Seen {
  V origin;
  std::array<V, 3> axes;

  V components(const V& v) const { return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)}; }
  V combined(const V& c) const { return axes[0] * c[0] + axes[1] * c[1] + axes[2] * c[2]; }
  // As an observer here sees it change.
  V rate(const V& v) const { return combined(derivative(components(v))); }
  V angular_velocity() const {
    const auto entry = [&](std::size_t r, std::size_t s) {  // of R′Rᵀ
      Series sum;
      for (const V& a : axes) sum += a[r].derivative() * a[s];
      return sum;
    };
    return {entry(2, 1), entry(0, 2), entry(1, 0)};
  }
};

// One coordinate of a body by size · t^level/level!.
struct Varied {
  std::int32_t body = -1;
  std::size_t coordinate = 0, level = 0;

  V along() const {
    V v{};
    v[coordinate % 3].c[level].varied = level == 2 ? 0.5 : 1.0;
    return v;
  }
};

class World {
 public:
  explicit World(unsigned seed) : system(seed) {
    // The markers of all bodies, fixed on them.
    for (const MarkerPlace*& place : system.p.layout.markers) {
      markers_.push_back(*place);
      markers_.back().shapes = nullptr;
      place = &markers_.back();
    }
  }

  const MarkerPlace& place(int m) const { return markers_[static_cast<std::size_t>(m)]; }
  BodyMotion& body(int m) { return system.p.motion.bodies[static_cast<std::size_t>(place(m).body.index)]; }

  Seen frame(int m, const Varied& by) const {
    const MarkerPlace& at = place(m);
    const BodyMotion& b = system.p.motion.body(at.body);
    V r = course(b.r, b.rdot, b.rddot);
    const V turn = course({}, b.w, b.wdot);
    std::array<V, 3> axes;
    for (std::size_t c = 0; c < 3; ++c) {
      const V a = exact(b.R[c]), across = cross(turn, a);
      axes[c] = a + across + cross(turn, across) * Series(0.5);
      if (by.body == at.body.index && by.coordinate >= 3) axes[c] = axes[c] + cross(by.along(), axes[c]);
    }
    if (by.body == at.body.index && by.coordinate < 3) r = r + by.along();
    const Seen on_body{r, axes};
    Seen seen{r + on_body.combined(exact(at.p_BM)), {}};
    for (std::size_t c = 0; c < 3; ++c) seen.axes[c] = on_body.combined(exact(at.R_BM[c]));
    return seen;
  }

  SmallSystem system;

 private:
  std::deque<MarkerPlace> markers_;
};

using Arguments = std::array<int, 4>;  // i, j, k, l

Series measure(const std::string& name, const World& world, const Arguments& of, const Varied& by) {
  const Seen i = world.frame(of[0], by), j = world.frame(of[1], by), k = world.frame(of[2], by),
             l = world.frame(of[3], by);
  const auto R = [&](std::size_t r, std::size_t c) { return dot(j.axes[r - 1], i.axes[c - 1]); };
  const V d = i.origin - j.origin, w = i.angular_velocity() - j.angular_velocity();
  const std::string family = name.substr(0, name.size() - 1);
  const auto shown = [&](const V& v) {
    return name.back() == 'M' ? size(v) : k.components(v)[static_cast<std::size_t>(name.back() - 'X')];
  };
  if (family == "D") return shown(d);
  if (name == "VR") return size(d).derivative();
  if (family == "V") return shown(l.rate(d));
  if (family == "ACC") return shown(l.rate(l.rate(d)));
  if (family == "W") return shown(w);
  if (family == "WDT") return shown(l.rate(w));
  if (name == "AX") return atan2(-R(2, 3), R(3, 3));
  if (name == "AY") return atan2(R(1, 3), R(3, 3));
  if (name == "AZ") return atan2(R(2, 1), R(1, 1));
  if (name == "PSI") return atan2(R(1, 3), -R(2, 3));
  if (name == "THETA") return atan2(sqrt(R(1, 3) * R(1, 3) + R(2, 3) * R(2, 3)), R(3, 3));
  if (name == "PHI") return atan2(R(3, 1), R(3, 2));
  if (name == "YAW") return atan2(R(2, 1), R(1, 1));
  if (name == "PITCH") return atan2(R(3, 1), sqrt(R(1, 1) * R(1, 1) + R(2, 1) * R(2, 1)));
  if (name == "ROLL") return atan2(R(3, 2), R(3, 3));
  // Smooth where these are not.
  if (name == "PSI+PHI") return atan2(R(2, 1) - R(1, 2), R(1, 1) + R(2, 2));
  if (name == "PSI-PHI") return atan2(R(2, 1) + R(1, 2), R(1, 1) - R(2, 2));
  if (name == "YAW+ROLL") return atan2(-R(1, 2) - R(2, 3), R(2, 2) - R(1, 3));
  if (name == "YAW-ROLL") return atan2(-R(1, 2) + R(2, 3), R(2, 2) + R(1, 3));
  EXPECT_EQ(name, "INCANG");
  const V b = k.origin - j.origin;
  return atan2(size(cross(d, b)), dot(d, b));
}

struct Call {
  std::string text, name;
  Arguments frames;
};
Call call(const std::string& name, const std::vector<int>& written, const Arguments& frames) {
  return {fmt::format("{}({})", name, fmt::join(written, ",")), name, frames};
}
Arguments filled(std::vector<int> a) {
  a.resize(4, 0);
  return {a[0], a[1], a[2], a[3]};
}

// Markers 2 and 3 are on the first body, 4 and 5 on the second, 6 on a point mass, 8 on a third body, 1 on the ground.
std::vector<Call> calls() {
  using Lists = std::vector<std::vector<int>>;
  const Lists with_axes = {{2}, {2, 4}, {2, 0, 8}, {2, 4, 8}, {2, 1, 5}, {2, 4, 3}, {6, 4, 2}};
  const Lists with_frame = {{2, 0, 0, 8}, {2, 4, 0, 8}, {2, 4, 8, 5}, {2, 4, 1, 5},
                            {2, 0, 5, 3}, {3, 5, 8, 2}, {2, 4, 8, 1}, {6, 1, 0, 4}};
  const Lists of_size = {{2}, {2, 4}, {2, 0, 8}, {2, 4, 9}, {2, 4, 5}, {2, 1, 3}};
  std::vector<Call> all;
  for (const std::string family : {"D", "V", "W", "ACC", "WDT"}) {
    const bool seen = family != "D" && family != "W";
    for (const std::string axis : {"X", "Y", "Z"}) {
      for (const auto& a : with_axes) all.push_back(call(family + axis, a, filled(a)));
      for (const auto& a : seen ? with_frame : Lists{}) all.push_back(call(family + axis, a, filled(a)));
    }
    for (const auto& a : of_size) {
      if (seen || a.size() < 3) all.push_back(call(family + "M", a, {a[0], filled(a)[1], 0, filled(a)[2]}));
    }
  }
  for (const std::vector<int>& a : Lists{{2}, {2, 4}, {6, 8}}) all.push_back(call("VR", a, filled(a)));
  for (const std::string name : {"AX", "AY", "AZ", "PSI", "THETA", "PHI", "YAW", "PITCH", "ROLL"}) {
    for (const std::vector<int>& a : Lists{{2}, {4, 2}, {8, 1}, {1, 3}}) all.push_back(call(name, a, filled(a)));
  }
  for (const std::vector<int>& a : Lists{{2, 4, 8}, {1, 3, 5}, {2, 1, 3}, {6, 4, 5}})
    all.push_back(call("INCANG", a, filled(a)));
  return all;
}

double number(const Real& x) { return static_cast<double>(x); }

constexpr double accuracy = 1e-12;

// What the product has, by its three coordinates and levels, against the truth. `of` reads value, rate and acceleration
// of a series; families of partials are those by coordinates, their rates and second rates. The largest of a
// family counts, or 1.
using Read = Real (*)(const Series::Coefficient&);

class Comparison {
 public:
  Comparison(World& world, Call call, double tolerance, const std::function<Series(const Varied&)>& truth)
      : world_(world), call_(std::move(call)), tolerance_(tolerance), truth_(truth) {}

  void run() {
    SmallSystem& s = world_.system;
    const BoundExpression e = s.bound(call_.text);
    ExpressionScratch scratch;
    const Series now = truth_({});
    expect(e.value(s.p.motion, scratch), number(now.c[0].value), 1, "value");
    if (e.order() == 0) {
      const Taylor course = e.along_motion(s.p.motion, scratch);
      expect(course.rate, number(now.c[1].value), 1, "first derivative");
      expect(course.acceleration, number(2 * now.c[2].value), 1, "second derivative");
    }
    if (e.order() == 1) expect(e.rate(s.p.motion, scratch), number(now.c[1].value), 1, "first derivative");
    expect_partials(0, "value",
                    [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 1.0, PartialBy::velocity); });
    if (e.order() > 1) return;
    const BoundExpression with_rates = s.bound(call_.text, Binding::rates);
    expect_partials(1, "first derivative", [&](Equations& eq, std::int32_t row) {
      with_rates.add_rate(s.p.motion, eq, row, 1.0, PartialBy::velocity);
    });
  }

 private:
  void expect(double found, double expected, double size, const std::string& of) const {
    EXPECT_NEAR(found, expected, tolerance_ * std::max(size, std::abs(expected))) << of << " of " << call_.text;
  }

  template <class Add>
  void expect_partials(std::size_t derivative, const std::string& of, const Add& add) const {
    const Layout& layout = world_.system.p.layout;
    const std::int32_t row = layout.coordinate_count + 1;
    const std::array families = {PartialBy::position, PartialBy::velocity, PartialBy::acceleration};
    const Equations eq =
        mechanics_test::assembled(layout, {PartialBy::position, PartialBy::velocity, PartialBy::acceleration},
                                  [&](Equations& to) { add(to, row); });
    for (std::size_t level = 0; level < 3; ++level) {
      std::map<std::int32_t, double> expected;
      double largest = 1;
      for (std::int32_t b = 1; b < 5; ++b) {
        const BodyBlock& block = layout.body({b});
        for (std::int32_t k = 0; k < block.count; ++k) {
          const Series s = truth_({b, static_cast<std::size_t>(k), level});
          const double partial = number(s.c[derivative].varied);
          expected[block.offset + k] = partial;
          largest = std::max(largest, std::abs(partial));
        }
      }
      for (const auto& [column, partial] : expected) {
        expect(mechanics_test::entry(eq.matrix(families[level]), row, column), partial, largest,
               fmt::format("partial by {} of the {}", mechanics_test::coordinate_name(layout, column, level), of));
      }
    }
  }

  World& world_;
  Call call_;
  double tolerance_;
  const std::function<Series(const Varied&)>& truth_;
};

void compare(World& world, const Call& c, double tolerance = accuracy) {
  const std::function<Series(const Varied&)> truth = [&](const Varied& by) {
    return measure(c.name, world, c.frames, by);
  };
  Comparison(world, c, tolerance, truth).run();
}

TEST(Measures, are_exact_with_derivatives_and_partials_in_all_forms) {
  for (unsigned seed = 1; seed <= draws(2u, 1u); ++seed) {
    World world(seed);
    for (const Call& c : calls()) compare(world, c);
  }
}

Matrix3 about(std::size_t axis, double angle) {
  Vector a;
  a[axis] = angle;
  return rotation_exponential(a);
}

// Body of marker 2 turned so that the marker has this orientation seen from marker 4.
void orient(World& world, const Matrix3& seen) {
  BodyMotion& b = world.body(2);
  const Matrix3 R = world.body(4).R * world.place(4).R_BM * seen * transpose(world.place(2).R_BM);
  b.set({b.r, R}, b.rdot, b.w, b.rddot, b.wdot);
}

// Rounding of the axes is a part of the distance from the place where the angle has no gradient, so that nothing knows
// it better than this.
double beside(double distance) { return accuracy + 64 * std::numeric_limits<double>::epsilon() / distance; }

TEST(Measures, are_as_exact_beside_singular_angles_as_the_axes_are) {
  for (const double distance : {1e-1, 1e-3, 1e-6}) {
    for (const double theta : {distance, std::numbers::pi - distance}) {
      World world(4);
      orient(world, about(2, 0.7) * about(0, theta) * about(2, -1.9));
      for (const char* name : {"PSI", "THETA", "PHI"})
        compare(world, call(name, {2, 4}, {2, 4, 0, 0}), beside(distance));
    }
    for (const double sign : {1.0, -1.0}) {
      World world(5);
      orient(world, about(2, 0.7) * about(1, sign * (std::numbers::pi / 2 - distance)) * about(0, -1.9));
      for (const char* name : {"YAW", "PITCH", "ROLL"})
        compare(world, call(name, {2, 4}, {2, 4, 0, 0}), beside(distance));
    }
    // The origins of 2 and 8 seen from 4 under an angle so small, or all but opposite.
    for (const double sign : {1.0, -1.0}) {
      World world(6);
      const auto at = [&](int m) { return world.system.p.motion.point(world.place(m)); };
      const Vector along = at(8) - at(4), across = cross(along, Vector{0.3, -0.8, 0.5});
      world.body(2).r += at(4) + (sign * 0.8) * along + (distance / norm(across)) * norm(along) * across - at(2);
      compare(world, call("INCANG", {2, 4, 8}, {2, 4, 8, 0}), beside(distance));
    }
  }
}

// Where the angles themselves have none, their sums do: to all digits, however near.
TEST(Measures, smooth_sums_of_angles_lose_nothing_beside_singular_angles) {
  struct Row {
    const char* name;
    const char* text;
    Matrix3 (*middle)(double);
  };
  const auto tilted = [](double d) { return about(0, d); };
  const auto turned_over = [](double d) { return about(0, std::numbers::pi - d); };
  const auto up = [](double d) { return about(1, -std::numbers::pi / 2 + d); };
  const auto down = [](double d) { return about(1, std::numbers::pi / 2 - d); };
  for (const Row& row : {Row{"PSI+PHI", "PSI(2,4)+PHI(2,4)", tilted}, Row{"PSI-PHI", "PSI(2,4)-PHI(2,4)", turned_over},
                         Row{"YAW+ROLL", "YAW(2,4)+ROLL(2,4)", up}, Row{"YAW-ROLL", "YAW(2,4)-ROLL(2,4)", down}}) {
    for (const double distance : {1e-1, 1e-3, 1e-6, 1e-9}) {
      World world(7);
      const std::size_t last = row.name[0] == 'P' ? 2 : 0;
      orient(world, about(2, 0.7) * row.middle(distance) * about(last, -0.4));
      compare(world, {row.text, row.name, {2, 4, 0, 0}});
    }
  }
}

TEST(Measures, squares_of_angles_lose_nothing_where_they_are_small) {
  for (const double distance : {1e-1, 1e-3, 1e-6, 1e-9}) {
    World world(8);
    orient(world, about(2, 0.7) * about(0, distance) * about(2, -0.4));
    const std::function<Series(const Varied&)> truth = [&](const Varied& by) {
      const Series theta = measure("THETA", world, {2, 4, 0, 0}, by);
      return theta * theta;
    };
    Comparison(world, {"THETA(2,4)**2", "THETA", {2, 4, 0, 0}}, accuracy, truth).run();
  }
}

}  // namespace
}  // namespace dynalin::precision::measure_test
