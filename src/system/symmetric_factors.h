// Sparse factors L D Lᵀ of symmetric matrices by MUMPS, which tell how many eigenvalues are negative: as many as D has
// negative pivots (Sylvester's law of inertia).
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mechanics/accumulator.h"

namespace dynalin {

class SymmetricFactors {
 public:
  // The pattern of all that is factored: the lower triangle, analysed once.
  explicit SymmetricFactors(const ColumnMatrix& lower);
  ~SymmetricFactors();
  SymmetricFactors(const SymmetricFactors&) = delete;
  SymmetricFactors& operator=(const SymmetricFactors&) = delete;

  // Values of the entries of the pattern, in its order. False if a pivot is nothing.
  bool factor(std::vector<double> values);
  std::int64_t negative_pivots() const;        // of what was factored last
  void solve(Eigen::MatrixXd& columns) const;  // in place

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace dynalin
