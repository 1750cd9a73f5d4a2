#include "selected_modes/selected_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/blas_threads.h"
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

double largest_backward_error(const EigenSolution& solution) {
  double largest = 0;
  for (const EigenMode& m : solution.modes) {
    if (!m.structural_zero && !(m.backward_error <= largest)) largest = m.backward_error;
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
    const auto* nearest = std::get_if<NearestModes>(&wanted_);
    if (!nearest || !found || found->selected->complete) return found;
    // Slow pairs that rounding has scattered may have been taken for two real values each: so many more make up for it.
    const std::size_t listed = modes_in(*found);
    if (listed >= nearest->count || search_.right().everything()) return found;
    Result<EigenSolution> more = find(NearestModes{2 * nearest->count - listed, nearest->frequency}, vectors);
    return more && modes_in(*more) > listed ? more : found;
  }

 private:
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
      if (is_mirror(v)) distance = std::min(distance, 2 * std::abs(v));
    }
    const NearZero zero = counted.has(0) ? search_.zero() : NearZero{Matrix(op_.states(), 0), Matrix(0, 0)};
    const bool both = !conservative_ && counted.centre.imag() == 0 && !upper_half;
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
      return !search_.region().has(pairs.values[k]) &&
             std::abs(pairs.values[k] - search_.region().centre) > found.trust[k].bound;
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
      const ModeRegion& region = search_.region();
      const bool everything = search_.right().everything() && search_.count_in(region) == search_.right().found();
      selected_.doubt = doubt_of(out.modes, wanted_, {region, op_.states(), search_.all_zeros(), everything});
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
  if (settled && states <= states_of_middling_models && !(largest_backward_error(*solution) <= inexact_vector)) {
    if (auto all = from_all(); all && largest_backward_error(*all) < largest_backward_error(*solution)) return all;
  }
  return solution;
}

}  // namespace dynalin
