// The largest eigenvalues of an operator and their invariant subspace, by Krylov subspaces with Schur restarts
// (Stewart, SIAM J. Matrix Anal. Appl. 23, 2001):
//
//     Op V = V H + v bᵀ        H brought to Schur form, leading values first; one with |b_k| ≈ 0 is found.
//
// What is found is locked: Op Q = Q T, and the search goes on in the complement of Q, from any start vector. So values
// that one start vector does not see, further copies of multiple ones among them, are found from the next.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "base/progress.h"
#include "distributed/krylov_run.h"

namespace dynalin {

class KrylovSchur {
 public:
  using Operator = std::function<void(Eigen::VectorXcd&)>;

  explicit KrylovSchur(Eigen::Index size, Progress progress = {})
      : size_(size), progress_(std::move(progress)), Q_(size, 0), T_(0, 0) {}

  // Goes on from a new start vector until this run has locked `wanted` values or the largest that it finds is below
  // `least`; false if it does not converge in so many restarts.
  bool run(const Operator&, Eigen::Index wanted, double least, int restarts = 300);

  Eigen::Index found() const { return Q_.cols(); }
  bool everything() const { return found() == size_; }
  const Eigen::MatrixXcd& basis() const { return Q_; }     // Q, orthonormal
  const Eigen::MatrixXcd& triangle() const { return T_; }  // T, upper triangular
  // Values of the last run that had not converged.
  const std::vector<std::complex<double>>& in_sight() const { return in_sight_; }

  // Brings those that `first` says to the front; how many they are.
  Eigen::Index order(const std::function<bool(std::complex<double>)>& first);
  // What Q and T are for f(Op) with the triangle f(T).
  void set_triangle(Eigen::MatrixXcd T) { T_ = std::move(T); }

 private:
  // What a team of processes has found; false if it is not invariant.
  bool take(const KrylovRun&);

  Eigen::Index size_;
  Progress progress_;
  Eigen::MatrixXcd Q_, T_;
  std::vector<std::complex<double>> in_sight_;
  unsigned starts_ = 0;
};

}  // namespace dynalin
