// Marker frames and measures with path variations of one body as seeds (mechanics/path.h), global axes.
#pragma once

#include "expression/measures.h"
#include "mechanics/marker_frame.h"
#include "mechanics/path.h"

namespace dynalin::path {

template <std::size_t N>
using Seeded = TimeTaylor<Dual<N>>;

template <std::size_t N>
Frame<Seeded<N>> constant(const Frame<Taylor>& f) {
  return {constant<N>(f.origin), {constant<N>(f.axes.x), constant<N>(f.axes.y), constant<N>(f.axes.z)}};
}

// The marker frame with path variations of `body` as seeds: 6 a level, δr then δθ, levels 0 … N/6 − 1. Measures are of
// differences: origins count from the BCS of `from`.
template <std::size_t N>
Frame<Seeded<N>> varied_frame(const Motion& motion, const MarkerFrame& marker, BodyId body, BodyId from) {
  const Frame<Taylor> plain = marker.frame(motion, from);
  Frame<Seeded<N>> f = constant<N>(plain);
  if (marker.place().body != body) return f;
  const Vec3<Taylor> arm = marker.arm(motion);
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

// With variations of one curve parameter as seeds: one a level.
inline constexpr std::size_t parameter_seeds = 6;
inline Frame<Seeded<parameter_seeds>> frame_by_parameter(const Motion& motion, const MarkerFrame& marker,
                                                         std::int32_t parameter, BodyId from) {
  if (!marker.curve || marker.parameter != parameter) return constant<parameter_seeds>(marker.frame(motion, from));
  Seeded<parameter_seeds> u = constant<parameter_seeds>(marker.along_motion(motion));
  u.value.partial[0] = 1.0, u.rate.partial[1] = 1.0, u.acceleration.partial[2] = 1.0;
  return marker.on_curve(constant<parameter_seeds>(motion.frame(marker.place(), from)), u);
}
inline Seeded<parameter_seeds> measure_by_parameter(Measure measure, const std::array<MarkerFrame, 4>& places,
                                                    const Motion& motion, std::int32_t parameter) {
  const auto frame = [&](std::size_t k) {
    return frame_by_parameter(motion, places[k], parameter, places[0].place().body);
  };
  return evaluate_measure<Seeded<parameter_seeds>>(measure, {frame(0), frame(1), frame(2), frame(3)});
}

template <std::size_t N>
Seeded<N> varied_measure(Measure measure, const std::array<MarkerFrame, 4>& places, const Motion& motion, BodyId body) {
  const auto frame = [&](std::size_t k) { return varied_frame<N>(motion, places[k], body, places[0].place().body); };
  return evaluate_measure<Seeded<N>>(measure, {frame(0), frame(1), frame(2), frame(3)});
}

}  // namespace dynalin::path
