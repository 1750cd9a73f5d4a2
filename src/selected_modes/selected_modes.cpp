#include "selected_modes/selected_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/blas_threads.h"
#include "base/cycle.h"
#include "base/parallel.h"
#include "perturbation/perturbed_point.h"
#include "selected_modes/backward_errors.h"
#include "selected_modes/region_search.h"
#include "selected_modes/selected_pairs.h"
#include "selected_modes/selection_doubts.h"
#include "selected_modes/selection_of_modes.h"
#include "selected_modes/zero_search.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;

// Of the state matrix, what A x − λ x may be of it: beyond the first a vector is not that of the mode at all, as where
// zeros in long chains are amplified into it, beyond the second the full solution has better ones.
constexpr double no_vector = 1e-9, inexact_vector = 1e-12;

// And of its modulus, what a value may be off by before that of the full solution is asked for.
constexpr double inexact_value = 1e-8;

double largest_backward_error(const EigenSolution& solution) {
  double largest = 0;
  for (const EigenMode& m : solution.modes) {
    if (!m.structural_zero && !(m.backward_error <= largest)) largest = m.backward_error;
  }
  return largest;
}

double largest_relative_bound(const EigenSolution& solution) {
  double largest = 0;
  for (const EigenMode& m : solution.modes) {
    const double of_modulus = m.error_bound_hz / std::abs(m.eigenvalue_hz);
    if (!m.structural_zero && !(of_modulus <= largest)) largest = of_modulus;
  }
  return largest;
}

Failure no_convergence(std::string what) { return {"eigensolution", std::move(what), {}, "no-eigensolution"}; }

class Solution {
 public:
  Solution(const System& system, const Perturbation& perturbation, const ModeSelection& wanted,
           const Progress& progress)
      : system_(system),
        perturbation_(perturbation),
        equations_(*perturbation.equations),
        wanted_(wanted),
        progress_(progress),
        conservative_(ConservativeModel::make(perturbation)),
        op_(equations_, conservative_),
        search_(equations_, op_, conservative_, progress) {}

  Result<EigenSolution> run(Vectors vectors) {
    selected_.wanted = wanted_;
    if (!search_.find_zeros(system_, perturbation_))
      return tl::unexpected(no_convergence("no shift near zero could be factored"));
    if (search_.too_many()) return tl::unexpected(no_convergence("too many zeros for the Krylov iteration"));
    Result<EigenSolution> found = find(wanted_, vectors);
    if (found && may_be_better_from_farther(*found)) {
      search_.start_from(farther_shift(*found));
      Result<EigenSolution> again = find(wanted_, vectors);
      const bool better = again && again->selected->complete && modes_in(*again) == modes_in(*found) &&
                          largest_relative_bound(*again) < largest_relative_bound(*found);
      return better ? std::move(again) : std::move(found);
    }
    const auto* nearest = std::get_if<NearestModes>(&wanted_);
    if (!nearest || !found || found->selected->complete) return found;
    // Slow pairs that rounding has scattered may have been taken for two real values each: so many more make up for it.
    const std::size_t listed = modes_in(*found);
    if (listed >= nearest->count || search_.right().everything()) return found;
    Result<EigenSolution> more = find(NearestModes{2 * nearest->count - listed, nearest->frequency}, vectors);
    return more && modes_in(*more) > listed ? more : found;
  }

 private:
  // From a shift that is small against the modes, zeros in chains are 1/σ² and leave these few digits.
  bool may_be_better_from_farther(const EigenSolution& found) const {
    const auto* nearest = std::get_if<NearestModes>(&wanted_);
    return nearest && nearest->frequency == 0 && found.selected->complete && search_.zero().count() > 0 &&
           modes_in(found) > 0 && !(largest_relative_bound(found) <= inexact_value) &&
           farther_shift(found) > 3 * std::abs(op_.shift());
  }
  static double farther_shift(const EigenSolution& found) {
    constexpr double of_the_nearest = 0.3137;
    double least = std::numeric_limits<double>::infinity();
    for (const EigenMode& m : found.modes) {
      if (!m.structural_zero) least = std::min(least, cycle * std::abs(m.eigenvalue_hz));
    }
    return of_the_nearest * least;
  }

