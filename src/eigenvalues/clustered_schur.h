// The Schur form of a matrix with its eigenvalues in clusters that stand together on the diagonal, and bases of the
// invariant subspaces that belong to them, in long double.
#pragma once

#include <vector>

#include "eigenvalues/inclusion.h"

namespace dynalin {

// Products of complex matrices by their parts: the operators of std::complex ask for infinities at every step.
LongComplexMatrix times(const LongComplexMatrix& a, const LongComplexMatrix& b);

class ClusteredSchur {
 public:
  // M = Q T Qᴴ, each eigenvalue a cluster of its own; false if the QR iteration does not converge. Of large matrices
  // in double: whatever is missing from the form is for the caller to find.
  bool compute(const LongComplexMatrix& M);

  Eigen::Index clusters() const { return static_cast<Eigen::Index>(first_.size()); }
  Eigen::Index first(Eigen::Index cluster) const { return first_[static_cast<std::size_t>(cluster)]; }
  Eigen::Index size(Eigen::Index cluster) const {
    return (cluster + 1 < clusters() ? first(cluster + 1) : T_.rows()) - first(cluster);
  }
  Eigen::Index cluster_of(Eigen::Index k) const;
  const LongComplexMatrix& triangle() const { return T_; }  // T
  std::complex<long double> mean(Eigen::Index cluster) const {
    return T_.diagonal().segment(first(cluster), size(cluster)).mean();
  }

  // Clusters with the same number become one.
  void join(const std::vector<Eigen::Index>& number_of_cluster);
  // Orthonormal bases of the invariant subspaces, side by side.
  LongComplexMatrix bases() const;

 private:
  void arrange();
  void exchange(Eigen::Index k);

  LongComplexMatrix T_, Q_;
  std::vector<Eigen::Index> label_, first_;
};

}  // namespace dynalin
