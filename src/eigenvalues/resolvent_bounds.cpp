#include "eigenvalues/resolvent_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eigenvalues/clustered_schur.h"

namespace dynalin {

namespace {

using LongComplex = std::complex<long double>;
using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

}  // namespace

Matrix sizes(const LongComplexMatrix& m) {
  return m.unaryExpr([](const LongComplex& v) { return static_cast<double>(std::abs(v)); });
}

std::vector<double> power_norms(const LongComplexMatrix& N) {
  const Index k = N.rows();
  std::vector<double> out{1.0};
  const double norm = sizes(N).norm() * upward;
  LongComplexMatrix power = N;
  double error = 0, before = norm;
  for (Index l = 1; l <= k; ++l) {
    if (l > 1) {
      power = times(power, N);
      error = norm * (error + rounding_of_sum(k) * before);
    }
    before = (sizes(power).norm() + error) * upward;
    out.push_back(before);
  }
  return out;
}

double resolvent_bound(const std::vector<double>& powers, double distance) {
  if (!(distance > 0)) return infinity;
  const std::size_t k = powers.size() - 1;
  double sum = 0, scale = 1 / distance;
  for (std::size_t l = 0; l < k; ++l, scale /= distance) sum += powers[l] * scale;
  const double rest = 1 - powers[k] * scale * distance;
  return rest > 0 && std::isfinite(sum) ? sum / rest * upward : infinity;
}

double smallest_radius(const std::vector<double>& powers, double tau) {
  if (!std::isfinite(tau)) return infinity;
  const double need = std::max(tau, least_size) * upward;
  double high = need;
  while (resolvent_bound(powers, high) * need >= 1) {
    high *= 2;
    if (!std::isfinite(high)) return infinity;
  }
  double low = high / 2;
  for (int k = 0; k < 12; ++k) {
    const double middle = std::sqrt(low * high);
    (resolvent_bound(powers, middle) * need < 1 ? high : low) = middle;
  }
  return high;
}

}  // namespace dynalin
