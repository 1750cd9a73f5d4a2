// Where switching functions change their sign, for the tests of this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "expression/switch_list.h"

namespace dynalin::expression_test {

// Places between two others at which one of the functions at(x), a SwitchList, changes its sign and counts; in order,
// each once.
template <class At>
std::vector<double> sign_changes(const At& at, double from, double to) {
  std::vector<double> places;
  constexpr int cells = 997;
  for (int c = 0; c < cells; ++c) {
    const double low = from + (to - from) * c / cells, high = from + (to - from) * (c + 1) / cells;
    const SwitchList left = at(low), right = at(high);
    if (left.value.size() != right.value.size()) throw std::runtime_error("the number of switches changes");
    for (std::size_t k = 0; k < left.value.size(); ++k) {
      if ((left.value[k] < 0) == (right.value[k] < 0)) continue;
      double a = low, b = high;
      while (b - a > 1e-13 * (1 + std::abs(a))) {
        const double middle = 0.5 * (a + b);
        ((at(middle).value[k] < 0) == (left.value[k] < 0) ? a : b) = middle;
      }
      if (at(a).counts[k] || at(b).counts[k]) places.push_back(a);
    }
  }
  std::sort(places.begin(), places.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  return places;
}

}  // namespace dynalin::expression_test
