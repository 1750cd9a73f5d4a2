// A deck as equations: M u″ + B u′ + K u = p with constraints, in all freedoms of its points.
#pragma once

#include <Eigen/SparseCore>
#include <string>
#include <utility>
#include <vector>

#include "nastran_reader/points.h"

namespace dynalin::nastran_reader {

using SparseMatrix = Eigen::SparseMatrix<double>;

struct ConstraintRow {
  std::vector<std::pair<int, double>> terms;  // freedom, coefficient; each freedom once
  std::string card;                           // "RJOINT 5 component 3"
  Span at;
};

struct Equations {
  SparseMatrix M, B, K;
  std::vector<ConstraintRow> rows;
  std::vector<bool> fixed;  // by SPC, SPC1 or PS
};

// Of a deck that has been checked.
Equations assemble(const Deck&, const Points&);

// What a rigid motion of A, in components of A, is at B, in components of B.
Matrix6 rigid_map(const Point& a, const Point& b);

}  // namespace dynalin::nastran_reader
