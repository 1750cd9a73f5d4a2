#include "expression/measured_angles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/dual.h"

namespace dynalin::measured_angles_test {
namespace {

using D = Dual<2>;

// Turned about z by the first seed, then about the new x by the second one, then about the new z.
MeasureFrames<D> turned(double psi, double theta, double phi) {
  const D a(psi, 0), b(theta, 1);
  const D ca = cos(a), sa = sin(a), cb = cos(b), sb = sin(b);
  const double cc = std::cos(phi), sc = std::sin(phi);
  MeasureFrames<D> f;
  const D none(0.0), one(1.0);
  f.j.axes = {Vec3<D>{one, none, none}, Vec3<D>{none, one, none}, Vec3<D>{none, none, one}};
  const Vec3<D> x{ca, sa, none}, y{-sa * cb, ca * cb, sb};
  f.i.axes = {x * cc + y * sc, y * cc - x * sc, Vec3<D>{sa * sb, -ca * sb, cb}};
  return f;
}

TEST(MeasuredAngles, sum_of_psi_and_phi_has_a_gradient_where_neither_of_them_has_one) {
  for (const double phi : {0.4, -2.9}) {
    const MeasureFrames<D> f = turned(0.7, 0, phi);
    const D sum = measured::psi_with_phi(f, 1.0);
    EXPECT_NEAR(std::remainder(sum.value - 0.7 - phi, 2 * M_PI), 0, 1e-15);
    EXPECT_NEAR(sum.partial[0], 1, 1e-15);
    EXPECT_TRUE(std::isnan(measured::psi_and_phi(f).last.partial[1]));
  }
}

TEST(MeasuredAngles, sums_are_in_the_turn_of_their_angles) {
  EXPECT_NEAR(measured::psi_with_phi(turned(2.5, 0.1, 2.8), 1.0).value, 5.3, 1e-14);
  EXPECT_NEAR(measured::psi_with_phi(turned(2.5, 3.1, -2.8), -1.0).value, 5.3, 1e-14);
}

// On both sides of where the series ends, at 1 - cos θ = 0.2.
TEST(MeasuredAngles, square_of_theta_has_no_kink) {
  EXPECT_EQ(measured::theta_squared(turned(0.3, 0, 0.2)).partial[1], 0);
  for (const double theta : {1e-6, 0.1, 0.64, 0.65, 2.0}) {
    const D squared = measured::theta_squared(turned(0.3, theta, 0.2));
    EXPECT_NEAR(squared.value, theta * theta, 1e-14 * theta);
    EXPECT_NEAR(squared.partial[1], 2 * theta, 1e-13);
  }
}

}  // namespace
}  // namespace dynalin::measured_angles_test
