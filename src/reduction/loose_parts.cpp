#include "reduction/loose_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/joined_sets.h"
#include "reduction/inertia_factors.h"

namespace dynalin::reduction {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double rounding_beside_diagonal = 1e-14;  // of an entry beside the diagonal, in parts of it

}  // namespace

std::string name_of(const Freedom& f) {
  return f.direction == 0 ? fmt::format("node {}", f.node) : fmt::format("node {}, direction {}", f.node, f.direction);
}

std::optional<LoosePart> loose_part(const FiniteElementModel& model, NodeLabel seen_from) {
  const SparseMatrix& K = model.stiffness;
  // What has no place is a coordinate of its own.
  std::map<Freedom, std::size_t> nodes;
  std::vector<std::size_t> node_of;
  for (const Freedom& f : model.freedoms)
    node_of.push_back(nodes.try_emplace(Freedom{f.node, f.direction == 0 ? 0 : 1}, nodes.size()).first->second);
  JoinedSets parts(nodes.size());  // of nodes that an entry of the stiffness connects
  const VectorXd diagonal = K.diagonal();
  std::vector<Index> empty;
  for (Index c = 0; c < K.cols(); ++c) {
    bool any = false;
    for (SparseMatrix::InnerIterator it(K, c); it; ++it) {
      const double size = std::sqrt(std::abs(diagonal[c] * diagonal[it.row()]));
      if (it.value() == 0 || (it.row() != c && std::abs(it.value()) <= rounding_beside_diagonal * size)) continue;
      any = true;
      parts.join(node_of[static_cast<std::size_t>(c)], node_of[static_cast<std::size_t>(it.row())]);
    }
    if (!any) empty.push_back(c);
  }
  if (!empty.empty()) {
    const std::string name = name_of(model.freedoms[static_cast<std::size_t>(empty.front())]);
    const std::size_t others = empty.size() - 1;
    const std::string all =
        others == 0 ? name + " has" : fmt::format("{} and {} other{} have", name, others, others == 1 ? "" : "s");
    return LoosePart{all + " no stiffness at all", empty.front()};
  }
  std::set<std::size_t> roots;
  for (const std::size_t node : node_of) roots.insert(parts.of(node));
  const auto seen = nodes.find({seen_from, 1});
  if (seen == nodes.end() || roots.size() == 1) return std::nullopt;
  const auto apart =
      std::ranges::find_if(node_of, [&](std::size_t node) { return parts.of(node) != parts.of(seen->second); });
  const Index row = apart - node_of.begin();
  return LoosePart{fmt::format("the stiffness falls into {} parts: node {} is not connected to node {}", roots.size(),
                               model.freedoms[static_cast<std::size_t>(row)].node, seen_from),
                   row};
}

VectorXd weakest_motion(const SparseMatrix& matrix) {
  const Index n = matrix.rows();
  const VectorXd diagonal = matrix.diagonal();
  const double largest = std::max(diagonal.cwiseAbs().maxCoeff(), 1e-300);
  const VectorXd unit = diagonal.unaryExpr([&](double d) { return 1 / std::sqrt(d > 0 ? d : largest); });
  const SparseMatrix scaled = SparseMatrix(unit.asDiagonal() * matrix) * unit.asDiagonal();
  SparseMatrix one(n, n);
  one.setIdentity();
  const auto moved_up = [&](double by) { return InertiaFactors(SparseMatrix(scaled + by * one)); };
  const auto is_positive = [](const InertiaFactors& f) { return f.negative() == 0 && f.null_pivots() == 0; };
  // The least shift above which no eigenvalue is negative: beyond it the lowest is the one nearest to zero.
  double above = 1e-10, below = 0;
  const double most = (scaled.cwiseAbs() * VectorXd::Ones(n)).maxCoeff();  // Gershgorin: none is below its negative
  while (above < most && !is_positive(moved_up(above))) below = above, above *= 1000;
  for (int step = 0; step < 6 && below > 0; ++step) {
    const double middle = std::sqrt(below * above);
    (is_positive(moved_up(middle)) ? above : below) = middle;
  }
  const InertiaFactors factors = moved_up(above);
  // Of no symmetry that the motion might lack.
  Eigen::MatrixXd x(n, 1);
  for (Index k = 0; k < n; ++k) x(k, 0) = 1 + 0.5 * std::sin(static_cast<double>(k + 1));
  for (int step = 0; step < 8; ++step) {
    factors.solve(x);
    x /= x.norm();
  }
  return x.col(0);
}

}  // namespace dynalin::reduction
