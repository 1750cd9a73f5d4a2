#include "linear/selected_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "base/blas_threads.h"
#include "base/cycle.h"
#include "base/parallel.h"
#include "linear/backward_errors.h"
#include "linear/conservative_search.h"
#include "linear/inertia_count.h"
#include "linear/mode_region.h"
#include "linear/near_zero.h"
#include "linear/perturbed_point.h"
#include "linear/selected_pairs.h"
#include "linear/selection_doubts.h"
#include "linear/zero_search.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using Side = EigenvalueSearch::Side;

constexpr double beside_axis = 0.0137;  // shifts keep off the axis that undamped modes are on
constexpr int most_rounds = 24;
// How many factorizations the count around one border may take, and around how many borders it may come to nothing:
// then it is not known. Of middling models the full solution is soon as cheap, of small ones factors cost nothing.
struct CountingLimits {
  std::size_t factorizations;
  int borders;
};
constexpr CountingLimits counting_of_large = {600, 5}, counting_of_middling = {150, 2}, counting_of_small = {1500, 5};
constexpr Index small = 400, middling = 1500;  // states
// Of the state matrix, what A x − λ x may be of it: beyond the first a vector is not that of the mode at all, as where
// zeros in long chains are amplified into it, beyond the second the full solution has better ones.
constexpr double no_vector = 1e-9, inexact_vector = 1e-12;

double largest_backward_error(const EigenSolution& solution) {
  double largest = 0;
  for (const EigenMode& m : solution.modes) {
    if (!m.structural_zero && !(m.backward_error <= largest)) largest = m.backward_error;
  }
  return largest;
}

Failure no_convergence(std::string what) { return {"eigensolution", std::move(what), {}, "no-eigensolution"}; }

