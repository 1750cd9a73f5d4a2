// A box where it stands, its faces and edges, and how far a place is within them: what contacts of boxes share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/touch.h"

namespace dynalin {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();
inline constexpr double least_cosine = 0.9;  // of two directions that are taken for one
inline constexpr double least_sine = 1e-6;   // of two edges that cross

template <class T>
struct PlacedBox {
  solid::Box box;
  Vec3<T> origin;
  std::array<Vec3<T>, 3> axes;

  Vec3<T> at(const Vector& p) const { return origin + axes[0] * p.x + axes[1] * p.y + axes[2] * p.z; }
  double size() const { return norm(box.high - box.low); }
};

template <class T>
struct Edge {
  Vec3<T> from, along;  // unit vector
  double length = 0;
};

// The one that looks most in a direction, with its corners and edges one after the other around it.
template <class T>
struct Face {
  const PlacedBox<T>& box;
  std::size_t axis = 0;
  bool upper = true;
  std::array<Vec3<T>, 4> corners;
  std::array<Edge<T>, 4> edges;

  Face(const PlacedBox<T>& of, const Vector& direction) : box(of) {
    double most = -unbounded;
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = dot(value_of(box.axes[k]), direction);
      if (std::abs(c) > most) most = std::abs(c), axis = k, upper = c > 0;
    }
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto& [low, high] = box.box;
    std::array<Vector, 4> place;
    for (std::size_t n = 0; n < 4; ++n) {
      place[n][axis] = height();
      place[n][u] = n == 1 || n == 2 ? high[u] : low[u];
      place[n][v] = n >= 2 ? high[v] : low[v];
      corners[n] = box.at(place[n]);
    }
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t way = n % 2 == 0 ? u : v;
      const double sign = n < 2 ? 1 : -1;
      edges[n] = {corners[n], box.axes[way] * sign, high[way] - low[way]};
    }
  }
  Vec3<T> normal() const { return upper ? box.axes[axis] : -box.axes[axis]; }
  double height() const { return upper ? box.box.high[axis] : box.box.low[axis]; }
};

// Of a place on an edge neither side holds for motions both ways: what is given is the mean of both.
inline double share_inside(double depth, double tolerance) {
  return depth > tolerance ? 1 : depth >= -tolerance ? 0.5 : 0;
}

template <class T>
Touch<T> between(const Vec3<T>& on_J, const T& gap, const Vec3<T>& normal) {
  Touch<T> t;
  t.gap = gap, t.normal = normal, t.point = on_J + normal * (gap * 0.5);
  return t;
}

// How far a point of the plane of a face is within it.
template <class T>
void keep_within(const Face<T>& face, const Vec3<T>& point, double tolerance, Touch<T>& t) {
  const Vector from = value_of(point - face.box.origin);
  double share = 1;
  for (const std::size_t k : {(face.axis + 1) % 3, (face.axis + 2) % 3}) {
    const double along = dot(from, value_of(face.box.axes[k]));
    for (const double depth : {along - face.box.box.low[k], face.box.box.high[k] - along})
      t.inside = std::min(t.inside, depth), share *= share_inside(depth, tolerance);
  }
  t.weight = T(share);
}

}  // namespace dynalin
