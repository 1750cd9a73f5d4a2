// A body moves as a whole before it deforms. A least change says so by a weight, which is finite, and leaves a little
// deformation where none is called for.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "system/system.h"

namespace dynalin {

// What weights leave of what moves beside the shape, and what rounding does.
constexpr double left_by_weights = 1e-4, left_by_rounding = 1e-14;

// Puts modal coordinates, or their rates, back to what is stated where they have left it by no more than weights
// explain; both behind those of bodies. `size` is what moves beside them, in lengths of the model and radians (by
// time). True if any was: another least change from there keeps them to rounding, or has to deform the body after all.
inline bool put_back_shape(const System& system, std::span<const double> stated, double size, std::span<double> shape,
                           double explained = left_by_weights) {
  const Layout& layout = system.layout();
  bool any = false;
  for (const ExtraBlock& e : layout.extras) {
    if (!e.is_shape()) continue;
    for (std::int32_t k = 0; k < e.count; ++k) {
      const std::size_t at = layout.extra_index(e.offset + k);
      const double change = std::abs(shape[at] - stated[at]);
      if (change == 0 ||
          !(change <= explained * std::max(std::abs(stated[at]), size * system.coordinate_scale(e.offset + k))))
        continue;
      shape[at] = stated[at], any = true;
    }
  }
  return any;
}

}  // namespace dynalin
