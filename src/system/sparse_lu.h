// Sparse direct solution of square systems, behind one small interface: KLU for tree-like patterns, MUMPS where loops
// would fill it in. The prediction of KLU's own analysis decides.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

struct Triplet {
  std::int32_t row, column;
  double value;
};
// Compressed columns from triplets; equal places are added up, zeros stay.
ColumnMatrix compressed(std::int32_t rows, std::int32_t columns, std::span<const Triplet>);

class SparseLu {
 public:
  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  // What follows from the pattern alone is found once for all matrices of one pattern that follow each other.
  // False if a pivot is nothing, or so small beside the others that it can only be rounding. Rounding may leave a
  // singular matrix pivots that are larger: how well a solution is determined is not asked here. There is nothing to
  // solve with then.
  bool factor(ColumnMatrix);
  // Solves in place with one step of iterative refinement; every column of B is a right-hand side.
  // Refined once, or as the factors have it: as good as the matrix is well-conditioned, at half the price.
  enum class Refined : bool { no, yes };
  void solve(Eigen::Ref<Eigen::MatrixXd> B, Refined = Refined::yes) const;
  void solve_transposed(Eigen::Ref<Eigen::MatrixXd> B) const;
  int determinant_sign() const;  // 1 or −1
  std::size_t entries() const;   // of the factors

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace dynalin
