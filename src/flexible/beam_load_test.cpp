#include "flexible/beam_load.h"

#include <gtest/gtest.h>

#include "flexible/plane_beam.h"
#include "flexible/spatial_beam.h"

namespace dynalin::beam_load_test {

namespace {

SpatialBeam bent_element() {
  const BeamSection section{1.5, 0.9, 0.4, 0.7, 0.15, 1.2, 1.3};
  return {{3.0, 200.0, 80.0, 0},
          {section, section},
          {1.9, 0.2, -0.1},
          {rotation::exponential(Vector{0.1, 0.05, -0.1}), rotation::exponential(Vector{-0.2, -0.1, 0.3})}};
}

// The spins θ of both ends and φ moved by a little from a turned place.
struct Moved {
  Matrix3 R1, R2;
  Vector phi;
};
Moved moved(std::size_t seed, double by) {
  Moved m{
      rotation::exponential(Vector{0.2, 0.3, -0.1}), rotation::exponential(Vector{0.5, -0.4, 0.6}), {0.05, -0.13, 0.1}};
  Vector e;
  e[seed % 3] = by;
  if (seed / 3 == 0) m.R1 = rotation::exponential(e) * m.R1;
  if (seed / 3 == 1) m.R2 = rotation::exponential(e) * m.R2;
  if (seed / 3 == 2) m.phi += e;
  return m;
}
BeamMotion motion_of(const Moved& m) {
  BeamMotion out{};
  const auto still = [](const Vector& v) { return Vec3<BeamMotion::Scalar>{{v.x, 0, 0}, {v.y, 0, 0}, {v.z, 0, 0}}; };
  out.chord = still({2, 0.3, 0.1});
  out.axes = {Mat3<BeamMotion::Scalar>{still(m.R1.x), still(m.R1.y), still(m.R1.z)},
              Mat3<BeamMotion::Scalar>{still(m.R2.x), still(m.R2.y), still(m.R2.z)}};
  out.slope = {still(m.R1.x), still(m.R2.x)};
  out.middle = still(m.phi);
  return out;
}
constexpr std::array<Eigen::Index, rotation_seeds> coordinate = {3, 4, 5, 9, 10, 11, 18, 19, 20};
constexpr double step = 1e-5;

}  // namespace

TEST(BeamLoad, forces_work_on_the_cubic_and_moments_on_the_spin_of_the_section) {
  const SpatialBeam e = bent_element();
  const auto points = beam_load_points_of(e, motion_of(moved(0, 0)), true);
  double whole = 0;
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const double weight = points[g].line[0] + points[g].line[2], x = beam_load_place(g);
    whole += weight;
    EXPECT_NEAR(points[g].line[2], weight * x * x * (3 - 2 * x), 1e-14);
    EXPECT_NEAR(points[g].line[1], weight * e.length() * x * (1 - x) * (1 - x), 1e-14);
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      const auto axes = [&](double by) {
        const Moved m = moved(i, by);
        return SectionRotation<double>(RotationField<double>(m.R1, m.R2, m.phi), 2 * x - 1, e.length()).R;
      };
      const Vector spin = (0.5 / step) * rotation::logarithm(axes(step) * transpose(axes(-step)));
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(points[g].turning[static_cast<std::size_t>(coordinate[i])][k], weight * spin[k], 1e-9) << i;
    }
  }
  EXPECT_NEAR(whole, e.length(), 1e-14);
}

TEST(BeamLoad, of_moments_changes_with_the_turning_of_sections) {
  const SpatialBeam e = bent_element();
  const std::array<Vector, beam_load_points> moments = {Vector{1, -2, 3}, {0.5, 2, -1}, {-2, 1, 1}, {0.3, -1, 0.7}};
  const BeamMatrix partials = beam_moments_by_position(e, motion_of(moved(0, 0)), moments);
  const auto loads = [&](std::size_t seed, double by) {
    BeamVector sum = BeamVector::Zero();
    const auto points = beam_load_points_of(e, motion_of(moved(seed, by)), true);
    for (std::size_t g = 0; g < beam_load_points; ++g) points[g].add({}, moments[g], sum);
    return sum;
  };
  EXPECT_GT(partials.norm(), 1);
  for (std::size_t i = 0; i < rotation_seeds; ++i) {
    const BeamVector difference = (loads(i, step) - loads(i, -step)) / (2 * step);
    EXPECT_LT((partials.col(coordinate[i]) - difference).norm(), 1e-9) << i;
  }
}

}  // namespace dynalin::beam_load_test
