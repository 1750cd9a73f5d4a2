#include "geometry/touch.h"

#include <algorithm>

#include "geometry/box_touch.h"
#include "geometry/cavity_touch.h"
#include "geometry/common_normal.h"
#include "geometry/convex_ellipsoid_touch.h"
#include "geometry/convex_touch.h"
#include "geometry/ellipsoid_touch.h"
#include "geometry/facet_touch.h"
#include "geometry/frustum_touch.h"
#include "geometry/low_on_circle.h"
#include "geometry/overlap_touch.h"
#include "geometry/plane_touch.h"
#include "geometry/seen_back.h"
#include "geometry/solid_overlap_touch.h"

namespace dynalin {

namespace {

using namespace solid;  // NOLINT: the shapes of this file

// --- which pairs there are: A with B, A not a cavity

// Solids and bodies of facets, which meet as convex bodies where both are.
template <class A>
bool is_convex(const A&) {
  return true;
}
bool is_convex(const Polyhedron& p) { return p.body->convex() != nullptr; }
template <class A>
bool meets_by_volume(const A& a, const Polyhedron& b, bool B_reversed) {
  return B_reversed || !is_convex(a) || !is_convex(b);
}

// In a cavity: all of what is convex, but an ellipsoid meets flat walls and mantles alone, and a tube is no convex one.
template <class A, class B>
std::size_t count_in_cavity(const A& a, const B& b) {
  if constexpr (std::is_same_v<A, Ellipsoid>) {
    return std::is_same_v<B, Box> || std::is_same_v<B, Frustum> ? walls(b) : 0;
  } else {
    const bool in_tube = std::is_same_v<B, Torus> && !std::is_same_v<A, Ball> && !std::is_same_v<A, Torus>;
    return in_tube ? 0 : outermost(a) * walls(b);
  }
}

template <class A, class B>
std::size_t count_of([[maybe_unused]] const A& a, [[maybe_unused]] const B& b, bool B_reversed) {
  if constexpr (std::is_same_v<B, Profile>) {
    if constexpr (std::is_same_v<A, Ball>) return a.radius == 0 ? 1 : 0;
    return std::is_same_v<A, Profile> ? most_plane_touches : 0;
  } else if constexpr (std::is_same_v<A, Profile> || std::is_same_v<A, Plane>) {
    return 0;
  } else if constexpr (std::is_same_v<B, Polyhedron>) {
    if constexpr (std::is_same_v<A, Ball>) return facet_touches(a);
    const ConvexBody* body = b.body->convex();
    if constexpr (std::is_same_v<A, Box> || std::is_same_v<A, Polyhedron>) {
      if (meets_by_volume(a, b, B_reversed)) return most_overlaps;
    }
    if constexpr (std::is_same_v<A, Frustum> || std::is_same_v<A, Ellipsoid> || std::is_same_v<A, Torus>) {
      if (meets_by_volume(a, b, B_reversed)) return most_overlaps;
    }
    if (!body || B_reversed) return 0;
    if constexpr (std::is_same_v<A, Ellipsoid> || std::is_same_v<A, Torus>) return 1;
    if constexpr (std::is_same_v<A, Frustum>) return frustum_flat_touches(*body);
    if constexpr (std::is_same_v<A, Box>) return convex_touches(outermost(a), body->corners().size());
    if constexpr (std::is_same_v<A, Polyhedron>)
      return convex_touches(a.body->convex()->corners().size(), body->corners().size());
    return 0;
  } else if constexpr (std::is_same_v<B, Plane>) {
    if constexpr (std::is_same_v<A, Ellipsoid>)
      return 1;
    else
      return outermost(a);
  } else {
    if (B_reversed) return count_in_cavity(a, b);
    if constexpr (std::is_same_v<A, Box> && std::is_same_v<B, Box>) return box_touches;
    if constexpr (std::is_same_v<A, Frustum> && std::is_same_v<B, Box>) return frustum_box_touches;
    if constexpr (std::is_same_v<A, Frustum> && std::is_same_v<B, Frustum>) return frustum_touches;
    if constexpr (std::is_same_v<A, Ellipsoid>) return std::is_same_v<B, Torus> || std::is_same_v<B, Ball> ? 0 : 1;
    return std::is_same_v<A, Ball> || (std::is_same_v<A, Torus> && !std::is_same_v<B, Ball>) ? 1 : 0;
  }
}
std::size_t direct_count(const Side& A, const Side& B) {
  if (const auto* profile = std::get_if<Profile>(&A.shape)) {
    // An open one has matter on one side or the other.
    const bool cavity = A.reversed && profile->curve->closed();
    return cavity ? 0 : std::visit([&](const auto& b) { return count_of(*profile, b, B.reversed); }, B.shape);
  }
  if (A.reversed) return 0;
  return std::visit([&](const auto& a, const auto& b) { return count_of(a, b, B.reversed); }, A.shape, B.shape);
}

// --- a torus and anything

// A torus is what is about its circle.
template <class T, class B>
void touch_torus(const Torus& t, const RelativeFrame<T>& I, const B& b, std::span<Touch<T>> out) {
  const OnCircle<T> nearest =
      nearest_on_circle(Circle<T>{I.p, I.x, I.y, t.major}, [&](const auto& p) { return distance(b, p); });
  out[0] = touch_of_ball(t.minor, nearest.point, nearest.distance, false);
}

// --- what reaches deepest through a plane

template <class T>
double inside(const Plane& p, const Vec3<T>& at) {
  const double x = value_of(at.x), y = value_of(at.y);
  return std::min({x - p.xmin, p.xmax - x, y - p.ymin, p.ymax - y});
}

template <class T>
Touch<T> touch_on_plane(const Vec3<T>& lowest, double up, const Plane& plane) {
  Touch<T> t;
  t.gap = lowest.z * up;
  t.normal = {T(0.0), T(0.0), T(up)};
  t.point = {lowest.x, lowest.y, lowest.z * 0.5};
  t.inside = inside(plane, lowest);
  return t;
}

// The lowest place of a circle about `centre`, across the unit vector `axis`.
template <class T>
Vec3<T> lowest_of_circle(const Vec3<T>& centre, const Vec3<T>& axis, double radius, double up) {
  // Down, less what of it is along the axis.
  const Vec3<T> down{axis.z * axis.x * up, axis.z * axis.y * up, (axis.z * axis.z - 1.0) * up};
  const LowPlace<T> low = low_on_circle(down, radius);
  Vec3<T> place = centre + low.from_centre;
  place.z = centre.z - low.depth * up;
  return place;
}

template <class T>
void touch_plane(const Ball& b, const RelativeFrame<T>& I, const Plane& plane, double up, std::span<Touch<T>> out) {
  out[0] = touch_of_ball(b.radius, I.p, {I.p.z, {T(0.0), T(0.0), T(1.0)}}, up < 0);
  out[0].inside = inside(plane, I.p);
}
template <class T>
void touch_plane(const Ellipsoid& e, const RelativeFrame<T>& I, const Plane& plane, double up,
                 std::span<Touch<T>> out) {
  const Vector& a = e.semi_axes;
  const Vec3<T> n{I.x.z * (a.x * up), I.y.z * (a.y * up), I.z.z * (a.z * up)};
  const Vec3<T> from_centre = I.x * (n.x * a.x) + I.y * (n.y * a.y) + I.z * (n.z * a.z);
  out[0] = touch_on_plane(I.p - from_centre / norm(n), up, plane);
}
template <class T>
void touch_plane(const Frustum& f, const RelativeFrame<T>& I, const Plane& plane, double up, std::span<Touch<T>> out) {
  for (const bool upper : {false, true}) {
    const Vec3<T> centre = I.p + I.z * (upper ? f.high : f.low);
    const double radius = upper ? f.high_radius : f.low_radius;
    out[upper ? 1 : 0] = touch_on_plane(lowest_of_circle(centre, I.z, radius, up), up, plane);
  }
}
template <class T>
void touch_plane(const Torus& t, const RelativeFrame<T>& I, const Plane& plane, double up, std::span<Touch<T>> out) {
  Vec3<T> lowest = lowest_of_circle(I.p, I.z, t.major, up);
  lowest.z -= T(t.minor * up);
  out[0] = touch_on_plane(lowest, up, plane);
}
// A shape with corners.
template <class T, class A>
void touch_plane(const A& b, const RelativeFrame<T>& I, const Plane& plane, double up, std::span<Touch<T>> out) {
  std::size_t next = 0;
  for_each_outermost(
      b, I, [&](const Vec3<T>& corner, double) { out[next++] = touch_on_plane(corner, up, plane); },
      [](const Circle<T>&, double) {});
}

template <class T>
void touch_ellipsoids(const Ellipsoid& a, const RelativeFrame<T>& I, const Ellipsoid& b, std::span<Touch<T>> out) {
  const auto c = common_normal(a, I, b);
  Touch<T>& t = out[0];
  if (!c) {
    t = {T(-norm(a.semi_axes)), {T(0.0), T(0.0), T(1.0)}, I.p * 0.5};
    t.defined = false;
    return;
  }
  t = {dot(c->normal, c->on_first - c->on_second), c->normal, (c->on_first + c->on_second) * 0.5};
}

template <class T>
void direct(const Side& A, const Side& B, const RelativeFrame<T>& A_from_B, std::span<Touch<T>> out) {
  std::visit(
      [&]<class S, class U>(const S& a, const U& b) {
        if constexpr (std::is_same_v<U, Profile>) {
          if constexpr (std::is_same_v<S, Profile>)
            touch_curves(*a.curve, A.reversed, A_from_B, *b.curve, B.reversed, out);
          else if constexpr (std::is_same_v<S, Ball>)
            out[0] = touch_point(A_from_B.p, *b.curve, B.reversed);
        } else if constexpr (std::is_same_v<S, Profile> || std::is_same_v<S, Plane>) {
          return;
        } else if constexpr (std::is_same_v<U, Polyhedron>) {
          if constexpr (std::is_same_v<S, Ball>) touch_facets(a, A_from_B.p, *b.body, B.reversed, out);
          if constexpr (std::is_same_v<S, Torus>) {
            if (meets_by_volume(a, b, B.reversed))
              touch_overlaps(TorusSolid(a), A_from_B, *b.body, B.reversed, out);
            else
              touch_torus(a, A_from_B, b, out);
          }
          if constexpr (std::is_same_v<S, Frustum> || std::is_same_v<S, Ellipsoid>) {
            if (meets_by_volume(a, b, B.reversed))
              touch_overlaps(QuadricSolid(a), A_from_B, *b.body, B.reversed, out);
            else if constexpr (std::is_same_v<S, Frustum>)
              touch_frustum(a, A_from_B, *b.body->convex(), out);
            else
              out[0] = touch_ellipsoid(a, A_from_B, *b.body->convex());
          }
          if constexpr (std::is_same_v<S, Box>) {
            if (meets_by_volume(a, b, B.reversed))
              touch_overlaps(facets_of_box(a.low, a.high), A_from_B, *b.body, B.reversed, out);
            else
              touch_convex(ConvexBody::box(a.low, a.high), A_from_B, *b.body->convex(), out);
          }
          if constexpr (std::is_same_v<S, Polyhedron>) {
            if (meets_by_volume(a, b, B.reversed))
              touch_overlaps(*a.body, A_from_B, *b.body, B.reversed, out);
            else
              touch_convex(*a.body->convex(), A_from_B, *b.body->convex(), out);
          }
        } else if constexpr (std::is_same_v<U, Plane>) {
          touch_plane(a, A_from_B, b, B.reversed ? -1.0 : 1.0, out);
        } else {
          if (B.reversed) {
            if constexpr (!std::is_same_v<S, Ellipsoid> || std::is_same_v<U, Box> || std::is_same_v<U, Frustum>)
              touch_cavity(a, A_from_B, b, out);
          } else if constexpr (std::is_same_v<S, Ball>) {
            out[0] = touch_of_ball(a.radius, A_from_B.p, distance(b, A_from_B.p), false);
          } else if constexpr (std::is_same_v<S, Torus>) {
            touch_torus(a, A_from_B, b, out);
          } else if constexpr (std::is_same_v<S, Ellipsoid> && std::is_same_v<U, Ellipsoid>) {
            touch_ellipsoids(a, A_from_B, b, out);
          } else if constexpr (std::is_same_v<S, Ellipsoid> && (std::is_same_v<U, Box> || std::is_same_v<U, Frustum>)) {
            out[0] = touch_ellipsoid(a, A_from_B, b);
          } else if constexpr (std::is_same_v<S, Box> && std::is_same_v<U, Box>) {
            touch_boxes(a, A_from_B, b, out);
          } else if constexpr (std::is_same_v<S, Frustum> && (std::is_same_v<U, Box> || std::is_same_v<U, Frustum>)) {
            touch_frustum(a, A_from_B, b, out);
          }
        }
      },
      A.shape, B.shape);
}

}  // namespace

std::size_t touch_count(const Side& I, const Side& J) {
  const std::size_t count = direct_count(I, J);
  return count > 0 ? count : direct_count(J, I);
}

template <class T>
void find_touches(const Side& I, const Side& J, const RelativeFrame<T>& R, std::span<Touch<T>> out) {
  if (direct_count(I, J) > 0) return direct(I, J, R, out);
  direct(J, I, seen_back(R), out);
  for (Touch<T>& t : out) {
    t.normal = -(R.x * t.normal.x + R.y * t.normal.y + R.z * t.normal.z);
    t.point = R.p + R.x * t.point.x + R.y * t.point.y + R.z * t.point.z;
  }
}

template void find_touches(const Side&, const Side&, const RelativeFrame<double>&, std::span<Touch<double>>);
template void find_touches(const Side&, const Side&, const RelativeFrame<Dual<12>>&, std::span<Touch<Dual<12>>>);

}  // namespace dynalin
