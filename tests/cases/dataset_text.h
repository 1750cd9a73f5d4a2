// Pieces of dataset text from numbers, and comparison of spectra without order.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/vec3.h"
#include "cases/run.h"

namespace dynalin::cases {

// 3-1-3 angles of a rotation.
inline std::string reuler(const Matrix3& R) {
  const double theta = std::acos(std::clamp(R(2, 2), -1.0, 1.0));
  if (R(2, 2) == 1.0) return fmt::format("{:.17g},0,0", std::atan2(R(1, 0), R(0, 0)));
  const double psi = std::atan2(R(0, 2), -R(1, 2)), phi = std::atan2(R(2, 0), R(2, 1));
  return fmt::format("{:.17g},{:.17g},{:.17g}", psi, theta, phi);
}
inline std::string xyz(const Vector& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); }

// A parallelogram that turns: crank, coupler and rocker of mass 1, radius of gyration of the cranks about their hinges
// 5/4, the spring alone moves it, w² = K/(5/4 + 5/4 + 1), whatever the crank's angle and speed.
inline std::string parallelogram(double angle, double speed, double stiffness) {
  const double c = std::cos(angle), s = std::sin(angle);
  return fmt::format(
      "Parallelogram\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=2,0,0\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1, REULER={0:.17g},0,0, WZ={1:.17g}\nMARKER/20, QP=0.5,0,0\nMARKER/21\n"
      "MARKER/22, QP=1,0,0\nPART/3, MASS=1, CM=30, IP=1,1,1, QG={2:.17g},{3:.17g},0, VX={4:.17g}, VY={5:.17g}\n"
      "MARKER/30, QP=1,0,0\nMARKER/31\nMARKER/32, QP=2,0,0\n"
      "PART/4, MASS=1, CM=40, IP=1,1,1, QG=2,0,0, REULER={0:.17g},0,0, WZ={1:.17g}\nMARKER/40, QP=0.5,0,0\nMARKER/41\n"
      "MARKER/42, QP=1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\nJOINT/3, REVOLUTE, I=41, J=2\n"
      "JOINT/4, REVOLUTE, I=32, J=42\nSPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT={6:.17g}, CT=0, ANGLE=0\nEND\n",
      angle, speed, c, s, -speed * s, speed * c, stiffness);
}

// Order-free comparison: sorted by imaginary part, then real.
inline void expect_same(std::vector<std::complex<double>> a, std::vector<std::complex<double>> b,
                        double relative = 1e-9) {
  ASSERT_EQ(a.size(), b.size());
  double largest = 0;  // zeros are known to rounding of the largest only
  for (const auto& x : a) largest = std::max(largest, std::abs(x));
  for (const auto& x : a) {
    const auto nearest =
        std::min_element(b.begin(), b.end(), [&](auto p, auto q) { return std::abs(p - x) < std::abs(q - x); });
    EXPECT_LE(std::abs(*nearest - x), std::max(relative * std::abs(x), 1e-13 * largest))
        << x << " against " << *nearest;
    b.erase(nearest);
  }
}

// Two bodies on a ball and springs, turning and moving in all directions, with more elements. Ground has the markers
// 1–4, part 2 the markers 20–22, part 3 the markers 30 and 31; nothing is aligned.
inline std::string two_bodies(const std::string& more) {
  return "Two bodies\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=0.4, JGRAV=-9, KGRAV=1.2\nPART/1, GROUND\nMARKER/1, "
         "REULER=0.3,0.4,0.5\n"
         "MARKER/2, QP=1,0.5,0\nMARKER/3, QP=-0.5,1,0.3\nMARKER/4, QP=0.2,-0.9,1\n"
         "PART/2, MASS=2, CM=20, IP=0.2,0.3,0.25, QG=0.1,0.2,-0.1, REULER=0.2,0.1,-0.3, WX=0.4, WY=-0.6, WZ=0.9, "
         "VX=0.3, VY=0.2, VZ=-0.5\n"
         "MARKER/20\nMARKER/21, QP=0.2,0.1,0, REULER=0.5,0.2,0.1\nMARKER/22, QP=-0.1,0.2,0.15\n"
         "PART/3, MASS=1, CM=30, IP=0.1,0.15,0.12, QG=0.7,0.1,0.4, WX=0.2, WY=0.3, WZ=-0.7, VX=0.1, VY=-0.2, "
         "VZ=0.5\nMARKER/30\nMARKER/31, QP=0.1,-0.2,0.1, REULER=0.7,0.9,0.2\n"
         "JOINT/1, SPHERICAL, I=22, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K=90, C=1, LENGTH=0.6\n"
         "SPRINGDAMPER/2, TRANSLATIONAL, I=21, J=3, K=70, C=1, LENGTH=0.7\nSPRINGDAMPER/3, TRANSLATIONAL, I=30, J=4, "
         "K=50, C=2, LENGTH=0.4\n"
         "SPRINGDAMPER/4, TRANSLATIONAL, I=31, J=21, K=60, C=1, LENGTH=0.3\nSPRINGDAMPER/5, TRANSLATIONAL, I=31, J=3, "
         "K=40, C=1, LENGTH=0.3\n"
         "SPRINGDAMPER/6, TRANSLATIONAL, I=30, J=2, K=45, C=1, LENGTH=0.2\n" +
         more + "END\n";
}

}  // namespace dynalin::cases
