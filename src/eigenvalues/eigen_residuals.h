// What the sparse perturbation equations say about computed eigenpairs, in components along all of them.
//
// With all eigenvectors X = [x_j] and Y their left counterparts, R the residuals S w − λ E w of the sparse pencil
// (pencil_residual.h) in long double, reduced to the states, the similar matrix
//
//     X⁻¹ A X = Λ + E,   E = G − P E,   G_ij = y_iᴴ r_j / y_iᴴ x_i,   P_ij = y_iᴴ x_j / y_iᴴ x_i off the diagonal
//
// is exact.
#pragma once

#include <vector>

#include "eigenvalues/eigen_pairs.h"
#include "eigenvalues/pencil_residual.h"

namespace dynalin {

class EigenResiduals {
 public:
  EigenResiduals(const StructuredPencil&, const ZeroModes&, const EigenPairs&);

  // Left and right vectors of a defective eigenvalue are orthogonal: nothing can be measured along them.
  bool complete() const { return complete_; }

  Eigen::Index count() const { return floor_.size(); }
  // Entries of G and P among members.
  std::complex<double> g(const Member& i, const Member& j) const { return entry(along_, along_conjugate_, i, j); }
  std::complex<double> p(const Member& i, const Member& j) const { return entry(product_, product_conjugate_, i, j); }
  // y_iᴴ x_i
  std::complex<double> unit(Eigen::Index i) const { return unit_(i); }

  // What rounding may have left of G_ii: of its own sums, and what was taken out for the sake of the zero modes.
  double floor(Eigen::Index i) const { return floor_(i); }
  // The part of it that follows from what is not known of the state matrix.
  double unknown(Eigen::Index i) const { return uncertain_(i, i); }
  // The floor of G_ij off the diagonal.
  double floor(Eigen::Index i, Eigen::Index j) const {
    return row_floor_.row(i).dot(column_floor_.row(j)) + uncertain_(i, j);
  }

  // What the zeros that were split off add to the second order of mode i, |g_i0 (λ_i − N)⁻¹ g_0i|, and the share that
  // they take in its right vector.
  double zero_coupling(Eigen::Index i) const { return zero_coupling_(i); }
  const Eigen::MatrixXcd& zero_share() const { return zero_share_; }

  // All members but i itself.
  template <class Function>
  void for_others(Eigen::Index i, Function&& visit) const {
    for (Eigen::Index j = 0; j < count(); ++j) {
      if (j != i) visit(Member{j, false});
      if (!pairs_.real(j)) visit(Member{j, true});
    }
  }

 private:
  Eigen::MatrixXcd measure(const StructuredPencil&);
  void measure_floors(const StructuredPencil&, const Eigen::MatrixXcd& reduced);
  void measure_zero_modes(const StructuredPencil&, const ZeroModes&, const Eigen::MatrixXcd& reduced);

  static std::complex<double> entry(const Eigen::MatrixXcd& plain, const Eigen::MatrixXcd& crossed, const Member& i,
                                    const Member& j) {
    const std::complex<double> v = (i.conjugate != j.conjugate ? crossed : plain)(i.at, j.at);
    return j.conjugate ? std::conj(v) : v;
  }

  const EigenPairs& pairs_;
  bool complete_ = true;
  Eigen::VectorXcd unit_;
  Eigen::VectorXd floor_, zero_coupling_;
  Eigen::VectorXd rounding_share_;  // of each equation in the rounding of any residual, at most
  // |y_a| of each left vector in units of its largest: in single precision they cost less to keep than to solve for
  // again.
  Eigen::MatrixXf left_shares_;
  Eigen::VectorXd left_units_;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> row_floor_, column_floor_;
  // Rows in units of y_iᴴ x_i; crossed: of y̅_i with r_j and x_j.
  Eigen::MatrixXcd along_, along_conjugate_, product_, product_conjugate_;
  Eigen::MatrixXd product_rounding_;  // of P
  Eigen::MatrixXcd zero_share_;
  Eigen::MatrixXd uncertain_;  // of entries, by what is not known of the state matrix
};

}  // namespace dynalin
