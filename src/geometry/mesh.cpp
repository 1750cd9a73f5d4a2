#include "geometry/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace dynalin {

namespace {

using Index = Mesh::Index;

// Of a way from one vertex to another.
std::uint64_t key(Index from, Index to) { return std::uint64_t{from} << 32 | to; }

template <class Use>
void for_each_side(const Mesh& mesh, const Use& use) {
  const auto around = [&](const auto& face) {
    for (std::size_t k = 0; k < face.size(); ++k) use(face[k], face[(k + 1) % face.size()]);
  };
  for (const auto& face : mesh.quads) around(face);
  for (const auto& face : mesh.triangles) around(face);
}

}  // namespace

void append(Mesh& to, const Mesh& more) {
  const auto first = static_cast<Index>(to.vertices.size());
  const bool closed = more.closed && (to.closed || to.vertices.empty());
  to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
  const auto take = [&](auto& list, auto items) {
    for (auto& item : items) {
      for (Index& v : item) v += first;
      list.push_back(item);
    }
  };
  take(to.quads, more.quads), take(to.triangles, more.triangles), take(to.segments, more.segments);
  for (const Index v : more.points) to.points.push_back(v + first);
  to.closed = closed;
}

void turn_over(Mesh& mesh) {
  for (auto& q : mesh.quads) std::swap(q[1], q[3]);
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

double signed_volume(const Mesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // From a vertex of its own: a mesh may lie far from the origin of its frame.
  const Vector origin = mesh.vertices.front();
  const auto at = [&](Index v) { return mesh.vertices[v] - origin; };
  double six = 0;
  for (const auto& t : mesh.triangles) six += dot(at(t[0]), cross(at(t[1]), at(t[2])));
  for (const auto& q : mesh.quads) {
    // The mean of both ways to halve it: neighbours agree on their sides alone, so any halving is consistent.
    const Vector a = at(q[0]), b = at(q[1]), c = at(q[2]), d = at(q[3]);
    const double one = dot(a, cross(b, c)) + dot(a, cross(c, d)), other = dot(a, cross(b, d)) + dot(b, cross(c, d));
    six += 0.5 * (one + other);
  }
  return six / 6;
}

bool is_watertight(const Mesh& mesh) {
  if (mesh.faces() == 0) return false;
  std::unordered_set<std::uint64_t> sides;
  bool once = true;
  for_each_side(mesh, [&](Index from, Index to) { once = sides.insert(key(from, to)).second && once; });
  if (!once) return false;
  bool both = true;
  for_each_side(mesh, [&](Index from, Index to) { both = both && sides.contains(key(to, from)); });
  return both;
}

std::string leak(const Mesh& mesh) {
  std::unordered_map<std::uint64_t, int> uses;
  for_each_side(mesh, [&](Index from, Index to) { ++uses[key(from, to)]; });
  std::string found;
  for_each_side(mesh, [&](Index from, Index to) {
    if (!found.empty()) return;
    const auto back = uses.find(key(to, from));
    const int there = uses[key(from, to)], here = back == uses.end() ? 0 : back->second;
    if (there == 1 && here == 1) return;
    const Vector &a = mesh.vertices[from], &b = mesh.vertices[to];
    found = fmt::format("the side from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) {}", a.x, a.y, a.z, b.x,
                        b.y, b.z,
                        there + here == 1   ? "belongs to one facet alone"
                        : there + here == 2 ? "belongs to two facets of which one is turned over"
                                            : fmt::format("belongs to {} facets", there + here));
  });
  return found;
}

void drop_loose_vertices(Mesh& mesh) {
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> place(mesh.vertices.size(), none);
  const auto for_each_use = [&](const auto& use) {
    for (auto& q : mesh.quads) std::for_each(q.begin(), q.end(), use);
    for (auto& t : mesh.triangles) std::for_each(t.begin(), t.end(), use);
    for (auto& s : mesh.segments) std::for_each(s.begin(), s.end(), use);
    std::for_each(mesh.points.begin(), mesh.points.end(), use);
  };
  for_each_use([&](Index& v) { place[v] = 0; });
  Index count = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == none) continue;
    mesh.vertices[count] = mesh.vertices[v];
    place[v] = count++;
  }
  mesh.vertices.resize(count);
  for_each_use([&](Index& v) { v = place[v]; });
}

void close(Mesh& mesh) {
  if (!is_watertight(mesh)) return;
  mesh.closed = true;
  if (signed_volume(mesh) < 0) turn_over(mesh);
}

std::vector<Mesh::Edge> distinct_edges(const Mesh& mesh) {
  std::unordered_set<std::uint64_t> seen;
  std::vector<Mesh::Edge> edges;
  const auto add = [&](Index a, Index b) {
    if (a > b) std::swap(a, b);
    if (seen.insert(key(a, b)).second) edges.push_back({a, b});
  };
  for_each_side(mesh, add);
  for (const Mesh::Edge& s : mesh.segments) add(s[0], s[1]);
  return edges;
}

}  // namespace dynalin
