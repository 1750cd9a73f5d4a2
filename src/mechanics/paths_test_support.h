// What the tests of this folder measure against: bodies on smooth paths, computed in extended precision from positions
// alone. Velocities and accelerations are differences in time, partials are differences of varied paths; no formula of
// the product is used.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <deque>
#include <random>
#include <span>
#include <vector>

#include "mechanics/equations.h"
#include "mechanics/layout.h"
#include "mechanics/motion.h"

namespace dynalin::mechanics_test {

using Real = long double;
using RealVector = Vec3<Real>;
using RealMatrix = Mat3<Real>;

inline RealVector real(const Vector& v) { return {v.x, v.y, v.z}; }
inline RealMatrix real(const Matrix3& m) { return {real(m.x), real(m.y), real(m.z)}; }
inline Vector rounded(const RealVector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Turns by |a| about the direction of a (Rodrigues).
inline RealMatrix turn(const RealVector& a) {
  const Real angle = norm(a);
  const Real sine = angle > 0 ? std::sin(angle) / angle : 1.0L;
  const Real half = angle > 0 ? std::sin(angle / 2) / (angle / 2) : 1.0L;
  RealMatrix m = RealMatrix::identity();
  for (std::size_t k = 0; k < 3; ++k) {
    const RealVector across = cross(a, m[k]);
    m[k] += across * sine + cross(a, across) * (half * half / 2);
  }
  return m;
}

// Central differences of eighth order of a function of one variable at 0: a number, vector or the like.
inline constexpr Real step = 0.02L;
template <class Function>
auto slope(const Function& f) {
  const auto pair = [&](int k) { return (f(static_cast<Real>(k) * step) - f(static_cast<Real>(-k) * step)) / step; };
  return pair(1) * (4.0L / 5) - pair(2) * (1.0L / 5) + pair(3) * (4.0L / 105) - pair(4) * (1.0L / 280);
}
template <class Function>
auto second_slope(const Function& f) {
  const auto pair = [&](int k) {
    return (f(static_cast<Real>(k) * step) + f(static_cast<Real>(-k) * step)) / (step * step);
  };
  return pair(1) * (8.0L / 5) - pair(2) * (1.0L / 5) + pair(3) * (8.0L / 315) - pair(4) * (1.0L / 560) -
         f(0.0L) * (205.0L / 72) / (step * step);
}

// Adds size · t^level / level! to a coordinate; rotations turn about the global axes, after all that stands before.
struct Variation {
  std::int32_t column = -1;
  std::size_t level = 0;
  Real size = 0;

  Real at(Real t) const { return level == 0 ? size : level == 1 ? size * t : size * t * t / 2; }
};

struct BodyPath {
  RealVector r, v, a;
  RealMatrix R = RealMatrix::identity();
  RealVector w, alpha;
};

class Paths;

// An instant of a varied motion.
struct Moment {
  const Paths* paths;
  Real t = 0;
  std::array<Variation, 3> variation{};
  std::size_t count = 0;

  std::span<const Variation> variations() const { return std::span(variation).first(count); }
  Moment later(Real dt) const { return {paths, t + dt, variation, count}; }
  Moment varied(std::int32_t column, std::size_t level, Real size) const {
    Moment m = *this;
    m.variation.at(m.count++) = {column, level, size};
    return m;
  }
  RealVector origin_of(BodyId) const;
  RealMatrix axes_of(BodyId) const;
  RealVector origin(MarkerId m) const;
  RealMatrix axes(MarkerId m) const;
  RealVector arm(MarkerId m) const { return origin(m) - origin_of(body(m)); }
  BodyId body(MarkerId m) const;
  Real outside_poses(std::size_t k) const;
  Real parameter(std::size_t k = 0) const { return outside_poses(6 + k); }
  RealVector on_body(MarkerId m) const;       // the origin in the BCS
  RealMatrix axes_on_body(MarkerId m) const;  // the axes in it

  template <class Function>
  auto rate(const Function& f) const {
    return slope([&](Real dt) { return f(later(dt)); });
  }
  template <class Function>
  auto second_rate(const Function& f) const {
    return second_slope([&](Real dt) { return f(later(dt)); });
  }
  template <class Function>
  auto partial(std::int32_t column, std::size_t level, const Function& f) const {
    return slope([&](Real size) { return f(varied(column, level, size)); });
  }
  // ω with R′ = ω × R, from the axes alone.
  RealVector angular_velocity(MarkerId m) const {
    const RealMatrix now = axes(m);
    RealVector sum{};
    for (std::size_t c = 0; c < 3; ++c) {
      sum += cross(now[c], rate([&](const Moment& at) { return at.axes(m)[c]; })) * 0.5L;
    }
    return sum;
  }
  // The derivative of a vector as an observer on marker l sees it.
  template <class Function>
  RealVector rate_seen_from(MarkerId l, const Function& f) const {
    return axes(l) * rate([&](const Moment& at) { return transpose_times(at.axes(l), f(at)); });
  }
};

// Ground, three parts and a point mass that move and turn in all directions, two markers to a body: 2b and 2b + 1 on
// body b, marker 0 the global frame. PART/2 and PART/3 change their shape, with two and four modal coordinates; two
// curve parameters follow those.
class Paths {
 public:
  explicit Paths(unsigned seed = 1) : random_(seed) {
    layout.add_body(BodyKind::ground, label("PART", 1));
    layout.add_body(BodyKind::part, label("PART", 2));
    layout.add_body(BodyKind::part, label("PART", 3));
    layout.add_body(BodyKind::point_mass, label("POINT_MASS", 4));
    layout.add_body(BodyKind::part, label("PART", 5));
    for (std::int32_t b = 0; b < 5; ++b) {
      BodyPath p;
      if (b > 0) p.r = draw(2), p.v = draw(1), p.a = draw(1);
      const bool turns = b > 0 && b != 3;
      if (turns) p.R = turn(draw(2)), p.w = draw(1), p.alpha = draw(1);
      bodies.push_back(p);
      for (int k = 0; k < 2; ++k) {
        MarkerPlace m{BodyId{b}, {}, Matrix3::identity()};
        if (b > 0 || k > 0) m.p_BM = rounded(draw(0.7L)), m.R_BM = rotation_exponential(rounded(draw(2)));
        if (b == 1 || b == 2) m.shapes = &shapes_.emplace_back(shapes(b == 1 ? 0 : 2, b == 1 ? 2 : 4));
        layout.markers.push_back(&markers_.emplace_back(m));
        layout.marker_labels.push_back(&labels_.emplace_back(label("MARKER", 2 * b + k)));
      }
    }
    layout.add_extra(label("PART", 2), {StateType::flex_body, ExtraRole::shape}, {{"Q1"}, {"Q2"}});
    layout.add_extra(label("PART", 3), {StateType::flex_body, ExtraRole::shape}, {{"Q1"}, {"Q2"}, {"Q3"}, {"Q4"}});
    layout.add_extra(label("PTCV", 1), {StateType::ptcv}, {{"U"}, {"V"}});
    for (auto& u : extra) u = draw(0.4L);
    for (const BodyPath& p : bodies) {
      BodyMotion m;
      m.set({rounded(p.r), {rounded(p.R.x), rounded(p.R.y), rounded(p.R.z)}}, rounded(p.v), rounded(p.w), rounded(p.a),
            rounded(p.alpha));
      motion.bodies.push_back(m);
    }
    for (const RealVector& u : extra) {
      motion.extra.push_back(static_cast<double>(u.x));
      motion.extra_rate.push_back(static_cast<double>(u.y));
      motion.extra_acceleration.push_back(static_cast<double>(u.z));
    }
    motion.time = 0.7;
  }
  Paths(const Paths&) = delete;
  Paths& operator=(const Paths&) = delete;

  Moment now() const { return {this}; }
  const MarkerPlace& marker(std::int32_t m) const { return layout.marker({m}); }
  // Numbers of double precision, so that both sides mean the same.
  RealVector draw(Real size) {
    std::uniform_real_distribution<double> number(-1, 1);
    const double s = static_cast<double>(size), x = number(random_), y = number(random_), z = number(random_);
    return {s * x, s * y, s * z};
  }
  Vector vector(double size = 1) { return rounded(draw(size)); }
  Matrix3 matrix(double size = 1) { return {vector(size), vector(size), vector(size)}; }

  Layout layout;
  std::vector<BodyPath> bodies;
  static constexpr std::size_t modal_coordinates = 6;
  std::array<RealVector, modal_coordinates + 2> extra;  // u, u′, u″ of each coordinate outside poses
  Motion motion;
  // The column of a curve parameter.
  std::int32_t parameter(std::int32_t k = 0) const {
    return layout.body_coordinate_count + static_cast<std::int32_t>(modal_coordinates) + k;
  }

 private:
  static ElementLabel label(std::string_view statement, std::int64_t id) { return {statement, id, {}, {}}; }
  NodeShapes shapes(std::size_t first, std::size_t count) {
    NodeShapes s{first, {}, {}, vector(0.5)};
    for (std::size_t k = 0; k < count; ++k) s.translation.push_back(vector(0.6)), s.rotation.push_back(vector(0.6));
    return s;
  }
  std::mt19937 random_;
  std::deque<NodeShapes> shapes_;    // markers point to them
  std::deque<MarkerPlace> markers_;  // the layout points to them
  std::deque<ElementLabel> labels_;
};

inline RealVector Moment::origin_of(BodyId b) const {
  const BodyPath& p = paths->bodies[static_cast<std::size_t>(b.index)];
  const BodyBlock& block = paths->layout.body(b);
  RealVector r = p.r + p.v * t + p.a * (t * t / 2);
  for (const Variation& v : variations()) {
    const std::int32_t k = v.column - block.offset;
    if (block.count > 0 && k >= 0 && k < 3) r[static_cast<std::size_t>(k)] += v.at(t);
  }
  return r;
}
inline RealMatrix Moment::axes_of(BodyId b) const {
  const BodyPath& p = paths->bodies[static_cast<std::size_t>(b.index)];
  const BodyBlock& block = paths->layout.body(b);
  RealMatrix R = turn(p.w * t + p.alpha * (t * t / 2)) * p.R;
  for (const Variation& v : variations()) {
    const std::int32_t k = v.column - block.offset - 3;
    if (!block.turns() || k < 0 || k >= 3) continue;
    RealVector e{};
    e[static_cast<std::size_t>(k)] = v.at(t);
    R = turn(e) * R;
  }
  return R;
}
inline BodyId Moment::body(MarkerId m) const { return paths->layout.marker(m).body; }
// The sum of shapes at a node times the modal coordinates.
inline RealVector shape_sum(const Moment& m, const NodeShapes& at, const std::vector<Vector>& shapes) {
  RealVector sum{};
  for (std::size_t k = 0; k < shapes.size(); ++k) sum += real(shapes[k]) * m.outside_poses(at.first + k);
  return sum;
}
inline RealVector Moment::on_body(MarkerId m) const {
  const MarkerPlace& place = paths->layout.marker(m);
  if (!place.shapes) return real(place.p_BM);
  const RealVector o = real(place.shapes->offset);
  return real(place.p_BM) - o + shape_sum(*this, *place.shapes, place.shapes->translation) +
         turn(shape_sum(*this, *place.shapes, place.shapes->rotation)) * o;
}
inline RealMatrix Moment::axes_on_body(MarkerId m) const {
  const MarkerPlace& place = paths->layout.marker(m);
  if (!place.shapes) return real(place.R_BM);
  return turn(shape_sum(*this, *place.shapes, place.shapes->rotation)) * real(place.R_BM);
}
inline RealVector Moment::origin(MarkerId m) const { return origin_of(body(m)) + axes_of(body(m)) * on_body(m); }
inline RealMatrix Moment::axes(MarkerId m) const { return axes_of(body(m)) * axes_on_body(m); }
inline Real Moment::outside_poses(std::size_t k) const {
  const RealVector& u = paths->extra[k];
  Real sum = u.x + u.y * t + u.z * (t * t / 2);
  const auto column = paths->layout.body_coordinate_count + static_cast<std::int32_t>(k);
  for (const Variation& v : variations()) {
    if (v.column == column) sum += v.at(t);
  }
  return sum;
}

inline ::testing::AssertionResult agree(double value, Real expected) {
  constexpr Real rounding = 1e-10L;  // what differences leave, with room
  if (std::abs(value - expected) <= rounding * (1 + std::abs(expected))) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << value << " instead of " << expected;
}

// One entry of a matrix of partials, zero where there is none.
inline double entry(const ColumnMatrix& m, std::int32_t row, std::int32_t column) {
  double found = 0;
  for_each_in_column(m, column, [&](std::int32_t r, double v) {
    if (r == row) found = v;
  });
  return found;
}
// Coefficients of a row in one coordinate, zero where it has none.
inline RowCoefficients coefficients(const ConstraintRows& rows, std::int32_t row, std::int32_t column) {
  for (const auto& e : rows.row(row)) {
    if (e.column == column) return e.c;
  }
  return {};
}

// What `add` adds to equations, after a pass that records the pattern.
template <class Add>
Equations assembled(const Layout& layout, std::initializer_list<PartialBy> wanted, const Add& add) {
  Equations eq;
  eq.resize(layout);
  for (int pass = 0; pass < 2; ++pass) {
    eq.begin(wanted);
    add(eq);
    eq.finish();
  }
  return eq;
}

inline std::string coordinate_name(const Layout& layout, std::int32_t column, std::size_t level = 0) {
  return layout.coordinate_text(column) + (level == 0 ? "" : level == 1 ? ", its rate" : ", its second rate");
}

}  // namespace dynalin::mechanics_test
