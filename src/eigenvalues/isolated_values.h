// Eigenvalues that residuals along all modes tell apart: each in a disc of its own, or equal ones with independent
// vectors in one together (inclusion.h has the theorem; here for all at once, in few passes).
#pragma once

#include <optional>

#include "eigenvalues/eigen_residuals.h"

namespace dynalin {

// Values λ_i + G_ii with their bounds. Those whose disc meets another have the bound of all that Gershgorin's discs
// connect them with.
struct IsolatedValues {
  std::vector<std::complex<double>> values;
  std::vector<EigenTrust> trust;
  bool all = false;  // have such a disc, a narrow one if they share it
};
// Nothing if the vectors are no good basis.
std::optional<IsolatedValues> isolated_values(const EigenPairs&, const EigenResiduals&);

}  // namespace dynalin
