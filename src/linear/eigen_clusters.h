// Eigenvalues that perturbations of the size of the residuals mix are corrected together.
//
// G_ii (eigen_residuals.h) is what the two-sided Rayleigh quotient adds to λ_i; what is left of second order,
// Σ_j (|G_ij|/|λ_i − λ_j| + |p_ij|) |G_ji|, bounds the error of an isolated eigenvalue, the norm of its block of G that
// of one in a cluster (Gershgorin, Bauer and Fike; Stewart and Sun, Matrix Perturbation Theory, IV).
#pragma once

#include "linear/eigen_residuals.h"

namespace dynalin {

class EigenClusters {
 public:
  EigenClusters(const EigenPairs&, const EigenResiduals&);

  // Whether j belongs to the cluster of the pair i.
  bool together(Eigen::Index i, const Member& j) const {
    return root(j.at) == root(i) && (closed_[static_cast<std::size_t>(root(i))] || !j.conjugate);
  }

  // Replaces every pair by what its cluster becomes; a pair of real ones may turn out to be complex and the other way
  // round.
  struct Corrected {
    EigenPairs pairs;
    std::vector<EigenTrust> trust;
    std::vector<bool> alone;  // not in a cluster
  };
  Corrected corrected() const;

 private:
  struct Part {
    std::vector<std::complex<double>> values;
    Eigen::MatrixXcd right, left;
    double bound = 0;
  };
  Eigen::Index root(Eigen::Index i) const {
    while (group_[static_cast<std::size_t>(i)] != i) i = group_[static_cast<std::size_t>(i)];
    return i;
  }
  Part correct(const std::vector<Member>&, bool closed) const;
  Part correct_together(const std::vector<Member>&, bool closed, double outside, double written) const;
  Part unchanged(const std::vector<Member>&, double bound) const;
  Eigen::MatrixXcd columns(const Eigen::MatrixXcd& of, const std::vector<Member>&) const;

  const EigenPairs& pairs_;
  const EigenResiduals& residuals_;
  std::vector<Eigen::Index> group_;
  std::vector<bool> closed_;  // with the conjugate of each of its members
};

}  // namespace dynalin
