#include "system/moved_origin.h"

namespace dynalin {

void move_origin(OperatingPoint& op, std::size_t k, std::int32_t offset, const Vector& by) {
  const auto three = [offset](std::vector<double>& values, std::int32_t first) {
    double* x = values.data() + offset + first;
    return Vector{x[0], x[1], x[2]};
  };
  const auto add = [offset](std::vector<double>& values, const Vector& change) {
    for (std::size_t i = 0; i < 3; ++i) values[static_cast<std::size_t>(offset) + i] += change[i];
  };
  const Vector d = op.poses[k].R * by, w = three(op.velocity, 3), alpha = three(op.acceleration, 3);
  op.poses[k].r += d;
  add(op.velocity, cross(w, d));
  add(op.acceleration, cross(alpha, d) + cross(w, cross(w, d)));
}

}  // namespace dynalin
