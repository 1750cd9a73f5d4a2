// A box or a convex body of flat faces as a frustum meets it: the face that looks along a direction, and the edge
// across which both may part. A convex body stands in its own axes.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/convex_normals.h"
#include "geometry/frustum_parting.h"

namespace dynalin::solid {

struct FlatBody {
  const ConvexBody& body;

  double size() const { return body.size(); }
};
inline FlatBody plain(const FlatBody& b) { return b; }

inline Vector farthest(const FlatBody& b, const Vector& n) { return b.body.corners()[b.body.farthest(n, 0)]; }

template <class T>
Edge<T> edge_at(const ConvexBody& body, const ConvexBody::Edge& e) {
  return {constant<T>(body.corners()[e.from]), constant<T>(e.along), e.length};
}

// As that of a box (placed_box.h).
template <class T>
struct FlatFace {
  const ConvexBody::Face& face;
  std::vector<Vec3<T>> corners;
  std::vector<Edge<T>> edges;

  FlatFace(const ConvexBody& body, const ConvexBody::Face& of) : face(of) {
    const std::size_t count = face.corners.size();
    for (std::size_t n = 0; n < count; ++n) {
      const Vector from = body.corners()[face.corners[n]], way = body.corners()[face.corners[(n + 1) % count]] - from;
      const double length = norm(way);
      corners.push_back(constant<T>(from));
      edges.push_back({corners.back(), constant<T>(way / length), length});
    }
  }
  Vec3<T> normal() const { return constant<T>(face.normal); }
};

template <class T>
void keep_within(const FlatFace<T>& face, const Vec3<T>& point, double tolerance, Touch<T>& t) {
  double share = 1;
  for (const Edge<T>& e : face.edges) {
    const double depth = dot(cross(face.face.normal, value_of(e.along)), value_of(point) - value_of(e.from));
    t.inside = std::min(t.inside, depth), share *= share_inside(depth, tolerance);
  }
  t.weight = T(share);
}

// --- the face that takes part, and the edge

template <class T>
Face<T> facing(const PlacedBox<T>& b, const PartingDirection& d) {
  return Face<T>(b, d.normal);
}
template <class T>
FlatFace<T> facing(const FlatBody& b, const PartingDirection& d) {
  using Of = PartingDirection::Of;
  const ConvexBody& body = b.body;
  const auto most_looking = [&](const auto& faces) {
    return *std::ranges::max_element(faces, {}, [&](auto f) { return dot(body.faces()[f].normal, d.normal); });
  };
  if (d.of == Of::face && d.which < body.faces().size()) return {body, body.faces()[d.which]};
  if (d.of == Of::lines || d.of == Of::ruled_J) {
    const ConvexBody::Edge& e = body.edges()[d.which];
    return {body, body.faces()[most_looking(std::array{e.left, e.right})]};
  }
  return {body, body.faces()[most_looking(body.faces_at(body.farthest(d.normal, 0)))]};
}

template <class T>
Ruled<T> line_of(const PlacedBox<T>& b, const PartingDirection& d) {
  return lines(b, d.which, d.normal);
}
template <class T>
Ruled<T> line_of(const FlatBody& b, const PartingDirection& d) {
  const ConvexBody::Edge& e = b.body.edges()[d.which];
  return ruled_of(edge_at<T>(b.body, e), constant<T>(b.body.faces()[e.left].normal));
}

// Of the normals at an edge n of a face: those that look along both of these, times the size.
struct NormalsOfEdge {
  std::array<Vector, 2> inner;
  double size;
};
template <class T>
NormalsOfEdge normals_of_edge(const PlacedBox<T>& b, const Face<T>& face, std::size_t n) {
  const Vector out = value_of(face.normal()), along = value_of(face.edges[n].along);
  const Vector middle = 0.25 * value_of(face.corners[0] + face.corners[1] + face.corners[2] + face.corners[3]);
  const Vector across = cross(out, along);
  return {{out, dot(across, value_of(face.corners[n]) - middle) > 0 ? across : -across}, b.size()};
}
template <class T>
NormalsOfEdge normals_of_edge(const FlatBody& b, const FlatFace<T>& face, std::size_t n) {
  const Vector along = value_of(face.edges[n].along);
  const Vector& beyond = b.body.faces()[face.face.across[n]].normal;
  return {{-cross(face.face.normal, along), -cross(along, beyond)}, b.size()};
}

}  // namespace dynalin::solid
