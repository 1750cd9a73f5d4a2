// What speaks against a selection of modes of which as many were found as were counted.
#pragma once

#include <string>
#include <vector>

#include "eigenvalues/eigen.h"
#include "selected_modes/mode_region.h"

namespace dynalin {

struct SelectionSeen {
  const ModeRegion& region;
  Eigen::Index states;
  bool all_zeros;   // all zeros that follow from the structure are known
  bool everything;  // all eigenvalues are, and in the region
};

// The end of a sentence; empty where nothing does.
std::string doubt_of(const std::vector<EigenMode>&, const ModeSelection& wanted, const SelectionSeen&);

// Whether the bounds of one leave open on which side of the border of a band it is.
bool may_be_beyond_band(const ModesInBand&, const std::vector<EigenMode>&);
inline constexpr const char* beyond_band = "bounds do not tell whether one at the border is inside";

}  // namespace dynalin
