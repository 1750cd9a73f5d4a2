// Angles, angular velocity and angular acceleration of sections, against the section that is turned by them and against
// differences along motions that differ by little in a coordinate, its rate or its acceleration.
#include "elements/families/section_reading.h"

#include <gtest/gtest.h>

#include "flexible/plane_beam.h"
#include "flexible/spatial_beam.h"
#include "mechanics/motion.h"

namespace dynalin::section_reading_test {
namespace {

using Scalar = BeamMotion::Scalar;

const BeamMaterial material{3.0, 200.0, 80.0, 0};
const BeamSection section{1.5, 0.9, 0.4, 0.7, 0.15, 1.2, 1.3};
constexpr double step = 1e-5;

Matrix3 turn(const Vector& a) { return rotation::exponential(a); }

// Of a coordinate that is moved by `by`; none: beam_coordinates.
BeamMotion in_space(const Scalar& t, std::size_t coordinate, const Scalar& by) {
  const Scalar u = t * t;
  BeamMotion m{};
  m.chord = {2.0 - 0.5 * t, 0.5 + 0.6 * t - u, 0.1 + 0.3 * t};
  m.axes = {rotation::exponential(Vec3<Scalar>{0.6 + t, 0.9 - 0.4 * t, -0.5 + 0.3 * u}),
            rotation::exponential(Vec3<Scalar>{0.5 - 0.6 * t, 1.1 + 0.4 * t, -0.2 + 0.7 * t - u})};
  m.slope = {Vec3<Scalar>{1.02 + 0.1 * t, 0.1 + 0.2 * u, -0.2 * t}, Vec3<Scalar>{Scalar(0.97), 0.3 - 0.3 * t, 0.2 * u}};
  m.middle = {0.05 + 0.2 * t, -0.03 + 0.1 * u, 0.04 - 0.3 * t};
  Vec3<Scalar> e{Scalar(0.0), Scalar(0.0), Scalar(0.0)};
  e[coordinate % 3] = by;
  if (coordinate / 3 == 1) m.axes[0] = rotation::exponential(e) * m.axes[0];
  if (coordinate / 3 == 3) m.axes[1] = rotation::exponential(e) * m.axes[1];
  if (coordinate / 3 == 6) m.middle += e;
  return m;
}
constexpr BeamPlane plane{1, 2, 0};
BeamMotion in_plane(const Scalar& t, std::size_t coordinate, const Scalar& by) {
  const Scalar u = t * t, none(0.0);
  BeamMotion m{};
  m.chord = {none, 1.8 - 0.5 * t, 0.9 + 0.6 * t - u};
  m.slope = {Vec3<Scalar>{none, 1.02 + 0.4 * t, 0.5 - 0.9 * u}, Vec3<Scalar>{none, 0.4 + 0.6 * t, 0.93 - 0.2 * t + u}};
  Vec3<Scalar> e{none, none, none};
  e[coordinate % 3] = by;
  if (coordinate / 3 == 0) m.chord -= e;
  if (coordinate / 3 == 2) m.chord += e;
  if (coordinate / 3 == 4) m.slope[0] += e;
  if (coordinate / 3 == 5) m.slope[1] += e;
  return m;
}

template <class MotionOf>
void compare(const BeamElement& e, const MotionOf& motion_of) {
  const Scalar now(0.3, 1, 0);
  const BeamMotion here = motion_of(now, beam_coordinates, Scalar(0.0));
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const auto reading = [&](const BeamMotion& m, std::size_t derivative, std::size_t component) {
      return section_reading(e, m, g, derivative, component);
    };
    const auto axes_at = [&](double t) {
      const auto s = e.section_along(motion_of(Scalar(t), beam_coordinates, Scalar(0.0)), g);
      return Matrix3{value(s.axes.x), value(s.axes.y), value(s.axes.z)};
    };
    const Matrix3 R = axes_at(0.3);
    std::array<double, 3> angles{};
    for (std::size_t c = 0; c < 3; ++c) angles[c] = reading(here, 0, c).value;
    const Matrix3 turned = rotation_313(angles[0], angles[1], angles[2]);
    // Twice the step, and the differences of a fourth order.
    const double h = 1e-3;
    const auto spin = [&](double t) {
      const auto by = [&](double d) {
        return (0.5 / d) * rotation::logarithm(axes_at(t + d) * transpose(axes_at(t - d)));
      };
      return (4.0 / 3) * by(h) - (1.0 / 3) * by(2 * h);
    };
    const Vector w = spin(0.3), faster = (2.0 / 3 / h) * (spin(0.3 + h) - spin(0.3 - h)) -
                                         (1.0 / 12 / h) * (spin(0.3 + 2 * h) - spin(0.3 - 2 * h));
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t r = 0; r < 3; ++r) EXPECT_NEAR(turned(r, c), R(r, c), 1e-13);
      EXPECT_NEAR(reading(here, 1, c).value, w[c], 1e-9);
      EXPECT_NEAR(reading(here, 2, c).value, faster[c], 1e-7);
      for (std::size_t derivative = 0; derivative < 3; ++derivative) {
        const SectionReading found = reading(here, derivative, c);
        EXPECT_TRUE(found.has_gradient());
        for (std::size_t k = 0; k < beam_coordinates; ++k) {
          if (!e.turns_sections(k)) continue;
          const auto difference = [&](const Scalar& by) {
            return (reading(motion_of(now, k, by), derivative, c).value -
                    reading(motion_of(now, k, -by), derivative, c).value) /
                   (2 * step);
          };
          EXPECT_NEAR(found.by_position[k], difference(Scalar(step, 0, 0)), 1e-7) << derivative << " " << k;
          EXPECT_NEAR(found.by_rate[k], difference(Scalar(0, step, 0)), 1e-7) << derivative << " " << k;
          EXPECT_NEAR(found.by_acceleration[k], difference(Scalar(0, 0, step)), 1e-7) << derivative << " " << k;
        }
      }
    }
  }
}

