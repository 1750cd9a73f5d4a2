// What pushes in a volume that two bodies have in common, out of its integrals: the normal by the net area of the
// surface that either has in the other one, without sides, and the depth.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/smooth_step.h"
#include "geometry/facet_overlap.h"
#include "geometry/touch.h"

namespace dynalin::overlap_law {

using Index = FacetBody::Index;

// Of the area of both parts of a volume's surface: below it they are nearly closed, and no direction is left.
inline constexpr double least_net_area = 0.1;
inline constexpr double no_sides = 1e-6;                      // of the area of a surface
inline constexpr double most_depth = 1.1;                     // of the extent of a volume along the normal
inline constexpr double side_below = 0.05, face_above = 0.2;  // cosine between a facet and the net area: see NetArea
inline constexpr double just_touching = 1e-12;                // of the size: a mean depth that is none
inline constexpr double on_facet = 1e-9;  // of its size: how far beside it a line still meets a facet

template <class T>
Vec3<T> turned(const RelativeFrame<T>& f, const Vector& v) {
  return f.x * v.x + f.y * v.y + f.z * v.z;
}

// One of the bodies where it stands, in the axes of J.
template <class T>
struct PlacedFacets {
  const FacetBody& body;
  RelativeFrame<T> frame;
  double sign;  // −1: what is around the facets

  Vec3<T> normal(Index t) const { return turned(frame, body.triangles()[t].normal) * sign; }
  Vec3<T> corner(Index t, std::size_t n) const {
    return frame.p + turned(frame, body.vertices()[body.triangles()[t].corner[n % 3]]);
  }
  // How far along a line from a point the plane of a triangle is.
  T length_to(Index t, const Vec3<T>& from, const Vec3<T>& way) const {
    const Vec3<T> n = normal(t);
    return dot(n, corner(t, 0) - from) / dot(n, way);
  }
};

// Where a line through a volume leaves one of the bodies.
struct Exit {
  Index triangle = 0;
  double length = 0;                                      // along the line
  double seam = std::numeric_limits<double>::infinity();  // to the next edge between faces of two planes
};

// Of the facets that look along the line, the one that it meets nearest to where it starts.
template <class Part>
std::optional<Exit> exit_of(const PlacedFacets<double>& A, const std::vector<Part>& facets, const Vector& from,
                            const Vector& way) {
  std::optional<Exit> nearest;
  for (const Part& facet : facets) {
    const Index t = facet.triangle;
    const Vector n = A.normal(t);
    if (!(dot(n, way) > 0)) continue;
    Exit e{t, A.length_to(t, from, way)};
    if (nearest && std::abs(e.length) >= std::abs(nearest->length)) continue;
    const Vector at = from + way * e.length;
    bool within = true;
    for (std::size_t side = 0; side < 3 && within; ++side) {
      const Vector begin = A.corner(t, side), along = A.corner(t, side + 1) - begin;
      const double length = norm(along), depth = A.sign * dot(cross(n, along), at - begin) / length;
      within = depth >= -on_facet * length;
      const Index beside = A.body.triangles()[t].across[side];
      if (norm(A.body.triangles()[beside].normal - A.body.triangles()[t].normal) > on_facet)
        e.seam = std::min(e.seam, std::abs(depth));
    }
    if (within) nearest = e;
  }
  return nearest;
}

template <class T>
RelativeFrame<double> plain(const RelativeFrame<T>& f) {
  return {value_of(f.p), value_of(f.x), value_of(f.y), value_of(f.z)};
}

// A motion of I as a shift of what of it is at a place and a turn, both 0 with the derivatives that the frame has.
template <class T>
struct Nudge {
  Vec3<T> shift, turn;

