#include "geometry/frustum_touch.h"

#include <algorithm>

#include "geometry/frustum_convex_parting.h"
#include "geometry/frustum_places.h"

namespace dynalin {

namespace solid {
namespace {

template <class Other>
Parting<Other> parting_of(const PlacedFrustum<double>& I, const Other& J) {
  return {I, J};
}
FlatParting parting_of(const PlacedFrustum<double>& I, const FlatBody& J) { return {I, J}; }

template <class Other>
bool is_sound(const Parting<Other>&) {
  return true;
}
bool is_sound(const FlatParting& p) { return p.is_sound(); }

// The direction that parts soonest, if places there say so; otherwise the next one.
template <class T, class Other>
void touch(const PlacedFrustum<T>& I, const Other& J, std::span<Touch<T>> out) {
  const auto at = plain(I);
  const auto other = plain(J);
  const auto parting = parting_of(at, other);
  const std::span<const PartingDirection> all = parting.all();
  const double size = std::min(I.size(), J.size()), tolerance = coincidence * size;
  constexpr std::size_t tries = 8;
  const PartingDirection& best = all.front();
  for (std::size_t k = 0; k < std::min(tries, all.size()); ++k) {
    if (k > 0 && all[k].separation < deeper * best.separation - tolerance) break;
    PlacesAbout<T> places(all[k], size, out);
    places.all(I, J, all[k]);
    if (best.separation >= -tolerance) return;  // apart, or hardly touching
    if (places.anything_closed()) {
      if (!is_sound(parting)) places.make_undefined();
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

std::size_t frustum_flat_touches(const ConvexBody& J) {
  std::size_t most = 0;
  for (const ConvexBody::Face& f : J.faces()) most = std::max(most, f.corners.size());
  return 7 + 4 * most + std::min(J.corners().size() + J.edges().size(), solid::most_beside);
}
bool jumps_at_corners(const ConvexBody& J) {
  const auto is_shallow = [&](ConvexBody::Index e) {
    const ConvexBody::Edge& edge = J.edges()[e];
    return dot(J.faces()[edge.left].normal, J.faces()[edge.right].normal) > one_side;
  };
  for (ConvexBody::Index c = 0; c < J.corners().size(); ++c)
    if (std::ranges::all_of(J.edges_at(c), is_shallow)) return true;
  return false;
}
template <class T>
void touch_frustum(const solid::Frustum& I, const RelativeFrame<T>& at, const ConvexBody& J, std::span<Touch<T>> out) {
  solid::touch(solid::PlacedFrustum<T>{solid::FrustumFaces(I), at}, solid::FlatBody{J}, out);
}

template void touch_frustum(const solid::Frustum&, const RelativeFrame<double>&, const solid::Box&,
                            std::span<Touch<double>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<Dual<12>>&, const solid::Box&,
                            std::span<Touch<Dual<12>>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<double>&, const solid::Frustum&,
                            std::span<Touch<double>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<Dual<12>>&, const solid::Frustum&,
                            std::span<Touch<Dual<12>>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<double>&, const ConvexBody&,
                            std::span<Touch<double>>);
template void touch_frustum(const solid::Frustum&, const RelativeFrame<Dual<12>>&, const ConvexBody&,
                            std::span<Touch<Dual<12>>>);

}  // namespace dynalin
