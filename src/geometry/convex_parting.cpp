#include "geometry/convex_parting.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/placed_box.h"

namespace dynalin {

namespace {

using Index = ConvexBody::Index;

constexpr double preference = 1e-6;  // of the size: by how much one across edges, or across a face of I, must part more
constexpr double beside_an_edge = 1e-12;  // sine: what is between the normals of two faces

Vector turned(const RelativeFrame<double>& f, const Vector& v) { return f.x * v.x + f.y * v.y + f.z * v.z; }
Vector turned_back(const RelativeFrame<double>& f, const Vector& v) { return {dot(f.x, v), dot(f.y, v), dot(f.z, v)}; }

// By how much B is below each face of A, and with which of its corners.
struct BelowFaces {
  std::vector<double> overlap;
  std::vector<Index> deepest;
  Index least = 0;  // of these faces
};
BelowFaces below_faces(const ConvexBody& A, const ConvexBody& B, const RelativeFrame<double>& B_from_A) {
  BelowFaces found;
  const std::size_t count = A.faces().size();
  found.overlap.resize(count), found.deepest.resize(count);
  for (Index k = 0; k < count; ++k) {
    const ConvexBody::Face& f = A.faces()[k];
    const Vector down = -turned_back(B_from_A, f.normal);
    found.deepest[k] = B.farthest(down, found.deepest[f.before]);
    found.overlap[k] = f.height - dot(f.normal, B_from_A.p) + dot(down, B.corners()[found.deepest[k]]);
    if (found.overlap[k] < found.overlap[found.least]) found.least = k;
  }
  return found;
}

// Edges of A about which less than `limit` may overlap. Across a direction between the normals of both faces A reaches
// as far as the edge, and B at least as far as its corners that are deepest below either face; a reach n·w is least at
// one of the two.
std::vector<Index> near_edges(const ConvexBody& A, const BelowFaces& below, const ConvexBody& B,
                              const RelativeFrame<double>& B_from_A, double limit) {
  std::vector<Index> near;
  for (Index k = 0; k < A.edges().size(); ++k) {
    const ConvexBody::Edge& e = A.edges()[k];
    const auto beyond = [&](Index deepest, Index face) {
      const Vector from = A.corners()[e.from] - B_from_A.p - turned(B_from_A, B.corners()[deepest]);
      return dot(A.faces()[face].normal, from);
    };
    const double by_left = std::min(below.overlap[e.left], beyond(below.deepest[e.left], e.right)),
                 by_right = std::min(below.overlap[e.right], beyond(below.deepest[e.right], e.left));
    if (std::max(by_left, by_right) < limit) near.push_back(k);
  }
  return near;
}

struct AcrossEdges {
  Vector normal;  // out of J
  double overlap = 0;
  Index I = 0, J = 0;
};

// An edge where it stands in the axes of J, with the normals of both faces.
struct PlacedEdge {
  Vector from, along, into_left, into_right, left, right;

