// The modes of a conservative model nearest to a shift: block Krylov subspaces of (K − σM)⁻¹ M in real numbers, with
// vectors that are orthonormal by M, restarted and locked as in krylov_schur.h. Half as many values as states, found
// once for both members of pairs, and left vectors need no search.
#pragma once

#include "selected_modes/eigenvalue_search.h"

namespace dynalin {

class ConservativeSearch : public ModeSearch {
 public:
  ConservativeSearch(std::shared_ptr<const ConservativeModel>, ShiftInverse&, Progress = {});

  // On shifts off the real axis values are those above it.
  void follow_shift() override;
  bool run(Eigen::Index wanted, double radius) override;
  std::vector<std::complex<double>> glance(Eigen::Index values) override;
  Eigen::Index found() const override;
  bool everything() const override { return vectors_.cols() == model_->freedoms(); }
  std::vector<std::complex<double>> values() const override;
  std::vector<std::complex<double>> in_sight() const override;
  double reached() const override { return reached_; }
  Part part(const std::function<bool(std::complex<double>)>& which) override { return part(which, false); }
  // The left vectors of the same values.
  Part left_part(const std::function<bool(std::complex<double>)>& which) { return part(which, true); }

 private:
  bool extend(Eigen::Index wanted, double least, int restarts);
  std::vector<std::complex<double>> values_of(double square) const;
  Part part(const std::function<bool(std::complex<double>)>& which, bool left) const;

  std::shared_ptr<const ConservativeModel> model_;
  ShiftInverse* op_;
  Progress told_;
  Eigen::MatrixXd vectors_;                  // of coordinates, VᵀMV = 1
  std::vector<double> squares_, unsettled_;  // ω², and of what has not converged
  double reached_ = 0;
  unsigned starts_ = 0;
};

// The same values, with left vectors.
class LeftOfConservative : public ModeSearch {
 public:
  explicit LeftOfConservative(ConservativeSearch& right) : right_(right) {}
  void follow_shift() override {}
  bool run(Eigen::Index, double) override { return true; }
  std::vector<std::complex<double>> glance(Eigen::Index) override { return {}; }
  Eigen::Index found() const override { return right_.found(); }
  bool everything() const override { return right_.everything(); }
  std::vector<std::complex<double>> values() const override { return right_.values(); }
  std::vector<std::complex<double>> in_sight() const override { return right_.in_sight(); }
  double reached() const override { return right_.reached(); }
  Part part(const std::function<bool(std::complex<double>)>& which) override { return right_.left_part(which); }

 private:
  ConservativeSearch& right_;
};

}  // namespace dynalin
