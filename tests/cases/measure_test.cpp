// All marker measures in all forms of their arguments, against what the test itself finds: three free bodies under
// constant loads move as Newton and Euler say; measures are differences of that motion in time as an observer on l sees
// it, their partials differences of motions that begin elsewhere. Extended precision makes both as exact as the
// product.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "base/vec3.h"
#include "cases/study_of.h"

namespace dynalin::measure_test {
namespace {

using Real = long double;
using V = Vec3<Real>;
using M = Mat3<Real>;

M exponential(const V& a) {
  const Real angle = std::sqrt(dot(a, a));
  const Real s = angle < 1e-9L ? 1 : std::sin(angle) / angle;
  const Real c = angle < 1e-9L ? Real(0.5) : (1 - std::cos(angle)) / (angle * angle);
  const M k = skew(a), kk = k * k;
  M r = M::identity();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) r(i, j) += s * k(i, j) + c * kk(i, j);
  }
  return r;
}

struct Body {
  Real mass;
  V inertia, force, torque;  // about the axes of the body; global
  V r, v, w;
  M R;
};

struct PlacedOn {
  int body;  // 0 is ground
  V p;
  M R;
};

struct Pose {
  V r;
  M R;
};

// The motion over a short time, exact to the second derivative in it at t = 0.
class World {
 public:
  std::vector<Body> bodies;
  std::map<int, PlacedOn> markers;
  V gravity;

  Pose marker(int id, Real t) const {
    if (id == 0) return {V{}, M::identity()};
    const PlacedOn& m = markers.at(id);
    if (m.body == 0) return {m.p, m.R};
    const Body& b = bodies[static_cast<std::size_t>(m.body - 1)];
    const V a = gravity + b.force * (1 / b.mass);
    const V Iw{b.inertia.x * dot(b.R.x, b.w), b.inertia.y * dot(b.R.y, b.w), b.inertia.z * dot(b.R.z, b.w)};
    const V moment = transpose_times(b.R, V(b.torque - cross(b.w, b.R * Iw)));
    const V alpha = b.R * V{moment.x / b.inertia.x, moment.y / b.inertia.y, moment.z / b.inertia.z};
    const M R = exponential(b.w * t + alpha * (t * t / 2)) * b.R;
    return {b.r + b.v * t + a * (t * t / 2) + R * m.p, R * m.R};
  }
};

// Sixth order.
template <class F>
auto derivative(const F& f, Real h) {
  return (f(h) - f(-h)) * (Real(3) / 4 / h) - (f(2 * h) - f(-2 * h)) * (Real(3) / 20 / h) +
         (f(3 * h) - f(-3 * h)) * (Real(1) / 60 / h);
}
constexpr Real step = 1e-3L;

using Arguments = std::array<int, 4>;  // i, j, k, l

class Observer {
 public:
  Observer(const World& world, const Arguments& of) : w_(world), i_(of[0]), j_(of[1]), k_(of[2]), l_(of[3]) {}

  V displacement(Real t) const { return w_.marker(i_, t).r - w_.marker(j_, t).r; }
  // As components in l, to be differentiated there and turned back.
  V seen(const std::function<V(Real)>& vector, Real t) const { return transpose_times(w_.marker(l_, t).R, vector(t)); }
  V velocity(Real t) const {
    const auto r = [&](Real s) { return seen([&](Real u) { return displacement(u); }, s); };
    return w_.marker(l_, t).R * derivative([&](Real h) { return r(t + h); }, step);
  }
  V acceleration() const {
    const auto v = [&](Real s) { return seen([&](Real u) { return velocity(u); }, s); };
    return w_.marker(l_, 0).R * derivative(v, step);
  }
  V angular(int id, Real t) const {
    const M R = w_.marker(id, t).R;
    V sum{};
    for (std::size_t c = 0; c < 3; ++c) {
      sum += cross(R[c], V(derivative([&](Real h) { return w_.marker(id, t + h).R[c]; }, step)));
    }
    return sum * Real(0.5);
  }
  V relative_angular(Real t) const { return angular(i_, t) - angular(j_, t); }
  V angular_acceleration() const {
    const auto w = [&](Real s) { return seen([&](Real u) { return relative_angular(u); }, s); };
    return w_.marker(l_, 0).R * derivative(w, step);
  }
  V in_k(const V& v) const { return transpose_times(w_.marker(k_, 0).R, v); }
  M turn() const { return transpose_times(w_.marker(j_, 0).R, w_.marker(i_, 0).R); }
  V third() const { return w_.marker(k_, 0).r - w_.marker(j_, 0).r; }

