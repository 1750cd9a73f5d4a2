// A subspace as residuals are made of it: of complex numbers as it stands, or of real ones that leave phases out.
//
// Modes of a conservative model (conservative_model.h) and their left vectors have, but for a common factor, real
// positions and rates that are i times real, and B is i times real. Where Σ is 1 for positions and −1 for rates, B = i
// Ω and Ỹ = Σ Y, all without their phases,
//
//     A X − X B = R   is   A X − Σ X Ω = R      and      Aᴴ Y − Y Bᴴ = L   is   Aᵀ Ỹ − Σ Ỹ Ωᵀ = L
//
// but for phases of R and L: half the numbers, and half the work for each.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>

#include "base/dense_products.h"
#include "selected_modes/short_columns.h"
#include "selected_modes/subspace_pencil.h"

namespace dynalin {

// Complex numbers: Σ = 1, and nothing has a phase of its own.
class ComplexSubspace {
 public:
  using Scalar = std::complex<double>;
  explicit ComplexSubspace(const Subspace& s)
      : s_(s), onto_(s.B.rows() + s.C.rows(), s.B.cols()), left_onto_(s.B.adjoint()) {
    onto_ << s.B, s.C;
    if (s.V.cols() == 0) return;
    beside_.resize(s.X.rows(), onto_.rows());
    beside_ << s.X, s.V.cast<Scalar>();
  }

  const Eigen::MatrixXcd& X() const { return s_.X; }
  const Eigen::MatrixXcd& Y() const { return s_.Y; }
  // A X − Σ U `onto`, where U is X with zeros beside it.
  const Eigen::MatrixXcd& U() const { return s_.V.cols() > 0 ? beside_ : s_.X; }
  const Eigen::MatrixXcd& onto() const { return onto_; }
  const Eigen::MatrixXcd& left_onto() const { return left_onto_; }
  double sign(Eigen::Index) const { return 1; }

  // A real linear map of columns; it may take its argument for its own.
  template <class Function>
  static Eigen::MatrixXcd mapped(const Eigen::MatrixXcd& m, Function&& real_map) {
    return by_parts(m, real_map);
  }
  // Yᴴ R of right residuals or their likes, and these and left ones with their phases.
  Eigen::MatrixXcd projected(const Eigen::MatrixXcd& residual) const { return adjoint_product(s_.Y, residual); }
  Eigen::MatrixXcd product_of_residual(Eigen::MatrixXcd m) const { return m; }
  Eigen::MatrixXcd right_residual(Eigen::MatrixXcd m) const { return m; }
  Eigen::MatrixXcd left_residual(Eigen::MatrixXcd m) const { return m; }

 private:
  const Subspace& s_;
  Eigen::MatrixXcd beside_, onto_, left_onto_;
};

class RealSubspace {
 public:
  using Scalar = double;
  // Of a subspace of a conservative model; nothing where phases are others.
  static std::optional<RealSubspace> of(const Subspace& s) {
    if (s.V.cols() > 0 || (s.B.real().array() != 0).any()) return std::nullopt;
    RealSubspace real;
    real.X_ = s.X.real(), real.Y_ = s.Y.real(), real.onto_ = s.B.imag(), real.left_onto_ = s.B.imag().transpose();
    real.sign_ = Eigen::VectorXd::Ones(s.X.rows());
    for (Eigen::Index k = 0; k < s.X.rows(); ++k) {
      const auto x = s.X.row(k), y = s.Y.row(k);
      if ((x.imag().array() == 0).all() && (y.imag().array() == 0).all()) continue;
      if ((x.real().array() != 0).any() || (y.real().array() != 0).any()) return std::nullopt;
      real.sign_(k) = -1, real.X_.row(k) = x.imag(), real.Y_.row(k) = -y.imag();
    }
    return real;
  }

  const Eigen::MatrixXd& X() const { return X_; }
  const Eigen::MatrixXd& Y() const { return Y_; }  // Ỹ
  const Eigen::MatrixXd& U() const { return X_; }
  const Eigen::MatrixXd& onto() const { return onto_; }            // Ω
  const Eigen::MatrixXd& left_onto() const { return left_onto_; }  // Ωᵀ
  double sign(Eigen::Index state) const { return sign_(state); }

  template <class Function>
  static Eigen::MatrixXd mapped(Eigen::MatrixXd m, Function&& real_map) {
    return real_map(std::move(m));
  }
  Eigen::MatrixXcd projected(const Eigen::MatrixXd& residual) const {
    return product_of_residual(transposed_product(Y_, residual));
  }
  Eigen::MatrixXcd product_of_residual(const Eigen::MatrixXd& m) const { return std::complex<double>(0, 1) * m; }
  Eigen::MatrixXcd right_residual(const Eigen::MatrixXd& m) const { return with_phases(m, {0, 1}); }
  Eigen::MatrixXcd left_residual(const Eigen::MatrixXd& m) const { return with_phases(m, {0, -1}); }

 private:
  RealSubspace() = default;
  // Of positions; rates have none.
  Eigen::MatrixXcd with_phases(const Eigen::MatrixXd& m, std::complex<double> of_positions) const {
    Eigen::MatrixXcd out = m.cast<std::complex<double>>();
    for (Eigen::Index k = 0; k < m.rows(); ++k) {
      if (sign_(k) > 0) out.row(k) *= of_positions;
    }
    return out;
  }

  Eigen::MatrixXd X_, Y_, onto_, left_onto_;
  Eigen::VectorXd sign_;  // the diagonal of Σ
};

}  // namespace dynalin
