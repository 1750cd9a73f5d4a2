// What the parts of a beam element share: its Gauss points, its cubics, and where its coordinates stand.
#pragma once

#include <Eigen/Core>
#include <array>

#include "flexible/beam_element.h"

namespace dynalin::beam {

// Gauss points from −1 to 1. Three are exact for the strains of a straight element and for its rotational inertia, four
// for the products of cubics with an area or a load that varies along it.
inline constexpr std::array<double, 3> three_places = {-0.77459666924148337704, 0.0, 0.77459666924148337704};
inline constexpr std::array<double, 3> three_weights = {5.0 / 9, 8.0 / 9, 5.0 / 9};
inline constexpr std::array<double, 4> four_places = {-0.86113631159405257522, -0.33998104358485626480,
                                                      0.33998104358485626480, 0.86113631159405257522};
inline constexpr std::array<double, 4> four_weights = {0.34785484513745385737, 0.65214515486254614263,
                                                       0.65214515486254614263, 0.34785484513745385737};

// Where the coordinates of the cubics r₁, r_s1, r₂, r_s2 stand.
inline constexpr std::array<Eigen::Index, 4> cubic_at = {0, 12, 6, 15};

inline std::array<double, 4> cubics(double x, double length) {
  const double a = 0.5 * (1 + x), a2 = a * a, a3 = a2 * a;
  return {1 - 3 * a2 + 2 * a3, length * (a - 2 * a2 + a3), 3 * a2 - 2 * a3, length * (a3 - a2)};
}

// S of a section, times its density.
inline Matrix3 second_moments(const BeamSection& s, double density) {
  Matrix3 S;
  S(1, 1) = density * s.zz, S(2, 2) = density * s.yy;
  S(1, 2) = S(2, 1) = density * s.yz;
  return S;
}

template <class T>
Vector values(const Vec3<T>& v) {
  return {value_of(v.x), value_of(v.y), value_of(v.z)};
}
template <class T>
Matrix3 values(const Mat3<T>& m) {
  return {values(m.x), values(m.y), values(m.z)};
}

}  // namespace dynalin::beam
