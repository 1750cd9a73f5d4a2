#include "geometry/frustum_touch.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "geometry/frustum_parting.h"
#include "geometry/low_on_circle.h"

namespace dynalin {

namespace solid {
namespace {

constexpr double flat = 1e-6;  // sine of lines that are taken for parallel

template <class T>
Circle<T> circle_at(const Vec3<T>& point) {
  const Vec3<T> zero{T(0.0), T(0.0), T(0.0)};
  return {point, zero, zero, 0};
}
double angle_towards(const Circle<double>& c, const Vector& n) { return std::atan2(dot(c.second, n), dot(c.first, n)); }

// The places of one pair about one of its directions. `I` is the frustum, or one of two.
template <class T>
class PlacesAbout {
 public:
  PlacesAbout(const PartingDirection& d, double size, std::span<Touch<T>> out)
      : n_(d.normal), separation_(d.separation), tolerance_(coincidence * size), out_(out) {}

  void all(const PlacedFrustum<T>& I, const PlacedBox<T>& J, const PartingDirection& d) {
    const Face<T> face(J, n_);
    const Ruled<T> mantle = I.mantle();
    // The edge beside the mantle, and whether that lies along it.
    const Ruled<T> edge = edge_beside(face, mantle);
    const T ends = share_of_ends(mantle, edge, n_);
    const bool in_face = near(value_of(face.normal()));
    std::optional<Touch<T>> last;
    if (d.of == PartingDirection::Of::ruled_I) {
      last = touch_ruled(mantle, circle_at(farthest(J, n_)), mantle.angle_of(-n_), 0, false, tolerance_);
    } else if (d.of == PartingDirection::Of::ruled_J) {
      const bool upper = upper_reaches(plain(I), -n_);
      last = across(lines(J, d.which, n_), I.rim(upper), true);
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
    std::array<Passes, 4> over_rim;
    for (std::size_t n = 0; n < 4; ++n)
      over_rim[n] = passes_over(I, end, face.edges[n], ruled_of(face.edges[n], face.normal()), true);
    if (end) share_at_rim(I, *end, face, over_rim);
    for (Passes& p : over_rim) put_but(p[0], last), put_but(p[1], last);
    for (const bool upper : {false, true}) {
      std::optional<Touch<T>> t = value_of(ends) > 0 ? across(edge, I.rim(upper), true) : std::nullopt;
      put_end(t, ends, J, edge);
    }
    for (const double along : {0.0, edge.length}) {
      const Circle<T> corner = circle_at(Vec3<T>(edge.origin + edge.axis * along));
      std::optional<Touch<T>> t = value_of(ends) > 0 ? across(mantle, corner, false) : std::nullopt;
      put_end(t, ends, J, edge);
    }
    put_last(last, ends);
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
    } else if (d.of == PartingDirection::Of::rims) {
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
  Touch<T> rim_in_face(const PlacedFrustum<T>& I, bool upper, const Face<T>& J) const {
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

  // Where it comes over the end and where it leaves it, along its direction.
  using Passes = std::array<std::optional<Touch<T>>, 2>;
  template <class S>
  Passes passes_over(const PlacedFrustum<T>& f, std::optional<bool> end, const Edge<S>& line, const Ruled<T>& r,
                     bool out_of_J) const {
    Passes found;
    if (!end) return found;
    const auto at = passes({value_of(line.from), value_of(line.along), line.length}, plain(f).rim(*end));
    for (std::size_t k = 0; k < 2; ++k) {
      std::optional<Touch<T>>& t = found[k];
      if (at[k]) t = touch_ruled(r, f.rim(*end), r.angle_of(out_of_J ? n_ : -n_), *at[k], out_of_J, tolerance_);
    }
    return found;
  }
  // One that is there already hands its share to that one.
  void put_but(std::optional<Touch<T>>& t, std::optional<Touch<T>>& already) {
    if (t && already && norm(value_of(t->point) - value_of(already->point)) < 1e3 * tolerance_) {
      already->weight *= t->weight;
      t.reset();
    }
    put(t);
  }
  template <class S>
  void put_passes(const PlacedFrustum<T>& f, std::optional<bool> end, const Edge<S>& line, const Ruled<T>& r,
                  bool out_of_J, std::optional<Touch<T>>& already) {
    for (std::optional<Touch<T>>& t : passes_over(f, end, line, r, out_of_J)) put_but(t, already);
  }

  // The angle by which the outline of what both have in common turns where it passes from an edge to the rim or back,
  // in right angles. `sense`: 1 where the edge goes around its face as the rim goes around its axis, else −1.
  T turn_at_rim(const Circle<T>& rim, const Vec3<T>& place, const Vec3<T>& edge, double sense) const {
    using std::abs, std::atan2, std::sqrt;
    const Vec3<T> from = place - rim.centre;
    const T x = dot(rim.first, from), y = dot(rim.second, from), u = dot(rim.first, edge), v = dot(rim.second, edge);
    const T outward = x * u + y * v, along = (x * v - y * u) * sense;
    return atan2(value_of(outward) < 0 ? T(-outward) : outward, along) * (2 / std::numbers::pi);
  }
  // Where an edge passes over the rim it has the force of a corner times the angle a by which their outline turns
  // there, in right angles. So two edges whose corner leaves over the rim share what that had, one that only just
  // reaches over the rim has none, and no force jumps where an outline gains a corner or loses one. A place that is
  // alone, with those that it would share with less deep or not there, has the more of a whole force:
  //
  //     a + (1 − a)(1 − r)²(1 + 2r),      r: the ratio of depths, theirs to its own
  void share_at_rim(const PlacedFrustum<T>& f, bool upper, const Face<T>& face, std::array<Passes, 4>& over_rim) const {
    const Circle<T> rim = f.rim(upper);
    const auto there = [&](const std::optional<Touch<T>>& t) {
      return t && t->inside >= -tolerance_ && value_of(t->gap) < 0;
    };
    const Vector around = cross(value_of(face.edges[0].along), value_of(face.edges[1].along));
    const double sense = dot(around, cross(value_of(rim.first), value_of(rim.second))) < 0 ? -1 : 1;
    std::array<std::array<T, 2>, 4> turns, shares;
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t k = 0; k < 2; ++k) {
        turns[n][k] =
            there(over_rim[n][k]) ? turn_at_rim(rim, over_rim[n][k]->point, face.edges[n].along, sense) : T(0.0);
      }
    }
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t k = 0; k < 2; ++k) {
        if (!there(over_rim[n][k])) continue;
        const Touch<T>& own = *over_rim[n][k];
        const T& a = turns[n][k];
        // The other end of what the edge has over the end: another place of these, or its corner.
        const std::optional<Touch<T>>& across = over_rim[n][1 - k];
        const Vec3<T>& corner = face.corners[k == 1 ? n : (n + 1) % 4];
        const T at_other_end = across && across->inside >= -tolerance_
                                   ? across->gap
                                   : lowest(circle_at(corner), f.centre(upper), f.end_normal(upper), false).first.gap;
        T ratio = at_other_end / own.gap;
        // The edge that comes back from beyond the corner, the less of it the less that is over the end.
        const std::size_t next = k == 1 ? (n + 1) % 4 : (n + 3) % 4;
        if (there(over_rim[next][1 - k]) && value_of(a) < 1) {
          const T part = turns[next][1 - k] / (1.0 - a), depth = over_rim[next][1 - k]->gap / own.gap;
          const T of_next = value_of(part) < 1 ? T(depth * part) : depth;
          if (value_of(of_next) > value_of(ratio)) ratio = of_next;
        }
        const T alone = value_of(ratio) <= 0  ? T(1.0)
                        : value_of(ratio) < 1 ? T((1.0 - ratio) * (1.0 - ratio) * (1.0 + 2.0 * ratio))
                                              : T(0.0);
        shares[n][k] = a + (1.0 - a) * alone;
      }
    }
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t k = 0; k < 2; ++k)
        if (there(over_rim[n][k])) over_rim[n][k]->weight *= shares[n][k];
    }
  }

