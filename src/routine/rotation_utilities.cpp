// RCNVRT: rotations from one description into another, and the same under the name by which Fortran calls it.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "dataset/characters.h"
#include "routine/utilities.h"

namespace dynalin {

namespace {

using Rotation = Eigen::Quaterniond;

// Angles about three axes of the body, one after the other.
struct AngleSequence {
  std::string_view name;
  std::array<int, 3> axes;
};
constexpr std::array<AngleSequence, 6> sequences = {{{"EULER", {2, 0, 2}},
                                                     {"B313", {2, 0, 2}},
                                                     {"B321", {2, 1, 0}},
                                                     {"B312", {2, 0, 1}},
                                                     {"B323", {2, 1, 2}},
                                                     {"B123", {0, 1, 2}}}};

Rotation from_angles(const std::array<int, 3>& axes, const double* angles) {
  Rotation q = Rotation::Identity();
  for (std::size_t k = 0; k < 3; ++k) q = q * Eigen::AngleAxisd(angles[k], Eigen::Vector3d::Unit(axes[k]));
  return q;
}

double wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

// E. Bernardes, S. Viollet, Quaternion to Euler angles conversion: a direct, general and computationally efficient
// method (2022), for turns about fixed axes, which are those of the body in reverse. Where two axes coincide the last
// angle is 0.
void to_angles(const std::array<int, 3>& axes, const Rotation& q, double* angles) {
  const std::size_t i = static_cast<std::size_t>(axes[2]), j = static_cast<std::size_t>(axes[1]);
  const bool proper = axes[0] == axes[2];
  const std::size_t k = proper ? 3 - i - j : static_cast<std::size_t>(axes[0]);
  const double sign = (j == (i + 1) % 3) ? 1 : -1;
  const std::array<double, 3> v = {q.x(), q.y(), q.z()};
  const double a = proper ? q.w() : q.w() - v[j], b = proper ? v[i] : v[i] + sign * v[k];
  const double c = proper ? v[j] : v[j] + q.w(), d = proper ? sign * v[k] : sign * v[k] - v[i];
  const double both = std::hypot(a, b), other = std::hypot(c, d);
  double middle = 2 * std::atan2(other, both);
  const double plus = std::atan2(b, a), minus = std::atan2(d, c);
  constexpr double part_that_vanishes = 1e-14;
  double last = 0, first = 0;
  if (other <= part_that_vanishes * both) {
    first = 2 * plus;
  } else if (both <= part_that_vanishes * other) {
    first = 2 * minus;
  } else {
    last = plus - minus, first = plus + minus;
  }
  if (!proper) first *= sign, middle -= M_PI / 2;
  angles[0] = wrapped(first), angles[1] = middle, angles[2] = wrapped(last);
}

// Nothing if there is no such description, or a rotation cannot be made of it.
std::optional<Rotation> rotation_of(std::string_view system, const double* from) {
  for (const AngleSequence& s : sequences) {
    if (s.name == system) return from_angles(s.axes, from);
  }
  if (system == "EULPAR" || system == "RODPAR") {
    const bool whole = system == "EULPAR";
    const Rotation q = whole ? Rotation(from[0], from[1], from[2], from[3]) : Rotation(1, from[0], from[1], from[2]);
    return q.norm() > 0 && std::isfinite(q.norm()) ? std::optional(q.normalized()) : std::nullopt;
  }
  if (system == "YPR") {
    const std::array<double, 3> turned = {from[0], -from[1], from[2]};
    return from_angles({2, 1, 0}, turned.data());
  }
  if (system == "COSINES") {
    const Eigen::Matrix3d R = Eigen::Map<const Eigen::Matrix3d>(from);
    const bool orthonormal = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6;
    return orthonormal && R.determinant() > 0 ? std::optional(Rotation(R).normalized()) : std::nullopt;
  }
  return std::nullopt;
}

bool write_rotation(std::string_view system, const Rotation& q, double* to) {
  for (const AngleSequence& s : sequences) {
    if (s.name != system) continue;
    to_angles(s.axes, q, to);
    return true;
  }
  const Eigen::Matrix3d R = q.toRotationMatrix();
  if (system == "EULPAR") {
    const double sign = q.w() < 0 ? -1 : 1;
    to[0] = sign * q.w(), to[1] = sign * q.x(), to[2] = sign * q.y(), to[3] = sign * q.z();
  } else if (system == "RODPAR") {
    if (std::abs(q.w()) < 1e-14) return false;  // half a turn has none
    to[0] = q.x() / q.w(), to[1] = q.y() / q.w(), to[2] = q.z() / q.w();
  } else if (system == "YPR") {
    to_angles({2, 1, 0}, q, to);
    to[1] = -to[1];
  } else if (system == "AXAYAZ") {  // as the functions AX, AY, AZ have them
    to[0] = std::atan2(-R(1, 2), R(2, 2)), to[1] = std::atan2(R(0, 2), R(2, 2)), to[2] = std::atan2(R(1, 0), R(0, 0));
  } else if (system == "COSINES") {
    Eigen::Map<Eigen::Matrix3d> all(to);
    all = R;
  } else {
    return false;
  }
  return true;
}

void convert(std::string_view from, const double* coordinates, std::string_view to, double* converted, int* istat) {
  const auto rotation = rotation_of(upper_case(from), coordinates);
  *istat = !rotation || !write_rotation(upper_case(to), *rotation, converted);
}

}  // namespace

void keep_rotation_utilities() {}

}  // namespace dynalin

extern "C" {

void c_rcnvrt(const char* sys1, const double* coord1, const char* sys2, double* coord2, int* istat) {
  dynalin::convert(sys1, coord1, sys2, coord2, istat);
}
void rcnvrt_(const char* sys1, const double* coord1, const char* sys2, double* coord2, int* istat, std::size_t length1,
             std::size_t length2) {
  dynalin::convert(dynalin::text_of(sys1, length1), coord1, dynalin::text_of(sys2, length2), coord2, istat);
}

}  // extern "C"