  PlacedEdge(const ConvexBody& body, const ConvexBody::Edge& e, const RelativeFrame<double>& F)
      : from(F.p + turned(F, body.corners()[e.from])),
        along(turned(F, e.along)),
        into_left(turned(F, e.into_left)),
        into_right(turned(F, e.into_right)),
        left(turned(F, body.faces()[e.left].normal)),
        right(turned(F, body.faces()[e.right].normal)) {}
  // Whether a direction across the edge lies between the normals of its faces.
  bool is_between_faces(const Vector& n) const {
    return dot(n, left + right) > 0 && dot(n, into_left) <= beside_an_edge && dot(n, into_right) <= beside_an_edge;
  }
};

// Where a direction across an edge of both lies between the normals of the faces of either, it is that of a face of
// their Minkowski difference.
std::vector<AcrossEdges> across_edges(const ConvexBody& I, const RelativeFrame<double>& I_from_J, const ConvexBody& J,
                                      const std::vector<Index>& of_I, const std::vector<Index>& of_J, double limit) {
  const RelativeFrame<double> itself{{}, unit_vectors[0], unit_vectors[1], unit_vectors[2]};
  std::vector<PlacedEdge> edges_of_J;
  for (const Index j : of_J) edges_of_J.emplace_back(J, J.edges()[j], itself);
  std::vector<AcrossEdges> found;
  for (const Index i : of_I) {
    const PlacedEdge e(I, I.edges()[i], I_from_J);
    for (std::size_t k = 0; k < of_J.size(); ++k) {
      const PlacedEdge& f = edges_of_J[k];
      Vector n = cross(e.along, f.along);
      const double sine = norm(n);
      if (!(sine > least_sine)) continue;
      n = n / (dot(n, f.left + f.right) > 0 ? sine : -sine);
      if (!f.is_between_faces(n) || !e.is_between_faces(-n)) continue;
      if (const double overlap = dot(n, f.from - e.from); overlap < limit) found.push_back({n, overlap, i, of_J[k]});
    }
  }
  return found;
}

}  // namespace

RelativeFrame<double> seen_back(const RelativeFrame<double>& F) {
  return {-turned_back(F, F.p), {F.x.x, F.y.x, F.z.x}, {F.x.y, F.y.y, F.z.y}, {F.x.z, F.y.z, F.z.z}};
}

ConvexParting convex_parting(const ConvexBody& I, const RelativeFrame<double>& I_from_J, const ConvexBody& J) {
  const double size = std::min(I.size(), J.size()), as_near = solid::coincidence * size;
  const RelativeFrame<double> J_from_I = seen_back(I_from_J);
  const BelowFaces below_J = below_faces(J, I, I_from_J), below_I = below_faces(I, J, J_from_I);
  const double by_J = below_J.overlap[below_J.least], by_I = below_I.overlap[below_I.least];
  const Vector normal_J = J.faces()[below_J.least].normal,
               normal_I = -turned(I_from_J, I.faces()[below_I.least].normal);

  ConvexParting found;
  Vector normal = normal_J;
  found.overlap = by_J, found.face_of_J = below_J.least;
  if (by_I < by_J - preference * size)
    found.overlap = by_I, normal = normal_I, found.face_of_J.reset(), found.face_of_I = below_I.least;
  if (std::abs(by_I - by_J) <= preference * size && dot(normal_I, normal_J) >= least_cosine)
    found.face_of_I = below_I.least, found.face_of_J = below_J.least;
  found.deepest_of_I = below_J.deepest[below_J.least], found.deepest_of_J = below_I.deepest[below_I.least];

  const double limit = found.overlap + as_near;
  const std::vector<Index> of_J = near_edges(J, below_J, I, I_from_J, limit),
                           of_I = near_edges(I, below_I, J, J_from_I, limit);
  const std::vector<AcrossEdges> edges = across_edges(I, I_from_J, J, of_I, of_J, limit);
  const auto best = std::ranges::min_element(edges, {}, &AcrossEdges::overlap);
  if (best != edges.end() && best->overlap < found.overlap - preference * size) {
    found.overlap = best->overlap, normal = best->normal;
    found.face_of_I.reset(), found.face_of_J.reset();
    found.edge_of_I = best->I, found.edge_of_J = best->J;
  }

  const auto is_as_near = [&](double overlap) { return std::abs(overlap - found.overlap) <= as_near; };
  const auto is_another = [&](const Vector& n) { return dot(n, normal) < least_cosine; };
  for (Index k = 0; k < J.faces().size(); ++k)
    if (is_as_near(below_J.overlap[k]) && (found.face_of_J ? k != *found.face_of_J : is_another(J.faces()[k].normal)))
      found.definite = false;
  for (Index k = 0; k < I.faces().size(); ++k)
    if (is_as_near(below_I.overlap[k]) &&
        (found.face_of_I ? k != *found.face_of_I : is_another(-turned(I_from_J, I.faces()[k].normal))))
      found.definite = false;
  for (const AcrossEdges& e : edges)
    if (is_as_near(e.overlap) && is_another(e.normal)) found.definite = false;
  return found;
}

}  // namespace dynalin
