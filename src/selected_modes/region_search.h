// All eigenvalues of a region, or the nearest ones and the disc around them: Krylov iterations from shifts near them,
// and from other start vectors, until they are as many as an independent count says.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "perturbation/perturbation.h"
#include "selected_modes/conservative_search.h"
#include "selected_modes/eigenvalue_search.h"
#include "selected_modes/inertia_count.h"
#include "selected_modes/mode_region.h"
#include "selected_modes/near_zero.h"
#include "selected_modes/selected_modes.h"

namespace dynalin {

// Of looking for what is missing, on either side.
inline constexpr int most_search_rounds = 24;
// Of models with no more states the full solution is soon as cheap.
inline constexpr Eigen::Index states_of_middling_models = 1500;

class RegionSearch {
 public:
  RegionSearch(const PerturbationEquations&, ShiftInverse&, std::shared_ptr<const ConservativeModel>, Progress = {});

  // What is zero, which comes first; false where no shift near it could be factored.
  bool find_zeros(const System&, const Perturbation&);
  // False where an iteration does not converge; the outcome says how many were found and counted.
  bool find(const ModeSelection&);
  // The nearest to the origin are looked for from this shift on the real axis, and not from where zeros were found.
  void start_from(double shift) { from_ = shift; }
  // So many that the full solution costs less.
  bool too_many() const;

  // The region; what was counted is all in another one around it, between whose border and the eigenvalues there is a
  // gap.
  const ModeRegion& region() const { return region_; }
  const ModeRegion& counted_region() const { return counted_region_; }
  Eigen::Index count_in(const ModeRegion&) const;
  SelectedModes& outcome() { return selected_; }

  ModeSearch& right() { return *right_; }
  ModeSearch& left() { return *left_; }
  const std::vector<std::complex<double>>& shifts() const { return shifts_; }  // where right vectors were found
  const NearZero& zero() const { return zero_; }
  bool all_zeros() const { return all_zeros_; }
  double near() const;  // the modulus of what may be a zero, as it comes out from the last shift
  // Undamped modes of the region are so far below the shifts that 1/(ω² − σ) has no digits of them: what was found in
  // their place is a mixture of them, and of zeros.
  bool reaches_too_far_down() const { return too_far_down_; }

 private:
  // How many factorizations the count around one border may take, and around how many borders it may come to nothing:
  // then it is not known.
  struct CountingLimits {
    std::size_t factorizations;
    int borders;
  };
  static CountingLimits counting_limits(Eigen::Index states);

  void start_anew();
  std::complex<double> shift_at(double height) const;
  std::vector<std::complex<double>> values() const;
  KnownModes known() const { return KnownModes(values(), op_.shift()); }
  bool both_members() const;
  std::vector<std::complex<double>> places() const;
  ModeRegion countable_region(int attempt) const;
  std::optional<Eigen::Index> counted_by_inertia();
  std::optional<Eigen::Index> missing_by_winding();
  bool count();
  bool move_to(std::complex<double> shift);
  bool find_nearest(const NearestModes&);
  double reach_of_region() const;
  bool look_for_more(double radius);
  bool find_band(const ModesInBand&);
  bool has_modes_too_far_down();

  const PerturbationEquations& equations_;
  const std::shared_ptr<const ConservativeModel> conservative_;
  ShiftInverse& op_;
  const Progress progress_;
  std::unique_ptr<ModeSearch> right_, left_;
  std::vector<std::complex<double>> shifts_;
  NearZero zero_;
  ModeRegion region_, counted_region_;
  std::unique_ptr<InertiaCount> by_inertia_;  // while it is counted
  CountingLimits counting_;                   // what is left of them
  Eigen::Index missing_ = 0;
  bool all_zeros_ = true, too_far_down_ = false;
  double near_ = 0, from_ = 0;
  SelectedModes selected_;
};

}  // namespace dynalin
