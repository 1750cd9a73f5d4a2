#include "geometry/prism.h"

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/polygon.h"

namespace dynalin {

Mesh prism(std::span<const Vector> outline, Outline kind, const Vector& along) {
  Mesh mesh;
  const auto n = static_cast<Mesh::Index>(outline.size());
  for (const Vector& p : outline) mesh.add(p);
  for (const Vector& p : outline) mesh.add(p + along);
  for (Mesh::Index k = 0; k + (kind == Outline::open ? 1 : 0) < n; ++k) {
    const Mesh::Index next = (k + 1) % n;
    add_polygon(mesh, std::array{k, next, n + next, n + k});
  }
  if (kind == Outline::closed) {
    std::vector<Mesh::Index> bottom, top;
    for (Mesh::Index k = 0; k < n; ++k) bottom.push_back(n - 1 - k), top.push_back(n + k);
    if (!add_polygon(mesh, bottom) || !add_polygon(mesh, top)) return mesh;
  }
  close(mesh);
  return mesh;
}

Mesh box(const Vector& extent) {
  const std::array<Vector, 4> base{Vector{}, Vector{extent.x, 0, 0}, Vector{extent.x, extent.y, 0},
                                   Vector{0, extent.y, 0}};
  return prism(base, Outline::closed, {0, 0, extent.z});
}

}  // namespace dynalin
