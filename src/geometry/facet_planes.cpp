#include "geometry/facet_planes.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

constexpr double one_plane = 3e-5;     // of normals
constexpr double farthest = 1e-6;      // of the size: what a vertex may be off its plane
constexpr double independent = 1e-2;   // of normals of planes that determine a vertex
constexpr double no_component = 1e-6;  // of a normal: a face along an axis is meant

Vector without_roundings(Vector normal) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(normal[k]) < no_component) normal[k] = 0;
  }
  return normal / norm(normal);
}

}  // namespace

std::vector<FacetPlane> facet_planes(std::span<const Vector> vertices, double size, std::size_t facets,
                                     const std::function<FacetOfPlane(std::size_t)>& facet) {
  std::vector<bool> taken(facets, false);
  std::vector<FacetPlane> planes;
  for (std::size_t first = 0; first < facets; ++first) {
    if (taken[first]) continue;
    const Vector normal = facet(first).normal;
    FacetPlane plane;
    plane.facets.push_back(static_cast<Mesh::Index>(first));
    taken[first] = true;
    for (std::size_t k = 0; k < plane.facets.size(); ++k) {
      for (const Mesh::Index next : facet(plane.facets[k]).across) {
        if (taken[next] || norm(facet(next).normal - normal) > one_plane) continue;
        taken[next] = true;
        plane.facets.push_back(next);
      }
    }
    if (plane.facets.size() == 1 && norm(without_roundings(normal) - normal) == 0) continue;
    Vector sum{}, middle{};
    double area = 0;
    const Vector origin = vertices[facet(first).corner[0]];
    for (const Mesh::Index t : plane.facets) {
      const auto corner = facet(t).corner;
      const Vector a = vertices[corner[0]] - origin, b = vertices[corner[1]] - origin, c = vertices[corner[2]] - origin;
      const Vector twice = cross(b - a, c - a);
      sum += twice, area += norm(twice);
      middle += (a + b + c) * (norm(twice) / 3);
      plane.vertices.insert(plane.vertices.end(), corner.begin(), corner.end());
    }
    plane.normal = without_roundings(sum / norm(sum));
    plane.height = dot(plane.normal, origin + middle / area);
    std::ranges::sort(plane.vertices);
    plane.vertices.erase(std::unique(plane.vertices.begin(), plane.vertices.end()), plane.vertices.end());
    const bool flat = std::ranges::all_of(plane.vertices, [&](Mesh::Index v) {
      return std::abs(dot(plane.normal, vertices[v]) - plane.height) <= farthest * size;
    });
    if (flat) planes.push_back(std::move(plane));
  }
  return planes;
}

void put_into_planes(std::span<Vector> vertices, double size, std::span<const FacetPlane> planes) {
  std::vector<std::vector<const FacetPlane*>> of(vertices.size());
  for (const FacetPlane& p : planes) {
    for (const Mesh::Index v : p.vertices) of[v].push_back(&p);
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (of[v].empty()) continue;
    const auto count = static_cast<Eigen::Index>(of[v].size());
    Eigen::MatrixX3d normals(count, 3);
    Eigen::VectorXd off(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const FacetPlane& p = *of[v][static_cast<std::size_t>(k)];
      normals.row(k) << p.normal.x, p.normal.y, p.normal.z;
      off(k) = p.height - dot(p.normal, vertices[v]);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixX3d> solver;
    solver.setThreshold(independent);
    solver.compute(normals);
    const Eigen::Vector3d move = solver.solve(off);
    if (move.norm() <= farthest * size) vertices[v] += Vector{move.x(), move.y(), move.z()};
  }
}

}  // namespace dynalin
