#include "geometry/lines.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

Mesh arc(double radius, const Sweep& sweep) {
  Mesh mesh;
  const bool full = sweep.full();
  const double angle = full ? 2 * std::numbers::pi : sweep.angle;
  const std::size_t n = std::max<std::size_t>(sweep.segments, full ? 3 : 1);
  for (std::size_t i = 0; i < n + (full ? 0 : 1); ++i) {
    const double azimuth = sweep.start + angle * static_cast<double>(i) / static_cast<double>(n);
    mesh.add({radius * std::cos(azimuth), radius * std::sin(azimuth), 0});
  }
  const auto count = static_cast<Mesh::Index>(mesh.vertices.size());
  for (Mesh::Index i = 0; i < static_cast<Mesh::Index>(n); ++i) mesh.segments.push_back({i, (i + 1) % count});
  return mesh;
}

Mesh polyline(std::span<const Vector> points) {
  Mesh mesh;
  for (const Vector& p : points) {
    if (!mesh.vertices.empty() && norm(p - mesh.vertices.back()) == 0) continue;
    const Mesh::Index v = mesh.add(p);
    if (v > 0) mesh.segments.push_back({v - 1, v});
  }
  return mesh.segments.empty() ? Mesh{} : mesh;
}

}  // namespace dynalin