TEST(SectionReading, follows_the_sections_of_a_beam_in_space) {
  compare(
      SpatialBeam(material, {section, section}, {1.9, 0.2, -0.1}, {turn({0.1, 0.05, -0.1}), turn({-0.2, -0.1, 0.3})}),
      in_space);
}

// Turned about itself by 0.4 at one end and by 0.7 at the other.
PlaneBeam plane_beam(double roll, double other) {
  const auto axes = [](double heading, double by) {
    const Vector x{0, std::cos(heading), std::sin(heading)}, y{0, -std::sin(heading), std::cos(heading)}, n{1, 0, 0};
    return Matrix3{x, std::cos(by) * y + std::sin(by) * n, std::cos(by) * n - std::sin(by) * y};
  };
  return {plane, material, {section, section}, {0, 1.9, 0.2}, {axes(0.2, roll), axes(-0.3, other)}};
}

TEST(SectionReading, follows_the_sections_of_a_beam_in_a_plane) { compare(plane_beam(0.4, 0.7), in_plane); }

// Where z of the section is along the global axis only the sum of two angles is known, and nothing that turns it away.
TEST(SectionReading, has_no_gradient_where_an_angle_has_none) {
  const BeamMotion straight = [] {
    BeamMotion m{};
    const auto still = [](const Vector& v) { return Vec3<Scalar>{Scalar(v.x), Scalar(v.y), Scalar(v.z)}; };
    m.chord = still({2, 0, 0});
    m.slope = {still({1, 0, 0}), still({1, 0, 0})};
    for (auto& axes : m.axes) axes = {still({1, 0, 0}), still({0, 1, 0}), still({0, 0, 1})};
    return m;
  }();
  const SpatialBeam e(material, {section, section}, {2, 0, 0}, {Matrix3::identity(), Matrix3::identity()});
  EXPECT_FALSE(section_reading(e, straight, 1, 0, 0).has_gradient());
  EXPECT_TRUE(section_reading(e, straight, 1, 1, 0).has_gradient());
  // A beam that stays across that axis keeps the sum, which is the first angle.
  const PlaneBeam in_xy({0, 1, 2}, material, {section, section}, {2, 0, 0}, {Matrix3::identity(), Matrix3::identity()});
  const SectionReading psi = section_reading(in_xy, straight, 1, 0, 0);
  EXPECT_TRUE(psi.has_gradient());
  const auto spins = in_xy.spins(straight);
  for (std::size_t k = 0; k < beam_coordinates; ++k) EXPECT_NEAR(psi.by_position[k], spins[1][k].z, 1e-14) << k;
}

}  // namespace
}  // namespace dynalin::section_reading_test
