#include "selected_modes/zero_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "perturbation/perturbation.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

constexpr double next_to_zero = 0.05;  // of a shift: what may be a zero, as far as it is computed
constexpr int most_rounds = 24;

struct Sight {
  bool zeros = false;  // from the last shift
  bool small = false;  // from any of them
};

// What is in sight of a shift σ > 0.
struct Glance {
  double least = std::numeric_limits<double>::infinity();  // modulus of what is not next to zero
  double zeros = 0;                                        // the largest next to it
  bool any_zeros = false;

  // Nothing is between what is next to zero and the modes, which are not far off: so far that their digits would be
  // lost beside 1/σ of the zeros, and 1/σ² of those in chains.
  bool is_good(double shift) const { return !std::isfinite(least) || (least >= 0.5 * shift && least <= 1e3 * shift); }
};

Glance glance_from(ModeSearch& right, double shift) {
  Glance seen;
  for (int round = 0; round < 3 && !std::isfinite(seen.least); ++round) {
    seen = {};
    for (const Complex& v : right.glance(4 + 8 * round)) {
      const double size = std::abs(v);
      if (size > next_to_zero * shift) {
        seen.least = std::min(seen.least, size);
      } else {
        seen.zeros = std::max(seen.zeros, size), seen.any_zeros = true;
      }
    }
  }
  return seen;
}

// A shift on the positive real axis that is small against all that is not zero, and not too small.
std::optional<Sight> place_near_zero(ShiftInverse& op, ModeSearch& right) {
  constexpr double surely_zero = 1e-3;  // of a shift
  double shift = 1.0137;
  Sight sight;
  const auto move_to = [&](double to) {
    shift = to;
    if (!op.move_to(shift)) return false;
    // Without them rounding scatters the zeros of equations that are not symmetric widely.
    if (!op.symmetric()) op.find_units();
    return true;
  };
  const auto settled = [&] {
    if (op.symmetric()) op.find_units();
    return sight;
  };
  std::optional<double> good;    // where what is next to zero may be modes as well as zeros that rounding scatters
  std::optional<double> placed;  // the last that could be factored
  for (int tries = 0; tries < 16; ++tries) {
    if (!move_to(shift)) {
      shift *= 1.3719;
      continue;
    }
    placed = shift;
    const Glance seen = glance_from(right, shift);
    sight.zeros = seen.any_zeros;
    sight.small = sight.small || sight.zeros;
    if (seen.is_good(shift)) {
      if (seen.zeros <= surely_zero * shift) return settled();
      // From nearby modes are modes still.
      if (good) break;
      good = shift;
      shift = 0.2137 * seen.zeros;
    } else {
      if (good) break;
      shift = 0.2137 * seen.least;
    }
  }
  if (good) sight.zeros = true;
  if (!placed || !move_to(good.value_or(*placed))) return std::nullopt;
  return settled();
}

NearZero zeros_of_matrix(const System& system, const Perturbation& perturbation) {
  const auto linear = reduce(system, perturbation);
  const auto states = static_cast<Index>(perturbation.model.states.size());
  return linear ? all_structural_zeros(*linear) : NearZero{Eigen::MatrixXd(states, 0), Eigen::MatrixXd(0, 0)};
}

}  // namespace

bool costs_more_than_all(const ModeSearch& right, Index states) {
  return states <= most_for_full_solution && right.found() > std::max<Index>(100, states / 6);
}

std::optional<ZerosFound> zeros_near(const System& system, const Perturbation& perturbation, ShiftInverse& op,
                                     ModeSearch& right) {
  const auto sight = place_near_zero(op, right);
  if (!sight) return std::nullopt;
  const Index states = op.states();
  const double shift = std::abs(op.shift()), near = next_to_zero * shift;
  ZerosFound found{{Eigen::MatrixXd(states, 0), Eigen::MatrixXd(0, 0)}, near};
  // Zeros are the nearest to this shift: an arbitrary vector shows the first of them at a glance.
  if (!sight->zeros) {
    // What was small at first may have been soft, or zeros in chains, which rounding scatters wherever they are looked
    // at from nearby.
    if (sight->small && states <= most_for_full_solution) found.zero = zeros_of_matrix(system, perturbation);
    return found;
  }
  // All that are no farther from the shift than what is near zero, and once more from elsewhere.
  int empty = 0;
  for (int round = 0; round < most_rounds && empty < 2 && !right.everything(); ++round) {
    if (costs_more_than_all(right, states)) return found;
    const Index before = right.found();
    right.run(8, shift + near);
    const auto values = right.values();
    const bool any = std::any_of(values.begin() + before, values.end(), [&](Complex v) { return std::abs(v) <= near; });
    empty = any ? 0 : empty + 1;
  }
  found.all = empty == 2 || right.everything();
  const auto part = right.part([&](Complex v) { return std::abs(v) <= near; });
  if (part.basis.cols() == 0) return found;
  if (states > most_for_state_matrix)
    found.zero = structural_zeros_near(system, perturbation, op.units().asDiagonal() * part.basis, op.units());
  // Long chains and speeds that mix zeros with others leave directions that are not clear enough.
  const bool unclear = states <= most_for_full_solution && found.zero.count() < part.basis.cols();
  if (states <= most_for_state_matrix || unclear) found.zero = zeros_of_matrix(system, perturbation);
  return found;
}

}  // namespace dynalin