 private:
  const World& w_;
  int i_, j_, k_, l_;
};

Real size(const V& v) { return std::sqrt(dot(v, v)); }

// The angles are those that turn the axes of j into those of i, whatever the formula they are read off by.
M about(std::size_t axis, Real angle) {
  V a{};
  a[axis] = angle;
  return exponential(a);
}
std::array<Real, 3> angles_313(const M& R) {
  // Newton's method on the product of the three turns, from a coarse start.
  std::array<Real, 3> a = {std::atan2(R(0, 2), -R(1, 2)), std::acos(R(2, 2)), std::atan2(R(2, 0), R(2, 1))};
  const M back = about(2, a[0]) * about(0, a[1]) * about(2, a[2]);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(size(back[c] - R[c]), 1e-15L);
  return a;
}
std::array<Real, 3> angles_321(const M& R) {
  std::array<Real, 3> a = {std::atan2(R(1, 0), R(0, 0)), std::asin(-R(2, 0)), std::atan2(R(2, 1), R(2, 2))};
  const M back = about(2, a[0]) * about(1, a[1]) * about(0, a[2]);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(size(back[c] - R[c]), 1e-15L);
  return a;
}

// By name, of frames i, j, k, l.
Real measure(const std::string& name, const World& world, const Arguments& of) {
  const Observer o(world, of);
  const auto component = [&](const V& v) { return o.in_k(v)[static_cast<std::size_t>(name.back() - 'X')]; };
  const std::string family = name.substr(0, name.size() - 1);
  const bool of_size = name.back() == 'M';
  const auto vector = [&](const V& v) { return of_size ? size(v) : component(v); };
  const M R = o.turn();
  if (family == "D") return vector(o.displacement(0));
  if (name == "VR") return derivative([&](Real h) { return size(o.displacement(h)); }, step);
  if (family == "V") return vector(o.velocity(0));
  if (family == "W") return vector(o.relative_angular(0));
  if (family == "ACC") return vector(o.acceleration());
  if (family == "WDT") return vector(o.angular_acceleration());
  if (name == "AX") return std::atan2(-R(1, 2), R(2, 2));
  if (name == "AY") return std::atan2(R(0, 2), R(2, 2));
  if (name == "AZ") return std::atan2(R(1, 0), R(0, 0));
  if (name == "PSI") return angles_313(R)[0];
  if (name == "THETA") return angles_313(R)[1];
  if (name == "PHI") return angles_313(R)[2];
  if (name == "YAW") return angles_321(R)[0];
  if (name == "PITCH") return -angles_321(R)[1];
  if (name == "ROLL") return angles_321(R)[2];
  EXPECT_EQ(name, "INCANG");
  const V a = o.displacement(0), b = o.third();
  return std::acos(dot(a, b) / (size(a) * size(b)));
}

struct Call {
  std::string text, name;
  Arguments frames;
};

std::string text_of(const V& v) {
  return fmt::format("{:.17g},{:.17g},{:.17g}", static_cast<double>(v.x), static_cast<double>(v.y),
                     static_cast<double>(v.z));
}

struct MarkerText {
  int id, body;
  V p, angles;  // 3-1-3
};
const std::vector<MarkerText> marker_texts = {
    {5, 0, {0.3L, -0.2L, 0.5L}, {0.3L, 0.7L, -0.4L}},  {21, 1, {0.2L, 0.1L, -0.3L}, {0.5L, 0.2L, 0.1L}},
    {22, 1, {-0.1L, 0.4L, 0.2L}, {1.1L, 0.9L, -2.0L}}, {31, 2, {0.1L, -0.2L, 0.1L}, {0.7L, 0.9L, 0.2L}},
    {32, 2, {-0.3L, 0.2L, 0.4L}, {-0.6L, 1.4L, 0.8L}}, {41, 3, {0.15L, 0.25L, -0.2L}, {2.1L, 0.4L, -0.9L}},
    {42, 3, {0.3L, -0.1L, 0.1L}, {-1.3L, 1.8L, 0.6L}}};

