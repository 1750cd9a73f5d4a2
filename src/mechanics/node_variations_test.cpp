// How markers on bodies that change their shape follow its modal coordinates, against differences of where they stand.
#include "mechanics/node_variations.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dynalin::node_variations_test {
namespace {

constexpr std::size_t modes = 5;

NodeShapes shapes() {
  NodeShapes s;
  s.first = 1;
  s.offset = {0.3, -0.2, 0.5};
  for (std::size_t k = 0; k < modes; ++k) {
    const double x = 0.4 + static_cast<double>(k);
    s.translation.push_back({std::sin(x), std::cos(2 * x), 0.3 * x});
    s.rotation.push_back({0.5 * std::cos(3 * x), -0.4 * std::sin(x), 0.2 + 0.1 * x});
  }
  return s;
}

// With all coordinates at the instant t of a motion: the body turns as well.
Motion motion_at(double t) {
  Motion m;
  m.bodies.resize(2);
  const Vector w{0.7, -0.4, 1.1};
  m.bodies[1].set({{1, 2, 3}, rotation_exponential(t * w) * rotation_exponential({0.3, 0.5, -0.2})}, {0.1, 0.2, 0.3}, w,
                  {}, {});
  m.extra = {9}, m.extra_rate = {9}, m.extra_acceleration = {9};
  for (std::size_t k = 0; k < modes; ++k) {
    const double q = 0.3 - 0.1 * static_cast<double>(k), q1 = 0.2 + 0.1 * static_cast<double>(k), q2 = -0.3;
    m.extra.push_back(q + q1 * t + 0.5 * q2 * t * t);
    m.extra_rate.push_back(q1 + q2 * t);
    m.extra_acceleration.push_back(q2);
  }
  return m;
}

Deformation<double> deformed(const NodeShapes& s, const Motion& m) {
  return deformation<double>(s, [&](std::size_t k) { return m.extra[s.first + k]; });
}
Motion moved(Motion m, std::size_t k, double by) {
  m.extra[1 + k] += by;
  return m;
}

}  // namespace

TEST(NodeVariations, are_how_places_and_axes_of_a_marker_change) {
  const NodeShapes s = shapes();
  const Motion m = motion_at(0);
  const NodeVariations variations(m, BodyId{1}, s);
  constexpr double h = 1e-5;
  for (std::size_t k = 0; k < modes; ++k) {
    const auto far = deformed(s, moved(m, k, h)), near = deformed(s, moved(m, k, -h));
    const Matrix3& A = m.bodies[1].R;
    const Vector moves = (1 / (2 * h)) * (A * (far.moved - near.moved));
    const Matrix3 turn = far.turned * transpose(near.turned);
    const Vector spin =
        (1 / (4 * h)) * (A * Vector{turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)});
    const auto found = variations.by(k);
    EXPECT_LT(norm(value(found.moves) - moves), 1e-9) << k;
    EXPECT_LT(norm(value(found.turns) - spin), 1e-9) << k;
  }
}

TEST(NodeVariations, have_rates_along_the_motion) {
  const NodeShapes s = shapes();
  constexpr double h = 1e-4;
  const NodeVariations now(motion_at(0), BodyId{1}, s), later(motion_at(h), BodyId{1}, s),
      before(motion_at(-h), BodyId{1}, s);
  for (std::size_t k = 0; k < modes; ++k) {
    for (const auto& part : {&NodeVariations::One::moves, &NodeVariations::One::turns}) {
      const Vec3<Taylor> at = now.by(k).*part, to = later.by(k).*part, from = before.by(k).*part;
      EXPECT_LT(norm(rate(at) - (1 / (2 * h)) * (value(to) - value(from))), 1e-6) << k;
      EXPECT_LT(norm(acceleration(at) - (1 / (2 * h)) * (rate(to) - rate(from))), 1e-6) << k;
      EXPECT_GT(norm(acceleration(at)), 1e-3);
    }
  }
}

TEST(NodeVariations, work_and_how_it_changes_is_that_of_each_coordinate) {
  const NodeShapes s = shapes();
  const Motion m = motion_at(0);
  const Vector force{1.2, -0.7, 2.1}, torque{-0.4, 1.5, 0.8};
  const auto work_on = [&](const Motion& at, std::size_t k) {
    return NodeVariations(at, BodyId{1}, s).work(force, torque).of(s, k);
  };
  const Matrix3 S = change_of_work(m, BodyId{1}, s, force, torque);
  constexpr double h = 1e-5;
  for (std::size_t k = 0; k < modes; ++k) {
    const auto one = NodeVariations(m, BodyId{1}, s).by(k);
    EXPECT_NEAR(work_on(m, k), dot(value(one.moves), force) + dot(value(one.turns), torque), 1e-14);
    for (std::size_t l = 0; l < modes; ++l) {
      const double change = (work_on(moved(m, l, h), k) - work_on(moved(m, l, -h), k)) / (2 * h);
      EXPECT_NEAR(dot(s.rotation[k], S * s.rotation[l]), change, 1e-8) << k << ' ' << l;
    }
  }
}

}  // namespace dynalin::node_variations_test
