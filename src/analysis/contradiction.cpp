#include "analysis/contradiction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/enumeration.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

constexpr double least_part = 1e-6;  // of the largest
constexpr std::size_t most_contradicted = 4;

double gradient_norm(const SparseRow& row) {
  double square = 0;
  for (const double v : row.value) square += v * v;
  return std::sqrt(square);
}

// How much of each active row is in the gradient, by least squares: what is left of it is perpendicular to all of them.
std::vector<double> parts_of_gradient(std::int32_t coordinates, const std::vector<SparseRow>& gradients,
                                      const std::vector<bool>& active, std::size_t row) {
  const std::int32_t n = coordinates, m = static_cast<std::int32_t>(gradients.size());
  std::vector<double> part(gradients.size(), 0.0);
  std::vector<Triplet> entries;
  for (std::int32_t k = 0; k < n; ++k) entries.push_back({k, k, 1.0});
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n + m, 1);
  for (std::size_t k = 0; k < gradients.size(); ++k) {
    const auto at = n + static_cast<std::int32_t>(k);
    const SparseRow& g = gradients[k];
    const double norm = gradient_norm(g);
    if (k == row) {
      for (std::size_t i = 0; i < g.column.size(); ++i) x(g.column[i], 0) += g.value[i];
    }
    if (k == row || !active[k] || norm == 0) {
      entries.push_back({at, at, 1.0});
      continue;
    }
    for (std::size_t i = 0; i < g.column.size(); ++i) {
      entries.push_back({at, g.column[i], g.value[i] / norm});
      entries.push_back({g.column[i], at, g.value[i] / norm});
    }
  }
  SparseLu lu;
  if (!lu.factor(compressed(n + m, n + m, entries))) return part;
  lu.solve(x);
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (k != row && active[k]) part[k] = std::abs(x(n + static_cast<std::int32_t>(k), 0));
  }
  return part;
}

}  // namespace

std::vector<SparseRow> scaled_gradients(const System& system, const ConstraintRows& rows) {
  std::vector<SparseRow> gradients(static_cast<std::size_t>(rows.size()));
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    SparseRow& g = gradients[static_cast<std::size_t>(k)];
    for (const auto& e : rows.row(k)) {
      g.column.push_back(e.column);
      g.value.push_back(e.c.g * system.coordinate_scale(e.column));
    }
  }
  return gradients;
}

std::string contradiction(const System& system, const std::vector<SparseRow>& gradients,
                          const std::vector<bool>& active, std::int32_t row) {
  const auto at = static_cast<std::size_t>(row);
  const std::vector<double> part =
      parts_of_gradient(static_cast<std::int32_t>(system.coordinates()), gradients, active, at);
  const double largest = *std::ranges::max_element(part);
  const std::vector<ConstraintRow>& rows = system.layout().rows;
  std::vector<std::string> others;
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (!(part[k] > least_part * largest)) continue;
    std::string name = k < rows.size() ? rows[k].owner->full_text() : system.row_text(static_cast<std::int32_t>(k));
    if (std::ranges::find(others, name) == others.end()) others.push_back(std::move(name));
  }
  if (others.empty()) return system.row_text(row) + " cannot hold together with the others";
  const std::size_t more = others.size() > most_contradicted ? others.size() - most_contradicted : 0;
  others.resize(others.size() - more);
  if (more > 0) others.push_back(fmt::format("{} more", more));
  return fmt::format("{} cannot hold together with {}", system.row_text(row), enumeration(others));
}

}  // namespace dynalin
