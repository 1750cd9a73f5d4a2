// A frustum and a box, or two frustums, for tests: what touches, and the largest separation by a search over all
// directions.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/touch.h"

namespace dynalin::frustum_test {

using solid::Box;
using solid::Frustum;
using solid::Side;
using Frame = RelativeFrame<double>;

struct Pair {
  std::string name;
  Side I, J;
};

inline void PrintTo(const Pair& p, std::ostream* out) { *out << p.name; }

// How far all of a side reaches in a direction, in its own axes.
inline double reach(const Side& s, const Vector& n) {
  if (const auto* b = std::get_if<Box>(&s.shape)) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::max(n[k] * b->low[k], n[k] * b->high[k]);
    return sum;
  }
  const auto& f = std::get<Frustum>(s.shape);
  const double across = std::hypot(n.x, n.y);
  return std::max(f.low * n.z + f.low_radius * across, f.high * n.z + f.high_radius * across);
}
inline double separation(const Pair& p, const Frame& at, const Vector& n) {
  return dot(n, at.p) - reach(p.I, {-dot(n, at.x), -dot(n, at.y), -dot(n, at.z)}) - reach(p.J, n);
}

// The largest of all directions: by many of them, and steps that shrink from the best ones.
inline double largest_separation(const Pair& p, const Frame& at) {
  constexpr int rings = 60;
  std::vector<std::pair<double, Vector>> list;
  for (int i = 0; i < rings; ++i) {
    const double polar = M_PI * (i + 0.5) / rings;
    const int around = std::max(4, static_cast<int>(2 * rings * std::sin(polar)));
    for (int k = 0; k < around; ++k) {
      const double a = 2 * M_PI * k / around;
      const Vector n{std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar)};
      list.emplace_back(separation(p, at, n), n);
    }
  }
  // The sharp ones between them.
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector of_J = sign * unit_vectors[static_cast<std::size_t>(k)];
      const Vector of_I = sign * (k == 0 ? at.x : k == 1 ? at.y : at.z);
      list.emplace_back(separation(p, at, of_J), of_J), list.emplace_back(separation(p, at, of_I), of_I);
    }
  }
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::mt19937_64 random(11);
  std::normal_distribution<double> any;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t start = 0; start < 12; ++start) {
    auto [best, n] = list[start];
    for (double step = 0.05; step > 1e-9;) {
      bool better = false;
      for (int k = 0; k < 40 && !better; ++k) {
        const Vector to = n + step * Vector{any(random), any(random), any(random)};
        const Vector m = (1 / norm(to)) * to;
        if (const double h = separation(p, at, m); h > best) best = h, n = m, better = true;
      }
      if (!better) step *= 0.7;
    }
    most = std::max(most, best);
  }
  return most;
}

inline std::vector<Touch<double>> touches(const Pair& p, const Frame& at) {
  std::vector<Touch<double>> list(touch_count(p.I, p.J));
  find_touches<double>(p.I, p.J, at, list);
  return list;
}
// Those that exert something.
inline std::vector<Touch<double>> closed(const Pair& p, const Frame& at) {
  std::vector<Touch<double>> list = touches(p, at);
  std::erase_if(list, [](const Touch<double>& t) { return !t.closed() || t.weight == 0; });
  return list;
}
// Force and moment about the origin of J, for a stiffness of one.
inline std::array<double, 6> resultant(const Pair& p, const Frame& at) {
  std::array<double, 6> sum{};
  for (const Touch<double>& t : touches(p, at)) {
    if (!t.closed()) continue;
    EXPECT_TRUE(t.defined);
    const Vector F = (-t.gap * t.weight) * t.normal, M = cross(t.point, F);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += F[k], sum[3 + k] += M[k];
  }
  return sum;
}

// --- by hand

inline const Frustum roller{-0.5, 0.1, 0.5, 0.1}, drum{-1, 0.5, 1, 0.5};
inline const Box table{{-2, -2, -1}, {2, 2, 0}};

// z of the first along (cos, sin, 0) of an angle, its x up.
inline Frame lying(double angle, const Vector& p) {
  return {p, {0, 0, 1}, {std::sin(angle), -std::cos(angle), 0}, {std::cos(angle), std::sin(angle), 0}};
}

}  // namespace dynalin::frustum_test
