// What holds of every mesh, checked without the functions under test.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "geometry/mesh.h"

namespace dynalin {

template <class Face>
std::vector<Vector> corners_of(const Mesh& mesh, const Face& face) {
  std::vector<Vector> at;
  for (const Mesh::Index v : face) at.push_back(mesh.vertices.at(v));
  return at;
}

// All vertices are used, no line is a point, no face is flat, corners of quadrilaterals turn one way.
inline void expect_sound(const Mesh& mesh) {
  std::set<Mesh::Index> used(mesh.points.begin(), mesh.points.end());
  double size = 0;
  for (const Vector& p : mesh.vertices) size = std::max(size, norm(p - mesh.vertices.front()));
  for (const auto& s : mesh.segments) {
    used.insert(s.begin(), s.end());
    EXPECT_GT(norm(mesh.vertices.at(s[0]) - mesh.vertices.at(s[1])), 0);
  }
  const auto check = [&](const auto& face) {
    used.insert(face.begin(), face.end());
    const auto at = corners_of(mesh, face);
    const std::size_t n = at.size();
    Vector first;
    for (std::size_t k = 0; k < n; ++k) {
      const Vector turn = cross(at[(k + 1) % n] - at[k], at[(k + 2) % n] - at[(k + 1) % n]);
      EXPECT_GT(norm(turn), 1e-13 * size * size);
      if (k == 0) first = turn;
      EXPECT_GT(dot(turn, first), 0);
    }
  };
  for (const auto& q : mesh.quads) check(q);
  for (const auto& t : mesh.triangles) check(t);
  EXPECT_EQ(used.size(), mesh.vertices.size());
  if (!used.empty()) {
    EXPECT_LT(*used.rbegin(), mesh.vertices.size());
  }
}

// Corners of quadrilaterals are in one plane.
inline void expect_plane(const Mesh& mesh) {
  for (const auto& q : mesh.quads) {
    const auto at = corners_of(mesh, q);
    const Vector a = at[1] - at[0], b = at[2] - at[0], c = at[3] - at[0];
    EXPECT_NEAR(dot(a, cross(b, c)), 0, 1e-12 * norm(a) * norm(b) * norm(c));
  }
}

// Each side of a face is run along once each way; `characteristic` is vertices − edges + faces.
inline void expect_closed(const Mesh& mesh, int characteristic) {
  expect_sound(mesh);
  EXPECT_TRUE(mesh.closed);
  std::map<std::pair<Mesh::Index, Mesh::Index>, int> ways;
  const auto add = [&](const auto& face) {
    for (std::size_t k = 0; k < face.size(); ++k) ++ways[{face[k], face[(k + 1) % face.size()]}];
  };
  for (const auto& q : mesh.quads) add(q);
  for (const auto& t : mesh.triangles) add(t);
  for (const auto& [way, count] : ways) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(ways.count({way.second, way.first}), 1u);
  }
  const auto vertices = static_cast<int>(mesh.vertices.size()), edges = static_cast<int>(ways.size() / 2);
  EXPECT_EQ(vertices - edges + static_cast<int>(mesh.faces()), characteristic);
}

// The volume by the divergence theorem, triangle by triangle; quadrilaterals are plane here.
inline double volume_of(const Mesh& mesh) {
  double six = 0;
  const auto add = [&](const Vector& a, const Vector& b, const Vector& c) { six += dot(a, cross(b, c)); };
  for (const auto& t : mesh.triangles) add(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  for (const auto& q : mesh.quads) {
    add(mesh.vertices[q[0]], mesh.vertices[q[1]], mesh.vertices[q[2]]);
    add(mesh.vertices[q[0]], mesh.vertices[q[2]], mesh.vertices[q[3]]);
  }
  return six / 6;
}

}  // namespace dynalin
