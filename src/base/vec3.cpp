#include "base/vec3.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynalin {

Matrix3 rotation_exponential(const Vector& a) {
  const double angle_squared = dot(a, a);
  const double angle = std::sqrt(angle_squared);
  // sin(s)/s and (1 − cos s)/s² by series where the quotients lose digits.
  double sinc = 1.0 - angle_squared / 6.0 * (1.0 - angle_squared / 20.0);
  double cosc = 0.5 * (1.0 - angle_squared / 12.0 * (1.0 - angle_squared / 30.0));
  if (angle > 1e-2) {
    const double half = std::sin(0.5 * angle);
    sinc = std::sin(angle) / angle;
    cosc = 2.0 * half * half / angle_squared;
  }
  return Matrix3::identity() + sinc * skew(a) + cosc * (outer(a, a) - Matrix3::diagonal(angle_squared));
}

namespace {

struct SineCosine {
  double s, c;
};

// π/2 is no double: the cosine of 90 degrees comes out as 6e-17. What lies within the rounding of the angle itself is
// taken as the exact zero that is meant.
SineCosine sine_cosine(double angle) {
  const double rounding = std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(angle));
  double s = std::sin(angle), c = std::cos(angle);
  if (std::abs(s) < rounding) s = 0, c = std::copysign(1.0, c);
  if (std::abs(c) < rounding) c = 0, s = std::copysign(1.0, s);
  return {s, c};
}

}  // namespace

Matrix3 rotation_313(double psi, double theta, double phi) {
  const auto about_z = [](double angle) {
    const auto [s, c] = sine_cosine(angle);
    return Matrix3{{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
  };
  const auto [s, c] = sine_cosine(theta);
  const Matrix3 about_x{{1, 0, 0}, {0, c, s}, {0, -s, c}};
  return about_z(psi) * about_x * about_z(phi);
}

Matrix3 orthonormalized(const Matrix3& m) {
  // One Newton step of the polar decomposition removes an error ε down to ε².
  const Matrix3 excess = transpose_times(m, m) - Matrix3::identity();
  return m - 0.5 * (m * excess);
}

}  // namespace dynalin