  Nudge(const RelativeFrame<T>& f, const Vector& place) {
    const RelativeFrame<double> at = plain(f);
    turn = (cross(at.x, f.x) + cross(at.y, f.y) + cross(at.z, f.z)) * 0.5;
    shift = f.p - at.p + cross(turn, place - at.p);
  }
  T of(double value, const Vector& by_shift, const Vector& by_turn) const {
    return dot(shift, by_shift) + dot(turn, by_turn) + value;
  }
  Vec3<T> of(const Vector& value, const Matrix3& by_shift, const Matrix3& by_turn) const {
    return by_shift * shift + by_turn * turn + value;
  }
};

// --- the normal

// 0 below the first number, 1 above the second one.
template <class T>
T step(const T& x, double from, double to) {
  if (value_of(x) <= from) return T(0.0);
  if (value_of(x) >= to) return T(1.0);
  return smooth_step(T((x - from) / (to - from)));
}

// A face of one body as far as it is in the other one: of a curved one the mean normal.
template <class T>
struct FaceInside {
  T area;
  Vec3<T> net;                    // ∫ n dS
  std::optional<Vec3<T>> normal;  // nothing where it is curved
  Vector plane;                   // in the axes of its body; faces of one plane have one normal
};

// The surface of one body that is in the other one, as seen from where that comes from.
template <class T>
struct NetArea {
  Vec3<T> all{T(0.0), T(0.0), T(0.0)};   // ∫ n dS
  Vec3<T> face{T(0.0), T(0.0), T(0.0)};  // without sides
  T sides{0.0};                          // their area
  std::optional<Vec3<T>> flat;           // the normal of all that is no side, where that is one plane
};

template <class Part>
double surface_of(const std::vector<Part>& parts) {
  double sum = 0;
  for (const Part& p : parts) sum += p.area;
  return sum;
}

// Of faces whose areas are `surface` together.
template <class T>
NetArea<T> net_area(const std::vector<FaceInside<T>>& faces, double surface) {
  NetArea<T> net;
  for (const FaceInside<T>& f : faces) net.all += f.net;
  net.face = net.all;
  const T size = norm(net.all);
  if (value_of(size) <= no_sides * surface) return net;
  const Vec3<T> towards = net.all / size;
  Vec3<T> of_sides{T(0.0), T(0.0), T(0.0)};
  T area(0.0);
  const Vector* plane = nullptr;
  bool is_flat = true;
  for (const FaceInside<T>& f : faces) {
    if (!f.normal && !(value_of(f.area) > no_sides * surface)) continue;
    const T cosine = f.normal ? dot(*f.normal, towards) : dot(f.net, towards) / f.area,
            share = 1.0 - step(value_of(cosine) < 0 ? -cosine : cosine, side_below, face_above);
    of_sides += f.net * share, area += f.area * share;
    if (value_of(share) == 1) continue;
    is_flat =
        is_flat && f.normal && (!plane || (f.plane.x == plane->x && f.plane.y == plane->y && f.plane.z == plane->z));
    if (!plane) plane = &f.plane, net.flat = f.normal;
  }
  if (!is_flat) net.flat.reset();
  if (!(value_of(area) > 0)) return net;
  // The square: a norm has no derivative at 0.
  const T sideways = dot(of_sides, of_sides) / (size * size);
  const T left_out = 1.0 - step(sideways, 0.01, 0.09);
  net.face = net.all - of_sides * left_out, net.sides = area * left_out;
  return net;
}

template <class T, class Part>
NetArea<T> net_area(const PlacedFacets<T>& A, const std::vector<Part>& parts, const Nudge<T>& nudge) {
  std::vector<FaceInside<T>> faces;
  for (const Part& p : parts) {
    const T area = nudge.of(p.area, p.area_by_shift, p.area_by_turn);
    const Vec3<T> n = A.normal(p.triangle);
    faces.push_back({area, n * area, n, A.body.triangles()[p.triangle].normal});
  }
  return net_area(faces, surface_of(parts));
}

// Both bodies' areas are opposite, as they bound one volume; without sides they incline to each other as faces do. That
// of a body with fewer sides counts, as the face of a floor does for a block that stands on it. `surface`: the smaller
// one of both.
template <class T>
std::optional<Vec3<T>> normal_of(const NetArea<T>& of_I, const NetArea<T>& of_J, double surface) {
  if (value_of(norm(of_J.all)) <= least_net_area * surface) return std::nullopt;
  // What is flat says the normal without roundings, so that nothing pushes along it.
  const T sides = of_I.sides + of_J.sides;
  if (value_of(of_J.sides) <= no_sides * surface && of_J.flat) return of_J.flat;
  if (value_of(of_I.sides) <= no_sides * surface && of_I.flat) return -*of_I.flat;
  if (value_of(sides) <= no_sides * surface) return normalized(of_J.all);
  return normalized(of_J.face * (of_I.sides / sides) - of_I.face * (of_J.sides / sides));
}

// --- the depth

// How far the surfaces of J and of I are from a place along the normal.
template <class T>
struct Reach {
  T above{0.0}, below{0.0};
  T sum() const { return above + below; }
};

inline double extent(const Overlap& o, const Vector& along) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector& v : o.corners) low = std::min(low, dot(v, along)), high = std::max(high, dot(v, along));
  return high - low;
}

// From the centroid c, where one of the surfaces is flat and the other comes to a point, to an edge or a face there: by
// their mean distances from it. With a cross-section that grows from the point on as the power p of the way, of the
// depth d the mean is d/(p + 1) and c is d/(p + 2) below the flat surface, of which d is what both say together. Where
// none is flat it is less than the depth.
template <class T>
Reach<T> mean_reach(const Overlap& o, const PlacedFacets<T>& J, const Nudge<T>& nudge, const T& volume,
                    const Vec3<T>& from_origin, const Vec3<T>& normal) {
  T seen(0.0), flux(0.0);  // ∫ n · m dS, ∫ (x · m) (n · m) dS over J's part; both over I's are what is left to 0 and V
  for (const Overlap::FixedPart& p : o.of_J) {
    const T cosine = dot(J.normal(p.triangle), normal);
    seen += cosine * nudge.of(p.area, p.area_by_shift, p.area_by_turn);
    flux += cosine * dot(normal, nudge.of(p.first, p.first_by_shift, p.first_by_turn));
  }
  const T at = dot(normal, from_origin), up = flux / seen - at, down = at - (flux - volume) / seen;
  if (!(value_of(up) > 0 && value_of(down) > 0)) return {};
  const T mean = volume / seen;
  if (value_of(up) > value_of(down)) return {up, mean * up / down - up};
  return {mean * down / up - down, down};
}

