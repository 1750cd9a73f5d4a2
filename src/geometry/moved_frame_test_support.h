// Frames a little beside another one.
#pragma once

#include "geometry/distance.h"

namespace dynalin {

// Moved by h along axis k or, k = 3, 4, 5, turned by h about axis k − 3.
inline RelativeFrame<double> moved(const RelativeFrame<double>& f, std::size_t k, double h) {
  RelativeFrame<double> g = f;
  if (k < 3) {
    g.p[k] += h;
    return g;
  }
  const Matrix3 turn = rotation_exponential(h * unit_vectors[k - 3]);
  return {f.p, turn * f.x, turn * f.y, turn * f.z};
}

}  // namespace dynalin