std::vector<Complex> joined(std::vector<Complex> a, const std::vector<Complex>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class Solution {
 public:
  Solution(const System& system, const Perturbation& perturbation, const ModeSelection& wanted)
      : system_(system),
        perturbation_(perturbation),
        equations_(*perturbation.equations),
        wanted_(wanted),
        conservative_(ConservativeModel::make(perturbation)),
        op_(equations_, conservative_) {
    start_anew();
    zero_.directions.resize(op_.states(), 0);
    counting_ = op_.states() <= small      ? counting_of_small
                : op_.states() <= middling ? counting_of_middling
                                           : counting_of_large;
  }

  Result<EigenSolution> run(Vectors vectors) {
    selected_.wanted = wanted_;
    std::optional<ZerosFound> zeros;
    in_parallel(conservative_ ? 2 : 1, [&](std::size_t task) {
      if (task == 0) {
        zeros = zeros_near(system_, perturbation_, op_, *right_);
      } else {
        by_inertia_ = std::make_unique<InertiaCount>(conservative_);
      }
    });
    if (!zeros) return tl::unexpected(no_convergence("no shift near zero could be factored"));
    zero_ = std::move(zeros->zero), near_ = zeros->near, all_zeros_ = zeros->all;
    if (too_many()) return tl::unexpected(no_convergence("too many zeros for the Krylov iteration"));
    Result<EigenSolution> found = find(wanted_, vectors);
    const auto* nearest = std::get_if<NearestModes>(&wanted_);
    if (!nearest || !found || found->selected->complete) return found;
    // Slow pairs that rounding has scattered may have been taken for two real values each: so many more make up for it.
    const std::size_t listed = modes_in(*found);
    if (listed >= nearest->count || right_->everything()) return found;
    Result<EigenSolution> more = find(NearestModes{2 * nearest->count - listed, nearest->frequency}, vectors);
    return more && modes_in(*more) > listed ? more : found;
  }

 private:
  Result<EigenSolution> find(const ModeSelection& selection, Vectors vectors) {
    selected_.doubt.clear();
    const auto* nearest = std::get_if<NearestModes>(&selection);
    const bool found = nearest ? find_nearest(*nearest) : find_band(std::get<ModesInBand>(selection));
    if (too_many()) return tl::unexpected(no_convergence("too many modes for the Krylov iteration"));
    if (!found) return tl::unexpected(no_convergence("the Krylov iteration did not converge"));
    by_inertia_.reset();
    auto bounded = bound();
    if (bounded) return solution(*bounded, vectors);
    // Right vectors alone: what there is, and that it may be anything.
    selected_.complete = false, selected_.doubt = "left and right vectors do not agree";
    const double zero = zero_.count() > 0 ? near_ : -1;
    const ModeSearch::Part right = right_->part([&](Complex v) { return region_.has(v) && std::abs(v) > zero; });
    BoundedPairs found_only = pairs_without_bounds(op_, right.basis, right.matrix);
    return solution(found_only, vectors);
  }
  void start_anew() {
    if (conservative_) {
      auto right = std::make_unique<ConservativeSearch>(conservative_, op_);
      left_ = std::make_unique<LeftOfConservative>(*right);
      right_ = std::move(right);
    } else {
      right_ = std::make_unique<EigenvalueSearch>(op_, Side::right);
      left_ = std::make_unique<EigenvalueSearch>(op_, Side::left);
    }
  }
  bool too_many() const { return costs_more_than_all(*right_, op_.states()); }
  // Near the imaginary axis at that height, where no undamped mode is; symmetric factors exist on it alone.
  Complex shift_at(double height) const {
    return conservative_ ? Complex(0, (1 + beside_axis) * height) : Complex(beside_axis * height, height);
  }

  // Structural zeros are exactly that.
  std::vector<Complex> values() const {
    std::vector<Complex> all = right_->values();
    std::stable_sort(all.begin(), all.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
    // What is not real by no more than values are computed to is.
    for (Complex& v : all) {
      if (std::abs(v.imag()) <= 1e-10 * std::abs(v - op_.shift())) v.imag(0);
    }
    // So small they are zeros of long chains, or next to it, scattered by rounding.
    const double near = std::max(near_, 1e-6 * std::abs(op_.shift())), scattered = 2e-3 * near;
    for (Complex& v : all) {
      if (std::abs(v) <= scattered) v.imag(0);
    }
    for (std::size_t k = 0; k < all.size() && k < static_cast<std::size_t>(zero_.count()); ++k) {
      if (std::abs(all[k]) <= near) all[k] = 0;
    }
    return all;
  }
  KnownModes known() const { return KnownModes(values()); }
  // From shifts on the real axis both members of every pair are found.
  bool both_members() const { return region_.centre.imag() == 0 && region_.low == 0; }
  Index count_in(const ModeRegion& region) const {
    if (!both_members()) return region.count(known());
    const auto all = values();
    return static_cast<Index>(std::count_if(all.begin(), all.end(), [&](Complex v) { return region.has(v); }));
  }
  // Also what is in sight: no matter for the count, it only makes the determinant smoother.
  std::vector<Complex> places() const { return joined(known().all(), KnownModes(right_->in_sight()).all()); }

  ModeRegion countable_region(int attempt) const {
    return countable(region_, KnownModes(joined(values(), right_->in_sight())), attempt);
  }
  std::optional<Index> counted_by_inertia() {
    counted_region_ = countable_region(0);
    return by_inertia_->eigenvalues_inside(counted_region_);
  }
  // How many there are more than are known: by the winding number around one border, and around others where that says
  // anything else than 0. Nothing if they contradict each other.
  std::optional<Index> missing_by_winding() {
    const Complex shift = op_.shift();
    std::map<Index, int> said;
    std::optional<Index> missing;
    for (int attempt = 0; attempt < 5 && !missing && counting_.borders > 0; ++attempt) {
      counted_region_ = countable_region(attempt);
      // Of a band that is off the real axis the border is around its upper half alone.
      const bool half = !counted_region_.is_disc && counted_region_.low > 0;
      const auto counted = eigenvalues_inside(
          op_.factors(), counted_region_.border(), places(),
          [&](Complex v) { return counted_region_.has(v) && (!half || v.imag() > 0); }, counting_.factorizations);
      if (!counted) {
        --counting_.borders;
        continue;
      }
      const Index more = half ? 2 * *counted - count_in(counted_region_) : *counted - count_in(counted_region_);
      if (++said[more] == 2 || (more == 0 && said.size() == 1)) missing = more;
    }
    op_.move_to(shift);
    return missing;
  }
  // The modes in region_ and how many there ought to be; the search goes on where they differ.
  bool count() {
    constexpr Index few_unknowns = 10000;  // a count costs nothing there, and is a second opinion
    if (right_->everything() && equations_.unknowns() > few_unknowns) {
      // As many as there are states: factors have nothing to add.
      counted_region_ = countable_region(0);
      selected_.by = CountedBy::full_solution;
      selected_.found = selected_.counted = static_cast<std::size_t>(count_in(region_));
      missing_ = 0;
      return selected_.complete = true;
    }
    bool agreed = false;
    if (!by_inertia_ && conservative_) by_inertia_ = std::make_unique<InertiaCount>(conservative_);
    const std::optional<Index> counted = by_inertia_ ? counted_by_inertia() : std::nullopt;
    const std::optional<Index> missing =
        counted ? std::optional(*counted - count_in(counted_region_)) : missing_by_winding();
    if (missing) {
      const Index inside = count_in(region_);
      selected_.by = counted ? CountedBy::inertia : CountedBy::winding_number;
      selected_.found = static_cast<std::size_t>(inside);
      selected_.counted = static_cast<std::size_t>(std::max<Index>(0, inside + *missing));
      missing_ = *missing;
      agreed = missing_ == 0;
    } else {
      selected_.by = CountedBy::nothing;
    }
    selected_.complete = agreed;
    return agreed;
  }

  bool find_nearest(const NearestModes& nearest) {
    if (nearest.frequency > 0) {
      const double modulus = cycle * nearest.frequency;
      start_anew();
      if (!op_.move_to(shift_at(modulus))) return false;
      op_.find_units();
    }
    const Index per_mode = nearest.frequency > 0 ? 1 : 2;
    Index target = static_cast<Index>(std::min(nearest.count, static_cast<std::size_t>(op_.states()))) * per_mode + 4;
    if (nearest.frequency == 0) target += zero_.count();
    constexpr double beyond_border = 1.3;
    int fruitless = 0, wider = 0;
    for (int round = 0; round < most_rounds && !too_many(); ++round) {
      const Index before = right_->found();
      if (right_->found() < target && !right_->everything()) right_->run(target - right_->found(), 0);
      const bool progress = right_->found() > before;
      const KnownModes modes = known();
      const auto zeros = std::count(modes.upper().begin(), modes.upper().end(), Complex(0));
      const auto disc = disc_of(nearest, modes, std::min<Index>(zero_.count(), zeros), right_->everything());
      if (!disc) {
        if (!progress && ++fruitless > 2) return false;
        target = std::max(target, right_->found()) + 6;
        continue;
      }
      region_ = *disc;
      if (nearest.count == 0 || modes.upper().empty()) {
        selected_.complete = true;
        return true;
      }
      // Inertia counts whatever was found: where it agrees, there is nothing to look for.
      if (conservative_ && count()) break;
      // From other start vectors as far as the border, until there is nothing more.
      if (look_for_more(reach_of_region())) continue;
      if ((!conservative_ && count()) || right_->everything()) break;
      // What is next to the border makes it countable, and may be nearer than some of what was found: a Krylov
      // iteration takes the outermost first.
      if (selected_.by == CountedBy::nothing) {
        const Index before_more = right_->found();
        right_->run(std::max<Index>(target / 2, 8), beyond_border * reach_of_region());
        if (right_->found() > before_more && ++wider < 4) continue;
      }
      if (++fruitless > 2) break;
    }
    selected_.radius_hz = region_.radius / cycle;
    return true;
  }
  // How far from the shift the disc reaches.
  double reach_of_region() const { return region_.radius + std::abs(op_.shift() - region_.centre); }
  // Whether another start vector has found something in the region.
  bool look_for_more(double radius) {
    if (right_->everything()) return false;
    const Index before = right_->found(), inside = count_in(region_);
    right_->run(std::max<Index>(2, missing_ + 1), radius);
    return right_->found() > before && count_in(region_) > inside;
  }

  bool find_band(const ModesInBand& band) {
    region_ = region_of(band);
    if (region_.high == 0) return find_nearest({0, 0});  // structural zeros alone
    start_anew();
    constexpr Index at_a_time = 30, enough_from_a_shift = 90, most_from_a_shift = 240;
    // So much farther than the heights of its part: what is next to the band, where it is counted, is then known too.
    constexpr double beyond = 1.3;
    std::size_t inside_before = 0;
    // The middle of the band, then of its halves, quarters …; on the real axis, for all from there.
    for (int level = 0; level < 6 && !too_many(); ++level) {
      const int parts = both_members() ? 1 : 1 << level;
      bool covered = true;
      for (int part = 0; part < parts; ++part) {
        const double half = 0.5 * (region_.high - region_.low) / parts;
        const double middle = region_.low + (2 * part + 1) * half;
        const Complex shift = both_members() ? Complex(beside_axis * region_.high) : shift_at(middle);
        if (!op_.move_to(shift)) continue;
        if (level == 0) op_.find_units();
        right_->follow_shift();
        shifts_.push_back(shift);
        const double height = both_members() ? region_.high : half,
                     all = std::hypot(region_.right + shift.real(), height);
        bool reached = false;
        for (Index from_here = 0; from_here < most_from_a_shift && !reached && !right_->everything() && !too_many();) {
          const Index before = right_->found();
          right_->run(at_a_time, all);
          from_here += right_->found() - before;
          const bool far_enough =
              right_->reached() >= beyond * height && (level > 0 || from_here >= enough_from_a_shift);
          reached = right_->found() == before || right_->reached() >= all || far_enough;
        }
        covered = covered && (reached || right_->everything());
      }
      if (shifts_.empty() || !covered) continue;
      for (int round = 0; round < most_rounds && !too_many(); ++round) {
        if (!look_for_more(std::hypot(region_.right, 0.5 * (region_.high - region_.low)))) break;
      }
      if (count() || right_->everything()) return true;
      // It cannot be counted, and smaller parts have brought nothing: nor will others.
      const auto inside = static_cast<std::size_t>(count_in(region_));
      if (selected_.by == CountedBy::nothing && level > 0 && inside == inside_before) break;
      inside_before = inside;
    }
    return !shifts_.empty();
  }

  // Left vectors of the same eigenvalues, and what both say.
  std::optional<BoundedPairs> bound() {
    // All of a region between whose border and them there is a gap.
    const bool upper_half = region_.low > 0;
    const auto in_part = [&](Complex v) { return counted_region_.has(v) && (!upper_half || v.imag() > 0); };
    if (counted_region_.is_disc && counted_region_.radius == 0) counted_region_ = region_;
    const auto inside = [&](const ModeSearch& search) {
      const auto values = search.values();
      return static_cast<Index>(std::count_if(values.begin(), values.end(), in_part));
    };
    if (shifts_.empty()) shifts_.push_back(op_.shift());
    for (int round = 0, fruitless = 0; round < most_rounds && fruitless < 4; ++round) {
      const Complex shift = shifts_[static_cast<std::size_t>(round) % shifts_.size()];
      if (shift != op_.shift() && !op_.move_to(shift)) continue;
      right_->follow_shift(), left_->follow_shift();
      const Index of_right = inside(*right_), of_left = inside(*left_);
      if (of_left == of_right) break;
      ModeSearch& behind = of_left < of_right ? *left_ : *right_;
      const Index before = behind.found();
      double radius = 0;
      for (const Complex& v : (of_left < of_right ? right_ : left_)->values()) {
        if (in_part(v)) radius = std::max(radius, std::abs(v - op_.shift()));
      }
      behind.run(std::abs(of_right - of_left) + 2, 1.01 * radius);
      if (behind.found() == before) ++fruitless;
    }
    if (inside(*left_) != inside(*right_)) return std::nullopt;
    selected_.found = static_cast<std::size_t>(count_in(region_));

    // Of undamped pairs one member says all: the other is no nearer than twice its modulus.
    const auto is_mirror = [&](Complex v) { return conservative_ && v.imag() < 0 && -v.imag() > near_; };
    const auto chosen = [&](Complex v) { return in_part(v) && !is_mirror(v); };
    ModeSearch::Part right, left;
    in_parallel(2, [&](std::size_t side) {
      if (side == 0) {
        right = right_->part(chosen);
      } else {
        left = left_->part(chosen);
      }
    });
    double distance = std::numeric_limits<double>::infinity();
    for (const Complex& v : right_->values()) {
      if (!in_part(v)) continue;
      distance = std::min(distance, std::max(counted_region_.distance_to_border(v), 1e-300));
      if (is_mirror(v)) distance = std::min(distance, 2 * std::abs(v));
    }
    const NearZero zero = counted_region_.has(0) ? zero_ : NearZero{Matrix(op_.states(), 0), Matrix(0, 0)};
    const bool both = !conservative_ && counted_region_.centre.imag() == 0 && !upper_half;
    return bounded_pairs(equations_, op_,
                         {std::move(right.basis), std::move(right.matrix), std::move(left.basis), both}, zero,
                         distance);
  }

  EigenSolution solution(BoundedPairs& found, Vectors vectors) {
    const std::vector<Complex> computed = found.pairs.values;
    clear_rounding(found.pairs, found.trust);
    clear_phases(found.pairs, found.trust);
    EigenSolution out;
    out.time = perturbation_.model.time;
    out.kinematic_states = perturbation_.kinematic_states;
    out.differential_states = perturbation_.differential_states;
    out.states = perturbation_.model.states;
    const EigenPairs& pairs = found.pairs;
    std::vector<std::size_t> order = printed_order(pairs.values);
    std::erase_if(order, [&](std::size_t k) {
      return !region_.has(pairs.values[k]) && std::abs(pairs.values[k] - region_.centre) > found.trust[k].bound;
    });
    const Index z = zero_.count();
    out.vectors.resize(op_.states(), z + static_cast<Index>(order.size()));
    const double norm = norm_of_state_matrix(equations_);
    const auto backward_error = [&](double residual) { return norm > 0 ? residual / norm : 0; };
    const Matrix zeros = z > 0 ? zero_.vectors() : Matrix(op_.states(), 0);
    out.vectors.leftCols(z) = zeros.cast<Complex>();
    const Eigen::VectorXd of_zeros = sizes_of_images(equations_, zeros);
    for (Index k = 0; k < z; ++k) {
      EigenMode mode;
      mode.backward_error = backward_error(of_zeros(k));
      mode.is_real = mode.structural_zero = true;
      mode.condition = zero_.defective() ? std::numeric_limits<double>::infinity() : 1.0;
      out.modes.push_back(std::move(mode));
    }
    for (const std::size_t k : order) {
      EigenMode mode;
      mode.eigenvalue_hz = pairs.values[k] / cycle;
      mode.is_real = pairs.values[k].imag() == 0;
      const auto at = static_cast<Index>(k);
      out.vectors.col(static_cast<Index>(out.modes.size())) = pairs.right.col(at);
      mode.condition = 1 / std::abs(pairs.left.col(at).dot(pairs.right.col(at)));
      mode.backward_error = backward_error(found.residual[k] + std::abs(pairs.values[k] - computed[k]));
      mode.error_bound_hz = found.trust[k].bound / cycle;
      mode.refined = found.trust[k].refined;
      mode.cluster_size = static_cast<std::size_t>(found.trust[k].cluster);
      out.modes.push_back(std::move(mode));
    }
    if (selected_.complete) {
      const bool everything = right_->everything() && count_in(region_) == right_->found();
      selected_.doubt = doubt_of(out.modes, wanted_, {region_, op_.states(), all_zeros_, everything});
      const double error = largest_backward_error(out);
      if (selected_.doubt.empty() && !(error <= no_vector))
        selected_.doubt = fmt::format("their vectors leave {:.1e} of the state matrix", error);
      selected_.complete = selected_.doubt.empty();
    }
    out.selected = selected_;
    if (vectors == Vectors::none) out.vectors.resize(0, 0);
    return selected_.complete ? without_farther_ones(std::move(out)) : out;
  }

  const System& system_;
  const Perturbation& perturbation_;
  const PerturbationEquations& equations_;
  const ModeSelection wanted_;
  const std::shared_ptr<const ConservativeModel> conservative_;
  ShiftInverse op_;
  std::unique_ptr<ModeSearch> right_, left_;
  std::vector<Complex> shifts_;  // where right vectors were found
  NearZero zero_;
  ModeRegion region_, counted_region_;
  std::unique_ptr<InertiaCount> by_inertia_;  // while it is counted
  CountingLimits counting_;                   // what is left of them
  Index missing_ = 0;
  bool all_zeros_ = true;
  double near_ = 0;  // the modulus of what may be a zero
  SelectedModes selected_;
};

}  // namespace

Result<EigenSolution> eigensolve_selected(const System& system, const Perturbation& perturbation,
                                          const ModeSelection& wanted, Vectors vectors) {
  const PerturbedPoint& at = *perturbation.at;
  const auto states = static_cast<Index>(perturbation.model.states.size());
  const auto from_all = [&]() -> Result<EigenSolution> {
    auto linear = reduce(system, perturbation);
    if (!linear) return tl::unexpected(linear.error());
    auto all = eigensolve(*linear, vectors);
    if (!all) return all;
    return selected_of(*all, wanted);
  };
  // No sparse equations have a block missing that the original implementation leaves out.
  const bool block_missing = at.without_damping && at.without_rate_coupling && perturbation.differential_states > 0;
  if (block_missing || states == 0) return from_all();
  auto solution = [&] {
    // Blocks are narrow: its threads would cost more than they give, and round as many as there are.
    const OneBlasThread alone;
    return Solution(system, perturbation, wanted).run(vectors);
  }();
  const bool settled = solution && solution->selected->complete;
  if (!settled && states <= most_for_full_solution) return from_all();
  if (settled && states <= middling && !(largest_backward_error(*solution) <= inexact_vector)) {
    if (auto all = from_all(); all && largest_backward_error(*all) < largest_backward_error(*solution)) return all;
  }
  return solution;
}

}  // namespace dynalin
