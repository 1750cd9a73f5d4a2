// Marker frames and measures with path variations of one body as seeds (mechanics/path.h), global axes.
#pragma once

#include "expression/measures.h"
#include "mechanics/path.h"

namespace dynalin::path {

template <std::size_t N>
using Seeded = TimeTaylor<Dual<N>>;

// The marker frame with path variations of `body` as seeds: 6 a level, δr then δθ, levels 0 … N/6 − 1.
template <std::size_t N>
Frame<Seeded<N>> seeded_frame(const Motion& motion, const MarkerPlace& place, BodyId body) {
  const Frame<Taylor> plain = motion.frame(place);
  Frame<Seeded<N>> f{constant<N>(plain.origin),
                     {constant<N>(plain.axes.x), constant<N>(plain.axes.y), constant<N>(plain.axes.z)}};
  if (place.body != body) return f;
  const BodyMotion& b = motion.body(body);
  const Vec3<Taylor> arm = plain.origin - along_motion(b.r, b.rdot, b.rddot);
  for (std::size_t level = 0; 6 * level < N; ++level) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector e = unit_vectors[k];
      vary(f.origin, 6 * level + k, level, {Taylor(e.x), Taylor(e.y), Taylor(e.z)});
      vary(f.origin, 6 * level + 3 + k, level, turned(k, arm));
      for (std::size_t c = 0; c < 3; ++c) {
        vary(f.axes[c], 6 * level + 3 + k, level, turned(k, plain.axes[c]));
      }
    }
  }
  return f;
}

template <std::size_t N>
Seeded<N> seeded_measure(Measure measure, const std::array<MarkerPlace, 4>& places, const Motion& motion, BodyId body) {
  return evaluate_measure<Seeded<N>>(
      measure, {seeded_frame<N>(motion, places[0], body), seeded_frame<N>(motion, places[1], body),
                seeded_frame<N>(motion, places[2], body), seeded_frame<N>(motion, places[3], body)});
}

}  // namespace dynalin::path