  Result<EigenSolution> find(const ModeSelection& selection, Vectors vectors) {
    const bool found = search_.find(selection);
    if (search_.too_many()) return tl::unexpected(no_convergence("too many modes for the Krylov iteration"));
    if (!found) return tl::unexpected(no_convergence("the Krylov iteration did not converge"));
    auto bounded = bound();
    if (bounded) return solution(*bounded, vectors);
    // Right vectors alone: what there is, and that it may be anything.
    selected_.complete = false, selected_.doubt = "left and right vectors do not agree";
    const double zero = search_.zero().count() > 0 ? search_.near() : -1;
    const ModeSearch::Part right =
        search_.right().part([&](Complex v) { return search_.region().has(v) && std::abs(v) > zero; });
    BoundedPairs found_only = pairs_without_bounds(op_, right.basis, right.matrix);
    return solution(found_only, vectors);
  }
  // Left vectors of the same eigenvalues, and what both say.
  std::optional<BoundedPairs> bound() {
    progress_.tell("left vectors");
    const ModeRegion& region = search_.region();
    // Where nothing was counted, the region itself.
    const bool none = search_.counted_region().is_disc && search_.counted_region().radius == 0;
    const ModeRegion& counted = none ? region : search_.counted_region();
    ModeSearch &right_side = search_.right(), &left_side = search_.left();
    // All of a region between whose border and them there is a gap.
    const bool upper_half = region.low > 0;
    const auto in_part = [&](Complex v) { return counted.has(v) && (!upper_half || v.imag() > 0); };
    const auto inside = [&](const ModeSearch& search) {
      const auto values = search.values();
      return static_cast<Index>(std::count_if(values.begin(), values.end(), in_part));
    };
    const std::vector<Complex> shifts = search_.shifts().empty() ? std::vector{op_.shift()} : search_.shifts();
    for (int round = 0, fruitless = 0; round < most_search_rounds && fruitless < 4; ++round) {
      const Complex shift = shifts[static_cast<std::size_t>(round) % shifts.size()];
      if (shift != op_.shift() && !op_.move_to(shift)) continue;
      right_side.follow_shift(), left_side.follow_shift();
      const Index of_right = inside(right_side), of_left = inside(left_side);
      if (of_left == of_right) break;
      ModeSearch& behind = of_left < of_right ? left_side : right_side;
      const Index before = behind.found();
      double radius = 0;
      for (const Complex& v : (of_left < of_right ? right_side : left_side).values()) {
        if (in_part(v)) radius = std::max(radius, std::abs(v - op_.shift()));
      }
      behind.run(std::abs(of_right - of_left) + 2, 1.01 * radius);
      if (behind.found() == before) ++fruitless;
    }
    if (inside(left_side) != inside(right_side)) return std::nullopt;
    selected_.found = static_cast<std::size_t>(search_.count_in(region));

    progress_.tell("bounds");
    // Of undamped pairs one member says all: the other is no nearer than twice its modulus.
    const auto is_mirror = [&](Complex v) { return conservative_ && v.imag() < 0 && -v.imag() > search_.near(); };
    const auto chosen = [&](Complex v) { return in_part(v) && !is_mirror(v); };
    ModeSearch::Part right, left;
    in_parallel(2, [&](std::size_t side) {
      if (side == 0) {
        right = right_side.part(chosen);
      } else {
        left = left_side.part(chosen);
      }
    });
    double distance = std::numeric_limits<double>::infinity();
    for (const Complex& v : right_side.values()) {
      if (!in_part(v)) continue;
      distance = std::min(distance, std::max(counted.distance_to_border(v), 1e-300));
      // The other member is among the others, whether or not the search has seen it.
      if (conservative_ && std::abs(v.imag()) > search_.near()) distance = std::min(distance, 2 * std::abs(v.imag()));
    }
    const NearZero zero = counted.has(0) ? search_.zero() : NearZero{Matrix(op_.states(), 0), Matrix(0, 0)};
    const bool both = !conservative_ && counted.centre.imag() == 0 && !upper_half;
    auto bounded =
        bounded_pairs(equations_, op_, {std::move(right.basis), std::move(right.matrix), std::move(left.basis), both},
                      zero, distance);
    // The bounds hold as far from what was found as that is from all others.
    const std::vector<Complex> seen = right_side.values();
    for (std::size_t k = 0; bounded && k < bounded->pairs.values.size(); ++k) {
      const Complex value = bounded->pairs.values[k];
      double moved = std::numeric_limits<double>::infinity();
      for (const Complex& v : seen) {
        if (in_part(v)) moved = std::min({moved, std::abs(v - value), std::abs(std::conj(v) - value)});
      }
      if (!(moved + bounded->trust[k].bound <= distance)) return std::nullopt;
    }
    return bounded;
  }

