#include "elements/controls/signature_method.h"

#include <algorithm>
#include <limits>

namespace dynalin {

namespace {

// The best transversal, one unknown after the other along the shortest path, with prices of equations and unknowns that
// stay below all costs (the Hungarian method). Costs are negative derivatives.
class Assignment {
 public:
  explicit Assignment(const Signature& s) : n_(s.size()), cost_(n_, std::vector<int>(n_, nowhere)) {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        if (s[i][j]) cost_[i][j] = -*s[i][j];
      }
    }
  }

  std::optional<std::vector<std::size_t>> equations_of_unknowns() {
    std::vector<std::size_t> unknown_of(n_, n_);
    std::vector<int> price_of_equation(n_, 0), price_of_unknown(n_, 0);
    for (std::size_t start = 0; start < n_; ++start) {
      std::vector<int> distance(n_, std::numeric_limits<int>::max());
      std::vector<std::size_t> from(n_, n_);  // the equation reached before, n for the start
      std::vector<bool> done(n_, false);
      std::size_t unknown = start, last = n_;
      int so_far = 0;
      while (true) {
        for (std::size_t i = 0; i < n_; ++i) {
          if (done[i] || cost_[i][unknown] == nowhere) continue;
          const int d = so_far + cost_[i][unknown] - price_of_equation[i] - price_of_unknown[unknown];
          if (d < distance[i]) distance[i] = d, from[i] = last;
        }
        std::size_t next = n_;
        for (std::size_t i = 0; i < n_; ++i) {
          if (!done[i] && distance[i] != std::numeric_limits<int>::max() &&
              (next == n_ || distance[i] < distance[next]))
            next = i;
        }
        if (next == n_) return std::nullopt;
        done[next] = true, so_far = distance[next], last = next;
        if (unknown_of[next] == n_) break;
        unknown = unknown_of[next];
      }
      price_of_unknown[start] += so_far;
      for (std::size_t i = 0; i < n_; ++i) {
        if (!done[i] || unknown_of[i] == n_) continue;
        price_of_equation[i] -= so_far - distance[i];
        price_of_unknown[unknown_of[i]] += so_far - distance[i];
      }
      for (std::size_t i = last; i != n_;) {
        const std::size_t before = from[i];
        unknown_of[i] = before == n_ ? start : unknown_of[before];
        i = before;
      }
    }
    std::vector<std::size_t> equation(n_);
    for (std::size_t i = 0; i < n_; ++i) equation[unknown_of[i]] = i;
    return equation;
  }

 private:
  static constexpr int nowhere = std::numeric_limits<int>::max();
  std::size_t n_;
  std::vector<std::vector<int>> cost_;
};

}  // namespace

std::optional<StructuralIndex> structural_index(const Signature& s) {
  const std::size_t n = s.size();
  auto equation = Assignment(s).equations_of_unknowns();
  if (!equation) return std::nullopt;
  StructuralIndex found{std::move(*equation), std::vector<int>(n, 0), std::vector<int>(n, 0), 0};
  // The smallest that fit: d at least c + σ everywhere, and equal on the transversal. A fixed point, since that one is
  // the best.
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t j = 0; j < n; ++j) {
      int d = found.highest[j];
      for (std::size_t i = 0; i < n; ++i) {
        if (s[i][j]) d = std::max(d, found.differentiated[i] + *s[i][j]);
      }
      const std::size_t own = found.equation[j];
      const int c = d - *s[own][j];
      moved = moved || d != found.highest[j] || c != found.differentiated[own];
      found.highest[j] = d, found.differentiated[own] = c;
    }
  }
  for (std::size_t k = 0; k < n; ++k) found.freedoms += found.highest[k] - found.differentiated[k];
  return found;
}

}  // namespace dynalin
