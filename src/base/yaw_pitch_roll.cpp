#include "base/yaw_pitch_roll.h"

#include <cmath>

namespace dynalin {

std::array<double, 3> yaw_pitch_roll(const Matrix3& R) {
  constexpr double cosine_of_vertical = 1e-12;
  const Vector &x = R[0], &y = R[1], &z = R[2];
  const double level = std::hypot(x.x, x.y), pitch = std::atan2(x.z, level);
  if (level > cosine_of_vertical) return {std::atan2(x.y, x.x), pitch, std::atan2(y.z, z.z)};
  const double sign = x.z > 0 ? 1.0 : -1.0;
  return {std::atan2(-y.x - sign * z.y, y.y - sign * z.x), pitch, 0.0};
}

}  // namespace dynalin
