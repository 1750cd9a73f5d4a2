// Where a ball or a point touches a body of facets: at all places in the ball where the distance of its centre from the
// surface is critical, by weight (facet_body.h). On a face, an edge or a corner that is one place, in a groove one on
// each wall; across a groove so flat that its bottom is in the ball too, that counts against them. A point, and a ball
// whose centre is in the body, have the nearest place of all.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/cavity_touch.h"
#include "geometry/facet_body.h"

namespace dynalin {

inline constexpr std::size_t most_facet_touches = 96;  // of a ball; of more the last is not defined
inline std::size_t facet_touches(const solid::Ball& ball) { return ball.radius == 0 ? 1 : most_facet_touches; }

namespace solid {

// From a place of the surface while its feature is the nearest one.
template <class T>
Distance<T> distance(const FacetBody::Place& place, const Vec3<T>& p) {
  using Kind = FacetBody::Feature::Kind;
  const auto& [kind, origin, direction] = place.feature;
  const Vec3<T> from = p - constant<T>(origin);
  Distance<T> d;
  if (kind == Kind::face) {
    d = {dot(from, direction), constant<T>(direction)};
  } else {
    // Of what is as near elsewhere the place knows.
    d = from_point(kind == Kind::edge ? from - constant<T>(direction) * dot(from, direction) : from, 0);
    if (!place.outside) d.value = -d.value, d.direction = -d.direction;
  }
  d.defined = d.defined && place.definite;
  return d;
}

template <class T>
Distance<T> distance(const Polyhedron& f, const Vec3<T>& p) {
  return distance(f.body->nearest(value_of(p)), p);
}

}  // namespace solid

template <class T>
void touch_facets(const solid::Ball& ball, const Vec3<T>& centre, const FacetBody& body, bool cavity,
                  std::span<Touch<T>> out) {
  const Vector p = value_of(centre);
  const auto touch = [&](const FacetBody::Place& place) {
    Touch<T> t = solid::touch_of_ball(ball.radius, centre, solid::distance(place, centre), cavity);
    t.weight = T(place.weight);
    return t;
  };
  const FacetBody::Place nearest = body.nearest(p);
  out[0] = touch(nearest);
  Touch<T> far;
  far.gap = T(std::max(ball.radius, std::abs(value_of(out[0].gap))));
  std::fill(out.begin() + 1, out.end(), far);
  const bool in_matter = nearest.outside == cavity;
  if (ball.radius == 0 || in_matter || nearest.distance >= ball.radius) return;
  std::vector<FacetBody::Place> places;
  body.critical_places(p, ball.radius, cavity, places);
  const std::size_t count = std::min(places.size(), out.size());
  for (std::size_t k = 0; k < count; ++k) out[k] = touch(places[k]);
  if (places.size() > out.size()) out.back().defined = false;
}

}  // namespace dynalin
