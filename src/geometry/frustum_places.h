// The places where a frustum and a box, a convex body of flat faces or another frustum touch about a direction in which
// they may part.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/common_normal.h"
#include "geometry/flat_body.h"
#include "geometry/looking_side.h"
#include "geometry/low_on_circle.h"
#include "geometry/shares_at_rim.h"

namespace dynalin::solid {

inline constexpr std::size_t most_beside = 512;  // places beside the face of a convex body
inline constexpr double flat = 1e-6;             // sine of lines that are taken for parallel

template <class T>
Circle<T> circle_at(const Vec3<T>& point) {
  const Vec3<T> zero{T(0.0), T(0.0), T(0.0)};
  return {point, zero, zero, 0};
}
inline double angle_towards(const Circle<double>& c, const Vector& n) {
  return std::atan2(dot(c.second, n), dot(c.first, n));
}

// The places of one pair about one of its directions. `I` is the frustum, or one of two.
template <class T>
class PlacesAbout {
 public:
  PlacesAbout(const PartingDirection& d, double size, std::span<Touch<T>> out)
      : n_(d.normal), separation_(d.separation), tolerance_(coincidence * size), out_(out) {}

  // J: a box or a convex body.
  template <class Flat>
  void all(const PlacedFrustum<T>& I, const Flat& J, const PartingDirection& d) {
    const auto face = facing<T>(J, d);
    const Ruled<T> mantle = I.mantle();
    // The edge beside the mantle, and whether that lies along it.
    const std::size_t beside = edge_beside(face, mantle);
    const Ruled<T> edge = ruled_of(face.edges[beside], face.normal());
    const T ends = share_of_ends(mantle, edge, n_);
    const bool in_face = near(value_of(face.normal()));
    std::optional<Touch<T>> last;
    if (d.of == PartingDirection::Of::ruled_I) {
      last = touch_ruled(mantle, circle_at(as<T>(farthest(J, n_))), mantle.angle_of(-n_), 0, false, tolerance_);
    } else if (d.of == PartingDirection::Of::ruled_J) {
      const bool upper = upper_reaches(plain(I), -n_);
      last = across(line_of<T>(J, d), I.rim(upper), true);
    }

    for (const bool upper : {false, true}) {
      if (in_face)
        put(rim_in_face(I, upper, face));
      else
        put_none();
    }
    for (const Edge<T>& e : face.edges) put(lines_crossing(mantle, ruled_of(e, face.normal())));
    const std::optional<bool> end = end_towards(I, -n_);
    for (const Vec3<T>& c : face.corners) {
      if (end)
        put(point_in_end(I, *end, circle_at(c), false));
      else
        put_none();
    }
    std::vector<PassesOverRim<T>> over_rim(face.edges.size());
    for (std::size_t n = 0; n < over_rim.size(); ++n)
      over_rim[n] = passes_over(I, end, face.edges[n], ruled_of(face.edges[n], face.normal()), true);
    if (end) SharesAtRim<T>(I, *end, tolerance_).give(face, over_rim);
    for (PassesOverRim<T>& p : over_rim) put_but(p[0], last), put_but(p[1], last);
    for (const bool upper : {false, true}) {
      std::optional<Touch<T>> t = value_of(ends) > 0 ? across(edge, I.rim(upper), true) : std::nullopt;
      put_end(t, ends, normals_of_edge(J, face, beside));
    }
    for (const double along : {0.0, edge.length}) {
      const Circle<T> corner = circle_at(Vec3<T>(edge.origin + edge.axis * along));
      std::optional<Touch<T>> t = value_of(ends) > 0 ? across(mantle, corner, false) : std::nullopt;
      put_end(t, ends, normals_of_edge(J, face, beside));
    }
    put_last(last, ends);
    if constexpr (std::is_same_v<Flat, FlatBody>) put_beside(I, J.body, face.face, end);
  }

