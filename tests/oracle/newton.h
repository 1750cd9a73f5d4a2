// Newton's method for small systems in extended precision. Jacobians are difference quotients: they only
// steer, the converged residual alone decides, so their accuracy does not matter.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "jet.h"

namespace dynalin::oracle {

// Unknowns of one group share a scale: the largest of the group, at least `floor`.
struct NewtonScales {
  std::vector<int> group;
  std::vector<Real> floor;
};

[[nodiscard]] inline std::vector<Real> group_scales(const NewtonScales& scales, const std::vector<Real>& x) {
  std::vector<Real> largest(x.size() + 8, 0);
  for (std::size_t k = 0; k < x.size(); ++k) {
    Real& of_group = largest.at(static_cast<std::size_t>(scales.group[k]));
    of_group = std::max({of_group, std::fabs(x[k]), scales.floor[k]});
  }
  std::vector<Real> result(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    result[k] = largest[static_cast<std::size_t>(scales.group[k])];
  }
  return result;
}

template <class Residual>
[[nodiscard]] Dense difference_jacobian(Residual&& residual, const std::vector<Real>& x,
                                        const std::vector<Real>& scale) {
  const std::vector<Real> base = residual(x);
  Dense jacobian(base.size(), x.size());
  std::vector<Real> moved = x;
  for (std::size_t j = 0; j < x.size(); ++j) {
    moved[j] = x[j] + 1e-9L * scale[j];
    const Real step = moved[j] - x[j];
    const std::vector<Real> there = residual(moved);
    for (std::size_t i = 0; i < base.size(); ++i) jacobian(i, j) = (there[i] - base[i]) / step;
    moved[j] = x[j];
  }
  return jacobian;
}

// Iterates with the given factors as long as they contract, then with fresh ones, down to the noise of the
// arithmetic. `factors` is filled when it is empty; later calls nearby reuse it.
template <class Residual>
void newton(Residual&& residual, std::vector<Real>& x, const NewtonScales& scales, Lu& factors,
            const std::string& level) {
  if (x.empty()) return;
  Lu fresh;
  if (!factors.ready()) factors = Lu(difference_jacobian(residual, x, group_scales(scales, x)));
  Real before = 1e30L;
  int stalled = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Lu& lu = fresh.ready() ? fresh : factors;
    const std::vector<Real> dx = lu.solve(residual(x));
    for (std::size_t k = 0; k < x.size(); ++k) x[k] -= dx[k];
    const std::vector<Real> scale = group_scales(scales, x);
    Real step = 0;
    for (std::size_t k = 0; k < x.size(); ++k) step = std::max(step, std::fabs(dx[k]) / scale[k]);
    if (!is_known(step)) break;
    if (step < 1e-18L) return;
    stalled = step > 0.3L * before ? stalled + 1 : 0;
    if (stalled >= 2 && step < 1e-12L) return;
    if (stalled >= 1 && step > 1e-12L) {
      fresh = Lu(difference_jacobian(residual, x, scale));
      stalled = 0;
      before = 1e30L;
      continue;
    }
    before = step;
  }
  throw std::runtime_error("Newton does not converge on the " + level + " level");
}

}  // namespace dynalin::oracle
