// An ellipsoid and a solid with faces, edges and corners: the direction n in which the ellipsoid separates from the
// solid most, or overlaps it least, and where. n is the normal of a face, or stands across a mantle, or lies between
// the normals of the faces that meet at an edge or a corner: of each of these features the best direction is found on
// its own, and the feature with the largest gap of those whose direction belongs to it is the one.
#pragma once

#include <algorithm>
#include <optional>

#include "geometry/direction_patch.h"
#include "geometry/ellipsoid_separation.h"
#include "geometry/touch.h"

namespace dynalin::solid {

// As seen from the other solid.
template <class T>
struct PlacedEllipsoid {
  Vector semi_axes;
  RelativeFrame<T> at;

  // Of its surface, in a direction of any length.
  template <class S>
  Vec3<S> farthest(const Vec3<S>& n) const {
    const Vec3<S> x = as<S>(at.x), y = as<S>(at.y), z = as<S>(at.z);
    const Vec3<S> m{dot(x, n) * semi_axes.x, dot(y, n) * semi_axes.y, dot(z, n) * semi_axes.z};
    const S size = norm(m);
    return as<S>(at.p) + (x * (m.x * semi_axes.x) + y * (m.y * semi_axes.y) + z * (m.z * semi_axes.z)) / size;
  }
  Vec3<T> in_its_axes(const Vec3<T>& v) const { return {dot(at.x, v), dot(at.y, v), dot(at.z, v)}; }
  Vec3<T> from_its_axes(const Vec3<T>& v) const { return at.x * v.x + at.y * v.y + at.z * v.z; }
  PlacedEllipsoid<double> plain() const {
    return {semi_axes, {as<double>(at.p), as<double>(at.x), as<double>(at.y), as<double>(at.z)}};
  }
};

template <class T>
Touch<T> touch_between(const Vec3<T>& on_ellipsoid, const T& gap, const Vec3<T>& normal) {
  return {gap, normal, on_ellipsoid - normal * (gap * 0.5)};
}

// Across a plane n·x = offset, with n out of the solid towards the ellipsoid.
template <class T>
Touch<T> touch_face(const PlacedEllipsoid<T>& e, const Vec3<T>& n, double offset) {
  const Vec3<T> nearest = e.farthest(-n);
  return touch_between(nearest, T(dot(n, nearest) - offset), n);
}

// Across a mantle, outside of it or in the cavity that it bounds: in the meridional plane in which the ellipsoid is
// farthest from it, or deepest in it.
template <class T>
Touch<T> touch_mantle(const PlacedEllipsoid<T>& e, const FrustumFaces& faces, bool cavity) {
  using std::cos, std::sin;
  const double up = cavity ? -1 : 1, offset = faces.f.low_radius * faces.along_z - faces.f.low * faces.along_radius;
  const auto normal = [&](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    return Vec3<S>{S(cos(s) * (up * faces.along_z)), S(sin(s) * (up * faces.along_z)), S(-up * faces.along_radius)};
  };
  const auto turned = [&](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    return Vec3<S>{S(sin(s) * (-up * faces.along_z)), S(cos(s) * (up * faces.along_z)), S(0.0)};
  };
  // The gap grows where it is outside and falls in a cavity: there the least is meant.
  const PlacedEllipsoid<double> plain = e.plain();
  const auto value = [&](double s) { return -up * dot(normal(s), plain.farthest(-normal(s))); };
  const auto slope = [&](const auto& s) { return dot(turned(s), plain.farthest(-normal(s))) * -up; };
  const LeastAngle least = least_on_turn(value, slope, norm(e.semi_axes));
  T s(least.at);
  if (least.definite) s = s + dot(turned(s), e.farthest(-normal(s))) * (up / least.curvature);
  Touch<T> t = touch_face(e, normal(s), up * offset);
  t.defined = least.definite;
  return t;
}

// With a point of the solid, given in the axes of the ellipsoid: there the distance from the ellipsoid says all.
template <class T>
Touch<T> touch_point_of_solid(const PlacedEllipsoid<T>& e, const Vec3<T>& in_its_axes, const Distance<T>& d) {
  const Vec3<T> normal = -e.from_its_axes(d.direction);
  Touch<T> t{d.value, normal, e.at.p + e.from_its_axes(in_its_axes) + normal * (d.value * 0.5)};
  t.defined = d.defined;
  return t;
}

// With a corner or a rim along the direction of a patch that separates most: of what is inside of the ellipsoid the
// nearest way out may lie on the far side, beyond the patch.
template <class T>
std::optional<Touch<T>> touch_patch(const PlacedEllipsoid<T>& e, const DirectionPatch& patch) {
  const PlacedEllipsoid<double> plain = e.plain();
  const auto largest = largest_on_patch(
      patch, [&](const auto& n) { return plain.farthest(n); }, norm(e.semi_axes));
  if (!largest) return std::nullopt;
  T s(largest->s), t(largest->t);
  const auto slope = patch.slopes(s, t, [&](const auto& n) { return e.farthest(n); });
  const auto& J = largest->curvature;
  const double determinant = J[0][0] * J[1][1] - J[0][1] * J[1][0];
  s = s - (slope[0] * J[1][1] - slope[1] * J[0][1]) * (1 / determinant);
  t = t - (slope[1] * J[0][0] - slope[0] * J[1][0]) * (1 / determinant);
  const Vec3<T> n = patch.normal(s, t), nearest = e.farthest(-n);
  Touch<T> touch = touch_between(nearest, T(dot(n, nearest - patch.support(s))), n);
  touch.defined = largest->definite;
  return touch;
}

// --- features of solids: how many, and the touch of one if its direction belongs to it

inline constexpr double belongs = -1e-9;  // sines of directions

inline std::size_t features(const Frustum&) { return 5; }
template <class T>
std::optional<Touch<T>> touch_feature(const PlacedEllipsoid<T>& e, const Frustum& f, std::size_t which) {
  const FrustumFaces faces(f);
  const double tolerance = 1e-9 * (f.high - f.low);
  const auto radius_of = [](const Vec3<T>& p) { return std::hypot(value_of(p.x), value_of(p.y)); };
  if (which < 2) {  // below, above
    const bool upper = which == 1;
    const Touch<T> t = touch_face(e, {T(0.0), T(0.0), T(upper ? 1.0 : -1.0)}, upper ? f.high : -f.low);
    if (radius_of(t.point) > (upper ? f.high_radius : f.low_radius)) return std::nullopt;
    return t;
  }
  if (which == 2) {
    const Touch<T> t = touch_mantle(e, faces, false);
    const Vec3<T> on_mantle = t.point - t.normal * (t.gap * 0.5);
    const double along = faces.along_mantle(radius_of(on_mantle), value_of(on_mantle.z));
    // On the other side of the axis, too, there is no mantle of a cone.
    const double outward = value_of(on_mantle.x) * value_of(t.normal.x) + value_of(on_mantle.y) * value_of(t.normal.y);
    if (along < -tolerance || along > faces.length + tolerance || outward < 0) return std::nullopt;
    return t;
  }
  const bool upper = which == 4;
  const double radius = upper ? f.high_radius : f.low_radius, height = upper ? f.high : f.low;
  const auto axis = [&](double x, double y, double z) { return e.in_its_axes({T(x), T(y), T(z)}); };
  const Circle<T> rim{e.in_its_axes(Vec3<T>{T(0.0), T(0.0), T(height)} - e.at.p), axis(1, 0, 0), axis(0, 1, 0), radius};
  const OnCircle<T> nearest =
      nearest_on_circle(rim, [&](const auto& p) { return distance(Ellipsoid{e.semi_axes}, p); });
  const Touch<T> t = touch_point_of_solid(e, nearest.point, nearest.distance);
  // Between the normal of the end and that of the mantle.
  const Vec3<T> on_rim = t.point - t.normal * (t.gap * 0.5);
  const double nx = value_of(t.normal.x), ny = value_of(t.normal.y);
  const double outward = radius > 0 ? (value_of(on_rim.x) * nx + value_of(on_rim.y) * ny) / radius : std::hypot(nx, ny);
  const double of_mantle = outward / faces.along_z,
               of_end = (value_of(t.normal.z) + of_mantle * faces.along_radius) * (upper ? 1 : -1);
  const bool between = of_mantle >= belongs && of_end >= belongs, deep = value_of(t.gap) < 0 && radius > 0;
  if (between && (t.defined || !deep)) return t;
  if (!deep) return std::nullopt;
  const double sign = upper ? 1 : -1;
  return touch_patch(e, {.pole = {0, 0, sign},
                         .first = {1, 0, 0},
                         .second = {0, 1, 0},
                         .turn = 2 * std::numbers::pi,
                         .reach = std::atan2(faces.along_z, -sign * faces.along_radius),
                         .base = {0, 0, height},
                         .radius = radius});
}

// Six faces, twelve edges, eight corners.
inline std::size_t features(const Box&) { return 26; }
template <class T>
std::optional<Touch<T>> touch_feature(const PlacedEllipsoid<T>& e, const Box& b, std::size_t which) {
  const auto side = [&](std::size_t axis, bool upper) { return upper ? b.high[axis] : b.low[axis]; };
  const auto looks = [&](const Touch<T>& t, std::size_t axis, bool upper) {
    return value_of(t.normal[axis]) * (upper ? 1 : -1) >= belongs;
  };
  const auto from_ellipsoid = [&](const auto& p) { return distance(Ellipsoid{e.semi_axes}, p); };
  if (which < 6) {
    const std::size_t axis = which / 2;
    const bool upper = which % 2 == 1;
    Vec3<T> n{T(0.0), T(0.0), T(0.0)};
    n[axis] = T(upper ? 1.0 : -1.0);
    const Touch<T> t = touch_face(e, n, upper ? b.high[axis] : -b.low[axis]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k != axis && (value_of(t.point[k]) < b.low[k] || value_of(t.point[k]) > b.high[k])) return std::nullopt;
    }
    return t;
  }
  if (which >= 18) {
    Vec3<T> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = T(side(k, (which - 18) >> k & 1));
    const Vec3<T> seen = e.in_its_axes(corner - e.at.p);
    const Touch<T> t = touch_point_of_solid(e, seen, from_ellipsoid(seen));
    bool between = true;
    for (std::size_t k = 0; k < 3; ++k) between = between && looks(t, k, (which - 18) >> k & 1);
    const bool deep = value_of(t.gap) < 0;
    if (between && (t.defined || !deep)) return t;
    if (!deep) return std::nullopt;
    const auto out = [&](std::size_t k) {
      Vector n{0, 0, 0};
      n[k] = (which - 18) >> k & 1 ? 1 : -1;
      return n;
    };
    return touch_patch(e, {.pole = out(2),
                           .first = out(0),
                           .second = out(1),
                           .turn = 0.5 * std::numbers::pi,
                           .reach = 0.5 * std::numbers::pi,
                           .base = value_of(corner)});
  }
  const std::size_t axis = (which - 6) / 4, one = (axis + 1) % 3, other = (axis + 2) % 3;
  const bool one_upper = (which - 6) % 2 == 1, other_upper = (which - 6) / 2 % 2 == 1;
  Vec3<double> corner, first{0, 0, 0}, second{0, 0, 0};
  corner[axis] = 0, corner[one] = side(one, one_upper), corner[other] = side(other, other_upper);
  first[one] = one_upper ? 1 : -1, second[other] = other_upper ? 1 : -1;
  const auto normal = [&](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    using std::cos, std::sin;
    return as<S>(first) * S(cos(s)) + as<S>(second) * S(sin(s));
  };
  const auto turned = [&](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    using std::cos, std::sin;
    return as<S>(second) * S(cos(s)) - as<S>(first) * S(sin(s));
  };
  const PlacedEllipsoid<double> plain = e.plain();
  const auto gap = [&](double s) { return dot(normal(s), plain.farthest(-normal(s)) - corner); };
  const auto slope = [&](const auto& s) {
    using S = std::decay_t<decltype(s)>;
    return dot(turned(s), plain.farthest(-normal(s)) - as<S>(corner));
  };
  const auto largest = largest_between(0, 0.5 * std::numbers::pi, gap, slope, norm(e.semi_axes));
  if (!largest) return std::nullopt;
  const double curvature = slope(Dual<1>(largest->at, std::size_t{0})).partial[0];
  T s(largest->at);
  s = s - dot(turned(s), e.farthest(-normal(s)) - as<T>(corner)) * (1 / curvature);
  const Vec3<T> n = normal(s), nearest = e.farthest(-n);
  // Beyond an end of the edge its corner is nearer.
  if (!(value_of(nearest[axis]) >= b.low[axis] && value_of(nearest[axis]) <= b.high[axis])) return std::nullopt;
  Touch<T> t = touch_between(nearest, T(dot(n, nearest - as<T>(corner))), n);
  t.defined = largest->definite;
  return t;
}

