// The roots of a Nastran deck, read and solved on a path of its own, against eigenvalues of the program.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "nastran_reader/solve.h"

namespace dynalin {

// How far roots may be from eigenvalues [rad/time]: each by `relative` of itself, and by what it is uncertain to
// anyway.
struct ExpectedRoot {
  std::complex<double> value;
  double uncertain = 0;
};

inline void expect_roots(const std::string& deck, std::vector<ExpectedRoot> expected, double relative) {
  auto solved = nastran_reader::solve_modes(deck);
  ASSERT_TRUE(solved) << deck << ": " << solved.error();
  std::vector<std::complex<double>> roots = solved->eigenvalues;
  ASSERT_EQ(roots.size(), expected.size()) << deck;
  std::ranges::sort(expected, std::greater<>(), [](const ExpectedRoot& e) { return std::abs(e.value); });
  const double largest = expected.empty() ? 0 : std::abs(expected.front().value);
  for (const ExpectedRoot& e : expected) {
    // A zero of the model may be one but for what was rounded on the way.
    const double size = std::abs(e.value) <= 1e-20 * largest ? largest : std::abs(e.value);
    const auto nearest =
        std::ranges::min_element(roots, std::less<>(), [&](const auto& r) { return std::abs(r - e.value); });
    EXPECT_LE(std::abs(*nearest - e.value), relative * size + e.uncertain)
        << deck << ": " << *nearest << " for " << e.value;
    roots.erase(nearest);
  }
}

}  // namespace dynalin
