// Integration of smooth motion to nearly all digits of long double, in a few long steps.
#pragma once

#include <vector>

namespace dynalin::cases {

// x at t + step of x′ = rates(x, t): the modified midpoint rule in 2, 4, … 14 parts, extrapolated (Gragg, Bulirsch and
// Stoer).
template <class Rates, class Vector, class Real>
Vector extrapolated_step(const Rates& rates, const Vector& x, Real t, Real step) {
  std::vector<Vector> row;
  std::vector<Real> parts;
  for (int k = 1; k <= 7; ++k) {
    const int n = 2 * k;
    const Real h = step / n;
    Vector before = x, now = x + h * rates(x, t);
    for (int i = 1; i < n; ++i) {
      const Vector next = before + 2 * h * rates(now, t + i * h);
      before = now, now = next;
    }
    Vector better = (before + now + h * rates(now, t + step)) / 2;
    parts.push_back(n);
    for (std::size_t m = 0; m < row.size(); ++m) {
      const Real ratio = parts.back() / parts[row.size() - 1 - m];
      const Vector refined = better + (better - row[m]) / (ratio * ratio - 1);
      row[m] = better, better = refined;
    }
    row.push_back(better);
  }
  return row.back();
}

}  // namespace dynalin::cases
