// Takes over what elements know of the motion of two markers (pair_state_source.h) where another model lets it go on:
// as it is between the same markers, with the sign and the axes that it has there where the same surfaces are seen
// otherwise. Elsewhere a slip begins without bristles that are bent, and a displacement with what is found.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "model/restated.h"
#include "system/entry_keys.h"
#include "system/system.h"

namespace dynalin {

// A plain value of PairStates.
struct KnownPair {
  struct End {
    std::int64_t marker = 0;
    EntryKey body;
    Vector at, axis;
  };

  EntryKey of;
  std::int64_t joint = 0;
  std::string motion;
  std::array<End, 2> ends;
  std::vector<Vector> directions;
  double radius = 0;

  bool slips() const { return !directions.empty(); }
};
std::vector<KnownPair> known_pairs(const System&, const OperatingPoint&);

struct ChangedPairs {
  std::set<std::size_t> found;    // states of displacements that begin with what is found, as the caller lets them
  std::vector<std::string> anew;  // elements whose bristles begin anew
};
// `op` has the bodies and, by their keys, the states and the memory of the point where `before` was known.
ChangedPairs take_over_pairs(const std::vector<KnownPair>& before, const System&, OperatingPoint& op);

// States of displacements begin with the displacement and the velocity that the point has.
void begin_as_found(const System&, const std::set<std::size_t>& states, OperatingPoint&);

}  // namespace dynalin