std::string dataset(const std::string& more) {
  std::string s = "Three free bodies\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=0.5, JGRAV=-9.81, KGRAV=1.5\nPART/1, GROUND\n";
  const std::array<std::string, 3> part = {
      "MASS=2, CM=20, IP=0.2,0.3,0.25, QG=0.1,0.2,-0.1, REULER=0.2,0.1,-0.3, WX=1.4, WY=-0.6, WZ=2.9, VX=0.3, VY=0.2, "
      "VZ=-0.5",
      "MASS=1, CM=30, IP=0.1,0.15,0.12, QG=0.7,0.1,0.4, REULER=1.2,0.8,-0.7, WX=0.2, WY=2.3, WZ=-0.7, VX=1.1, VY=-0.2, "
      "VZ=0.5",
      "MASS=3, CM=40, IP=0.4,0.35,0.6, QG=-0.5,0.6,0.2, REULER=-0.4,1.1,0.6, WX=-1.2, WY=0.8, WZ=1.7, VX=-0.4, VY=0.9, "
      "VZ=0.3"};
  const auto markers_of = [&](int body) {
    for (const MarkerText& m : marker_texts) {
      if (m.body != body) continue;
      s += fmt::format("MARKER/{}, QP={}, REULER={}\n", m.id, text_of(m.p), text_of(m.angles));
    }
  };
  s += "MARKER/1\nMARKER/91, FLOATING\nMARKER/92, FLOATING\nMARKER/93, FLOATING\n";
  markers_of(0);
  for (int b = 1; b <= 3; ++b) {
    s += fmt::format("PART/{}, {}\nMARKER/{}\n", b + 1, part[static_cast<std::size_t>(b - 1)], 10 + 10 * b);
    markers_of(b);
  }
  s += "GFORCE/1, I=20, JFLOAT=91, RM=1, FX=7\\FY=-3\\FZ=5\\TX=0.4\\TY=0.7\\TZ=-0.9\n"
       "GFORCE/2, I=30, JFLOAT=92, RM=1, FX=-2\\FY=4\\FZ=9\\TX=-0.3\\TY=0.2\\TZ=0.5\n"
       "GFORCE/3, I=40, JFLOAT=93, RM=1, FX=3\\FY=11\\FZ=-6\\TX=0.8\\TY=-1.1\\TZ=0.6\n";
  return s + more + "END\n";
}

World world_of(const library::OperatingPoint& point) {
  World world;
  world.gravity = {0.5L, -9.81L, 1.5L};
  const std::array<Body, 3> loads = {Body{2, {0.2L, 0.3L, 0.25L}, {7, -3, 5}, {0.4L, 0.7L, -0.9L}, {}, {}, {}, {}},
                                     Body{1, {0.1L, 0.15L, 0.12L}, {-2, 4, 9}, {-0.3L, 0.2L, 0.5L}, {}, {}, {}, {}},
                                     Body{3, {0.4L, 0.35L, 0.6L}, {3, 11, -6}, {0.8L, -1.1L, 0.6L}, {}, {}, {}, {}}};
  const auto vector = [](const std::array<double, 3>& a) { return V{a[0], a[1], a[2]}; };
  const std::vector<BodyState> states = point.state().bodies;
  for (std::size_t b = 0; b < 3; ++b) {
    Body body = loads[b];
    body.r = vector(states[b].position), body.v = vector(states[b].velocity);
    body.w = vector(states[b].angular_velocity);
    body.R = {vector(states[b].axes[0]), vector(states[b].axes[1]), vector(states[b].axes[2])};
    world.bodies.push_back(body);
  }
  for (const MarkerText& t : marker_texts) {
    world.markers[t.id] = {t.body, t.p, about(2, t.angles.x) * about(0, t.angles.y) * about(2, t.angles.z)};
  }
  return world;
}