  void all(const PlacedFrustum<T>& I, const PlacedFrustum<T>& J, const PartingDirection& d) {
    const Ruled<T> of_I = I.mantle(), of_J = J.mantle();
    const T ends = share_of_ends(of_I, of_J, n_);
    const bool upper_I = upper_reaches(plain(I), -n_), upper_J = upper_reaches(plain(J), n_);
    std::optional<Touch<T>> last;
    if (d.of == PartingDirection::Of::ruled_I) {
      last = across(of_I, J.rim(upper_J), false);
    } else if (d.of == PartingDirection::Of::ruled_J) {
      last = across(of_J, I.rim(upper_I), true);
    }
    // Beyond the end of the line its rim goes on, with the same force: there is no edge to it.
    if (last && value_of(last->weight) > 0) last->weight = T(1.0);
    if (d.of == PartingDirection::Of::rims) {
      const Circle<T> a = I.rim(d.which >= 2), b = J.rim(d.which % 2 == 1);
      const RelativeFrame<T> seen{a.centre - b.centre, I.at.x, I.at.y, I.at.z};
      const auto c = common_normal_at<T>(n_, {a.radius, a.radius, 0}, seen, {b.radius, b.radius, 0});
      last = between(Vec3<T>(b.centre + c.on_second), T(dot(c.normal, c.on_first - c.on_second)), c.normal);
    }

    for (const bool of_other : {false, true}) {
      const PlacedFrustum<T>&with_end = of_other ? I : J, &other = of_other ? J : I;
      const std::optional<bool> end = end_towards(with_end, of_other ? -n_ : n_);
      for (const bool upper : {false, true}) {
        if (end)
          put(point_in_end(with_end, *end, other.rim(upper), !of_other));
        else
          put_none();
      }
      const Ruled<T> mantle = other.mantle();
      const Ruled<double> plain = mantle.plain();
      const Edge<double> line = plain.line(plain.normal(plain.angle_of(of_other ? n_ : -n_)));
      put_passes(with_end, end, line, mantle, of_other, last);
    }
    put(lines_crossing(of_I, of_J));
    for (const bool out_of_J : {true, false}) {
      for (const bool upper : {false, true}) {
        std::optional<Touch<T>> t;
        if (value_of(ends) > 0) t = across(out_of_J ? of_J : of_I, (out_of_J ? I : J).rim(upper), out_of_J);
        if (t) t->weight *= ends;
        put(t);
      }
    }
    put_last(last, d.of == PartingDirection::Of::rims ? T(0.0) : ends);
  }

  bool anything_closed() const {
    return std::any_of(out_.begin(), out_.end(), [](const Touch<T>& t) { return t.closed(); });
  }
  void make_undefined() {
    for (Touch<T>& t : out_) t.defined = false;
  }

 private:
  bool near(const Vector& n) const { return dot(n, n_) >= least_cosine; }
  std::optional<bool> end_towards(const PlacedFrustum<T>& f, const Vector& n) const {
    const double c = dot(value_of(f.at.z), n);
    if (std::abs(c) < least_cosine || f.radius(c > 0) == 0) return std::nullopt;
    return c > 0;
  }

  // --- places

