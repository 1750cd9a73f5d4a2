#include "expression/switch_list.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {
constexpr double farthest = 1e100;  // what a search for roots can still multiply
}

void SwitchList::add(double switching, bool does_count) {
  value.push_back(std::isnan(switching) ? 1.0 : std::clamp(switching, -farthest, farthest));
  counts.push_back(does_count && !std::isnan(switching));
  any_undefined = any_undefined || std::isnan(switching);
}

bool changes_between(const SwitchList& a, const SwitchList& b) {
  const auto sign = [](double v) { return (v > 0) - (v < 0); };
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    if ((a.counts[k] || b.counts[k]) && sign(a.value[k]) != sign(b.value[k])) return true;
  }
  return false;
}

double knot_switch(std::span<const double> knots, double x, std::size_t first) {
  const std::size_t n = knots.size();
  const auto k = static_cast<std::size_t>(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin());
  const double sign = (first + k) % 2 == 0 ? -1.0 : 1.0;  // knots left of x
  if (n == 0) return sign;
  if (k > 0 && k < n) {
    const double share = (x - knots[k - 1]) / (knots[k] - knots[k - 1]);
    return sign * std::sin(std::numbers::pi * share);
  }
  // Beyond the ends on with the slope that it has there.
  const std::size_t end = k == 0 ? 0 : n - 1, inner = k == 0 ? std::min<std::size_t>(1, n - 1) : n - 1;
  const double width = n == 1 ? std::numbers::pi : knots[inner] - knots[inner - 1];
  return sign * std::numbers::pi * std::abs(x - knots[end]) / width;
}

}  // namespace dynalin
