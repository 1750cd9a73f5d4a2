// What of a force the places have where edges of a face pass over the rim of an end.
//
// Each has the force of a corner times the angle a by which the outline of what both have in common turns there, in
// right angles. So two edges whose corner leaves over the rim share what that had, one that only just reaches over the
// rim has none, and no force jumps where an outline gains a corner or loses one. A place that is alone, with those that
// it would share with less deep or not there, has the more of a whole force:
//
//     a + (1 − a)(1 − r)²(1 + 2r),      r: the ratio of depths, theirs to its own
//
// Where the corner that is beyond the rim turns by q instead of one right angle, all that both of its edges have goes
// over from a to a/q as it comes to the rim, where it has a whole force of its own: with x and y, what their angles are
// of q, by x y / (x y + 1 − x − y).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "geometry/flat_body.h"
#include "geometry/frustum_parting.h"

namespace dynalin::solid {

// Where an edge comes over an end and where it leaves it, along its direction.
template <class T>
using PassesOverRim = std::array<std::optional<Touch<T>>, 2>;

template <class T>
class SharesAtRim {
 public:
  SharesAtRim(const PlacedFrustum<T>& f, bool upper, double tolerance)
      : end_(f.centre(upper)), normal_(f.end_normal(upper)), rim_(f.rim(upper)), tolerance_(tolerance) {}

  // To the passes of all edges of a face, in its order.
  template <class AnyFace>
  void give(const AnyFace& face, std::vector<PassesOverRim<T>>& passes) const {
    const Vector around = cross(value_of(face.edges[0].along), value_of(face.edges[1].along));
    const double sense = dot(around, cross(value_of(rim_.first), value_of(rim_.second))) < 0 ? -1 : 1;
    const std::size_t count = passes.size();
    std::vector<std::array<T, 2>> turns(count), shares(count);
    for (std::size_t n = 0; n < count; ++n) {
      for (std::size_t k = 0; k < 2; ++k)
        turns[n][k] = there(passes[n][k]) ? turn(passes[n][k]->point, face.edges[n].along, sense) : T(0.0);
    }
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t next = (n + 1) % count;
      if (there(passes[n][1]) && there(passes[next][0]))
        share_corner(value_of(face.edges[n].along), value_of(face.edges[next].along), turns[n][1], turns[next][0]);
    }
    for (std::size_t n = 0; n < count; ++n) {
      for (std::size_t k = 0; k < 2; ++k) {
        if (!there(passes[n][k])) continue;
        const Touch<T>& own = *passes[n][k];
        const T& a = turns[n][k];
        // The other end of what the edge has over the end: another place of these, or its corner.
        const std::optional<Touch<T>>& across = passes[n][1 - k];
        const Vec3<T>& corner = face.corners[k == 1 ? n : (n + 1) % count];
        const T at_other_end = across && across->inside >= -tolerance_ ? across->gap : T(dot(corner - end_, normal_));
        T ratio = at_other_end / own.gap;
        // The edge that comes back from beyond the corner, the less of it the less that is over the end.
        const std::size_t next = k == 1 ? (n + 1) % count : (n + count - 1) % count;
        if (there(passes[next][1 - k]) && value_of(a) < 1) {
          const T part = turns[next][1 - k] / (1.0 - a), depth = passes[next][1 - k]->gap / own.gap;
          const T of_next = value_of(part) < 1 ? T(depth * part) : depth;
          if (value_of(of_next) > value_of(ratio)) ratio = of_next;
        }
        shares[n][k] = a + (1.0 - a) * alone(ratio);
      }
    }
    for (std::size_t n = 0; n < count; ++n) {
      for (std::size_t k = 0; k < 2; ++k)
        if (there(passes[n][k])) passes[n][k]->weight *= shares[n][k];
    }
  }

 private:
  bool there(const std::optional<Touch<T>>& t) const { return t && t->inside >= -tolerance_ && value_of(t->gap) < 0; }
  // The angle by which the outline turns where it passes from an edge to the rim or back, in right angles. `sense`: 1
  // where the edge goes around its face as the rim goes around its axis, else −1.
  T turn(const Vec3<T>& place, const Vec3<T>& edge, double sense) const {
    using std::atan2;
    const Vec3<T> from = place - rim_.centre;
    const T x = dot(rim_.first, from), y = dot(rim_.second, from), u = dot(rim_.first, edge),
            v = dot(rim_.second, edge);
    const T outward = x * u + y * v, along = (x * v - y * u) * sense;
    return atan2(value_of(outward) < 0 ? T(-outward) : outward, along) * (2 / std::numbers::pi);
  }
  // How much a place is alone, by the ratio of depths.
  static T alone(const T& ratio) {
    if (value_of(ratio) <= 0) return T(1.0);
    return value_of(ratio) < 1 ? T((1.0 - ratio) * (1.0 - ratio) * (1.0 + 2.0 * ratio)) : T(0.0);
  }
  static void share_corner(const Vector& before, const Vector& after, T& a, T& b) {
    const double q = std::atan2(norm(cross(before, after)), dot(before, after)) * (2 / std::numbers::pi);
    if (std::abs(q - 1) <= coincidence) return;
    const T product = a * b * (1 / (q * q)), rest = 1.0 - (a + b) * (1 / q);
    const T near = value_of(rest) > 0 ? T(product / (product + rest)) : T(1.0);
    const T factor = 1.0 + near * (1 / q - 1);
    a *= factor, b *= factor;
  }

  Vec3<T> end_, normal_;  // its middle, and out of it
  Circle<T> rim_;
  double tolerance_;
};

}  // namespace dynalin::solid
