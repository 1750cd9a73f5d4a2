#include "geometry/convex_ellipsoid_touch.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "geometry/common_normal.h"
#include "geometry/convex_normals.h"
#include "geometry/ellipsoid_touch.h"

namespace dynalin {
namespace solid {
namespace {

using Index = ConvexBody::Index;

constexpr double width_of_border = 1e-12;  // of the size: on the border of a face it is its edge's place as well

// A convex body as ellipsoid_touch.h asks for one. First the faces are counted, then the edges, then the corners.
struct Facets {
  const ConvexBody& body;

  const ConvexBody::Edge* edge(std::size_t which) const {
    const std::size_t faces = body.faces().size();
    return which >= faces && which - faces < body.edges().size() ? &body.edges()[which - faces] : nullptr;
  }
  Index corner(std::size_t which) const {
    return static_cast<Index>(which - body.faces().size() - body.edges().size());
  }
  double tolerance() const { return width_of_border * body.size(); }
};

std::size_t features(const Facets& f) {
  return f.body.faces().size() + f.body.edges().size() + f.body.corners().size();
}

double support(const Facets& f, const Vector& n) { return dot(n, f.body.corners()[f.body.farthest(n, 0)]); }

// All whose separation may be the largest, or as large as that.
template <class Visit>
void for_each_candidate(const PlacedEllipsoid<double>& e, const Facets& f, const Visit& visit) {
  const ConvexBody& body = f.body;
  const std::size_t faces = body.faces().size(), edges = body.edges().size();
  std::vector<Vector> nearest(faces);
  std::vector<double> apart(faces);
  for (std::size_t k = 0; k < faces; ++k) {
    const ConvexBody::Face& face = body.faces()[k];
    nearest[k] = e.farthest(-face.normal), apart[k] = dot(face.normal, nearest[k]) - face.height;
  }
  // Along the normal of each face they are as far apart as that, and no farther than any point of the ellipsoid is.
  const double least = *std::ranges::max_element(apart) - 2 * coincidence * norm(e.semi_axes) - f.tolerance();
  for (std::size_t k = 0; k < faces; ++k)
    if (apart[k] >= least) visit(k);
  for (std::size_t k = 0; k < edges; ++k) {
    const ConvexBody::Edge& edge = body.edges()[k];
    const auto most = [&](Index face) { return most_along(body, edge, nearest[face] - body.corners()[edge.from]); };
    if (most(edge.left) >= least && most(edge.right) >= least) visit(faces + k);
  }
  for (Index k = 0; k < body.corners().size(); ++k) {
    const Index face = *std::ranges::max_element(body.faces_at(k), {}, [&](Index n) { return apart[n]; });
    if (most_along(body, k, nearest[face] - body.corners()[k]) >= least) visit(faces + edges + k);
  }
}

// --- places

template <class T>
std::optional<Touch<T>> on_face(const PlacedEllipsoid<T>& e, const Facets& f, const ConvexBody::Face& face) {
  const Touch<T> t = touch_face(e, constant<T>(face.normal), face.height);
  const Vector place = value_of(t.point);
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Vector &from = f.body.corners()[face.corners[k]],
                 &to = f.body.corners()[face.corners[(k + 1) % face.corners.size()]];
    const Vector inwards = cross(face.normal, to - from);
    if (dot(inwards, place - from) < -f.tolerance() * norm(inwards)) return std::nullopt;
  }
  return t;
}

template <class T>
std::optional<Touch<T>> on_edge(const PlacedEllipsoid<T>& e, const Facets& f, const ConvexBody::Edge& edge) {
  const NormalsAtEdge arc(f.body, edge);
  const Vector& from = f.body.corners()[edge.from];
  const PlacedEllipsoid<double> plain = e.plain();
  const auto gap = [&](double s) { return dot(arc.normal(s), plain.farthest(-arc.normal(s)) - from); };
  const auto slope = [&](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    return dot(arc.turned(s), plain.farthest(-arc.normal(s)) - as<S>(from));
  };
  const auto largest = largest_between(0, arc.turn, gap, slope, norm(e.semi_axes));
  if (!largest) return std::nullopt;
  T s(largest->at);
  s = s - dot(arc.turned(s), e.farthest(-arc.normal(s)) - as<T>(from)) *
              (1 / slope(Dual<1>(largest->at, std::size_t{0})).partial[0]);
  const Vec3<T> n = arc.normal(s), nearest = e.farthest(-n);
  // Beyond an end of the edge its corner is nearer.
  const double along = dot(edge.along, value_of(nearest) - from);
  if (!(along >= -f.tolerance() && along <= edge.length + f.tolerance())) return std::nullopt;
  Touch<T> t = touch_between(nearest, T(dot(n, nearest - as<T>(from))), n);
  t.defined = largest->definite;
  return t;
}

// A corner inside of an ellipsoid may have two best ways out, each on its side of the middle plane.
template <class T>
std::optional<Touch<T>> on_corner(const PlacedEllipsoid<T>& e, const Facets& f, Index corner) {
  const ConvexBody& body = f.body;
  const Vector& at = body.corners()[corner];
  const PlacedEllipsoid<double> plain = e.plain();
  const RelativeFrame<double> from_corner{plain.at.p - at, plain.at.x, plain.at.y, plain.at.z};
  std::optional<Vector> best;
  double most = 0;
  bool definite = true;
  const auto climb = [&](const Vector& start) {
    const auto n = common_normal(e.semi_axes, from_corner, {}, start / norm(start));
    if (!n || !is_normal_at(body, corner, *n, -belongs)) return;
    const double gap = dot(*n, plain.farthest(-*n) - at);
    if (best && norm(*n - *best) < 1e-6) return;
    const bool as_far = best && std::abs(gap - most) <= coincidence * norm(e.semi_axes);
    definite = !as_far && (definite || gap > most);
    if (!best || gap > most) best = n, most = gap;
  };
  Vector between;
  for (const Index face : body.faces_at(corner)) between += body.faces()[face].normal;
  climb(between);
  for (const Index face : body.faces_at(corner)) {
    if (best && most > 0) break;
    climb(body.faces()[face].normal);
  }
  if (!best) return std::nullopt;
  const RelativeFrame<T> seen{e.at.p - constant<T>(at), e.at.x, e.at.y, e.at.z};
  const auto c = common_normal_at<T>(*best, e.semi_axes, seen, {});
  Touch<T> t = touch_between(Vec3<T>(c.on_first + constant<T>(at)), T(dot(c.normal, c.on_first)), c.normal);
  t.defined = definite;
  return t;
}

template <class T>
std::optional<Touch<T>> touch_feature(const PlacedEllipsoid<T>& e, const Facets& f, std::size_t which) {
  if (which < f.body.faces().size()) return on_face(e, f, f.body.faces()[which]);
  if (const ConvexBody::Edge* edge = f.edge(which)) return on_edge(e, f, *edge);
  return on_corner(e, f, f.corner(which));
}

}  // namespace
}  // namespace solid

template <class T>
Touch<T> touch_ellipsoid(const solid::Ellipsoid& e, const RelativeFrame<T>& at, const ConvexBody& body) {
  return solid::touch_ellipsoid(e, at, solid::Facets{body});
}

template Touch<double> touch_ellipsoid(const solid::Ellipsoid&, const RelativeFrame<double>&, const ConvexBody&);
template Touch<Dual<12>> touch_ellipsoid(const solid::Ellipsoid&, const RelativeFrame<Dual<12>>&, const ConvexBody&);

}  // namespace dynalin
