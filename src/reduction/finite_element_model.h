// A finite-element model as its matrices state it: no mesh, no materials.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "base/source.h"

namespace dynalin::reduction {

using NodeLabel = std::int64_t;
using SparseMatrix = Eigen::SparseMatrix<double>;

// What one row of the matrices is.
struct Freedom {
  NodeLabel node = 0;
  int direction = 0;  // 1 to 3: translation along x, y, z [length]; 4 to 6: rotation about them [rad]; 0: a coordinate
                      // without a place, as the modes of a model that was reduced before
  auto operator<=>(const Freedom&) const = default;
};

// n freedoms in the axes of the model. Units are those of the program that made it, consistent among themselves:
// ω² = K/M.
struct FiniteElementModel {
  std::vector<Freedom> freedoms;               // n, none twice
  std::map<NodeLabel, Eigen::Vector3d> nodes;  // places [length]; of every node of a freedom, and perhaps of others
  SparseMatrix stiffness;                      // n x n, symmetric, both triangles [force/length, force, force·length]
  SparseMatrix mass;                           // n x n, symmetric, both triangles [mass, mass·length, mass·length²]
  // Where the diagonal entry of a row is written, for messages; empty where no file states the matrices.
  std::function<Span(Eigen::Index row)> stiffness_at, mass_at;
};

}  // namespace dynalin::reduction
