// The perturbation equations of a model at an operating point as one sparse system, nothing eliminated:
//
//     0  = F a + G x + H u          a = (δq, δq′, δq″, δλ, δw, δz′),  x the states,  u the inputs
//     x′ = P a + R x
//
// F is block lower triangular in three levels that are solved one after the other:
//
//     [Φ_q; X] δq  = [0; δx]                                            Φ_q constraint rows, X chosen coordinates
//     [Φ_q; X] δq′ = [−Φ_q′ δq; δx′ − X′ δq]
//     augmented (δq″, δλ, δw, δz′) = −(∂/∂q δq + ∂/∂q′ δq′ + ∂/∂z δz), constraint rows −(a1 δq′ + a0 δq)
//
// and δx″ = X δq″ + 2 X′ δq′ + X″ δq. Velocity rows make the second level larger: fewer rates than coordinates.
// Freedoms without mass leave F without its blocks: their balances stand among the augmented equations, and
// differentiated balances in the places of the rows that the first two levels lack (massless_states.h); F is then
// factored as a whole. The state matrix is A = R − P F⁻¹ G; its eigenvalues are those of the sparse pencil S − λ E of
// all unknowns (a, x).
#pragma once

#include <array>
#include <memory>

#include "analysis/augmented_system.h"
#include "states/massless_states.h"
#include "states/state_choice.h"
#include "system/sparse_lu.h"

namespace dynalin {

struct PerturbedPoint;

// All unknowns of the pencil, (a; x), in columns.
template <class Columns>
Columns all_unknowns(const Columns& a, const Columns& x) {
  Columns all(a.rows() + x.rows(), x.cols());
  all << a, x;
  return all;
}

class PerturbationEquations {
 public:
  // Inputs are cut free of their own equation. The equations of the point must hold all partials, and sizes.
  static Result<PerturbationEquations> make(const System&, const PerturbedPoint&);

  // x′ = A x as it stands.
  static PerturbationEquations of_state_matrix(const Eigen::MatrixXd& A);

  std::int32_t states() const { return states_; }
  std::int32_t unknowns() const { return algebraic_ + states_; }  // of the pencil
  std::int32_t coordinates() const { return n_; }
  // Where parts of a begin.
  std::int32_t rates() const { return n_; }
  std::int32_t accelerations() const { return 2 * n_; }
  std::int32_t augmented() const { return 2 * n_; }
  std::int32_t state_columns() const { return algebraic_; }

  // a of columns (x; u) or x alone.
  Eigen::MatrixXd complete(const Eigen::MatrixXd& states_and_inputs, SparseLu::Refined = SparseLu::Refined::yes) const;
  // The part of a that is motion, δq and δq′ of columns x.
  Eigen::MatrixXcd motions(const Eigen::MatrixXcd& of_states) const;
  // The left counterpart: y_a of the rows y_x of states, with y_aᵀ F + y_xᵀ P = 0.
  Eigen::MatrixXd complete_left(const Eigen::MatrixXd& of_states) const;
  // y with yᵀ F = bᵀ.
  Eigen::MatrixXd solve_transposed(Eigen::MatrixXd b) const;
  // r_x − P F⁻¹ r_a of residuals (r_a; r_x): what they amount to in the equations of states. Of what is rounding itself
  // a few digits are enough.
  Eigen::MatrixXd reduced(Eigen::MatrixXd residuals, SparseLu::Refined = SparseLu::Refined::yes) const;
  // [A B] of the columns a that complete(unit matrix) has given, corrected by a residual in long double: entries are as
  // good as those of the equations, however much cancels in them.
  Eigen::MatrixXd state_matrices(const Eigen::MatrixXd& a) const;
  // Roundings that the entries of A may carry, element by element: Σ|y||r| over the very sums that make them, in so
  // many units of the last place.
  static constexpr double units_of_rounding = 16;
  // What computing the coefficients of the equations has left of them, √Σ(y·(rounding of the coefficient)·a)²: each may
  // be off by all that its longest way makes (roundoff_scales.h), several times what it is in the mean, and they are
  // off to all sides. Where a single one decides, near singular configurations, that is its own.
  struct Roundings {
    Eigen::MatrixXd of_sums, of_coefficients;
  };
  Roundings roundings(const Eigen::MatrixXd& a, const ColumnMatrix& sizes) const;
  // Of the entries of products() where roundings are counted: the sizes of what they are made of (roundoff_scales.h).
  // They are found anew, as large as the equations themselves; selected modes of large models do not ask for them.
  static ColumnMatrix sizes(const System&, const PerturbedPoint&);
  // The same of the coefficients alone, row by row of all equations, for columns (a; x): Σ((rounding)·right)².
  Eigen::MatrixXd rounding_variances(const Eigen::MatrixXcd& right) const;
  Eigen::MatrixXd rounding_variances(const Eigen::MatrixXd& right) const;

  // Columns a that the equations leave open, of freedoms without mass: rates or accelerations that depend on
  // derivatives of inputs or, where the model moves, of coefficients. The states do not depend on them.
  const Eigen::MatrixXd& open_directions() const { return open_; }

  // [F G; P R] without entries that are zero at this point. E has its ones in the last states() places of the diagonal.
  const ColumnMatrix& products() const { return products_; }
  // [G H] in the same way.
  const ColumnMatrix& by_states_and_inputs() const { return on_states_; }

 private:
  class Assembly;  // perturbation_assembly.cpp

  template <class Columns>
  Eigen::MatrixXd variances_of(const Columns& right) const;
  void solve_levels(Eigen::Ref<Eigen::MatrixXd> b, SparseLu::Refined) const;

  std::int32_t n_ = 0, augmented_size_ = 0, algebraic_ = 0, states_ = 0;
  std::array<std::shared_ptr<const SparseLu>, 3> level_;
  std::shared_ptr<const SparseLu> whole_;  // of F, where freedoms without mass couple the levels
  Eigen::MatrixXd open_;
  // Blocks that are multiplied only, without entries that are zero.
  ColumnMatrix rates_on_positions_, augmented_on_positions_, augmented_on_rates_;  // below the diagonal of F
  ColumnMatrix on_states_;                                                         // [G H]
  ColumnMatrix state_rates_on_algebraic_, state_rates_on_states_;                  // P and R
  ColumnMatrix products_;
  // Of its entries, where roundings are counted, in half units of the last place: what computing them has left
  // (roundoff_scales.h).
  ColumnMatrix roundings_;
};

}  // namespace dynalin
