// The cubic from 0 at 0 to 1 at 1, level at both ends.
#pragma once

namespace dynalin {

template <class T>
T smooth_step(const T& x) {
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace dynalin
