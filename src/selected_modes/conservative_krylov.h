// The block Krylov space of (K − σM)⁻¹ M beside columns that are locked, with vectors V that are orthonormal by M:
//
//     (K − σM)⁻¹ M V = V H        H symmetric but for rounding, and for the rows of the last block beyond it
//
// Those rows are what is left over beside the space: residuals of its eigenvalues.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "distributed/krylov_progress.h"
#include "selected_modes/conservative_model.h"

namespace dynalin {

class ConservativeKrylov {
 public:
  // Eigenvalues θ = 1/(ω² − σ) of the space, the largest first, their vectors in it, and what these leave over.
  struct Ritz {
    Eigen::VectorXd theta;
    Eigen::MatrixXd vectors, residuals;

    Eigen::Index count() const { return theta.size(); }
    KrylovProgress::Value value(Eigen::Index k) const {
      return {std::abs(theta(k)), residuals.rows() > 0 ? residuals.col(k).norm() : 0.0};
    }
    // So many of the first are found.
    Eigen::Index found() const;
  };

  // At most so many vectors beside the block; `starts` counts the start vectors that were taken.
  ConservativeKrylov(const ConservativeFactors&, const Eigen::MatrixXd& locked, Eigen::Index most, unsigned& starts);

  // Takes a block of start vectors; false if there is none in what is left of the space of all motions.
  bool start();
  // Takes in the images of all vectors, and theirs; false if one of them is not finite.
  bool fill();
  Ritz ritz() const;
  // Goes on from the space of the first `kept` vectors of `ritz`.
  void restart(const Ritz&, Eigen::Index kept);
  // The locked columns and the first `found` vectors of `ritz` behind them. Nothing can be done with the space then.
  Eigen::MatrixXd take(const Ritz&, Eigen::Index found);

 private:
  bool start_at(Eigen::Index column);
  Eigen::MatrixXd image(const Eigen::MatrixXd& v) const { return op_.solve(model_.forces(v)); }
  double without(Eigen::Ref<Eigen::VectorXd> w, Eigen::Index known, Eigen::Index columns,
                 Eigen::Ref<Eigen::VectorXd> share, double size, double before) const;

  const ConservativeFactors& op_;
  const ConservativeModel& model_;
  const Eigen::Index locked_, left_, most_;
  unsigned& starts_;
  Eigen::MatrixXd V_, H_;
  // Columns of V beyond the locked ones: `processed` with their images in H, then those of the block.
  Eigen::Index size_ = 0, processed_ = 0;
};

}  // namespace dynalin
