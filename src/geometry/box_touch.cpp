#include "geometry/box_touch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/placed_box.h"

namespace dynalin {

namespace {

constexpr double edge_preference = 1e-6;  // of the size: by how much a direction across two edges must part more

Vector half_of(const solid::Box& b) { return 0.5 * (b.high - b.low); }

// --- the direction in which they part soonest

template <class T>
struct Parting {
  Vec3<T> normal;        // out of J towards I
  bool definite = true;  // no other direction is as near
  bool faces = false;    // of both are parallel: either normal is that
};

// Normals of faces and of edges of both.
template <class T>
Parting<T> parting(const PlacedBox<T>& I, const PlacedBox<T>& J) {
  const Vector between =
      value_of(I.at(0.5 * (I.box.low + I.box.high))) - value_of(J.at(0.5 * (J.box.low + J.box.high)));
  const Vector h = half_of(I.box), g = half_of(J.box);
  const auto separation = [&](const Vector& n) {
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k)
      reach += h[k] * std::abs(dot(value_of(I.axes[k]), n)) + g[k] * std::abs(dot(value_of(J.axes[k]), n));
    return std::abs(dot(between, n)) - reach;
  };
  const double size = std::min(I.size(), J.size());
  struct Direction {
    Vec3<T> normal;
    double separation = 0;
  };
  std::array<Direction, 15> all;
  std::size_t count = 0, best = 0;
  // Where others part as soon, faces decide.
  const auto try_one = [&](const Vec3<T>& n) {
    all[count] = {n, separation(value_of(n))};
    if (all[count].separation > all[best].separation + edge_preference * size) best = count;
    ++count;
  };
  for (const Vec3<T>& b : J.axes) try_one(b);
  for (const Vec3<T>& a : I.axes) try_one(a);
  for (const Vec3<T>& a : I.axes) {
    for (const Vec3<T>& b : J.axes) {
      const Vec3<T> n = cross(a, b);
      using std::sqrt;
      const T sine = sqrt(dot(n, n));
      if (value_of(sine) > least_sine) try_one(n / sine);
    }
  }
  const auto& [normal, most] = all[best];
  Parting<T> found{dot(between, value_of(normal)) < 0 ? -normal : normal};
  bool of_I = false, of_J = false;
  for (std::size_t k = 0; k < count; ++k) {
    const bool alike = std::abs(dot(value_of(all[k].normal), value_of(normal))) >= least_cosine;
    const double less = std::abs(all[k].separation - most);
    found.definite = found.definite && (alike || less > solid::coincidence * size);
    if (alike && k < 6 && less <= edge_preference * size) (k < 3 ? of_J : of_I) = true;
  }
  found.faces = of_I && of_J;
  return found;
}

// --- places, all along one normal: what one of them loses where it ends another has

// From a point along the normal to the plane of a face.
template <class T>
T to_face(const Vec3<T>& point, const Face<T>& face, const Vec3<T>& normal) {
  const Vec3<T>& across = face.box.axes[face.axis];
  return (T(face.height()) - dot(point - face.box.origin, across)) / dot(normal, across);
}
template <class T>
Touch<T> corner_of_I(const Vec3<T>& corner, const Face<T>& J, const Vec3<T>& normal, double tolerance) {
  const T gap = -to_face(corner, J, normal);
  const Vec3<T> on_J = corner - normal * gap;
  Touch<T> t = between(on_J, gap, normal);
  keep_within(J, on_J, tolerance, t);
  return t;
}
template <class T>
Touch<T> corner_of_J(const Vec3<T>& corner, const Face<T>& I, const Vec3<T>& normal, double tolerance) {
  const T gap = to_face(corner, I, normal);
  Touch<T> t = between(corner, gap, normal);
  keep_within(I, corner + normal * gap, tolerance, t);
  return t;
}

// Where an edge of I and one of J cross, seen along the normal.
template <class T>
struct Crossing {
  std::optional<Touch<T>> touch;           // nothing where they do not
  T square_of_sine{};                      // of their angle
  std::size_t beyond_I = 0, beyond_J = 0;  // the edges with which they meet at their ends outside of the other face
};

template <class T>
Crossing<T> crossing(const Face<T>& I, std::size_t i, const Face<T>& J, std::size_t j, const Vec3<T>& normal,
                     double tolerance) {
  Crossing<T> found;
  const Edge<T>&e = I.edges[i], &f = J.edges[j];
  const Vec3<T>&u = e.along, &v = f.along;
  const T area = dot(cross(u, v), normal);
  const T un = dot(u, normal), vn = dot(v, normal);
  found.square_of_sine = area * area / ((1.0 - un * un) * (1.0 - vn * vn));
  if (!(value_of(found.square_of_sine) > least_sine * least_sine)) return found;
  const Vec3<T> d = e.from - f.from;
  const T s = -dot(d, cross(v, normal)) / area, r = -dot(d, cross(u, normal)) / area;
  const T gap = dot(d + u * s - v * r, normal);
  Touch<T> t = between(f.from + v * r, gap, normal);
  for (const double depth : {value_of(s), e.length - value_of(s), value_of(r), f.length - value_of(r)})
    t.inside = std::min(t.inside, depth), t.weight *= T(share_inside(depth, tolerance));
  if (std::abs(t.inside) <= tolerance) t.inside = 0;
  found.touch = t;
  // Edges go around their face: what lies on the side of its middle is in it.
  const auto leaves_at_end = [&](const Vec3<T>& along, const Edge<T>& other, const Face<T>& face) {
    const Vector beside = cross(value_of(other.along), value_of(normal));
    const Vector middle = 0.5 * (value_of(face.corners[0]) + value_of(face.corners[2])) - value_of(other.from);
    return dot(value_of(along), beside) * dot(middle, beside) < 0;
  };
  found.beyond_I = (i + (leaves_at_end(u, f, J) ? 1 : 3)) % 4;
  found.beyond_J = (j + (leaves_at_end(v, e, I) ? 1 : 3)) % 4;
  return found;
}

// Where a corner leaves over an edge, its two edges cross that one, as deep as the corner was: they share its force, by
// sin² of their angles with it, which make one. The less deep one of the two is the more the other has a whole force of
// its own.
template <class T>
T share_beside(const Crossing<T>& own, const Crossing<T>& other) {
  if (!other.touch || other.touch->inside < 0 || value_of(own.touch->gap) >= 0) return T(1.0);
  const T ratio = other.touch->gap / own.touch->gap;
  if (value_of(ratio) <= 0) return T(1.0);
  const T alone = value_of(ratio) < 1 ? T((1.0 - ratio) * (1.0 - ratio) * (1.0 + 2.0 * ratio)) : T(0.0);
  const T share = own.square_of_sine / (own.square_of_sine + other.square_of_sine);
  return share + (1.0 - share) * alone;
}

template <class T>
void touch_edges(const Face<T>& I, const Face<T>& J, const Vec3<T>& normal, double tolerance,
                 std::span<Touch<T>, 16> out) {
  std::array<std::array<Crossing<T>, 4>, 4> all;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) all[i][j] = crossing(I, i, J, j, normal, tolerance);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Crossing<T>& c = all[i][j];
      Touch<T>& t = out[4 * i + j];
      if (!c.touch) {
        t = between(J.edges[j].from, T(I.edges[i].length + J.edges[j].length), normal);
        t.inside = -unbounded;
        continue;
      }
      t = *c.touch;
      const T by_I = share_beside(c, all[c.beyond_I][j]), by_J = share_beside(c, all[i][c.beyond_J]);
      t.weight *= value_of(by_I) < value_of(by_J) ? by_I : by_J;
    }
  }
}