  // Of a circle, or a point, and a ruled surface, from the angles of this direction.
  std::optional<Touch<T>> across(const Ruled<T>& r, const Circle<T>& c, bool out_of_J) const {
    const Vector outward = out_of_J ? n_ : -n_;
    return touch_ruled(r, c, r.angle_of(outward), angle_towards(c.plain(), -outward), out_of_J, tolerance_);
  }
  std::optional<Touch<T>> lines_crossing(const Ruled<T>& I, const Ruled<T>& J) const {
    const auto both = common_normals(I, J);
    if (!both) return std::nullopt;
    const Vec3<T>& n = (*both)[dot(value_of((*both)[0]), n_) > dot(value_of((*both)[1]), n_) ? 0 : 1];
    const Edge<T> a = I.line(-n), b = J.line(n);
    const Vec3<T> across = cross(a.along, b.along);
    if (!(norm(value_of(across)) > flat)) return std::nullopt;
    const T share = 1.0 - share_of_ends(I, J, n_);
    if (!(value_of(share) > 0)) return std::nullopt;
    Touch<T> t = crossing_of_lines(a, b, n, tolerance_);
    t.weight *= share;
    return t;
  }
  // The deepest place of a circle below a plane, and whether it stands flat there.
  std::pair<Touch<T>, bool> lowest(const Circle<T>& c, const Vec3<T>& plane, const Vec3<T>& n, bool out_of_J) const {
    const LowPlace<T> low = low_on_circle(-(c.first * dot(c.first, n) + c.second * dot(c.second, n)), c.radius);
    const Vec3<T> p = c.centre + low.from_centre;
    const T gap = dot(c.centre - plane, n) - low.depth;
    Touch<T> t = between(Vec3<T>(p - n * dot(p - plane, n)), gap, n);
    if (!out_of_J) t.normal = -n;
    return {t, low.level};
  }
  template <class AnyFace>
  Touch<T> rim_in_face(const PlacedFrustum<T>& I, bool upper, const AnyFace& J) const {
    const Circle<T> rim = I.rim(upper);
    auto [t, level] = lowest(rim, J.corners[0], J.normal(), true);
    keep_within(J, Vec3<T>(t.point - t.normal * (t.gap * 0.5)), tolerance_, t);
    // Where the rim is flat on it, a face that is all in the circle stands on its corners.
    bool all_in = level;
    for (const Vec3<T>& c : J.corners) {
      const Vector d = value_of(c) - value_of(rim.centre);
      all_in =
          all_in && std::hypot(dot(value_of(rim.first), d), dot(value_of(rim.second), d)) <= rim.radius + tolerance_;
    }
    if (all_in) t.inside = -unbounded;
    return t;
  }
  Touch<T> point_in_end(const PlacedFrustum<T>& f, bool upper, const Circle<T>& c, bool out_of_J) const {
    auto [t, level] = lowest(c, f.centre(upper), f.end_normal(upper), out_of_J);
    // Of two ends that stand flat on each other the smaller one stands on the larger.
    const bool on_larger = f.radius(upper) > c.radius || (f.radius(upper) == c.radius && out_of_J);
    if (level && !on_larger) {
      t.inside = -unbounded;
      return t;
    }
    const Vector d = value_of(t.point) - value_of(f.at.p);
    t.inside = f.radius(upper) - std::hypot(dot(value_of(f.at.x), d), dot(value_of(f.at.y), d));
    t.weight = T(share_inside(t.inside, tolerance_));
    return t;
  }

  // --- and those of an edge or a line over the rim of an end, but not the one there is already

  template <class S>
  PassesOverRim<T> passes_over(const PlacedFrustum<T>& f, std::optional<bool> end, const Edge<S>& line,
                               const Ruled<T>& r, bool out_of_J) const {
    PassesOverRim<T> found;
    if (!end) return found;
    const auto at = passes({value_of(line.from), value_of(line.along), line.length}, plain(f).rim(*end));
    for (std::size_t k = 0; k < 2; ++k) {
      std::optional<Touch<T>>& t = found[k];
      if (at[k]) t = touch_ruled(r, f.rim(*end), r.angle_of(out_of_J ? n_ : -n_), *at[k], out_of_J, tolerance_);
    }
    return found;
  }
  bool is_at(const std::optional<Touch<T>>& t, const std::optional<Touch<T>>& already) const {
    return t && already && norm(value_of(t->point) - value_of(already->point)) < 1e3 * tolerance_;
  }
  // One that is there already hands its share to that one.
  void put_but(std::optional<Touch<T>>& t, std::optional<Touch<T>>& already) {
    if (is_at(t, already)) {
      already->weight *= t->weight;
      t.reset();
    }
    put(t);
  }
  template <class S>
  void put_passes(const PlacedFrustum<T>& f, std::optional<bool> end, const Edge<S>& line, const Ruled<T>& r,
                  bool out_of_J, const std::optional<Touch<T>>& already) {
    for (const std::optional<Touch<T>>& t : passes_over(f, end, line, r, out_of_J))
      put(is_at(t, already) ? std::nullopt : t);
  }

  // --- what looks the same way beside a face of a convex body: its corners in an end, its edges across the mantle