// A place in a volume, from its origin.
template <class T>
Vec3<T> centroid_of(const Overlap& o, const Nudge<T>& nudge) {
  return nudge.of(o.moment, o.moment_by_shift, o.moment_by_turn) /
         nudge.of(o.volume, o.volume_by_shift, o.volume_by_turn);
}

// The force is half-way between both surfaces as seen from the centroid. `met`: how far both are from it along the
// normal; `reaches`: whether the volume does so far.
template <class T, class Met, class Reaches>
Touch<T> touch_in(const Overlap& o, const PlacedFacets<T>& J, const Nudge<T>& nudge, const Vec3<T>& from_origin,
                  const std::optional<Vec3<T>>& found, const Met& met, const Reaches& reaches) {
  const T volume = nudge.of(o.volume, o.volume_by_shift, o.volume_by_turn);
  const Vec3<T> centroid = from_origin + o.origin;
  Touch<T> t;
  t.gap = T(-std::cbrt(std::abs(o.volume)));
  t.normal = {T(0.0), T(0.0), T(1.0)}, t.point = centroid;
  t.defined = false;
  if (!o.whole || !found) return t;
  const Vec3<T>& normal = *found;
  Reach<T> reach = mean_reach(o, J, nudge, volume, from_origin, normal);
  // Where a body comes out at the other side, surfaces look the other way in part, and the means say nothing.
  if (value_of(reach.sum()) > 0 && !reaches(value_of(normal), value_of(reach.sum()) / most_depth)) reach = {};
  double seam = t.seam;
  const std::optional<Reach<T>> ends = met(centroid, normal, seam);
  if (ends && value_of(ends->sum()) > value_of(reach.sum())) reach = *ends, t.seam = seam;
  if (!(value_of(reach.sum()) > 0)) return t;
  t.gap = -reach.sum();
  t.normal = normal, t.point = centroid + normal * ((reach.above - reach.below) * 0.5);
  t.defined = true;
  return t;
}

// Where I stands when its volumes are looked at.
template <class T>
RelativeFrame<T> aside(const RelativeFrame<T>& f, const Vector& way) {
  return {f.p + way, f.x, f.y, f.z};
}
// The same, moving: derivatives are what the whole way makes of a touch.
template <class T>
RelativeFrame<Dual<1>> along_the_way(const RelativeFrame<T>& f, const Vector& way) {
  const RelativeFrame<double> at = plain(f);
  const auto moving = [](double value, double rate) {
    Dual<1> x(value);
    x.partial[0] = rate;
    return x;
  };
  const auto still = [](const Vector& v) { return Vec3<Dual<1>>{v.x, v.y, v.z}; };
  return {{moving(at.p.x + way.x, way.x), moving(at.p.y + way.y, way.y), moving(at.p.z + way.z, way.z)},
          still(at.x),
          still(at.y),
          still(at.z)};
}
// A touch back from there to where I is, to first order; what is hardly deeper than the way stays.
template <class T>
Touch<T> back(Touch<T> t, const Touch<Dual<1>>& along) {
  constexpr double hardly_deeper = 1e-3;
  if (!t.defined || !(std::abs(along.gap.partial[0]) < hardly_deeper * std::abs(along.gap.value))) return t;
  const auto way = [](const Vec3<Dual<1>>& v) { return Vector{v.x.partial[0], v.y.partial[0], v.z.partial[0]}; };
  t.gap = t.gap - along.gap.partial[0];
  t.normal = t.normal - way(along.normal), t.point = t.point - way(along.point);
  return t;
}

// Nothing has touched yet, or what has cannot be told.
template <class T>
void fill_apart(double size, bool undefined, std::span<Touch<T>> out) {
  Touch<T> far;
  far.gap = T(size), far.normal = {T(0.0), T(0.0), T(1.0)};
  std::ranges::fill(out, far);
  if (undefined) out[0].gap = T(-size), out[0].defined = false;
}

// In the axes of its own.
template <class T>
PlacedFacets<T> standing(const FacetBody& body, bool cavity) {
  const Vec3<T> x{T(1.0), T(0.0), T(0.0)}, y{T(0.0), T(1.0), T(0.0)}, z{T(0.0), T(0.0), T(1.0)};
  return {body, {{T(0.0), T(0.0), T(0.0)}, x, y, z}, cavity ? -1.0 : 1.0};
}

// A touch of each volume, as many as there is room for.
template <class T, class Volume, class TouchOf>
void touch_each(const std::vector<Volume>& volumes, const TouchOf& touch_of, std::span<Touch<T>> out) {
  std::size_t count = 0;
  for (const Volume& o : volumes) {
    if (count == out.size()) {
      out.back().defined = false;
      return;
    }
    out[count++] = touch_of(o);
  }
}

}  // namespace dynalin::overlap_law