// Of parallel faces the one that holds more corners of the other one is the one whose normal stays where the boxes
// tilt.
template <class T>
Vec3<T> common_normal(const Face<T>& I, const Face<T>& J, double tolerance) {
  using std::sqrt;
  double by_I = 0, by_J = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    by_J += value_of(corner_of_I(I.corners[k], J, J.normal(), tolerance).weight);
    by_I += value_of(corner_of_J(J.corners[k], I, J.normal(), tolerance).weight);
  }
  if (by_I + by_J == 0) by_I = by_J = 1;
  const Vec3<T> sum = J.normal() * by_J - I.normal() * by_I;
  return sum / sqrt(dot(sum, sum));
}

}  // namespace

template <class T>
void touch_boxes(const solid::Box& I_box, const RelativeFrame<T>& R, const solid::Box& J_box, std::span<Touch<T>> out) {
  const Vec3<T> x{T(1.0), T(0.0), T(0.0)}, y{T(0.0), T(1.0), T(0.0)}, z{T(0.0), T(0.0), T(1.0)};
  const PlacedBox<T> I{I_box, R.p, {R.x, R.y, R.z}}, J{J_box, {T(0.0), T(0.0), T(0.0)}, {x, y, z}};
  const Parting<T> part = parting(I, J);
  const Face<T> of_I(I, -value_of(part.normal)), of_J(J, value_of(part.normal));
  const double tolerance = solid::coincidence * std::min(I.size(), J.size());
  const Vec3<T> normal = part.faces ? common_normal(of_I, of_J, tolerance) : part.normal;
  std::size_t count = 0;
  for (const Vec3<T>& c : of_I.corners) out[count++] = corner_of_I(c, of_J, normal, tolerance);
  for (const Vec3<T>& c : of_J.corners) out[count++] = corner_of_J(c, of_I, normal, tolerance);
  touch_edges(of_I, of_J, normal, tolerance, out.subspan(count).template first<16>());
  count += 16;
  for (Touch<T>& t : out.first(count)) {
    t.defined = part.definite;
    if (std::abs(t.inside) <= tolerance) t.inside = 0;
  }
}

template void touch_boxes(const solid::Box&, const RelativeFrame<double>&, const solid::Box&, std::span<Touch<double>>);
template void touch_boxes(const solid::Box&, const RelativeFrame<Dual<12>>&, const solid::Box&,
                          std::span<Touch<Dual<12>>>);

}  // namespace dynalin
