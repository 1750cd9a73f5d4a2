// Marker frames and measures with path variations of one block of coordinates as seeds (mechanics/path.h), global axes.
#pragma once

#include "expression/measures.h"
#include "mechanics/coordinate_block.h"
#include "mechanics/path.h"

namespace dynalin::path {

template <std::size_t N>
using Seeded = TimeTaylor<Dual<N>>;

template <std::size_t N>
Frame<Seeded<N>> constant(const Frame<Taylor>& f) {
  return {constant<N>(f.origin), {constant<N>(f.axes.x), constant<N>(f.axes.y), constant<N>(f.axes.z)}};
}

// A coordinate that is varied by t^level/level! as partial `seed`.
template <class D>
void vary(TimeTaylor<D>& q, std::size_t seed, std::size_t level) {
  (level == 0 ? q.value : level == 1 ? q.rate : q.acceleration).partial[seed] += 1.0;
}

inline Vec3<Taylor> constant_along(const Vector& v) { return {Taylor(v.x), Taylor(v.y), Taylor(v.z)}; }

// The marker frame with path variations of a block as seeds: 6 a level, levels 0 … N/6 − 1. Measures are of
// differences: origins count from the BCS of `from`.
template <std::size_t N>
Frame<Seeded<N>> varied_frame(const Motion& motion, const MarkerFrame& marker, const CoordinateBlock& block,
                              BodyId from) {
  constexpr std::size_t largest = CoordinateBlock::largest, levels = N / largest;
  const Frame<Taylor> plain = marker.frame(motion, from);
  Frame<Seeded<N>> f = constant<N>(plain);
  if (!block.moves(marker)) return f;
  if (block.kind == CoordinateBlock::Kind::pose) {
    const Vec3<Taylor> arm = marker.arm(motion);
    for (std::size_t level = 0; level < levels; ++level) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector e = unit_vectors[k];
        vary(f.origin, largest * level + k, level, constant_along(e));
        vary(f.origin, largest * level + 3 + k, level, turned(k, arm));
        for (std::size_t c = 0; c < 3; ++c) {
          vary(f.axes[c], largest * level + 3 + k, level, turned(k, plain.axes[c]));
        }
      }
    }
    return f;
  }
  // What the coordinates do on the body, turned as the body is.
  NodeMotion<Seeded<N>> node;
  if (const NodeShapes* shapes = marker.place().shapes) {
    const NodeMotion<Taylor> unvaried = node_motion(*shapes, motion);
    node = {constant<N>(unvaried.moved), constant<N>(unvaried.angle)};
    const bool modal = block.kind == CoordinateBlock::Kind::modal;
    for (std::size_t level = 0; level < levels; ++level) {
      for (std::size_t k = 0; modal && k < block.count; ++k) {
        const std::size_t seed = largest * level + k, shape = block.first_shape + k;
        vary(node.moved, seed, level, constant_along(shapes->translation[shape]));
        vary(node.angle, seed, level, constant_along(shapes->rotation[shape]));
      }
    }
  }
  Seeded<N> u{};
  if (marker.curve) u = constant<N>(marker.along_motion(motion));
  for (std::size_t level = 0; level < levels && block.kind == CoordinateBlock::Kind::curve_parameter; ++level)
    vary(u, largest * level, level);
  const Frame<Seeded<N>> local = marker.on_body(node, u);
  const Mat3<Taylor> R = motion.body(marker.place().body).axes();
  const Mat3<Seeded<N>> axes{constant<N>(R.x), constant<N>(R.y), constant<N>(R.z)};
  const auto take_partials = [](Vec3<Seeded<N>>& to, const Vec3<Seeded<N>>& of) {
    for (std::size_t c = 0; c < 3; ++c) {
      to[c].value.partial = of[c].value.partial;
      to[c].rate.partial = of[c].rate.partial;
      to[c].acceleration.partial = of[c].acceleration.partial;
    }
  };
  take_partials(f.origin, axes * local.origin);
  for (std::size_t c = 0; c < 3; ++c) take_partials(f.axes[c], axes * local.axes[c]);
  return f;
}

// A frame at its instant alone.
template <class T>
Frame<T> at_instant(const Frame<TimeTaylor<T>>& f) {
  const auto of = [](const Vec3<TimeTaylor<T>>& v) { return Vec3<T>{v.x.value, v.y.value, v.z.value}; };
  return {of(f.origin), {of(f.axes.x), of(f.axes.y), of(f.axes.z)}};
}

// A measure of displacements, which velocities take no part in: its value and gradient.
inline Dual<6> varied_displacement(Measure measure, const std::array<MarkerFrame, 4>& places, const Motion& motion,
                                   const CoordinateBlock& block) {
  const auto frame = [&](std::size_t k) {
    return at_instant(varied_frame<6>(motion, places[k], block, places[0].place().body));
  };
  return evaluate_measure<Dual<6>>(measure, {frame(0), frame(1), frame(2), frame(3)});
}

template <std::size_t N>
Seeded<N> varied_measure(Measure measure, const std::array<MarkerFrame, 4>& places, const Motion& motion,
                         const CoordinateBlock& block) {
  const auto frame = [&](std::size_t k) { return varied_frame<N>(motion, places[k], block, places[0].place().body); };
  return evaluate_measure<Seeded<N>>(measure, {frame(0), frame(1), frame(2), frame(3)});
}

}  // namespace dynalin::path
