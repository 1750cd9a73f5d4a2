// A curve of a plane where it stands, seen along z, and what of it is nearest to a point.
#pragma once

#include <cmath>
#include <limits>

#include "geometry/plane_curve.h"
#include "mechanics/path.h"

namespace dynalin::plane {

template <class A, class B>
auto cross_z(const Vec3<A>& a, const Vec3<B>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class A, class B>
auto dot_xy(const Vec3<A>& a, const Vec3<B>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class T>
T norm_xy(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot_xy(a, a));
}

// A curve where it stands, seen along z.
template <class T>
struct PlacedCurve {
  const PlaneCurve& curve;
  bool reversed;
  RelativeFrame<T> frame;

  Vec3<T> turned(const Vec3<T>& v) const { return frame.x * v.x + frame.y * v.y; }
  Vec3<T> at(const PlaneCurve::Piece& p, const T& u, int derivative = 0) const {
    const Vec3<T> v = turned(curve.at(p, u, derivative));
    return derivative == 0 ? frame.p + v : v;
  }
  Vec3<T> corner(const PlaneCurve::Corner& c) const { return frame.p + turned({T(c.at.x), T(c.at.y), T(0.0)}); }
  // Of a point as it is seen, in the axes of the curve.
  Vector local(const Vector& p) const {
    const Vector d = p - value_of(frame.p);
    return {dot(value_of(frame.x), d), dot(value_of(frame.y), d), 0};
  }
  // 1 where matter is to the left as it is seen.
  double sense() const {
    const double seen = value_of(frame.x.x * frame.y.y - frame.x.y * frame.y.x);
    return curve.sense() * (reversed ? -1.0 : 1.0) * (seen < 0 ? -1.0 : 1.0);
  }
  // Out of matter, by the tangent.
  Vec3<T> normal(const Vec3<T>& tangent) const {
    const T size = norm_xy(tangent) * sense();
    return {tangent.y / size, -tangent.x / size, T(0.0)};
  }
  bool solid(const PlaneCurve::Corner& c) const { return c.convex != reversed; }
};

// A whole circle does not turn about its centre: in axes that its z alone gives, no rounding says that it does.
template <class T>
RelativeFrame<T> untwisted(const PlaneCurve& curve, const RelativeFrame<T>& f) {
  if (curve.pieces().front().kind != PlaneCurve::Piece::Kind::circle || !curve.closed()) return f;
  const Vec3<T> along{T(1.0) - f.z.x * f.z.x, -f.z.y * f.z.x, -f.z.z * f.z.x};
  const Vec3<T> x = along / norm(along);
  return {f.p, x, cross(f.z, x), f.z};
}

// What is nearest to a point: somewhere on a piece, or a corner.
struct Foot {
  const PlaneCurve::Piece* piece = nullptr;
  const PlaneCurve::Corner* corner = nullptr;
  double u = 0, away = std::numeric_limits<double>::infinity();
  bool tied = false;  // something elsewhere is as near
};

inline Foot nearest_foot(const PlaneCurve& curve, const Vector& p) {
  Foot best;
  Vector best_at;
  const double rounding = 1e-12 * curve.radius(), elsewhere = 1e-6 * curve.radius();
  const auto consider = [&](Foot foot, const Vector& at) {
    foot.away = norm(p - at);
    if (!(foot.away <= best.away + rounding)) return;
    const bool as_near = foot.away >= best.away - rounding;
    foot.tied = as_near && (best.tied || norm(at - best_at) > elsewhere);
    if (foot.away < best.away) best = foot, best_at = at;
    best.tied = foot.tied;
  };
  for (const PlaneCurve::Piece& piece : curve.pieces()) {
    const double u = curve.nearest(piece, p);
    const bool before = !piece.round && u < piece.from, beyond = !piece.round && u > piece.to;
    if ((before && !piece.start_free) || (beyond && !piece.end_free)) continue;
    consider({&piece, nullptr, u}, curve.at(piece, before ? piece.from : beyond ? piece.to : u));
  }
  for (const PlaneCurve::Corner& c : curve.corners()) consider({nullptr, &c}, c.at);
  return best;
}

// A point of matter that stands over the foot: gap, direction away from the curve, and the point of the curve.
template <class T>
struct OverFoot {
  T gap{};
  Vec3<T> normal, at;
  bool defined = true;
};
template <class T>
OverFoot<T> over_foot(const PlacedCurve<T>& c, const Foot& foot, const Vec3<T>& p) {
  OverFoot<T> over;
  if (foot.corner != nullptr) {
    over.at = c.corner(*foot.corner);
    const double side = c.solid(*foot.corner) ? 1.0 : -1.0;
    const Vec3<T> d{(p.x - over.at.x) * side, (p.y - over.at.y) * side, T(0.0)};
    over.normal = {T(1.0), T(0.0), T(0.0)};
    over.defined = value_of(d.x) != 0 || value_of(d.y) != 0;
    if (!over.defined) return over;
    over.defined = !foot.tied;
    over.gap = norm_xy(d) * side;
    over.normal = d / norm_xy(d);
    return over;
  }
  // One step of Newton's method towards the foot.
  const Vec3<T> d = c.at(*foot.piece, T(foot.u)) - p;
  const Vec3<T> slope = c.at(*foot.piece, T(foot.u), 1), bend = c.at(*foot.piece, T(foot.u), 2);
  const double square = value_of(dot_xy(slope, slope)), curvature = square + value_of(dot_xy(d, bend));
  over.defined = curvature > 1e-9 * square;  // not in the centre of curvature
  const T u = over.defined ? T(foot.u) - dot_xy(d, slope) * (1 / curvature) : T(foot.u);
  over.at = c.at(*foot.piece, u);
  over.normal = c.normal(c.at(*foot.piece, u, 1));
  over.gap = dot_xy(p - over.at, over.normal);
  over.defined = over.defined && !foot.tied;
  return over;
}

// Where planes incline, the foot as it is seen is not that in the plane of the curve.
inline void refine(const PlacedCurve<double>& c, Foot& foot, const Vector& p) {
  if (foot.piece == nullptr) return;
  for (int k = 0; k < 20; ++k) {
    const Vector d = c.at(*foot.piece, foot.u) - p;
    const Vector slope = c.at(*foot.piece, foot.u, 1), bend = c.at(*foot.piece, foot.u, 2);
    const double curvature = dot_xy(slope, slope) + dot_xy(d, bend), step = dot_xy(d, slope) / curvature;
    if (!(curvature > 0)) return;
    foot.u -= step;
    if (std::abs(step) < 1e-15) return;
  }
}

}  // namespace dynalin::plane
