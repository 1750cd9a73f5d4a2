// Faces, lines and points between numbered vertices, all in one frame [length].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace dynalin {

struct Mesh {
  using Index = std::uint32_t;
  using Edge = std::array<Index, 2>;

  std::vector<Vector> vertices;
  // Corners around the perimeter, counter-clockwise as seen from outside; convex, and none without area.
  std::vector<std::array<Index, 4>> quads;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Edge> segments;
  std::vector<Index> points;
  bool closed = false;  // the faces bound a volume

  Index add(const Vector& p) {
    vertices.push_back(p);
    return static_cast<Index>(vertices.size() - 1);
  }
  std::size_t faces() const { return quads.size() + triangles.size(); }
};

// Adds faces, lines and points of another mesh in the same frame; the result is closed where both are.
void append(Mesh& to, const Mesh& more);
// Turns the faces over, so that their normals point the other way.
void turn_over(Mesh&);

// The volume that a closed mesh bounds, negative where its normals point inwards; a quadrilateral counts as its four
// corners say, also where they are not in one plane. [length³]
double signed_volume(const Mesh&);
// Whether each side of a face is a side of exactly one other face, which runs along it the other way.
bool is_watertight(const Mesh&);
// Where it is not so, and how: "the side from (0, 0, 1) to (1, 0, 1) belongs to one facet alone". Empty for a mesh that
// is, or has no faces.
std::string leak(const Mesh&);
// Leaves out vertices that nothing uses.
void drop_loose_vertices(Mesh&);
// Marks a mesh whose faces bound a volume as closed and makes their normals point outwards.
void close(Mesh&);

// The sides of all faces and the segments, each once whichever way it runs, smaller vertex first, in the order in which
// they appear.
std::vector<Mesh::Edge> distinct_edges(const Mesh&);

}  // namespace dynalin
