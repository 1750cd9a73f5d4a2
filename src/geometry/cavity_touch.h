// What of a shape is deepest in the walls of a cavity: of a box its six faces, of a frustum both ends and the mantle,
// each a wall that goes on beyond its edges, where nothing that is in the cavity comes; of a ball, an ellipsoid and a
// torus the whole surface is one. How far a place is out of a convex cavity is convex, and so corners and rims of a
// shape are deepest in it.
#pragma once

#include <span>

#include "geometry/ellipsoid_touch.h"
#include "geometry/least_on_circle.h"

namespace dynalin::solid {

// How many walls, and the distance of a place from one: negative in the cavity.
inline std::size_t walls(const Box&) { return 6; }
inline std::size_t walls(const Frustum&) { return 3; }
template <class B>
std::size_t walls(const B&) {
  return 1;
}
template <class T>
Distance<T> from_wall(const Box& b, std::size_t which, const Vec3<T>& p) {
  return face(b, which / 2, which % 2 == 1, p);
}
template <class T>
Distance<T> from_wall(const Frustum& f, std::size_t which, const Vec3<T>& p) {
  const FrustumFaces faces(f);
  return which == 0 ? faces.mantle(Meridional<T>(p, faces.size), p) : which == 1 ? faces.below(p) : faces.above(p);
}
template <class T, class B>
Distance<T> from_wall(const B& b, std::size_t, const Vec3<T>& p) {
  return distance(b, p);
}

// Of a ball about a place.
template <class T>
Touch<T> touch_of_ball(double radius, const Vec3<T>& centre, Distance<T> d, bool reversed) {
  if (reversed) d.value = -d.value, d.direction = -d.direction;
  const Vec3<T> point = centre - d.direction * (0.5 * (d.value + radius));
  return {d.value - radius, d.direction, point, std::numeric_limits<double>::infinity(), d.defined, d.seam};
}

// Calls place(point) and circle(Circle, radius of the tube about it) for what a shape reaches farthest with.
template <class T, class Place, class Ring>
void for_each_outermost(const Ball& b, const RelativeFrame<T>& I, const Place& place, const Ring&) {
  place(I.p, b.radius);
}
template <class T, class Place, class Ring>
void for_each_outermost(const Torus& t, const RelativeFrame<T>& I, const Place&, const Ring& ring) {
  ring(Circle<T>{I.p, I.x, I.y, t.major}, t.minor);
}
template <class T, class Place, class Ring>
void for_each_outermost(const Frustum& f, const RelativeFrame<T>& I, const Place&, const Ring& ring) {
  ring(Circle<T>{I.p + I.z * f.low, I.x, I.y, f.low_radius}, 0.0);
  ring(Circle<T>{I.p + I.z * f.high, I.x, I.y, f.high_radius}, 0.0);
}
template <class T, class Place, class Ring>
void for_each_outermost(const Box& b, const RelativeFrame<T>& I, const Place& place, const Ring&) {
  for (std::size_t k = 0; k < 8; ++k) {
    place(I.p + I.x * (k & 1 ? b.high.x : b.low.x) + I.y * (k & 2 ? b.high.y : b.low.y) +
              I.z * (k & 4 ? b.high.z : b.low.z),
          0.0);
  }
}
template <class T, class Place, class Ring>
void for_each_outermost(const Polyhedron& f, const RelativeFrame<T>& I, const Place& place, const Ring&) {
  for (const Vector& c : f.body->corners()) place(I.p + I.x * c.x + I.y * c.y + I.z * c.z, 0.0);
}
inline std::size_t outermost(const Ball&) { return 1; }
inline std::size_t outermost(const Torus&) { return 1; }
inline std::size_t outermost(const Frustum&) { return 2; }
inline std::size_t outermost(const Box&) { return 8; }
inline std::size_t outermost(const Polyhedron& f) { return f.body->corners().size(); }

// As many as `outermost` times `walls`.
template <class T, class A, class B>
void touch_cavity(const A& a, const RelativeFrame<T>& I, const B& b, std::span<Touch<T>> out) {
  std::size_t next = 0;
  for (std::size_t w = 0; w < walls(b); ++w) {
    for_each_outermost(
        a, I,
        [&](const Vec3<T>& p, double radius) { out[next++] = touch_of_ball(radius, p, from_wall(b, w, p), true); },
        [&](const Circle<T>& circle, double radius) {
          const OnCircle<T> deepest = nearest_on_circle(circle, [&](const auto& p) {
            auto d = from_wall(b, w, p);
            d.value = -d.value, d.direction = -d.direction;
            return d;
          });
          out[next++] = touch_of_ball(radius, deepest.point, deepest.distance, false);
        });
  }
}

// An ellipsoid with each wall, where it is deepest across its normal.
template <class T>
void touch_cavity(const Ellipsoid& a, const RelativeFrame<T>& I, const Box& b, std::span<Touch<T>> out) {
  for (std::size_t k = 0; k < 6; ++k) {
    const bool upper = k % 2 == 1;
    Vec3<T> n{T(0.0), T(0.0), T(0.0)};
    n[k / 2] = T(upper ? -1.0 : 1.0);
    out[k] = touch_face(PlacedEllipsoid<T>{a.semi_axes, I}, n, upper ? -b.high[k / 2] : b.low[k / 2]);
  }
}
template <class T>
void touch_cavity(const Ellipsoid& a, const RelativeFrame<T>& I, const Frustum& f, std::span<Touch<T>> out) {
  const PlacedEllipsoid<T> e{a.semi_axes, I};
  out[0] = touch_mantle(e, FrustumFaces(f), true);
  out[1] = touch_face(e, {T(0.0), T(0.0), T(1.0)}, f.low);
  out[2] = touch_face(e, {T(0.0), T(0.0), T(-1.0)}, -f.high);
}

}  // namespace dynalin::solid
