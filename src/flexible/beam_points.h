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

// Where the coordinates of the cubics r₁, r_s1, r₂, r_s2 and those of the spins stand.
inline constexpr std::array<Eigen::Index, 4> cubic_at = {0, 12, 6, 15};
inline constexpr std::array<Eigen::Index, 3> spin_at = {3, 9, 18};
constexpr Eigen::Index spin_place(std::size_t i) { return spin_at[i / 3] + static_cast<Eigen::Index>(i % 3); }

inline std::array<double, 4> cubics(double x, double length) {
  const double a = 0.5 * (1 + x), a2 = a * a, a3 = a2 * a;
  return {1 - 3 * a2 + 2 * a3, length * (a - 2 * a2 + a3), 3 * a2 - 2 * a3, length * (a3 - a2)};
}

template <class T>
Vector values(const Vec3<T>& v) {
  return {value_of(v.x), value_of(v.y), value_of(v.z)};
}
template <class T>
Matrix3 values(const Mat3<T>& m) {
  return {values(m.x), values(m.y), values(m.z)};
}

// Rotations with what the spins of both ends and φ, the variations of a rotation field, make of them.
using Turning = Dual<rotation_seeds>;

inline Mat3<Turning> turned(const Mat3<BeamMotion::Scalar>& R, std::size_t first) {
  Mat3<Turning> out;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector axis = values(R[c]);
    for (std::size_t r = 0; r < 3; ++r) out(r, c) = Turning(axis[r]);
    for (std::size_t k = 0; k < 3; ++k) {
      Vector e;
      e[k] = 1;
      const Vector by = cross(e, axis);
      for (std::size_t r = 0; r < 3; ++r) out(r, c).partial[first + k] = by[r];
    }
  }
  return out;
}
inline RotationField<Turning> varied(const BeamMotion& m) {
  Vec3<Turning> phi;
  for (std::size_t k = 0; k < 3; ++k) phi[k] = Turning(m.middle[k].value, 6 + k);
  return {turned(m.axes[0], 0), turned(m.axes[1], 3), phi};
}

}  // namespace dynalin::beam
