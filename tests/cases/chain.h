// A loaded and moving chain of two bodies in space, joined by the constraint under test or by the same as GCONs.
#pragma once

#include "cases/dataset_text.h"

namespace dynalin::cases {

using Pieces = std::vector<std::string>;

inline Matrix3 about(const Vector& axis, double angle) {
  const Vector u = axis / norm(axis);
  const Matrix3 K = skew(u), one = Matrix3::identity();
  return one + std::sin(angle) * K + (1 - std::cos(angle)) * (K * K);
}

struct Held {
  std::string name;
  std::string statement;  // the element between I=31 and J=22
  Vector p;               // I seen from J as drawn, where the element holds
  Matrix3 axes;
  Pieces functions;          // the same as GCONs
  std::string helpers = {};  // statements that those need
  bool at_rest = false;      // drawn without velocities
};
inline void PrintTo(const Held& h, std::ostream* out) { *out << h.name; }

// Two bodies in a chain on a ball, pulled by springs, turning; the element under test joins them.
inline std::string mechanism(const Held& h, bool as_functions) {
  std::string s = "Chain\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=1.7, JGRAV=-2.3, KGRAV=-8.9\nPART/1, GROUND\n";
  const Matrix3 R2 = rotation_313(0.3, 0.5, -0.2), R3 = rotation_313(-0.7, 1.1, 0.4), F = rotation_313(0.4, 0.9, 0.3);
  const Vector o2{0.3, 0.2, -0.1}, o3{0.9, 0.3, -0.5}, joint{0.6, 0.3, -0.2};
  s += fmt::format("PART/2, MASS=2, CM=20, IP=0.2,0.3,0.25,0.01,-0.02,0.015, QG={}, REULER={}{}\n", xyz(o2), reuler(R2),
                   h.at_rest ? "" : ", WX=0.4, WY=-0.6, WZ=0.9");
  s += fmt::format("PART/3, MASS=1.5, CM=30, IP=0.1,0.15,0.12,-0.01,0.005,0.01, QG={}, REULER={}\n", xyz(o3),
                   reuler(R3));
  const auto marker = [&](int id, int body, const Vector& p, const Matrix3& axes) {
    const Vector local = body == 1 ? p : body == 2 ? transpose_times(R2, p - o2) : transpose_times(R3, p - o3);
    const Matrix3 local_axes = body == 1 ? axes : transpose_times(body == 2 ? R2 : R3, axes);
    s += fmt::format("MARKER/{}, PART={}, QP={}, REULER={}\n", id, body, xyz(local), reuler(local_axes));
  };
  marker(20, 2, {0.35, 0.2, -0.15}, R2), marker(30, 3, {0.95, 0.25, -0.6}, R3);
  marker(1, 1, {0, 0, 0}, F), marker(21, 2, {0, 0, 0}, F), marker(22, 2, joint, F);
  const Vector at = joint + F * h.p;
  const Matrix3 axes = F * h.axes;
  marker(31, 3, at, axes);
  for (int k = 0; k < 3; ++k) marker(311 + k, 3, at + axes[static_cast<std::size_t>(k)], axes);
  marker(32, 3, {1.3, 0.1, -0.8}, F), marker(33, 3, {0.7, 0.6, -0.9}, F);
  marker(2, 1, {1.5, 0.5, 0.8}, F), marker(3, 1, {-0.8, 0.9, 0.4}, F), marker(4, 1, {0.5, -1.2, 0.3}, F),
      marker(5, 1, {1.9, -0.4, -0.6}, F);
  s += "JOINT/1, SPHERICAL, I=21, J=1\n";
  int id = 1;
  for (const auto& [i, j, k, c, l] : std::vector<std::tuple<int, int, double, double, double>>{{20, 3, 180, 3, 0.9},
                                                                                               {20, 4, 90, 1, 1.1},
                                                                                               {30, 2, 120, 1, 1.0},
                                                                                               {32, 2, 60, 0.5, 0.8},
                                                                                               {33, 3, 80, 0.7, 1.5},
                                                                                               {32, 5, 70, 2, 0.3},
                                                                                               {33, 4, 50, 1, 1.2}}) {
    s += fmt::format("SPRINGDAMPER/{}, TRANSLATIONAL, I={}, J={}, K={}, C={}, LENGTH={}\n", id++, i, j, k, c, l);
  }
  if (!as_functions) {
    s += h.statement + "\n";
  } else {
    s += h.helpers;
    for (std::size_t k = 0; k < h.functions.size(); ++k)
      s += fmt::format("GCON/{}, FUNCTION={}\n", k + 1, h.functions[k]);
  }
  return s + "END\n";
}

}  // namespace dynalin::cases
