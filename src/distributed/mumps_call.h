// Every call of MUMPS goes through here, one at a time: its Fortran core keeps state of its own, for all kinds of
// numbers. Where the program runs as several processes all of them take part in each call; the matrix, right-hand
// sides and results stay with the first. Without DYNALIN_DISTRIBUTED: alone.cpp.
#pragma once

#include <dmumps_c.h>
#include <zmumps_c.h>

namespace dynalin {

// With job −1 the communicator is set as well.
void call_mumps(DMUMPS_STRUC_C&);
void call_mumps(ZMUMPS_STRUC_C&);

// What the last factorization has taken.
struct FactorCost {
  int unknowns = 0;
  double entries = 0, entries_here = 0;  // of the factors: of all processes, and of this one
  double operations = 0;                 // of elimination, an operation of complex numbers counted once
  double megabytes = 0, megabytes_of_largest_process = 0;  // that were used
};
FactorCost last_mumps_factors();

template <class Problem>
FactorCost cost_of(const Problem& p) {
  // Numbers that are too large for an int stand as negative millions.
  const auto whole = [](int count) { return count < 0 ? -1e6 * count : 1.0 * count; };
  return {p.n,
          whole(p.infog[28]),
          whole(p.info[26]),
          p.rinfog[2],
          static_cast<double>(p.infog[21]),
          static_cast<double>(p.infog[20])};
}
template <class Problem>
bool has_factored(const Problem& p) {
  return (p.job == 2 || p.job == 4) && p.infog[0] >= 0;
}

}  // namespace dynalin
