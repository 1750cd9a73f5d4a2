#include "geometry/overlap_touch.h"

#include <algorithm>

#include "geometry/facet_pairs.h"
#include "geometry/overlap_law.h"
#include "geometry/prism.h"

namespace dynalin {

namespace {

using namespace overlap_law;  // NOLINT: what this file is about

// From the centroid along the normal to where both surfaces are met.
template <class T>
std::optional<Reach<T>> met_reach(const Overlap& o, const PlacedFacets<T>& I, const PlacedFacets<T>& J,
                                  const Vec3<T>& centroid, const Vec3<T>& normal, double& seam) {
  const PlacedFacets<double> plain_I{I.body, plain(I.frame), I.sign}, plain_J{J.body, plain(J.frame), J.sign};
  const Vector from = value_of(centroid), way = value_of(normal);
  const auto up = exit_of(plain_J, o.of_J, from, way), down = exit_of(plain_I, o.of_I, from, -way);
  if (!up || !down) return std::nullopt;
  seam = std::min(up->seam, down->seam);
  return Reach<T>{J.length_to(up->triangle, centroid, normal), I.length_to(down->triangle, centroid, -normal)};
}

template <class T>
Touch<T> touch_of(const Overlap& o, const PlacedFacets<T>& I, const PlacedFacets<T>& J) {
  // Of a touch alone roundings are left.
  if (o.whole && o.volume <= just_touching * (I.body.radius() + J.body.radius()) * surface_of(o.of_J)) return {};
  const Nudge<T> nudge(I.frame, o.origin);
  const auto normal = normal_of(net_area(I, o.of_I, nudge), net_area(J, o.of_J, nudge),
                                std::min(surface_of(o.of_I), surface_of(o.of_J)));
  return touch_in(
      o, J, nudge, centroid_of(o, nudge), normal,
      [&](const Vec3<T>& from, const Vec3<T>& way, double& seam) { return met_reach(o, I, J, from, way, seam); },
      [&](const Vector& along, double least) { return extent(o, along) >= least; });
}

}  // namespace

template <class T>
void touch_overlaps(const FacetBody& I_body, const RelativeFrame<T>& I_from_J, const FacetBody& J_body, bool cavity,
                    std::span<Touch<T>> out) {
  const RelativeFrame<double> f = plain(I_from_J);
  const Overlaps found = find_overlaps(I_body, f, J_body, cavity);
  const bool undefined = found.engulfed || !found.definite;
  fill_apart(I_body.radius() + J_body.radius(), undefined, out);
  if (undefined) return;
  if (found.volumes.empty()) out[0].gap = T(least_distance(I_body, f, J_body));
  const PlacedFacets<T> I{I_body, aside(I_from_J, found.aside), 1}, J = standing<T>(J_body, cavity);
  const PlacedFacets<Dual<1>> moving{I_body, along_the_way(I_from_J, found.aside), 1},
      still = standing<Dual<1>>(J_body, cavity);
  touch_each(
      found.volumes, [&](const Overlap& o) { return back(touch_of(o, I, J), touch_of(o, moving, still)); }, out);
}

FacetBody facets_of_box(const Vector& low, const Vector& high) {
  Mesh mesh = box(high - low);
  for (Vector& v : mesh.vertices) v += low;
  return FacetBody(mesh);
}

template void touch_overlaps(const FacetBody&, const RelativeFrame<double>&, const FacetBody&, bool,
                             std::span<Touch<double>>);
template void touch_overlaps(const FacetBody&, const RelativeFrame<Dual<12>>&, const FacetBody&, bool,
                             std::span<Touch<Dual<12>>>);

}  // namespace dynalin
