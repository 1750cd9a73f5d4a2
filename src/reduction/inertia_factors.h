// L D Lᵀ of a sparse symmetric matrix by MUMPS, with the signs of its eigenvalues.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

class InertiaFactors {
 public:
  // Of a symmetric matrix with both triangles. Throws std::bad_alloc if memory is short.
  explicit InertiaFactors(const SparseMatrix&);
  ~InertiaFactors();
  InertiaFactors(InertiaFactors&&) noexcept;

  // How many eigenvalues are below zero (Sylvester: the signs of D are theirs).
  Eigen::Index negative() const;
  // Pivots that are nothing beside the others: there is nothing to solve with if there are any.
  Eigen::Index null_pivots() const;
  // In place; every column is a right-hand side.
  void solve(Eigen::Ref<Eigen::MatrixXd>) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace dynalin::reduction
