// When Newton's method in a step of the integrator has converged: where it contracts, by the rate at which it does, as
// IDA's own test has it; where it no longer contracts because rounding is all that is left, when corrections are what
// rounding makes of their unknowns. IDA's own test would ask for shorter and shorter steps there, in vain.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include <functional>
#include <span>
#include <vector>

namespace dynalin {

class NewtonConvergence {
 public:
  // What rounding of its terms makes of each unknown, by the matrix that was factored last; false: not known.
  using Rounding = std::function<bool(std::span<double>)>;

  NewtonConvergence(std::size_t unknowns, int iterations, Rounding);

  // A matrix was factored anew: nothing is known of how corrections by it contract.
  void begin_matrix();
  // Of the iteration that `solver` is in, whose last correction this is; `left` is what it may leave of the error that
  // is allowed in a step, whose method has this leading coefficient. One of SUNDIALS' answers to a test of convergence.
  int test(SUNNonlinearSolver solver, double coefficient, N_Vector correction, double left, N_Vector weight);

  // What rounding leaves in each unknown, by the matrices so far; zero before the first.
  std::span<const double> rounding() const { return rounding_; }

 private:
  void look_at_rounding();
  double size_beyond_rounding(N_Vector correction, N_Vector weight) const;

  int iterations_;
  Rounding find_;
  std::vector<double> rounding_, here_;
  bool known_ = false, new_matrix_ = true;  // rounding of the matrix at hand; no iteration has begun with it
  double first_ = 0, last_ = 0;             // sizes of corrections of the iteration
  double coefficient_ = 0;                  // of the last step
  double still_to_come_;                    // at most this many times the last correction
};

}  // namespace dynalin