  void put_beside(const PlacedFrustum<T>& I, const ConvexBody& body, const ConvexBody::Face& face,
                  std::optional<bool> end) {
    enum : std::uint8_t { elsewhere, beside, of_face };
    std::vector<std::uint8_t> corners(body.corners().size(), elsewhere), faces(body.faces().size(), elsewhere);
    const auto number = static_cast<ConvexBody::Index>(&face - body.faces().data());
    const double reach = dot(n_, body.corners()[body.farthest(n_, face.corners[0])]);
    const LookingSide side(body, number, n_, reach - std::abs(separation_) - 1e3 * tolerance_);
    for (const ConvexBody::Index c : side.corners) corners[c] = beside;
    for (const ConvexBody::Index f : side.faces) faces[f] = beside;
    for (const ConvexBody::Index c : face.corners) corners[c] = of_face;
    faces[number] = of_face;
    // Each in its own place, if all have room.
    const std::size_t all = body.corners().size() + body.edges().size();
    const bool spread = all <= most_beside;
    while (next_ + std::min(all, most_beside) < out_.size()) put_none();
    const auto put_found = [&](const std::optional<Touch<T>>& t) {
      if (spread || (t && t->closed() && near(value_of(t->normal)))) put(t);
    };
    for (std::size_t c = 0; c < corners.size(); ++c) {
      std::optional<Touch<T>> t;
      if (end && corners[c] == beside) t = point_in_end(I, *end, circle_at(constant<T>(body.corners()[c])), false);
      put_found(t);
    }
    for (const ConvexBody::Edge& e : body.edges()) {
      const std::uint8_t left = faces[e.left], right = faces[e.right];
      std::optional<Touch<T>> t;
      if (left != of_face && right != of_face && (left == beside || right == beside))
        t = lines_crossing(I.mantle(), ruled_of(edge_at<T>(body, e), constant<T>(body.faces()[e.left].normal)));
      put_found(t);
    }
    while (next_ < out_.size()) put_none();
  }

  // --- edges of a face

  template <class AnyFace>
  std::size_t edge_beside(const AnyFace& face, const Ruled<T>& mantle) const {
    const Ruled<double> plain = mantle.plain();
    const Vector line = plain.line(plain.normal(plain.angle_of(-n_))).along;
    std::size_t best = 0;
    double least = unbounded;
    for (std::size_t n = 0; n < face.edges.size(); ++n) {
      const Vector along = value_of(face.edges[n].along), from = plain.origin - value_of(face.edges[n].from);
      if (std::abs(dot(along, line)) < 0.7) continue;
      if (const double away = norm(cross(along, from)); away < least) least = away, best = n;
    }
    return best;
  }
  // The normal of a place on an edge is between those of the two faces that meet there.
  void put_end(std::optional<Touch<T>> t, const T& share, const NormalsOfEdge& normals) {
    if (t) {
      t->weight *= share;
      for (const Vector& a : normals.inner) {
        const double depth = dot(a, value_of(t->normal)) * normals.size;
        t->inside = std::min(t->inside, depth), t->weight *= T(share_inside(depth, tolerance_));
      }
    }
    put(t);
  }

  // --- all of them, in their order

  void put_none() { put(std::nullopt); }
  void put(const std::optional<Touch<T>>& found) {
    if (next_ == out_.size()) return void(out_.back().defined = false);
    Touch<T>& t = out_[next_++];
    if (!found || !near(value_of(found->normal))) {
      t = {};
      t.gap = T(std::abs(separation_) + tolerance_), t.normal = as<T>(n_);
      t.point = {T(0.0), T(0.0), T(0.0)}, t.weight = T(0.0), t.inside = -unbounded;
      return;
    }
    t = *found;
    if (std::abs(t.inside) <= tolerance_) t.inside = 0;
  }
  void put_last(std::optional<Touch<T>> t, const T& ends) {
    if (t) t->weight *= 1.0 - ends;
    if (t && !(value_of(t->weight) > 0)) t.reset();
    put(t);
  }

  Vector n_;
  double separation_, tolerance_;
  std::span<Touch<T>> out_;
  std::size_t next_ = 0;
};

}  // namespace dynalin::solid
