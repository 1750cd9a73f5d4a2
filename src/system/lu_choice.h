// What the two users of sparse factors share: which of KLU and MUMPS, and the sign of a permutation.
#pragma once

#include <span>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

// Without loops KLU fills in almost nothing and is the fastest; its prediction of more than this many entries for each
// of the matrix means loops in all directions, where nested dissection (MUMPS with METIS) wins by orders.
inline bool wants_nested_dissection(const ColumnMatrix& m, double predicted_by_klu) {
  constexpr double klu_fill_limit = 4;
  constexpr std::int32_t smallest_for_mumps = 2000;
  return m.rows >= smallest_for_mumps && predicted_by_klu > klu_fill_limit * static_cast<double>(m.value.size());
}

// Whether a permutation is made of an odd number of exchanges.
inline bool is_odd(std::span<const int> permutation) {
  std::vector<bool> seen(permutation.size(), false);
  bool odd = false;
  for (std::size_t first = 0; first < permutation.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    // A cycle of n places takes n − 1 exchanges.
    for (auto at = static_cast<std::size_t>(permutation[first]); at != first; odd = !odd) {
      seen[at] = true;
      at = static_cast<std::size_t>(permutation[at]);
    }
  }
  return odd;
}

}  // namespace dynalin
