#include "reduction/inertia_invariants.h"

#include <array>
#include <map>

namespace dynalin::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// G_k of each column: the nodewise cross product e_k × v.
MatrixXd crossed(const std::map<Freedom, Index>& row_of, int k, const MatrixXd& v) {
  MatrixXd result = MatrixXd::Zero(v.rows(), v.cols());
  for (const auto& [freedom, row] : row_of) {
    if (freedom.direction == 0) continue;
    // (e_k × v)_{k+1} = −v_{k+2}, (e_k × v)_{k+2} = v_{k+1}, in a cycle of three.
    const int group = freedom.direction > 3 ? 4 : 1, d = freedom.direction - group;
    if (d == k) continue;
    const bool next = d == (k + 1) % 3;
    const int other = next ? (k + 2) % 3 : (k + 1) % 3;
    const auto from = row_of.find({freedom.node, group + other});
    if (from != row_of.end()) result.row(row) = (next ? -1.0 : 1.0) * v.row(from->second);
  }
  return result;
}

}  // namespace

BodyFile body_of(const FiniteElementModel& model, const Reduction& reduction, const std::vector<NodeLabel>& nodes,
                 InertiaOrder order, std::string title) {
  const MatrixXd& U = reduction.shapes;
  const Index N = U.cols();
  std::map<Freedom, Index> row_of;
  for (std::size_t k = 0; k < model.freedoms.size(); ++k) row_of[model.freedoms[k]] = static_cast<Index>(k);
  BodyFile body;
  body.title = std::move(title), body.labels = nodes;
  const auto n = static_cast<Index>(nodes.size());
  body.places.resize(3, n);
  body.shapes = MatrixXd::Zero(6 * n, N);
  for (Index node = 0; node < n; ++node) {
    const NodeLabel label = nodes[static_cast<std::size_t>(node)];
    body.places.col(node) = model.nodes.at(label);
    for (int d = 1; d <= 6; ++d) {
      const auto row = row_of.find({label, d});
      if (row != row_of.end()) body.shapes.row(6 * node + d - 1) = U.row(row->second);
    }
  }
  body.mass = MatrixXd::Identity(N, N);
  body.stiffness = reduction.squares.asDiagonal();
  body.total_mass = reduction.properties.mass;
  body.centre = reduction.properties.centre;
  body.inertia = reduction.properties.inertia;
  const MatrixXd rigid = rigid_motions(model);
  MatrixXd momentum = model.mass * U;
  momentum.rightCols(reduction.massless).setZero();  // but for the rounding of shapes that are large
  const MatrixXd momenta = rigid.transpose() * momentum;
  body.i3 = momenta.topRows(3), body.i4 = momenta.bottomRows(3);
  if (order == InertiaOrder::undeformed) return body;
  std::array<MatrixXd, 3> turned;
  for (int k = 0; k < 3; ++k) turned[static_cast<std::size_t>(k)] = crossed(row_of, k, U);
  body.i5.resize(3, N * N), body.i8.resize(3, 3 * N), body.i9.resize(3 * N, 3 * N);
  for (Index l = 0; l < 3; ++l) {
    const MatrixXd& of_l = turned[static_cast<std::size_t>(l)];
    MatrixXd pairs = momentum.transpose() * of_l;  // row k, column j: (G_l φ_j)ᵀ M φ_k
    // As of products of vectors; a mass that does not weigh all directions alike leaves a little more.
    pairs = (0.5 * (pairs - pairs.transpose())).eval();
    for (Index j = 0; j < N; ++j) body.i5.row(l).segment(j * N, N) = pairs.col(j).transpose();
    const MatrixXd forces = model.mass * of_l;
    const MatrixXd with_rigid = rigid.rightCols(3).transpose() * forces;
    for (Index j = 0; j < N; ++j) body.i8.col(3 * j + l) = -with_rigid.col(j);
    for (Index k = 0; k < 3; ++k) {
      const MatrixXd both = turned[static_cast<std::size_t>(k)].transpose() * forces;
      for (Index j = 0; j < N; ++j) {
        for (Index m = 0; m < N; ++m) body.i9(3 * j + k, 3 * m + l) = -both(j, m);
      }
    }
  }
  return body;
}

}  // namespace dynalin::reduction
