#include "geometry/spring_damper_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/lines.h"
#include "geometry/revolution.h"

namespace dynalin {

namespace {

// From coil `begin` to coil `end` of a spring that rises by `pitch` with each coil from height z.
Mesh band(const SpringDamperSize& size, double z, double pitch, double begin, double end) {
  Mesh mesh;
  const double radius = size.diameter / 2, width = std::abs(pitch) / 4;
  const double wanted = (end - begin) * static_cast<double>(size.segments);
  const auto pieces = static_cast<Mesh::Index>(std::max(1.0, std::ceil(wanted - 1e-9)));
  for (Mesh::Index i = 0; i <= pieces; ++i) {
    const double coil = begin + (end - begin) * static_cast<double>(i) / static_cast<double>(pieces);
    const double angle = 2 * std::numbers::pi * coil;
    const Vector p{radius * std::cos(angle), radius * std::sin(angle), z + pitch * coil};
    mesh.add(p - Vector{0, 0, width / 2}), mesh.add(p + Vector{0, 0, width / 2});
    if (i > 0) mesh.quads.push_back({2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 1});
  }
  return mesh;
}

}  // namespace

std::array<Mesh, 2> spring_damper_halves(const SpringDamperSize& size, double distance) {
  std::array<double, 2> tip = size.tip_length;
  if (tip[0] + tip[1] >= distance) tip = {0, 0};
  const double bottom = tip[0], top = distance - tip[1], middle = 0.5 * (bottom + top);
  const bool spring = size.coils > 0 && size.diameter > 0;
  std::array<Mesh, 2> halves;
  for (std::size_t side = 0; side < 2; ++side) {
    const double end = side == 0 ? 0 : distance, inwards = side == 0 ? 1 : -1;
    const double begin = end + inwards * tip[side];
    const bool tube = size.cup_diameter[side] > 0 && size.cup_length[side] > 0;
    // Without anything to show, the line itself goes on to the middle.
    append(halves[side], polyline(std::array<Vector, 2>{Vector{0, 0, end}, {0, 0, spring || tube ? begin : middle}}));
    if (spring) {
      const double pitch = (top - bottom) / size.coils, half = 0.5 * size.coils;
      append(halves[side],
             side == 0 ? band(size, bottom, pitch, 0, half) : band(size, bottom, pitch, half, size.coils));
    }
    if (tube) {
      Mesh cup = cylinder(size.cup_diameter[side] / 2, inwards * size.cup_length[side], {.segments = size.segments});
      for (Vector& p : cup.vertices) p.z += begin;
      append(halves[side], cup);
    }
  }
  return halves;
}

}  // namespace dynalin
