#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "elements/forces/friction_law.h"

namespace dynalin::friction_test {
namespace {

using One = std::array<double, 1>;

// s along one direction for b and σ, written by cases.
double direction(double b, double sigma) {
  if (b < 0) return -direction(-b, -sigma);
  return sigma + (1 - sigma) * b * b + (1 - sigma * sigma) * b * (1 - b);
}
double step(double x) { return std::abs(x) < 1 ? x * (3 - x * x) / 2 : std::copysign(1.0, x); }

TEST(FrictionLaw, direction_is_that_of_creep_at_rest_and_of_slip_in_sliding) {
  FrictionLaw law;
  for (const double z : {-0.01, -0.004, 0.0, 0.006, 0.012}) {
    for (const double u : {-0.2, -0.1, -0.03, 0.0, 0.05, 0.1, 0.11, 3.0})
      EXPECT_NEAR(law.direction(One{u}, One{z})[0], direction(step(u / 0.1), step(z / 0.01)), 1e-15) << u << " " << z;
  }
}

TEST(FrictionLaw, rises_with_slip_and_creep_and_never_passes_one) {
  FrictionLaw law;
  for (double z = -0.011; z < 0.011; z += 0.0005) {
    for (double u = -0.12; u < 0.12; u += 0.003) {
      const double s = law.direction(One{u}, One{z})[0];
      EXPECT_LE(std::abs(s), 1 + 1e-15);
      EXPECT_GE(law.direction(One{u + 1e-4}, One{z})[0], s - 1e-15);
      EXPECT_GE(law.direction(One{u}, One{z + 1e-5})[0], s - 1e-15);
    }
  }
}

TEST(FrictionLaw, a_turned_slip_turns_the_friction) {
  FrictionLaw law;
  const double c = 0.6, s = 0.8;
  const auto turned = [&](const std::array<double, 2>& v) {
    return std::array{c * v[0] - s * v[1], s * v[0] + c * v[1]};
  };
  const std::array<double, 2> u = {0.05, -0.03}, z = {0.0092, 0.001};
  const auto a = turned(law.direction(u, z)), b = law.direction(turned(u), turned(z));
  const auto d = turned(law.creep_rate(u, z)), e = law.creep_rate(turned(u), turned(z));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(a[k], b[k], 1e-15);
    EXPECT_NEAR(d[k], e[k], 1e-15);
  }
}

TEST(FrictionLaw, derivatives_hold_where_nothing_moves) {
  FrictionLaw law;
  using D = Dual<2>;
  for (const double z : {0.0, 0.005, 0.0085}) {
    const D s = law.direction(std::array{D(0.0, 0)}, std::array{D(z, 1)})[0];
    const double sigma = step(z / 0.01), x = z / 0.01;
    EXPECT_NEAR(s.value, sigma, 1e-15);
    EXPECT_NEAR(s.partial[0], 1.5 / 0.1 * (1 - sigma * sigma), 1e-12);
    EXPECT_NEAR(s.partial[1], 1.5 / 0.01 * (1 - x * x), 1e-11);
    const D rate = law.creep_rate(std::array{D(0.0, 0)}, std::array{D(z, 1)})[0];
    EXPECT_EQ(rate.partial[0], 1);
    EXPECT_EQ(rate.partial[1], 0);
  }
}

TEST(FrictionLaw, bristles_stay_within_the_largest_deformation_and_spring_back_freely) {
  FrictionLaw law;
  EXPECT_EQ(law.creep_rate(One{2}, One{0.005})[0], 2);
  EXPECT_EQ(law.creep_rate(One{2}, One{0.01})[0], 0);
  EXPECT_NEAR(law.creep_rate(One{2}, One{0.0095})[0], 1, 1e-12);
  EXPECT_EQ(law.creep_rate(One{-2}, One{0.01})[0], -2);
}

TEST(FrictionLaw, coefficient_follows_the_regime_and_the_effect) {
  FrictionLaw law;
  EXPECT_EQ(law.coefficient(0.1), 0.5);
  EXPECT_NEAR(law.coefficient(0.125), 0.4, 1e-15);
  EXPECT_EQ(law.coefficient(0.2), 0.3);
  law.effect = FrictionEffect::sliding;
  EXPECT_EQ(law.coefficient(0.0), 0.3);
  EXPECT_NEAR(law.direction(One{0.05}, One{0.009})[0], step(0.5), 1e-15);
  law.effect = FrictionEffect::stiction;
  EXPECT_EQ(law.coefficient(0.2), 0.5);
  EXPECT_EQ(law.direction(One{0.2}, One{0.01})[0], 0);
  EXPECT_NEAR(law.direction(One{0.125}, One{0.01})[0], 0.5, 1e-12);
}

// Sliding at a constant velocity bends bristles until z' = 0: s = 1 and the viscous part, and springs back by rest.
TEST(FrictionLaw, lugre_slides_with_its_coefficient_and_the_viscous_part) {
  FrictionLaw law;
  law.formulation = FrictionFormulation::lugre;
  law.bristle_damping = 0.2, law.viscosity = 0.03;
  for (const double u : {-0.4, -0.05, 0.02, 0.1, 3.0}) {
    const double g = 0.3 + 0.2 * std::exp(-u * u / 0.01), z = std::copysign(g / 50, u);
    EXPECT_NEAR(law.coefficient(std::abs(u)), g, 1e-15);
    EXPECT_NEAR(law.creep_rate(One{u}, One{z})[0], 0, 1e-15);
    EXPECT_NEAR(g * law.direction(One{u}, One{z})[0], std::copysign(g, u) + 0.03 * u, 1e-14);
    EXPECT_NEAR(law.creep_rate(One{u}, One{-z})[0], 2 * u, 1e-14);
  }
  using D = Dual<2>;
  const D s = law.direction(std::array{D(0.0, 0)}, std::array{D(0.004, 1)})[0];
  EXPECT_NEAR(s.value, 0.4, 1e-15);
  EXPECT_NEAR(s.partial[0], 0.23 / 0.5, 1e-15);
  EXPECT_NEAR(s.partial[1], 50 / 0.5, 1e-12);
}

}  // namespace
}  // namespace dynalin::friction_test
