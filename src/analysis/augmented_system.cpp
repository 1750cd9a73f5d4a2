#include "analysis/augmented_system.h"

#include <algorithm>
#include <cmath>

#include "base/arbitrary_vector.h"
#include "system/column_builder.h"

namespace dynalin {

AugmentedSystem::AugmentedSystem(const System& system)
    : n_(system.layout().coordinate_count),
      m_(static_cast<std::int32_t>(system.layout().rows.size())),
      w_(static_cast<std::int32_t>(system.layout().algebraic.size())),
      z_(static_cast<std::int32_t>(system.layout().states.size())),
      size_(n_ + m_ + w_ + z_) {}

ColumnMatrix AugmentedSystem::matrix(const Equations& eq, const ConstraintRows& rows, const std::vector<bool>& active,
                                     const AugmentedColumns& columns, const std::vector<bool>& cut,
                                     const std::vector<bool>& held, std::span<const double> added_diagonal) const {
  const auto replaced = [&](std::int32_t r) {
    if (r < n_) return false;
    if (r < n_ + w_) return !cut.empty() && cut[static_cast<std::size_t>(r - n_)];
    return !held.empty() && held[static_cast<std::size_t>(r - n_ - w_)];
  };
  return compressed_columns(size_, size_, [&](auto&& take) {
    const auto take_family = [&](PartialBy family, std::int32_t offset) {
      for_each_entry(eq.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
        if (!replaced(r)) take(equation(r), offset + c, v);
      });
    };
    if (columns.with_coordinates) take_family(columns.coordinates, 0);
    take_family(PartialBy::lambda, n_);
    take_family(PartialBy::algebraic, n_ + m_);
    take_family(columns.states, n_ + m_ + w_);
    for (std::int32_t k = 0; k < m_; ++k) {
      if (!active[static_cast<std::size_t>(k)]) {
        take(lambda(k), lambda(k), 1.0);
        continue;
      }
      for (const auto& e : rows.row(k)) {
        take(lambda(k), e.column, e.c.g);
        take(e.column, lambda(k), -e.c.g);
      }
    }
    for (std::int32_t k = 0; k < w_; ++k) {
      if (replaced(n_ + k)) take(algebraic(k), algebraic(k), 1.0);
    }
    for (std::int32_t k = 0; k < z_; ++k) {
      if (replaced(n_ + w_ + k)) take(state(k), state(k), 1.0);
    }
    for (std::size_t k = 0; k < added_diagonal.size(); ++k) {
      const auto i = static_cast<std::int32_t>(k);
      take(i, i, added_diagonal[k]);
    }
  });
}

std::vector<std::string> undetermined(const System& system, const AugmentedSystem& augmented, ColumnMatrix m) {
  // A random right-hand side, solved with a barely regularised matrix, grows along the null space.
  double largest = 0;
  for (const double v : m.value) largest = std::max(largest, std::abs(v));
  if (largest == 0) largest = 1;  // nothing but VARIABLE/1, FUNCTION=VARVAL(1)+1
  std::vector<Triplet> entries;
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
  for (std::int32_t c = 0; c < m.columns; ++c) entries.push_back({c, c, 1e-10 * largest});
  SparseLu lu;
  if (!lu.factor(compressed(m.rows, m.columns, entries))) return {};
  Eigen::MatrixXd x = arbitrary_vector(augmented.size(), 1).real();
  for (int pass = 0; pass < 2; ++pass) {
    lu.solve(x);
    x /= x.cwiseAbs().maxCoeff();
  }
  const Layout& layout = system.layout();
  std::vector<std::pair<double, std::string>> named;
  for (std::int32_t k = 0; k < augmented.size(); ++k) {
    const double size = std::abs(x(k, 0));
    if (size < 0.1) continue;
    if (k < augmented.lambda(0)) {
      named.emplace_back(size, layout.coordinate_text(k));
    } else if (k >= augmented.algebraic(0) && k < augmented.state(0)) {
      const auto& a = layout.algebraic[static_cast<std::size_t>(k - augmented.algebraic(0))];
      const bool is_rate = std::any_of(layout.algebraic.begin(), layout.algebraic.end(),
                                       [&](const auto& other) { return other.rate == k - augmented.algebraic(0); });
      named.emplace_back(size, (is_rate ? "the rate of " : "the value of ") + a.owner->full_text());
    } else if (k >= augmented.state(0)) {
      const auto& z = layout.states[static_cast<std::size_t>(k - augmented.state(0))];
      named.emplace_back(size, "the state of " + z.owner->full_text());
    }
  }
  std::stable_sort(named.begin(), named.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min<std::size_t>(named.size(), 6); ++k) names.push_back(named[k].second);
  return names;
}

}  // namespace dynalin
