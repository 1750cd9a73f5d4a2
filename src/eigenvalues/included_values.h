// Eigenvalues of the sparse perturbation equations when their vectors are no good basis, clusters of defective ones
// among them: discs of the core that is left beside the zero modes (inclusion.h), its entries corrected to long double.
#pragma once

#include <optional>
#include <vector>

#include "eigenvalues/eigen_pairs.h"
#include "eigenvalues/pencil_residual.h"

namespace dynalin {

struct IncludedValues {
  EigenPairs pairs;
  std::vector<EigenTrust> trust;
};
// Nothing if the core is too large for arithmetic in long double, or the QR iteration does not converge.
std::optional<IncludedValues> included_values(const StructuredPencil&, const ZeroModes&);

}  // namespace dynalin
