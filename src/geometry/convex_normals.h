// The directions that are normal to a convex body of flat faces at an edge, between the normals of its two faces, and
// at a corner, between those of all.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/convex_body.h"
#include "geometry/least_on_circle.h"

namespace dynalin {

// n(s) from the normal of the face on the left of an edge, s = 0, to that on its right.
struct NormalsAtEdge {
  Vector left, onwards;
  double turn;

  NormalsAtEdge(const ConvexBody& body, const ConvexBody::Edge& e)
      : left(body.faces()[e.left].normal), onwards(-e.into_left) {
    const Vector& right = body.faces()[e.right].normal;
    turn = std::atan2(dot(onwards, right), dot(left, right));
  }
  template <class S>
  Vec3<S> normal(const S& s) const {
    using std::cos, std::sin;
    return solid::as<S>(left) * S(cos(s)) + solid::as<S>(onwards) * S(sin(s));
  }
  template <class S>
  Vec3<S> turned(const S& s) const {  // its derivative
    using std::cos, std::sin;
    return solid::as<S>(onwards) * S(cos(s)) - solid::as<S>(left) * S(sin(s));
  }
};

// Whether a direction across an edge, and any direction at a corner, is one of them, but for `beyond`, a sine.
inline bool is_normal_at(const ConvexBody& body, const ConvexBody::Edge& e, const Vector& n, double beyond) {
  return dot(n, body.faces()[e.left].normal + body.faces()[e.right].normal) > 0 && dot(n, e.into_left) <= beyond &&
         dot(n, e.into_right) <= beyond;
}
inline bool is_normal_at(const ConvexBody& body, ConvexBody::Index corner, const Vector& n, double beyond) {
  return std::ranges::all_of(body.edges_at(corner), [&](ConvexBody::Index k) {
    const ConvexBody::Edge& e = body.edges()[k];
    return dot(n, e.from == corner ? e.along : -e.along) <= beyond;
  });
}

// The largest n·d of all of these unit vectors.
inline double most_along(const ConvexBody& body, const ConvexBody::Edge& e, const Vector& d) {
  if (is_normal_at(body, e, d, 0)) return norm(d - dot(d, e.along) * e.along);
  return std::max(dot(d, body.faces()[e.left].normal), dot(d, body.faces()[e.right].normal));
}
inline double most_along(const ConvexBody& body, ConvexBody::Index corner, const Vector& d) {
  if (is_normal_at(body, corner, d, 0)) return norm(d);
  double most = -std::numeric_limits<double>::infinity();
  for (const ConvexBody::Index e : body.edges_at(corner)) most = std::max(most, most_along(body, body.edges()[e], d));
  return most;
}

}  // namespace dynalin
