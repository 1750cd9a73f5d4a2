// Convex bodies of facets for tests, and the largest separation of them from something by a search over all directions.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/prism.h"
#include "geometry/revolution.h"
#include "geometry/touch.h"

namespace dynalin::flat_test {

inline RelativeFrame<Dual<12>> seeded(const RelativeFrame<double>& f) {
  const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
  const auto s = path::seeded<12>({along(f.p), along(f.x), along(f.y), along(f.z)});
  const auto values = [](const auto& v) { return Vec3<Dual<12>>{v.x.value, v.y.value, v.z.value}; };
  return {values(s.p), values(s.x), values(s.y), values(s.z)};
}

inline solid::Polyhedron facets_of(Mesh mesh, const Vector& move = {}) {
  for (Vector& v : mesh.vertices) v += move;
  return {std::make_shared<const FacetBody>(mesh)};
}
inline solid::Polyhedron facets_of(const solid::Box& b) { return facets_of(dynalin::box(b.high - b.low), b.low); }

// Each face of a box in four triangles about a point somewhere in it.
inline solid::Polyhedron divided_box(const solid::Box& b) {
  Mesh whole = dynalin::box(b.high - b.low), cut;
  cut.vertices = whole.vertices, cut.closed = true;
  double share = 0.2;
  for (const auto& q : whole.quads) {
    const auto at = [&](std::size_t k) { return whole.vertices[q[k]]; };
    const auto middle = static_cast<Mesh::Index>(cut.vertices.size());
    cut.vertices.push_back(at(0) + share * (at(1) - at(0)) + (0.9 - share) * (at(3) - at(0)));
    share += 0.08;
    for (std::size_t k = 0; k < 4; ++k) cut.triangles.push_back({q[k], q[(k + 1) % 4], middle});
  }
  return facets_of(cut, b.low);
}

// Of few facets and of many, with sharp edges and with blunt ones.
inline std::vector<solid::Side> flat_bodies() {
  const std::vector<Vector> wedge{{-0.6, -0.3, 0}, {0.7, -0.3, 0}, {0.7, 0.1, 0}},
      house{{-0.5, -0.4, 0}, {0.5, -0.4, 0}, {0.5, 0.2, 0}, {0.1, 0.45, 0}, {-0.5, 0.3, 0}};
  return {{facets_of(dynalin::ellipsoid({0.5, 0.7, 0.4}, 8))},
          {facets_of(dynalin::cylinder(0.4, 0.9, {.segments = 9}), {0, 0, -0.4})},
          {facets_of(dynalin::frustum(0.5, 0, 0.8, {.segments = 5}), {0, 0, -0.3})},
          {facets_of(prism(wedge, Outline::closed, {0, 0, 0.8}), {0, 0, -0.4})},
          {facets_of(prism(house, Outline::closed, {0, 0, 0.3}), {0, 0, -0.1})},
          {facets_of(dynalin::ellipsoid({0.6, 0.6, 0.3}, 24))}};
}

inline double reach_of(const solid::Side& s, const Vector& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector& c : std::get<solid::Polyhedron>(s.shape).body->corners()) most = std::max(most, dot(n, c));
  return most;
}
// Normals of its facets, by all planes through three of its corners that have all others on one side.
inline std::vector<Vector> sharp_directions(const solid::Side& s) {
  const std::vector<Vector>& at = std::get<solid::Polyhedron>(s.shape).body->corners();
  std::vector<Vector> list;
  if (at.size() > 60) return list;
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      for (std::size_t k = j + 1; k < at.size(); ++k) {
        const Vector across = cross(at[j] - at[i], at[k] - at[i]);
        if (!(norm(across) > 1e-9)) continue;
        for (const Vector& n : {across / norm(across), -across / norm(across)})
          if (reach_of(s, n) < dot(n, at[i]) + 1e-9) list.push_back(n);
      }
    }
  }
  return list;
}

// By many directions, those given, and steps that shrink from the best ones.
template <class Separation>
double largest_separation(const Separation& separation, std::vector<Vector> others) {
  constexpr int rings = 30;
  for (int i = 0; i < rings; ++i) {
    const double polar = std::numbers::pi * (i + 0.5) / rings;
    const int around = std::max(4, static_cast<int>(2 * rings * std::sin(polar)));
    for (int k = 0; k < around; ++k) {
      const double a = 2 * std::numbers::pi * k / around;
      others.push_back({std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar)});
    }
  }
  std::vector<std::pair<double, Vector>> list;
  for (const Vector& n : others) list.emplace_back(separation(n), n);
  std::ranges::sort(list, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::mt19937_64 random(11);
  std::normal_distribution<double> any;
  double most = list.front().first;
  for (std::size_t start = 0; start < 8; ++start) {
    auto [best, n] = list[start];
    for (double step = 0.05; step > 1e-8;) {
      bool better = false;
      for (int k = 0; k < 30 && !better; ++k) {
        const Vector to = n + step * Vector{any(random), any(random), any(random)};
        const Vector m = to / norm(to);
        if (const double h = separation(m); h > best) best = h, n = m, better = true;
      }
      if (!better) step *= 0.7;
    }
    most = std::max(most, best);
  }
  return most;
}

}  // namespace dynalin::flat_test