// Those that are looked at: all, of a solid with as few.
template <class Solid, class Visit>
void for_each_candidate(const PlacedEllipsoid<double>&, const Solid& s, const Visit& visit) {
  for (std::size_t k = 0; k < features(s); ++k) visit(k);
}

template <class T, class Solid>
Touch<T> touch_ellipsoid(const Ellipsoid& ellipsoid, const RelativeFrame<T>& at, const Solid& s) {
  const PlacedEllipsoid<T> e{ellipsoid.semi_axes, at};
  const PlacedEllipsoid<double> plain = e.plain();
  std::size_t best = features(s);
  Touch<double> most, next;
  most.gap = next.gap = -std::numeric_limits<double>::infinity();
  // Features that end where they touch lead to one place.
  const auto is_elsewhere = [](const Touch<double>& a, const Touch<double>& b) {
    return norm(a.normal - b.normal) > 1e-6;
  };
  for_each_candidate(plain, s, [&](std::size_t k) {
    const auto t = touch_feature(plain, s, k);
    if (!t) return;
    if (t->gap > most.gap) {
      if (is_elsewhere(most, *t)) next = most;
      most = *t, best = k;
    } else if (t->gap > next.gap && is_elsewhere(most, *t)) {
      next = *t;
    }
  });
  const double size = norm(ellipsoid.semi_axes);
  // What is found on one feature after the other is held against all directions.
  const auto separation = [&](const Vector& n) {
    const Vector m = plain.in_its_axes(n);
    return dot(n, plain.at.p) - support(s, n) -
           norm(Vector{m.x * ellipsoid.semi_axes.x, m.y * ellipsoid.semi_axes.y, m.z * ellipsoid.semi_axes.z});
  };
  const bool sound = best < features(s) && std::abs(separation(most.normal) - most.gap) <= 1e-9 * size &&
                     (most.gap >= 0 || !some_direction_exceeds(most.gap + 1e-9 * size, separation));
  if (sound) {
    if (auto t = touch_feature(e, s, best)) {
      t->defined = t->defined && most.gap - next.gap > coincidence * size;
      return *t;
    }
  }
  // As deep in each other as they are wide, or nearly so: no direction is the one.
  Touch<T> t{T(-size), {T(0.0), T(0.0), T(1.0)}, at.p};
  t.defined = false;
  return t;
}

}  // namespace dynalin::solid
