// Vectors that are one direction but for roundings, as those of a value that is defective or nearly so: residuals along
// all modes say nothing with them, about no mode at all. A basis of what such vectors span takes their place, and the
// others are as before.
#pragma once

#include <optional>

#include "eigenvalues/eigen_pairs.h"
#include "eigenvalues/pencil_residual.h"

namespace dynalin {

// Pairs with the values and bounds that isolated_values.h gives, where those of each such group are its mean and all
// have one bound and the vector that they share. Nothing where there are no such groups, or more is amiss.
struct GroupedValues {
  EigenPairs pairs;
  std::vector<EigenTrust> trust;
};
std::optional<GroupedValues> values_in_groups(const StructuredPencil&, const ZeroModes&, EigenPairs);

}  // namespace dynalin
