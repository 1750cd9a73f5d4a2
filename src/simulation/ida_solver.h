// SUNDIALS IDA with a DaeProblem behind it: its linear systems are solved by StepFactors, its iterations end by
// NewtonConvergence, and no error that it is asked for is less than rounding leaves. It makes single steps; what
// follows from how they went is for dae_integrator.h.
#pragma once

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "dynalin/simulation.h"
#include "simulation/dae_problem.h"
#include "simulation/newton_convergence.h"
#include "simulation/step_factors.h"

namespace dynalin {

class IdaSolver {
 public:
  IdaSolver(DaeProblem&, const StepBounds&);
  ~IdaSolver();
  IdaSolver(const IdaSolver&) = delete;
  IdaSolver& operator=(const IdaSolver&) = delete;

  // Where the last step has ended, or begin() is to begin.
  double t = 0;
  std::span<double> y() { return values(y_); }
  std::span<double> yp() { return values(yp_); }
  std::span<const double> y() const { return values(y_); }
  std::span<const double> yp() const { return values(yp_); }

  void begin();
  bool begun() const { return begun_; }
  // Once it has begun; from the next begin on.
  void limit_order(int largest);
  void limit_steps(double longest);

  enum class Went : std::uint8_t {
    well,
    to_switch,  // up to the first zero of one
    error_too_large,
    without_values,
    singular,
    between_zeros,  // a switch is zero at two instants that are hardly apart
    too_short,      // the next time is too near for a step
    not_converged
  };
  // One step towards `latest`, which ends no later than at `end`; of a stated length if it is the first.
  Went step(double end, double latest, std::optional<double> first);
  // After to_switch: of each switch the sign of its rate where it has met zero, else 0.
  std::span<const int> crossed() const { return side_; }

  // Values and rates at an instant of the last step, or of the next one as polynomials expect it; and as the rates of
  // now do, where nothing is known of the past. Both until either is called again.
  DaeProblem::Instant within(double at) const;
  DaeProblem::Instant by_rates(double at) const;
  void go_to(double at);        // within the last step
  double end_of_steps() const;  // beyond t where that is within a step
  double last_step() const;
  double next_step() const;
  double change() const;  // per time, of what is integrated: the mean in errors that are allowed
  IntegrationStatistics since_begin() const;

  // The unknown of which rounding leaves more than may be allowed, −1: none.
  std::int64_t at_its_rounding() const { return at_its_rounding_; }
  // The unknown whose error is the largest part of what is allowed, −1: not known.
  std::int64_t largest_error() const;

 private:
  struct Empty {};
  IdaSolver(Empty, DaeProblem&, const StepBounds&);

  static std::span<double> values(N_Vector v) { return {NV_DATA_S(v), static_cast<std::size_t>(NV_LENGTH_S(v))}; }
  static IdaSolver& of(void* self) { return *static_cast<IdaSolver*>(self); }
  // What IDA calls.
  static int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* self);
  static int jacobian(double t, double c, N_Vector y, N_Vector yp, N_Vector, SUNMatrix, void* self, N_Vector, N_Vector,
                      N_Vector);
  static int solve(SUNLinearSolver by, SUNMatrix, N_Vector x, N_Vector b, double);
  static int weights(N_Vector y, N_Vector weight, void* self);
  static int converged(SUNNonlinearSolver, N_Vector, N_Vector correction, double left, N_Vector weight, void* self);
  static int switches(double t, N_Vector y, N_Vector yp, double* to, void* self);

  void set_up();
  void attach_linear_solver();
  void scale_to_step(std::span<double> correction) const;
  void allow_rounding(std::span<double> weights);
  bool rounding(std::span<double> to);

  DaeProblem& problem_;
  StepBounds bounds_;
  SUNContext context_ = nullptr;
  void* ida_ = nullptr;
  N_Vector y_ = nullptr, yp_ = nullptr, work_ = nullptr, id_ = nullptr, weight_ = nullptr;
  // Shells: what IDA asks of a matrix and of what solves with it comes from the factors.
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  SUNNonlinearSolver newton_ = nullptr;
  StepFactors factors_;
  NewtonConvergence convergence_;
  std::minstd_rand random_{1};
  double coefficient_ = 1;  // of the method where the matrix was made
  bool begun_ = false;
  // The sides to which functions went where the last event was. Where the integration goes on from there they keep them
  // while they are zero: IDA gives up on one that is zero at two instants in a row.
  std::vector<int> side_;
  std::int64_t at_its_rounding_ = -1;
};

}  // namespace dynalin
