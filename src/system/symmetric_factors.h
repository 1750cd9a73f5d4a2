// Sparse factors of symmetric matrices. L D Lᵀ tells how many eigenvalues are negative: as many as D has negative
// pivots (Sylvester's law of inertia). MUMPS exchanges rows for it. Where there are no loops it is made in a given
// order first, which takes a tenth of the time on the small fronts of chains, and taken where what it makes of vectors
// is what the matrix makes of them. Who only solves gets KLU's L U there.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

enum class FactorsFor : std::uint8_t { inertia, solving };

constexpr std::int32_t long_column = 50000;  // rows from which threads share the columns of a block

class SymmetricFactors {
 public:
  // The pattern of all that is factored: the lower triangle, analysed once, by what may be at work for others beside
  // it.
  explicit SymmetricFactors(const ColumnMatrix& lower, FactorsFor = FactorsFor::inertia);
  ~SymmetricFactors();
  SymmetricFactors(const SymmetricFactors&) = delete;
  SymmetricFactors& operator=(const SymmetricFactors&) = delete;

  // Values of the entries of the pattern, in its order. False if a pivot is nothing.
  bool factor(std::vector<double> values);
  std::int64_t negative_pivots() const;        // of what was factored last, for inertia
  void solve(Eigen::MatrixXd& columns) const;  // in place

 private:
  struct Inertia;
  struct InOrder;
  struct Solving;
  // One of them, the second until it has failed once; the first is made to factor only.
  std::unique_ptr<Inertia> inertia_;
  std::unique_ptr<InOrder> in_order_;
  std::unique_ptr<Solving> solving_;
  ColumnMatrix lower_;                              // the pattern, for the first of them
  std::optional<std::vector<std::int32_t>> place_;  // in the order of elimination
};

}  // namespace dynalin
