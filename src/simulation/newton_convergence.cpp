#include "simulation/newton_convergence.h"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

// IDA's own: of a matrix of which nothing is known, of steps of another coefficient than the last, and the rate of
// iterations that do not converge.
constexpr double still_to_come_at_first = 20, still_to_come_at_change = 100, worst_rate = 0.9;
// Corrections that shrink by less than this may be rounding.
constexpr double hardly_shorter = 0.3;
constexpr double kept = 0.5;           // of what rounding left by the matrix before: samples differ
constexpr double nothing_left = 1e-6;  // of what an iteration may leave

}  // namespace

NewtonConvergence::NewtonConvergence(std::size_t unknowns, int iterations, Rounding find)
    : iterations_(iterations),
      find_(std::move(find)),
      rounding_(unknowns, 0.0),
      here_(unknowns, 0.0),
      still_to_come_(still_to_come_at_first) {}

void NewtonConvergence::begin_matrix() {
  known_ = false, new_matrix_ = true;
  still_to_come_ = still_to_come_at_first;
}

int NewtonConvergence::test(SUNNonlinearSolver solver, double coefficient, N_Vector correction, double left,
                            N_Vector weight) {
  if (!known_) look_at_rounding();
  const double size = N_VWrmsNorm(correction, weight);
  int iteration = 0;
  SUNNonlinSolGetCurIter(solver, &iteration);
  if (iteration == 0) {
    if (coefficient != coefficient_ && !new_matrix_) still_to_come_ = still_to_come_at_change;
    coefficient_ = coefficient, new_matrix_ = false;
    first_ = last_ = size;
    if (size <= nothing_left * left) return SUN_NLS_SUCCESS;
    return still_to_come_ * size <= left ? SUN_NLS_SUCCESS : SUN_NLS_CONTINUE;
  }
  const double rate = std::pow(size / first_, 1.0 / iteration);
  const bool stands = size > hardly_shorter * last_ || iteration + 1 >= iterations_;
  const double contraction = std::min(rate, worst_rate);
  still_to_come_ = contraction / (1 - contraction);
  last_ = size;
  if (stands && still_to_come_ * size_beyond_rounding(correction, weight) <= left) return SUN_NLS_SUCCESS;
  if (!(rate <= worst_rate)) return SUN_NLS_CONV_RECVR;
  return still_to_come_ * size <= left ? SUN_NLS_SUCCESS : SUN_NLS_CONTINUE;
}

void NewtonConvergence::look_at_rounding() {
  known_ = true;
  if (!find_(here_)) return;
  for (std::size_t k = 0; k < here_.size(); ++k) rounding_[k] = std::max(here_[k], kept * rounding_[k]);
}

double NewtonConvergence::size_beyond_rounding(N_Vector correction, N_Vector weight) const {
  const double *c = NV_DATA_S(correction), *w = NV_DATA_S(weight);
  double sum = 0;
  for (std::size_t k = 0; k < rounding_.size(); ++k) {
    const double beyond = std::max(0.0, std::abs(c[k]) - rounding_[k]) * w[k];
    sum += beyond * beyond;
  }
  return std::sqrt(sum / static_cast<double>(rounding_.size()));
}

}  // namespace dynalin
