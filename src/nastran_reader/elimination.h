// All constraints of a deck taken out together: u = T q for every u that meets them.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "nastran_reader/equations.h"

namespace dynalin::nastran_reader {

struct Elimination {
  // Freedoms × independent ones. Which freedoms these are the numbers decide, not the order of cards or terms.
  Eigen::SparseMatrix<double, Eigen::RowMajor> T;
  std::vector<int> independent;  // of each column the freedom that it is

  // Rows that follow from others: what was left of them relative to what they began with is rounding.
  struct Remainder {
    std::size_t row;  // of Equations::rows
    double relative;
  };
  std::vector<Remainder> redundant;
  // Rows of which so little was left that they may be meant to follow from others and were kept all the same.
  std::vector<Remainder> nearly_redundant;
};

// Below the first a row is redundant, between the two it is nearly so.
constexpr double redundant_below = 1e-11, nearly_redundant_below = 1e-5;

Elimination eliminate(const Equations&);

}  // namespace dynalin::nastran_reader