  EigenSolution solution(BoundedPairs& found, Vectors vectors) {
    const std::vector<Complex> computed = found.pairs.values;
    clear_rounding(found.pairs, found.trust);
    clear_phases(found.pairs, found.trust);
    EigenSolution out;
    out.time = perturbation_.model.time, out.of_equations = perturbation_.model.of_equations;
    out.kinematic_states = perturbation_.kinematic_states;
    out.differential_states = perturbation_.differential_states;
    out.states = perturbation_.model.states;
    const EigenPairs& pairs = found.pairs;
    std::vector<std::size_t> order = printed_order(pairs.values);
    const ModeRegion& region = search_.region();
    const auto* band = std::get_if<ModesInBand>(&wanted_);
    bool may_be_beyond = false;
    std::erase_if(order, [&](std::size_t k) {
      const Complex v = pairs.values[k];
      if (!band) return !region.has(v) && std::abs(v - region.centre) > found.trust[k].bound;
      if (belongs_to(*band, v / cycle, found.trust[k].bound / cycle)) return false;
      may_be_beyond = may_be_beyond || may_be_beyond_band(*band, {mode_of(pairs, found.trust[k], k)});
      // The search has counted what is next to a border as inside.
      const std::size_t members = v.imag() == 0 ? 1 : 2;
      if (region.has(v) && std::min(selected_.found, selected_.counted) >= members)
        selected_.found -= members, selected_.counted -= members;
      return true;
    });
    const NearZero& zero = search_.zero();
    const Index z = zero.count();
    out.vectors.resize(op_.states(), z + static_cast<Index>(order.size()));
    const double norm = norm_of_state_matrix(equations_);
    const auto backward_error = [&](double residual) { return norm > 0 ? residual / norm : 0; };
    const Matrix zeros = z > 0 ? zero.vectors() : Matrix(op_.states(), 0);
    out.vectors.leftCols(z) = zeros.cast<Complex>();
    const Eigen::VectorXd of_zeros = sizes_of_images(equations_, zeros);
    for (Index k = 0; k < z; ++k) {
      EigenMode& mode = out.modes.emplace_back(structural_zero_mode(zero.defective()));
      mode.backward_error = backward_error(of_zeros(k));
    }
    for (const std::size_t k : order) {
      out.vectors.col(static_cast<Index>(out.modes.size())) = pairs.right.col(static_cast<Index>(k));
      EigenMode& mode = out.modes.emplace_back(mode_of(pairs, found.trust[k], k));
      mode.backward_error = backward_error(found.residual[k] + std::abs(pairs.values[k] - computed[k]));
    }
    if (selected_.complete) {
      const bool everything = search_.right().everything() && search_.count_in(region) == search_.right().found();
      selected_.doubt = doubt_of(out.modes, wanted_, {region, op_.states(), search_.all_zeros(), everything});
      if (selected_.doubt.empty() && may_be_beyond) selected_.doubt = beyond_band;
      if (selected_.doubt.empty() && search_.reaches_too_far_down())
        selected_.doubt = "some are so far below the frequencies asked for that they are not told apart from there";
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
  const Progress& progress_;
  const std::shared_ptr<const ConservativeModel> conservative_;
  ShiftInverse op_;
  RegionSearch search_;
  SelectedModes& selected_ = search_.outcome();
};

}  // namespace

Result<EigenSolution> eigensolve_selected(const System& system, const Perturbation& perturbation,
                                          const ModeSelection& wanted, Vectors vectors, const Progress& progress) {
  const PerturbedPoint& at = *perturbation.at;
  const auto states = static_cast<Index>(perturbation.model.states.size());
  const auto from_all = [&]() -> Result<EigenSolution> {
    progress.tell("state matrix");
    auto linear = reduce(system, perturbation);
    if (!linear) return tl::unexpected(linear.error());
    auto all = eigensolve(*linear, vectors, progress);
    if (!all) return all;
    return selected_of(*all, wanted);
  };
  // No sparse equations have a block missing that the original implementation leaves out.
  const bool block_missing = at.without_damping && at.without_rate_coupling && perturbation.differential_states > 0;
  if (block_missing || states == 0) return from_all();
  auto solution = [&] {
    // Blocks are narrow: its threads would cost more than they give, and round as many as there are.
    const OneBlasThread alone;
    const Progress told = progress.of("selected modes");
    told.tell("factors");
    return Solution(system, perturbation, wanted, told).run(vectors);
  }();
  const bool settled = solution && solution->selected->complete;
  if (!settled && states <= most_for_full_solution) return from_all();
  if (!settled || states > states_of_middling_models) return solution;
  const double of_vectors = largest_backward_error(*solution), of_values = largest_relative_bound(*solution);
  if (of_vectors <= inexact_vector && of_values <= inexact_value) return solution;
  auto all = from_all();
  const bool better = all && ((of_vectors > inexact_vector && largest_backward_error(*all) < of_vectors) ||
                              (of_values > inexact_value && largest_relative_bound(*all) < of_values));
  return better ? std::move(all) : std::move(solution);
}

}  // namespace dynalin
