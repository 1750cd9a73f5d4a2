// Derivatives of functions in extended precision by extrapolated central differences.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jet.h"

namespace dynalin::oracle {

struct Extrapolated {
  std::vector<Real> value, error;
  Real relative = 0;
};

// Central differences at h, h/2, h/4 … on so many levels, extrapolated in h^2. The error is the last change of the
// diagonal of the tableau, which belongs to the less accurate of the two entries.
template <class F>
[[nodiscard]] Extrapolated extrapolate(F&& f, Real h, int levels) {
  std::vector<std::vector<std::vector<Real>>> T(static_cast<std::size_t>(levels));
  for (int k = 0; k < levels; ++k) {
    const auto level = static_cast<std::size_t>(k);
    const Real step = std::ldexp(h, -k);
    std::vector<Real> d = f(step);
    const std::vector<Real> back = f(-step);
    for (std::size_t i = 0; i < d.size(); ++i) {
      d[i] = (d[i] - back[i]) / (2 * step);
      if (!is_known(d[i])) throw std::runtime_error("a function has no value nearby");
    }
    T[level].push_back(d);
    for (std::size_t m = 1; m <= level; ++m) {
      std::vector<Real> better = T[level][m - 1];
      const Real weight = std::ldexp(1.0L, static_cast<int>(2 * m)) - 1;
      for (std::size_t i = 0; i < better.size(); ++i) {
        better[i] += (T[level][m - 1][i] - T[level - 1][m - 1][i]) / weight;
      }
      T[level].push_back(better);
    }
  }
  const std::vector<Real>&last = T.back().back(), &before = T[T.size() - 2].back();
  Extrapolated result{last, last, 0};
  Real largest = 1, worst = 0;
  for (std::size_t i = 0; i < result.value.size(); ++i) {
    result.error[i] = std::fabs(last[i] - before[i]);
    largest = std::max(largest, std::fabs(result.value[i]));
    worst = std::max(worst, result.error[i]);
  }
  result.relative = worst / largest;
  return result;
}

// Starts with a step that suits gentle nonlinearities and shrinks it while that pays. What is not sharp then, for the
// rounding of small steps or the curvature in large ones, gets more levels. Most steps of an attempt were steps of the
// one before it: what the function is there is kept.
template <class F>
[[nodiscard]] Extrapolated differentiate(F&& f, const Real first_step) {
  constexpr Real sharp = 1e-13L;  // what is compared agrees to 1e-9, and is off by 1e-11 at most of a part of its rows
  std::map<Real, std::vector<Real>> known;
  const auto kept = [&](Real step) {
    const auto found = known.find(step);
    return found != known.end() ? found->second : known.emplace(step, f(step)).first->second;
  };
  Extrapolated best;
  best.relative = -1;
  const auto attempt = [&](int levels, int attempts) {
    Real h = first_step;
    for (int k = 0; k < attempts && (best.relative < 0 || best.relative >= sharp); ++k, h /= 4) {
      try {
        Extrapolated next = extrapolate(kept, h, levels);
        if (best.relative < 0 || next.relative < best.relative) best = std::move(next);
      } catch (const std::runtime_error&) {
        // Too far away for Newton, or for a function: the next, smaller step decides.
        if (k + 1 == attempts && best.relative < 0) throw;
      }
    }
  };
  attempt(4, 10);
  attempt(6, 4);
  return best;
}

}  // namespace dynalin::oracle
