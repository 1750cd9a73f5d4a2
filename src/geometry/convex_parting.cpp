#include "geometry/convex_parting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/placed_box.h"
#include "geometry/seen_back.h"

namespace dynalin {

namespace {

using Index = ConvexBody::Index;

constexpr double preference = 1e-6;  // of the size: by how much one across edges, or across a face of I, must part more
constexpr double beside_an_edge = 1e-12;  // sine: what is between the normals of two faces

Vector turned(const RelativeFrame<double>& f, const Vector& v) { return f.x * v.x + f.y * v.y + f.z * v.z; }
Vector turned_back(const RelativeFrame<double>& f, const Vector& v) { return {dot(f.x, v), dot(f.y, v), dot(f.z, v)}; }

// By how much B is below each face of A, and with which of its corners: as far as it takes to know of which faces it is
// least, and of which as little. It is below a face by what the ball in its middle is, or more, and by that alone it is
// known of most faces that they are none of these.
class BelowFaces {
 public:
  BelowFaces(const ConvexBody& A, const ConvexBody& B, const RelativeFrame<double>& B_from_A)
      : A_(A), B_(B), B_from_A_(B_from_A), middle_(B_from_A.p + turned(B_from_A, B.middle())) {
    overlap_.reserve(A.faces().size());
    for (Index k = 0; k < A.faces().size(); ++k) {
      overlap_.push_back(A.faces()[k].height - dot(A.faces()[k].normal, middle_) + B.depth());
      if (overlap_[k] < overlap_[least_]) least_ = k;
    }
    deepest_.assign(overlap_.size(), unknown);
    know(least_);
  }

  // Makes known of all faces below which B is by less than `limit`, or by little more than what is least.
  void know_up_to(double limit, double more) {
    for (Index k = 0; k < overlap_.size(); ++k) {
      if (overlap_[k] < std::min(limit, overlap_[least_] + more)) know(k);
    }
  }
  Index least() const { return least_; }
  double overlap() const { return overlap_[least_]; }
  bool is_known(Index face) const { return deepest_[face] != unknown; }
  double overlap(Index face) { return know(face), overlap_[face]; }
  Index deepest(Index face) { return know(face), deepest_[face]; }
  // Whether the ball in the middle of B alone says that it is below both faces at an edge, and between their normals,
  // by `limit` or more: along a direction between them A reaches as far as the edge, as far from that middle as n·w,
  // which is least at one of the two where it is positive there.
  bool is_far_below(const ConvexBody::Edge& e, double limit) const {
    const auto far = [&](const ConvexBody::Face& f) {
      return f.height - dot(f.normal, middle_) >= std::max(0.0, limit - B_.depth());
    };
    return far(A_.faces()[e.left]) && far(A_.faces()[e.right]);
  }

 private:
  static constexpr Index unknown = std::numeric_limits<Index>::max();

  void know(Index k) {
    if (is_known(k)) return;
    const ConvexBody::Face& f = A_.faces()[k];
    const Vector down = -turned_back(B_from_A_, f.normal);
    last_ = deepest_[k] = B_.farthest(down, last_);
    overlap_[k] = f.height - dot(f.normal, B_from_A_.p) + dot(down, B_.corners()[last_]);
    if (overlap_[k] < overlap_[least_]) least_ = k;
  }

  const ConvexBody &A_, &B_;
  const RelativeFrame<double>& B_from_A_;
  Vector middle_;                // of B
  std::vector<double> overlap_;  // where it is not known, no more than that
  std::vector<Index> deepest_;
  Index least_ = 0, last_ = 0;
};

// Edges of A about which less than `limit` may overlap: in the same way by the corners that are deepest below either
// face.
std::vector<Index> near_edges(const ConvexBody& A, BelowFaces& below, const ConvexBody& B,
                              const RelativeFrame<double>& B_from_A, double limit) {
  std::vector<Index> near;
  for (Index k = 0; k < A.edges().size(); ++k) {
    const ConvexBody::Edge& e = A.edges()[k];
    if (below.is_far_below(e, limit)) continue;
    const auto beyond = [&](Index deepest, Index face) {
      const Vector from = A.corners()[e.from] - B_from_A.p - turned(B_from_A, B.corners()[deepest]);
      return dot(A.faces()[face].normal, from);
    };
    const double by_left = std::min(below.overlap(e.left), beyond(below.deepest(e.left), e.right)),
                 by_right = std::min(below.overlap(e.right), beyond(below.deepest(e.right), e.left));
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

ConvexParting convex_parting(const ConvexBody& I, const RelativeFrame<double>& I_from_J, const ConvexBody& J) {
  const double size = std::min(I.size(), J.size()), as_near = solid::coincidence * size;
  const RelativeFrame<double> J_from_I = seen_back(I_from_J);
  BelowFaces below_J(J, I, I_from_J), below_I(I, J, J_from_I);
  const double more = 2 * preference * size;
  below_J.know_up_to(below_I.overlap() + more, more);
  below_I.know_up_to(below_J.overlap() + more, more);
  const double by_J = below_J.overlap(), by_I = below_I.overlap();
  const Index face_J = below_J.least(), face_I = below_I.least();
  const Vector normal_J = J.faces()[face_J].normal, normal_I = -turned(I_from_J, I.faces()[face_I].normal);

  ConvexParting found;
  Vector normal = normal_J;
  found.overlap = by_J, found.face_of_J = face_J;
  if (by_I < by_J - preference * size)
    found.overlap = by_I, normal = normal_I, found.face_of_J.reset(), found.face_of_I = face_I;
  if (std::abs(by_I - by_J) <= preference * size && dot(normal_I, normal_J) >= least_cosine)
    found.face_of_I = face_I, found.face_of_J = face_J;
  found.deepest_of_I = below_J.deepest(face_J), found.deepest_of_J = below_I.deepest(face_I);

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
    if (below_J.is_known(k) && is_as_near(below_J.overlap(k)) &&
        (found.face_of_J ? k != *found.face_of_J : is_another(J.faces()[k].normal)))
      found.definite = false;
  for (Index k = 0; k < I.faces().size(); ++k)
    if (below_I.is_known(k) && is_as_near(below_I.overlap(k)) &&
        (found.face_of_I ? k != *found.face_of_I : is_another(-turned(I_from_J, I.faces()[k].normal))))
      found.definite = false;
  for (const AcrossEdges& e : edges)
    if (is_as_near(e.overlap) && is_another(e.normal)) found.definite = false;
  return found;
}

}  // namespace dynalin
