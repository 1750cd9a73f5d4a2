#include "geometry/solid_overlap_touch.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "geometry/overlap_law.h"
#include "geometry/solid_overlap.h"

namespace dynalin {

namespace {

using namespace overlap_law;  // NOLINT: what this file is about

// Of the size: a mean depth below which roundings say what means are; those of a torus are measured from its lines.
constexpr double shallow_of(const QuadricSolid&) { return 1e-6; }
constexpr double shallow_of(const TorusSolid&) { return 1e-7; }

template <class Solid, class T>
struct PlacedSolid {
  const Solid& solid;
  RelativeFrame<T> at;

  template <class S>
  Vec3<S> in_its_axes(const Vec3<S>& v) const {
    return {dot(at.x, v), dot(at.y, v), dot(at.z, v)};
  }
};

// Of an ellipsoid and a torus, whose one face it is, nothing is a side; of others ends and the mantle may be.
template <class T>
NetArea<T> net_area(const PlacedSolid<TorusSolid, T>&, const SolidOverlap&, const NetArea<T>& of_J, const Nudge<T>&) {
  NetArea<T> net;
  net.all = net.face = -of_J.all;
  return net;
}
template <class T>
NetArea<T> net_area(const PlacedSolid<QuadricSolid, T>& I, const SolidOverlap& o, const NetArea<T>& of_J,
                    const Nudge<T>& nudge) {
  NetArea<T> net;
  net.all = net.face = -of_J.all;
  if (!I.solid.has_ends()) return net;
  std::vector<FaceInside<T>> faces;
  Vec3<T> of_mantle = net.all;
  for (const bool high : {false, true}) {
    const Overlap::Part& part = high ? o.high : o.low;
    if (!(part.area > 0)) continue;
    const T area = nudge.of(part.area, part.area_by_shift, part.area_by_turn);
    const Vec3<T> n = I.at.z * (high ? 1.0 : -1.0);
    faces.push_back({area, n * area, n, {0, 0, high ? 1.0 : -1.0}});
    of_mantle -= faces.back().net;
  }
  const bool is_alone = faces.empty();
  faces.push_back(
      {nudge.of(o.curved.area, o.curved.area_by_shift, o.curved.area_by_turn), of_mantle, std::nullopt, {}});
  if (is_alone) return net;
  return overlap_law::net_area(faces, o.curved.area + o.low.area + o.high.area);
}

// From a place in the solid along a direction to its surface.
template <class T>
T length_out_of(const PlacedSolid<QuadricSolid, T>& I, const Vec3<T>& from, const Vec3<T>& way, double& seam) {
  const QuadricSolid& s = I.solid;
  const Vec3<T> p = I.in_its_axes(from - I.at.p), w = I.in_its_axes(way);
  const Vector p0 = value_of(p), w0 = value_of(w);
  const LineInSolid line = line_in_solid(s, p0, p0 + w0 * (2 * s.size()));
  seam = std::numeric_limits<double>::infinity();
  if (s.has_ends()) {
    const double r = std::hypot(line.to.x, line.to.y);
    seam = line.to_at == SolidFace::curved ? std::min(line.to.z - s.frustum().low, s.frustum().high - line.to.z)
                                           : s.radius(line.to_at == SolidFace::high) - r;
  }
  if (line.to_at != SolidFace::curved) return (s.height(line.to_at == SolidFace::high) - p.z) / w.z;
  // One step of Newton's method on duals from where it is.
  const double length = dot(line.to - p0, w0);
  return length - s.value(p + w * length) / dot(s.gradient(line.to), w0);
}

template <class T>
T length_out_of(const PlacedSolid<TorusSolid, T>& I, const Vec3<T>& from, const Vec3<T>& way, double& seam) {
  const TorusSolid& s = I.solid;
  const Vec3<T> p = I.in_its_axes(from - I.at.p), w = I.in_its_axes(way);
  const Vector p0 = value_of(p), w0 = value_of(w), to = line_through(s, p0, p0 + w0 * (2 * s.size())).at[0];
  seam = std::numeric_limits<double>::infinity();
  const double length = dot(to - p0, w0);
  return length - s.value(p + w * length) / dot(s.gradient(to), w0);
}

// From the middle along the normal to where both surfaces are met. Of what is shallower than roundings of its centroid
// that may be beside it, above or below the facets.
template <class Solid, class T>
std::optional<Reach<T>> met_reach(const SolidOverlap& o, const PlacedSolid<Solid, T>& I, const PlacedFacets<T>& J,
                                  const Vec3<T>& middle, const Vec3<T>& normal, double& seam) {
  const PlacedFacets<double> plain_J{J.body, plain(J.frame), J.sign};
  const Vector way = value_of(normal);
  double seen = 0, height = 0;
  for (const Overlap::FixedPart& p : o.of_J) {
    const double cosine = dot(plain_J.normal(p.triangle), way);
    seen += cosine * p.area, height += cosine * dot(way, p.first);
  }
  const auto is_inside = [&](const Vec3<T>& p) { return I.solid.holds(value_of(I.in_its_axes(p - I.at.p))); };
  const T shift(is_inside(middle) ? 0.0 : height / seen - dot(way, value_of(middle) - o.origin));
  const Vec3<T> from = middle + normal * shift;
  const auto up = exit_of(plain_J, o.of_J, value_of(from), way);
  if (!up || !is_inside(from)) return std::nullopt;
  const T down = length_out_of(I, from, -normal, seam);
  seam = std::min(seam, up->seam);
  return Reach<T>{J.length_to(up->triangle, from, normal) + shift, down - shift};
}

// Of a ring that just touches a face all around, whose middle is in its hole: a trough is half again as deep as it is
// in the mean.
template <class T>
Reach<T> trough_reach(const SolidOverlap& o, const PlacedFacets<T>& J, const Nudge<T>& nudge, const Vec3<T>& middle,
                      const Vec3<T>& normal) {
  T seen(0.0), height(0.0);
  for (const Overlap::FixedPart& p : o.of_J) {
    const T cosine = dot(J.normal(p.triangle), normal);
    seen += cosine * nudge.of(p.area, p.area_by_shift, p.area_by_turn);
    height += cosine * dot(normal, nudge.of(p.first, p.first_by_shift, p.first_by_turn));
  }
  const T up = height / seen - dot(normal, middle - o.origin);
  return {up, 1.5 * nudge.of(o.volume, o.volume_by_shift, o.volume_by_turn) / seen - up};
}

// Whether a volume is as long in a direction: from its highest place on a facet to its deepest one on a facet or, where
// that is in the body, of the solid.
template <class Solid>
bool reaches_along(const SolidOverlap& o, const PlacedSolid<Solid, double>& I, const FacetBody& J, bool cavity,
                   const Vector& along, double least) {
  if (extent(o, along) >= least) return true;
  const Vector deepest = turned(I.at, I.solid.farthest(-I.in_its_axes(along)));
  double high = -std::numeric_limits<double>::infinity();
  for (const Vector& v : o.corners) high = std::max(high, dot(v, along));
  return high - dot(deepest + (I.at.p - o.origin), along) >= least && J.nearest(I.at.p + deepest).outside == cavity;
}

// 0 where a volume is so small that roundings say where its centroid is, as the first touch of a corner is, to 1.
template <class T>
T share_of_centroid(const T& volume, const T& area, double size) {
  constexpr double small = 1e-36, large = 1e-32;  // of the size to the eighth: area by volume squared
  const T v = volume / (size * size * size);
  return value_of(v) > 0 ? step(T(v * v * area / (size * size)), small, large) : T(0.0);
}

template <class Solid, class T>
Touch<T> touch_of(const SolidOverlap& o, const PlacedSolid<Solid, T>& I, const PlacedFacets<T>& J) {
  const double surface = surface_of(o.of_J), size = I.solid.size(), none = just_touching * (size + J.body.radius());
  const Nudge<T> nudge(I.at, o.origin);
  T area(0.0);
  Vec3<T> first{T(0.0), T(0.0), T(0.0)};
  for (const Overlap::FixedPart& p : o.of_J) {
    area += nudge.of(p.area, p.area_by_shift, p.area_by_turn);
    first += nudge.of(p.first, p.first_by_shift, p.first_by_turn);
  }
  const T share = share_of_centroid(nudge.of(o.volume, o.volume_by_shift, o.volume_by_turn), area, size);
  // Of a touch alone roundings are left.
  const bool is_small = value_of(share) == 0;
  if (!(surface > 0) || (!is_small && o.volume <= none * surface)) return {};
  // From the middle of the facets in the solid to the centroid.
  Vec3<T> middle = is_small ? first / area : centroid_of(o, nudge);
  if (!is_small && value_of(share) < 1) middle = middle * share + first / area * (1.0 - share);

  const NetArea<T> of_J = overlap_law::net_area(J, o.of_J, nudge);
  const auto normal =
      normal_of(net_area(I, o, of_J, nudge), of_J, std::min(surface, o.curved.area + o.low.area + o.high.area));
  const PlacedSolid<Solid, double> plain_I{I.solid, plain(I.at)};
  const bool is_shallow = o.volume <= shallow_of(I.solid) * size * surface;
  const Touch<T> t = touch_in(
      o, J, nudge, middle, normal,
      [&](const Vec3<T>& from, const Vec3<T>& way, double& seam) {
        auto met = met_reach(o, I, J, from, way, seam);
        if (std::is_same_v<Solid, TorusSolid> && is_shallow && !met) met = trough_reach(o, J, nudge, from, way);
        return met;
      },
      [&](const Vector& along, double least) {
        if (is_shallow) return false;
        return reaches_along(o, plain_I, J.body, J.sign < 0, along, least);
      });
  if (is_small && normal && !(t.defined && value_of(t.gap) < -none)) return {};
  return t;
}

template <class Solid, class T>
void touch_solid(const Solid& solid, const RelativeFrame<T>& I_from_J, const FacetBody& J_body, bool cavity,
                 std::span<Touch<T>> out) {
  const RelativeFrame<double> f = plain(I_from_J);
  const SolidOverlaps found = find_overlaps(solid, f, J_body, cavity);
  const bool undefined = found.engulfed || !found.definite;
  fill_apart(solid.size() + J_body.radius(), undefined, out);
  if (undefined) return;
  if (found.volumes.empty()) out[0].gap = T(least_distance(solid, f, J_body));
  const PlacedSolid<Solid, T> I{solid, aside(I_from_J, found.aside)};
  const PlacedSolid<Solid, Dual<1>> moving{solid, along_the_way(I_from_J, found.aside)};
  const PlacedFacets<T> J = standing<T>(J_body, cavity);
  const auto still = standing<Dual<1>>(J_body, cavity);
  touch_each(
      found.volumes, [&](const SolidOverlap& o) { return back(touch_of(o, I, J), touch_of(o, moving, still)); }, out);
}

}  // namespace

template <class T>
void touch_overlaps(const QuadricSolid& solid, const RelativeFrame<T>& I_from_J, const FacetBody& J, bool cavity,
                    std::span<Touch<T>> out) {
  touch_solid(solid, I_from_J, J, cavity, out);
}
template <class T>
void touch_overlaps(const TorusSolid& torus, const RelativeFrame<T>& I_from_J, const FacetBody& J, bool cavity,
                    std::span<Touch<T>> out) {
  touch_solid(torus, I_from_J, J, cavity, out);
}

template void touch_overlaps(const QuadricSolid&, const RelativeFrame<double>&, const FacetBody&, bool,
                             std::span<Touch<double>>);
template void touch_overlaps(const QuadricSolid&, const RelativeFrame<Dual<12>>&, const FacetBody&, bool,
                             std::span<Touch<Dual<12>>>);

template void touch_overlaps(const TorusSolid&, const RelativeFrame<double>&, const FacetBody&, bool,
                             std::span<Touch<double>>);
template void touch_overlaps(const TorusSolid&, const RelativeFrame<Dual<12>>&, const FacetBody&, bool,
                             std::span<Touch<Dual<12>>>);

}  // namespace dynalin
