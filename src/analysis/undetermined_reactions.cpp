#include "analysis/undetermined_reactions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "system/sparse_lu.h"

namespace dynalin {

namespace {

// Beside singular values of rows of size 1, squared.
constexpr double regularization = 1e-14;
// Of a value, what a change has to be to count.
constexpr double noticeable = 1e-6;
constexpr std::size_t most_names = 6;
// Rows and coordinates, whose factors fill up in lattices.
constexpr std::int32_t affordable = 50000;

// With rows G of size 1 in comparable coordinates the least reactions are λ = G (Gᵀ G)⁻¹ Gᵀ λ₀: of
//     ⎡ 1    G  ⎤ ⎡ λ ⎤   ⎡   0   ⎤
//     ⎣ Gᵀ  −ε  ⎦ ⎣ μ ⎦ = ⎣ Gᵀ λ₀ ⎦ ,     ε for the directions that no row holds.
Eigen::VectorXd change_to_least_reactions(const System& system, const ConstraintRows& rows,
                                          const std::vector<bool>& taking_part, const std::vector<double>& lambda) {
  const std::int32_t count = rows.size(), n = system.layout().coordinate_count;
  Eigen::VectorXd size = Eigen::VectorXd::Ones(count), sized(count);
  std::vector<Triplet> entries;
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(count + n, 1);
  for (std::int32_t k = 0; k < count; ++k) {
    double largest = 0;
    for (const auto& e : rows.row(k)) largest = std::max(largest, std::abs(e.c.g * system.coordinate_scale(e.column)));
    if (largest > 0) size(k) = largest;
    sized(k) = lambda[static_cast<std::size_t>(k)] * size(k);
    entries.push_back({k, k, 1.0});
    if (!taking_part[static_cast<std::size_t>(k)]) continue;
    for (const auto& e : rows.row(k)) {
      const double g = e.c.g * system.coordinate_scale(e.column) / size(k);
      if (g == 0) continue;
      entries.push_back({k, count + e.column, g});
      entries.push_back({count + e.column, k, g});
      b(count + e.column, 0) += g * sized(k);
    }
  }
  for (std::int32_t c = 0; c < n; ++c) entries.push_back({count + c, count + c, -regularization});
  SparseLu lu;
  if (!lu.factor(compressed(count + n, count + n, entries))) return Eigen::VectorXd::Zero(count);
  lu.solve(b);
  Eigen::VectorXd change = b.col(0).head(count);
  for (std::int32_t k = 0; k < count; ++k)
    change(k) = taking_part[static_cast<std::size_t>(k)] ? (change(k) - sized(k)) / size(k) : 0.0;
  return change.allFinite() ? change : Eigen::VectorXd::Zero(count);
}

// What of the motion an equation depends on: where a friction is zero at rest its value says nothing, but its slope
// does.
constexpr std::array<PartialBy, 4> slopes = {PartialBy::position, PartialBy::velocity, PartialBy::damping,
                                             PartialBy::state};
std::array<ColumnMatrix, slopes.size()> slopes_of(const Equations& eq) {
  std::array<ColumnMatrix, slopes.size()> all;
  for (std::size_t k = 0; k < slopes.size(); ++k) all[k] = eq.matrix(slopes[k]);
  return all;
}
// Beside the largest of the row.
void mark_rows_that_change(const ColumnMatrix& a, const ColumnMatrix& b, std::vector<bool>& changes) {
  std::map<std::pair<std::int32_t, std::int32_t>, double> difference;
  std::vector<double> largest(changes.size(), 0);
  const auto add = [&](const ColumnMatrix& m, double sign) {
    for_each_entry(m, [&](std::int32_t row, std::int32_t column, double value) {
      double& most = largest[static_cast<std::size_t>(row)];
      most = std::max(most, std::abs(value));
      difference[{row, column}] += sign * value;
    });
  };
  add(a, 1), add(b, -1);
  for (const auto& [at, value] : difference) {
    const auto row = static_cast<std::size_t>(at.first);
    if (std::abs(value) > noticeable * largest[row]) changes[row] = true;
  }
}

}  // namespace

void warn_of_undetermined_reactions(const System& system, AccelerationEquations& equations, const OperatingPoint& op,
                                    Diagnostics& out) {
  const Layout& layout = system.layout();
  const ConstraintRows& rows = equations.rows();
  const Equations& eq = equations.equations();
  if (rows.size() + layout.coordinate_count > affordable) {
    out.warning(
        "undetermined-reaction", {},
        "the model is too large to look whether functions and FRICTION read reactions of redundant constraints, "
        "which nothing determines");
    return;
  }
  const auto evaluate = [&](const OperatingPoint& at) {
    equations.evaluate(at, {PartialBy::position, PartialBy::velocity, PartialBy::damping, PartialBy::state});
  };
  evaluate(op);
  const std::vector<double> before(eq.residual().begin(), eq.residual().end());
  const std::array<ColumnMatrix, slopes.size()> slopes_before = slopes_of(eq);
  std::vector<bool> taking_part = equations.partition().active;
  for (const std::int32_t r : equations.partition().redundant) taking_part[static_cast<std::size_t>(r)] = true;
  const Eigen::VectorXd change = change_to_least_reactions(system, rows, taking_part, op.lambda);
  OperatingPoint least = op;
  for (std::size_t k = 0; k < least.lambda.size(); ++k) least.lambda[k] += change(static_cast<Eigen::Index>(k));
  evaluate(least);
  std::vector<bool> changes(before.size(), false);
  for (std::size_t k = 0; k < slopes.size(); ++k)
    mark_rows_that_change(slopes_before[k], eq.matrix(slopes[k]), changes);

  std::vector<const ElementLabel*> readers;
  const auto look = [&](std::int32_t row, const ElementLabel* owner) {
    const auto at = static_cast<std::size_t>(row);
    const bool reads = changes[at] || std::abs(eq.residual()[at] - before[at]) > noticeable * eq.magnitude()[at];
    if (reads && std::find(readers.begin(), readers.end(), owner) == readers.end()) readers.push_back(owner);
  };
  for (std::size_t k = 0; k < layout.algebraic.size(); ++k)
    look(eq.algebraic_row(static_cast<std::int32_t>(k)), layout.algebraic[k].owner);
  for (std::size_t k = 0; k < layout.states.size(); ++k)
    look(eq.state_row(static_cast<std::int32_t>(k)), layout.states[k].owner);
  if (readers.empty()) return;

  double largest = 0;
  for (const double l : op.lambda) largest = std::max(largest, std::abs(l));
  std::vector<std::string> joints;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (std::abs(change(k)) <= noticeable * largest) continue;
    std::string name = layout.rows[static_cast<std::size_t>(k)].owner->full_text();
    if (std::find(joints.begin(), joints.end(), name) == joints.end()) joints.push_back(std::move(name));
  }
  if (joints.size() > most_names) {
    joints.resize(most_names);
    joints.emplace_back("…");
  }
  for (const ElementLabel* reader : readers) {
    out.warning("undetermined-reaction", reader->at,
                fmt::format("{} follows from reactions that nothing determines: how {} share their load depends on the "
                            "order of the statements",
                            reader->full_text(), fmt::join(joints, ", ")),
                "what leaves no constraint redundant, such as a BUSHING in the place of a joint, makes it a matter of "
                "the model");
  }
}

}  // namespace dynalin
