// Sparse factors of symmetric matrices. L D Lᵀ by MUMPS tells how many eigenvalues are negative: as many as D has
// negative pivots (Sylvester's law of inertia). Who only solves gets KLU's L U where there are no loops, which takes a
// fifth of the time on the small fronts of chains.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mechanics/accumulator.h"

namespace dynalin {

enum class FactorsFor : std::uint8_t { inertia, solving };

class SymmetricFactors {
 public:
  // The pattern of all that is factored: the lower triangle, analysed once.
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
  struct Solving;
  std::unique_ptr<Inertia> inertia_;
  std::unique_ptr<Solving> solving_;  // of the two, one
};

}  // namespace dynalin