// Every number of arguments, and 0 for each that may be left out, with observers on ground, on other bodies and on
// those of i and j.
std::vector<Call> calls() {
  std::vector<Call> all;
  const auto add = [&](const std::string& name, const std::vector<int>& written, const Arguments& frames) {
    all.push_back({fmt::format("{}({})", name, fmt::join(written, ",")), name, frames});
  };
  const std::vector<std::vector<int>> with_axes = {{21},         {21, 31},    {21, 0, 41},
                                                   {21, 31, 41}, {21, 5, 32}, {21, 31, 22}},
                                      with_frame = {{21, 0, 0, 41},  {21, 31, 0, 41}, {21, 31, 41, 42},
                                                    {21, 31, 5, 32}, {21, 0, 32, 22}, {22, 32, 41, 21},
                                                    {21, 31, 41, 5}},
                                      of_sizes = {{21}, {21, 31}, {21, 0, 41}, {21, 31, 42}, {21, 31, 32}, {21, 5, 22}};
  const auto filled = [](std::vector<int> a) {
    a.resize(4, 0);
    return Arguments{a[0], a[1], a[2], a[3]};
  };
  for (const std::string family : {"D", "V", "W", "ACC", "WDT"}) {
    for (const std::string axis : {"X", "Y", "Z"}) {
      for (const auto& a : with_axes) add(family + axis, a, filled(a));
      if (family == "D" || family == "W") continue;
      for (const auto& a : with_frame) add(family + axis, a, filled(a));
    }
    for (const auto& a : of_sizes) {
      if ((family == "D" || family == "W") && a.size() > 2) continue;
      add(family + "M", a, {a[0], a.size() > 1 ? a[1] : 0, 0, a.size() > 2 ? a[2] : 0});
    }
  }
  for (const auto& a : of_sizes) add("VR", a, {a[0], a.size() > 1 ? a[1] : 0, 0, 0});
  for (const std::string name : {"AX", "AY", "AZ", "PSI", "THETA", "PHI", "YAW", "PITCH", "ROLL"}) {
    for (const std::vector<int>& a : {std::vector{21}, std::vector{31, 21}, std::vector{41, 5}, std::vector{5, 22}}) {
      add(name, a, filled(a));
    }
  }
  for (const std::vector<int>& a : {std::vector{21, 31, 41}, std::vector{5, 22, 32}, std::vector{21, 5, 22}}) {
    add("INCANG", a, filled(a));
  }
  return all;
}

class Measures : public ::testing::Test {
 protected:
  library::Study study(const std::vector<Call>& list) const {
    std::string more, ids;
    for (std::size_t k = 0; k < list.size(); ++k) {
      more += fmt::format("VARIABLE/{}, FUNCTION={}\n", k + 1, list[k].text);
      ids += fmt::format("{}{}", k == 0 ? "" : ",\n,", k + 1);
    }
    return study_of(dataset(more + "POUTPUT/1, VARIABLES=" + ids + "\n"));
  }
};

TEST_F(Measures, are_what_an_observer_differentiates) {
  const std::vector<Call> list = calls();
  const auto m = study(list).initial_conditions();
  const World world = world_of(m);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Real expected = measure(list[k].name, world, list[k].frames);
    // Rounding of the product; the differences are good to 1e-14.
    EXPECT_NEAR(m.variable(static_cast<std::int64_t>(k) + 1), static_cast<double>(expected),
                2e-13 * std::max(1.0, static_cast<double>(std::fabs(expected))))
        << list[k].text;
  }
}

TEST_F(Measures, have_the_partials_of_motions_that_begin_elsewhere) {
  const std::vector<Call> list = calls();
  const auto study = this->study(list);
  const auto m = study.initial_conditions();
  LinearRequest request;
  request.poutput = 1;
  const StateSpace s = study.linearize(m, request).state_space();
  ASSERT_EQ(s.states.size(), 36u);
  const World world = world_of(m);
  for (std::size_t c = 0; c < s.states.size(); ++c) {
    const StateLabel& state = s.states[c];
    // A displacement or turn of the body, or its rate, along the global axes; the rate of the turn stays when the body
    // is turned, so that its angular velocity follows.
    const auto displaced = [&](Real e) {
      World w = world;
      Body& b = w.bodies[static_cast<std::size_t>(state.element - 2)];
      const int n = state.coordinate - (state.is_rate ? 6 : 0) - 1;
      V along{};
      along[static_cast<std::size_t>(n % 3)] = e;
      if (n < 3) {
        (state.is_rate ? b.v : b.r) += along;
      } else if (state.is_rate) {
        b.w += along;
      } else {
        const M turn = exponential(along);
        b.R = turn * b.R, b.w = turn * b.w;
      }
      return w;
    };
    std::map<Real, World> worlds;
    for (int n = -3; n <= 3; ++n) worlds.emplace(n, displaced(n * step));
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto at = [&](Real e) { return measure(list[k].name, worlds.at(std::round(e / step)), list[k].frames); };
      const auto expected = static_cast<double>(derivative(at, step));
      EXPECT_NEAR(s.C(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)), expected,
                  1e-9 * std::max(1.0, std::abs(expected)))  // differences of second differences
          << list[k].text << " by " << (state.is_rate ? "the rate of " : "") << state.text << " of "
          << state.owner.text();
    }
  }
}

}  // namespace
}  // namespace dynalin::measure_test
