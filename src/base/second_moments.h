// Second moments S = ∫ s sᵀ dm of a body and its inertia tensor J = tr(S) 1 − S. Of a slender body the inertia about
// the axis is small beside the others: sums and differences are taken so that it keeps its digits.
#pragma once

#include <algorithm>

#include "base/vec3.h"

namespace dynalin {

// tr(S) 1 − S, also of what has the form of S.
inline Matrix3 inertia_tensor(const Matrix3& S) {
  Matrix3 J = -S;
  J.x.x = S.y.y + S.z.z, J.y.y = S.z.z + S.x.x, J.z.z = S.x.x + S.y.y;
  return J;
}

// Half of two moments less the third. Where that is large one of the others is hardly less or more, and their
// difference is exact.
inline Matrix3 second_moments_of(const Matrix3& J) {
  const auto of = [](double own, double a, double b) { return 0.5 * ((std::max(a, b) - own) + std::min(a, b)); };
  Matrix3 S = -J;
  S.x.x = of(J.x.x, J.y.y, J.z.z), S.y.y = of(J.y.y, J.z.z, J.x.x), S.z.z = of(J.z.z, J.x.x, J.y.y);
  return S;
}

}  // namespace dynalin
