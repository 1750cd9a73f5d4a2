// Pieces of dataset text from numbers, and comparison of spectra without order.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "base/vec3.h"
#include "cases/run.h"

namespace dynalin::cases {

// 3-1-3 angles of a rotation.
inline std::string reuler(const Matrix3& R) {
  const double theta = std::acos(std::clamp(R(2, 2), -1.0, 1.0));
  const double psi = std::atan2(R(0, 2), -R(1, 2)), phi = std::atan2(R(2, 0), R(2, 1));
  return fmt::format("{:.17g},{:.17g},{:.17g}", psi, theta, phi);
}
inline std::string xyz(const Vector& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); }

// Order-free comparison: sorted by imaginary part, then real.
inline void expect_same(std::vector<std::complex<double>> a, std::vector<std::complex<double>> b,
                        double relative = 1e-9) {
  ASSERT_EQ(a.size(), b.size());
  double largest = 0;  // zeros are known to rounding of the largest only
  for (const auto& x : a) largest = std::max(largest, std::abs(x));
  for (const auto& x : a) {
    const auto nearest =
        std::min_element(b.begin(), b.end(), [&](auto p, auto q) { return std::abs(p - x) < std::abs(q - x); });
    EXPECT_LE(std::abs(*nearest - x), std::max(relative * std::abs(x), 1e-13 * largest)) << x << " against " << *nearest;
    b.erase(nearest);
  }
}

}  // namespace dynalin::cases