  // --- edges of a box

  Ruled<T> edge_beside(const Face<T>& face, const Ruled<T>& mantle) const {
    const Ruled<double> plain = mantle.plain();
    const Vector line = plain.line(plain.normal(plain.angle_of(-n_))).along;
    const Edge<T>* best = &face.edges[0];
    double least = unbounded;
    for (const Edge<T>& e : face.edges) {
      const Vector along = value_of(e.along), from = plain.origin - value_of(e.from);
      if (std::abs(dot(along, line)) < 0.7) continue;
      if (const double away = norm(cross(along, from)); away < least) least = away, best = &e;
    }
    return ruled_of(*best, face.normal());
  }
  // The normal of a place on an edge is between those of the two faces that meet there.
  void put_end(std::optional<Touch<T>> t, const T& share, const PlacedBox<T>& b, const Ruled<T>& edge) {
    if (t) {
      t->weight *= share;
      const Vector from = value_of(edge.origin + edge.axis * (0.5 * edge.length) - b.origin);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector a = value_of(b.axes[k]);
        if (std::abs(dot(a, value_of(edge.axis))) > 0.5) continue;
        const double side = dot(from, a) > 0.5 * (b.box.low[k] + b.box.high[k]) ? 1 : -1;
        const double depth = side * dot(a, value_of(t->normal)) * b.size();
        t->inside = std::min(t->inside, depth), t->weight *= T(share_inside(depth, tolerance_));
      }
    }
    put(t);
  }

  // --- all of them, in their order

  void put_none() { put(std::nullopt); }
  void put(const std::optional<Touch<T>>& found) {
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

// The direction that parts soonest, if places there say so; otherwise the next one.
template <class T, class Other>
void touch(const PlacedFrustum<T>& I, const Other& J, std::span<Touch<T>> out) {
  const auto at = plain(I);
  const auto other = plain(J);
  const Parting parting(at, other);
  const std::span<const PartingDirection> all = parting.all();
  const double size = std::min(I.size(), J.size()), tolerance = coincidence * size;
  constexpr std::size_t tries = 8;
  constexpr double deeper = 2;  // what parts so much later is not where they touch, whatever has been missed before it
  const PartingDirection& best = all.front();
  for (std::size_t k = 0; k < std::min(tries, all.size()); ++k) {
    if (k > 0 && all[k].separation < deeper * best.separation - tolerance) break;
    PlacesAbout<T> places(all[k], size, out);
    places.all(I, J, all[k]);
    if (best.separation >= -tolerance) return;  // apart, or hardly touching
    if (places.anything_closed()) {
      const bool tied = std::any_of(all.begin() + static_cast<std::ptrdiff_t>(k), all.end(), [&](const auto& d) {
        return d.separation >= all[k].separation - tolerance && dot(d.normal, all[k].normal) < least_cosine;
      });
      if (tied || all[k].level) places.make_undefined();
      return;
    }
  }
  // None: as deep as all of both says, at no place.
  for (Touch<T>& t : out) t.inside = -unbounded;
  out[0] = {};
  out[0].gap = T(best.separation), out[0].normal = as<T>(best.normal), out[0].point = I.at.p, out[0].defined = false;
}

template <class T>
RelativeFrame<T> identity() {
  return {{T(0.0), T(0.0), T(0.0)}, {T(1.0), T(0.0), T(0.0)}, {T(0.0), T(1.0), T(0.0)}, {T(0.0), T(0.0), T(1.0)}};
}

}  // namespace
}  // namespace solid

template <class T>
void touch_frustum(const solid::Frustum& I, const RelativeFrame<T>& at, const solid::Box& J, std::span<Touch<T>> out) {
  const RelativeFrame<T> i = solid::identity<T>();
  solid::touch(solid::PlacedFrustum<T>{solid::FrustumFaces(I), at}, PlacedBox<T>{J, i.p, {i.x, i.y, i.z}}, out);
}
template <class T>
void touch_frustum(const solid::Frustum& I, const RelativeFrame<T>& at, const solid::Frustum& J,
                   std::span<Touch<T>> out) {
  solid::touch(solid::PlacedFrustum<T>{solid::FrustumFaces(I), at},
               solid::PlacedFrustum<T>{solid::FrustumFaces(J), solid::identity<T>()}, out);
}

template void touch_frustum(const solid::Frustum&, const RelativeFrame<double>&, const solid::Box&,
                            std::span<Touch<double>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<Dual<12>>&, const solid::Box&,
                            std::span<Touch<Dual<12>>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<double>&, const solid::Frustum&,
                            std::span<Touch<double>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<Dual<12>>&, const solid::Frustum&,
                            std::span<Touch<Dual<12>>>);

}  // namespace dynalin
