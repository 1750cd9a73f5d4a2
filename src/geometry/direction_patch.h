// Where on a patch of directions an ellipsoid separates most from a corner or a rim. Directions between the normals of
// the faces that meet there are n(s, t) = cos t pole + sin t (cos s first + sin s second): the pole is the normal of
// one face, and what the ellipsoid is separated from is base + radius (cos s first + sin s second), a corner where the
// radius is 0. At the largest gap n·(x(−n) − support) both its slopes are zero, x the point of the ellipsoid that is
// farthest against n.
#pragma once

#include <array>
#include <optional>

#include "geometry/least_on_circle.h"

namespace dynalin::solid {

struct DirectionPatch {
  Vector pole, first, second;
  double turn = 0, reach = 0;  // 0 ≤ s ≤ turn, all around where that is 2π, and 0 ≤ t ≤ reach
  Vector base;
  double radius = 0;

  template <class S>
  Vec3<S> radial(const S& s) const {
    using std::cos, std::sin;
    return as<S>(first) * S(cos(s)) + as<S>(second) * S(sin(s));
  }
  template <class S>
  Vec3<S> normal(const S& s, const S& t) const {
    using std::cos, std::sin;
    return as<S>(pole) * S(cos(t)) + radial(s) * S(sin(t));
  }
  template <class S>
  Vec3<S> support(const S& s) const {
    return as<S>(base) + radial(s) * S(radius);
  }
  // Slopes of the gap along t and, but for the factor sin t, along s. `farthest` of a direction.
  template <class S, class Farthest>
  std::array<S, 2> slopes(const S& s, const S& t, const Farthest& farthest) const {
    using std::cos, std::sin;
    const Vec3<S> apart = farthest(-normal(s, t)) - support(s);
    const Vec3<S> around = as<S>(second) * S(cos(s)) - as<S>(first) * S(sin(s));
    return {dot(around, apart), dot(radial(s) * S(cos(t)) - as<S>(pole) * S(sin(t)), apart)};
  }
  bool all_around() const { return turn > 6; }
};

struct LargestOnPatch {
  double s = 0, t = 0, gap = 0;
  bool definite = true;
  std::array<std::array<double, 2>, 2> curvature{};  // of the slopes, by s and t
};

// The largest gap inside of the patch, nothing where it is on its border. `size`: what gaps compare with.
template <class Farthest>
std::optional<LargestOnPatch> largest_on_patch(const DirectionPatch& patch, const Farthest& farthest, double size) {
  constexpr int samples = 24, most_steps = 30;
  constexpr double longest = 0.2;
  const auto gap = [&](double s, double t) {
    const Vector n = patch.normal(s, t);
    return dot(n, farthest(-n) - patch.support(s));
  };
  const double step = patch.turn / samples;
  std::array<std::optional<double>, samples + 1> reached;
  std::array<double, samples + 1> value;
  for (int k = 0; k <= samples; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double s = k * step;
    const auto along = largest_between(
        0, patch.reach, [&](double t) { return gap(s, t); }, [&](double t) { return patch.slopes(s, t, farthest)[1]; },
        size);
    value[at] = -std::numeric_limits<double>::infinity();
    if (along) reached[at] = along->at, value[at] = gap(s, along->at);
  }
  const auto beside = [&](int k) {
    if (patch.all_around()) k = (k + samples) % samples;
    return k < 0 || k > samples ? -std::numeric_limits<double>::infinity() : value[static_cast<std::size_t>(k)];
  };
  std::optional<LargestOnPatch> found;
  for (int k = 0; k <= samples; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (!reached[at] || value[at] < beside(k - 1) || value[at] < beside(k + 1)) continue;
    LargestOnPatch here{k * step, *reached[at]};
    bool ended = false;
    for (int i = 0; i < most_steps && !ended; ++i) {
      using Pair = Dual<2>;
      const auto slope = patch.slopes(Pair(here.s, std::size_t{0}), Pair(here.t, std::size_t{1}),
                                      [&](const auto& n) { return farthest(n); });
      here.curvature = {slope[0].partial, slope[1].partial};
      const auto& J = here.curvature;
      const double determinant = J[0][0] * J[1][1] - J[0][1] * J[1][0];
      // A maximum: where it is none, this is no way to one.
      if (!(J[0][0] < 0) || !(determinant > 0)) break;
      double by_s = -(J[1][1] * slope[0].value - J[0][1] * slope[1].value) / determinant,
             by_t = -(J[0][0] * slope[1].value - J[1][0] * slope[0].value) / determinant;
      const double length = std::hypot(by_s, by_t);
      if (length > longest) by_s *= longest / length, by_t *= longest / length;
      here.s += by_s, here.t += by_t;
      ended = length < 1e-13;
    }
    const bool inside =
        here.t > 0 && here.t < patch.reach && (patch.all_around() || (here.s > 0 && here.s < patch.turn));
    if (!ended || !inside) continue;
    here.gap = gap(here.s, here.t);
    const bool same = found && norm(patch.normal(here.s, here.t) - patch.normal(found->s, found->t)) < 1e-6;
    if (same) continue;
    const bool apart = !found || std::abs(here.gap - found->gap) > coincidence * size;
    if (!found || here.gap > found->gap)
      found = here, found->definite = apart;
    else if (!apart)
      found->definite = false;
  }
  return found;
}

}  // namespace dynalin::solid
