#include "simulation/ida_solver.h"

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

namespace dynalin {

namespace {

constexpr int recoverable = 1;
// Of one step: convergence failures and error test failures before it is given up.
constexpr int integrator_failures = 25;
constexpr double of_no_weight = 1e-20;
// What an iteration may leave, as a part of the error of a step. IDA's own, 0.33, costs more than it saves: what is
// left looks like an error of the step, and there are up to twice as many of these.
constexpr double left_by_iteration = 0.01;
// How far the leading coefficient of the method may be from that of the Jacobian. With IDA's own, 0.25, iterations of
// stiff models end at their limit in every fifth step.
constexpr double stale_coefficient = 0.1;
// How far what rounding makes of an unknown may be from a random sample.
constexpr double rounding_margin = 8;
// The error that is allowed in an unknown is no less than so much of its rounding, up to a bound.
constexpr double error_over_rounding = 4;

void check(int flag) {
  if (flag < 0) throw std::logic_error("the integrator was not set up as it must be");
}
template <class T>
T* check(T* made) {
  if (!made) throw std::bad_alloc();
  return made;
}

int iterations_of(const StepBounds& b) { return std::max(1, b.iterations); }

}  // namespace

IdaSolver::IdaSolver(Empty, DaeProblem& problem, const StepBounds& bounds)
    : problem_(problem),
      bounds_(bounds),
      convergence_(problem.size(), iterations_of(bounds), [this](auto to) { return rounding(to); }) {}

// What was made until something fails is freed, as it would not be without the first constructor.
IdaSolver::IdaSolver(DaeProblem& problem, const StepBounds& bounds) : IdaSolver(Empty(), problem, bounds) {
  const auto n = static_cast<sunindextype>(problem_.size());
  check(SUNContext_Create(nullptr, &context_));
  for (N_Vector* v : {&y_, &yp_, &work_, &id_, &weight_}) *v = check(N_VNew_Serial(n, context_));
  ida_ = check(IDACreate(context_));
  const IDAErrHandlerFn ignore = [](int, const char*, const char*, char*, void*) {};
  check(IDASetErrHandlerFn(ida_, ignore, nullptr));
}

IdaSolver::~IdaSolver() {
  if (ida_) IDAFree(&ida_);
  if (newton_) SUNNonlinSolFree(newton_);
  if (solver_) SUNLinSolFreeEmpty(solver_);
  if (matrix_) SUNMatFreeEmpty(matrix_);
  for (const N_Vector v : {y_, yp_, work_, id_, weight_}) {
    if (v) N_VDestroy(v);
  }
  if (context_) SUNContext_Free(&context_);
}

// --- what IDA calls

int IdaSolver::residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* self) {
  return of(self).problem_.residual(t, values(y), values(yp), values(r)) ? 0 : recoverable;
}

int IdaSolver::jacobian(double t, double c, N_Vector y, N_Vector yp, N_Vector, SUNMatrix, void* self, N_Vector,
                        N_Vector, N_Vector) {
  IdaSolver& s = of(self);
  s.convergence_.begin_matrix();
  s.coefficient_ = c;
  const ColumnMatrix* matrix = s.problem_.jacobian(t, c, values(y), values(yp));
  return matrix && s.factors_.factor(*matrix) ? 0 : recoverable;
}

int IdaSolver::solve(SUNLinearSolver by, SUNMatrix, N_Vector x, N_Vector b, double) {
  std::ranges::copy(values(b), values(x).begin());
  IdaSolver& s = of(by->content);
  s.factors_.solve(values(x));
  s.scale_to_step(values(x));
  return 0;
}

int IdaSolver::weights(N_Vector y, N_Vector weight, void* self) {
  IdaSolver& s = of(self);
  s.problem_.weights(s.next_step(), values(y), values(weight));
  s.allow_rounding(values(weight));
  return 0;
}

int IdaSolver::converged(SUNNonlinearSolver newton, N_Vector, N_Vector correction, double left, N_Vector weight,
                         void* self) {
  double c = 0;
  IDAGetCurrentCj(of(self).ida_, &c);
  return of(self).convergence_.test(newton, c, correction, left, weight);
}

int IdaSolver::switches(double t, N_Vector y, N_Vector yp, double* to, void* self) {
  DaeProblem& p = of(self).problem_;
  p.switches(t, values(y), values(yp), {to, p.switch_count()});
  const std::vector<int>& side = of(self).side_;
  for (std::size_t k = 0; k < side.size(); ++k)
    if (to[k] == 0) to[k] = side[k] * std::numeric_limits<double>::min();
  return 0;
}

// Where the matrix is that of another step the corrections of what is integrated are too large or too small, about by
// the mean of both coefficients. IDA scales all unknowns so; those that equations give at the instant (multipliers,
// VARIABLEs) would then keep a part of what was predicted for them, and as no error test holds them, rounding would
// grow from step to step until nothing is left of them.
void IdaSolver::scale_to_step(std::span<double> correction) const {
  double c = 0;
  IDAGetCurrentCj(ida_, &c);
  if (c == coefficient_) return;
  const double factor = 2 / (1 + c / coefficient_);
  for (std::size_t k = 0; k < correction.size(); ++k) {
    if (problem_.differential()[k] != 0.0) correction[k] *= factor;
  }
}

void IdaSolver::allow_rounding(std::span<double> weights) {
  const std::span<const double> rounding = convergence_.rounding();
  at_its_rounding_ = -1;
  double most = 1 + 1e-6;
  for (std::size_t k = 0; k < rounding.size(); ++k) {
    double& w = weights[k];
    w = std::max(w / bounds_.loosest, std::min(w, 1 / (error_over_rounding * rounding[k])));
    const double part = w * error_over_rounding * rounding[k];
    if (problem_.differential()[k] != 0.0 && part > most) most = part, at_its_rounding_ = static_cast<std::int64_t>(k);
  }
}

// Of each unknown, what rounding of the terms of all equations makes of it.
bool IdaSolver::rounding(std::span<double> to) {
  N_Vector at = nullptr, rate = nullptr;
  if (IDAGetCurrentY(ida_, &at) < 0 || IDAGetCurrentYp(ida_, &rate) < 0) return false;
  const std::span<double> error = values(work_);
  problem_.terms(values(at), values(rate), error);
  std::uniform_real_distribution<double> part(-1, 1);
  constexpr double unit = std::numeric_limits<double>::epsilon();
  for (double& e : error) e *= unit * part(random_);
  factors_.solve(error);
  for (std::size_t k = 0; k < to.size(); ++k)
    to[k] = std::max(unit * std::abs(values(at)[k]), rounding_margin * std::abs(error[k]));
  return std::ranges::all_of(to, [](double v) { return std::isfinite(v); });
}

// --- what it is told

void IdaSolver::attach_linear_solver() {
  matrix_ = check(SUNMatNewEmpty(context_));
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->zero = [](SUNMatrix) { return 0; };
  solver_ = check(SUNLinSolNewEmpty(context_));
  solver_->content = this;
  solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver_->ops->solve = &solve;
  check(IDASetLinearSolver(ida_, solver_, matrix_));
  check(IDASetJacFn(ida_, &jacobian));
  check(IDASetDeltaCjLSetup(ida_, stale_coefficient));
  check(IDASetLinearSolutionScaling(ida_, SUNFALSE));
}

void IdaSolver::set_up() {
  check(IDAInit(ida_, &residual, t, y_, yp_));
  check(IDASetUserData(ida_, this));
  check(IDAWFtolerances(ida_, &weights));
  std::copy(problem_.differential().begin(), problem_.differential().end(), values(id_).begin());
  check(IDASetId(ida_, id_));
  check(IDASetSuppressAlg(ida_, SUNTRUE));
  limit_order(bounds_.largest_order);
  if (bounds_.largest) limit_steps(*bounds_.largest);
  check(IDASetMaxNumSteps(ida_, -1));
  check(IDASetMaxErrTestFails(ida_, integrator_failures));
  check(IDASetMaxConvFails(ida_, integrator_failures));
  check(IDASetNonlinConvCoef(ida_, left_by_iteration));
  newton_ = check(SUNNonlinSol_Newton(y_, context_));
  check(IDASetNonlinearSolver(ida_, newton_));
  check(SUNNonlinSolSetConvTestFn(newton_, &converged, this));
  check(IDASetMaxNonlinIters(ida_, iterations_of(bounds_)));
  attach_linear_solver();
  const std::size_t count = problem_.switch_count();
  if (count > 0) check(IDARootInit(ida_, static_cast<int>(count), &switches));
  check(IDASetNoInactiveRootWarn(ida_));
}

void IdaSolver::begin() {
  side_.clear();
  if (begun_) return check(IDAReInit(ida_, t, y_, yp_));
  set_up();
  begun_ = true;
}

void IdaSolver::limit_order(int largest) { check(IDASetMaxOrd(ida_, largest)); }
void IdaSolver::limit_steps(double longest) { check(IDASetMaxStep(ida_, longest)); }

IdaSolver::Went IdaSolver::step(double end, double latest, std::optional<double> first) {
  if (first) check(IDASetInitStep(ida_, *first));
  check(IDASetStopTime(ida_, end));
  switch (IDASolve(ida_, latest, &t, y_, yp_, IDA_ONE_STEP)) {
    case IDA_SUCCESS:
    case IDA_TSTOP_RETURN:
      return Went::well;
    case IDA_ROOT_RETURN:
      side_.resize(problem_.switch_count());
      check(IDAGetRootInfo(ida_, side_.data()));
      return Went::to_switch;
    case IDA_ERR_FAIL:
      return Went::error_too_large;
    case IDA_REP_RES_ERR:
      return Went::without_values;
    case IDA_LSETUP_FAIL:
    case IDA_LSOLVE_FAIL:
      return Went::singular;
    case IDA_ILL_INPUT:
      return problem_.switch_count() > 0 ? Went::between_zeros : Went::too_short;
    default:
      return Went::not_converged;
  }
}

// --- what it knows

DaeProblem::Instant IdaSolver::within(double at) const {
  check(IDAGetDky(ida_, at, 0, work_));
  check(IDAGetDky(ida_, at, 1, weight_));
  return {at, values(work_), values(weight_)};
}

DaeProblem::Instant IdaSolver::by_rates(double at) const {
  N_VLinearSum(1, y_, at - t, yp_, work_);
  return {at, values(work_), yp()};
}

void IdaSolver::go_to(double at) {
  t = at;
  check(IDAGetDky(ida_, t, 0, y_));
  check(IDAGetDky(ida_, t, 1, yp_));
}

double IdaSolver::end_of_steps() const {
  double at = 0;
  check(IDAGetCurrentTime(ida_, &at));
  return at;
}

double IdaSolver::last_step() const {
  double length = 0;
  check(IDAGetLastStep(ida_, &length));
  return length;
}

double IdaSolver::next_step() const {
  double length = 0;
  check(IDAGetCurrentStep(ida_, &length));
  return length;
}

double IdaSolver::change() const {
  problem_.weights(0, y(), values(weight_));
  for (std::size_t k = 0; k < problem_.size(); ++k)
    values(work_)[k] = problem_.differential()[k] != 0.0 ? yp()[k] : 0.0;
  return N_VWrmsNorm(work_, weight_);
}

IntegrationStatistics IdaSolver::since_begin() const {
  IntegrationStatistics s;
  if (!begun_) return s;
  long steps = 0, evaluations = 0, setups = 0, errors = 0, iterations = 0, failures = 0, extra = 0;
  int last = 0, now = 0;
  double first = 0, used = 0, next = 0, at = 0;
  IDAGetIntegratorStats(ida_, &steps, &evaluations, &setups, &errors, &last, &now, &first, &used, &next, &at);
  IDAGetNonlinSolvStats(ida_, &iterations, &failures);
  IDAGetNumLinResEvals(ida_, &extra);
  s.steps = steps, s.evaluations = evaluations + extra, s.jacobians = setups;
  s.iterations = iterations, s.failed_error_tests = errors, s.failed_iterations = failures;
  s.step_size = used, s.order = last;
  return s;
}

std::int64_t IdaSolver::largest_error() const {
  if (IDAGetEstLocalErrors(ida_, work_) < 0 || IDAGetErrWeights(ida_, weight_) < 0) return -1;
  std::int64_t found = -1;
  double largest = 0;
  for (std::size_t k = 0; k < problem_.size(); ++k) {
    const double weight = values(weight_)[k];
    if (weight < of_no_weight) continue;
    const double e = std::abs(values(work_)[k] * weight);
    if (e > largest) largest = e, found = static_cast<std::int64_t>(k);
  }
  return found;
}

}  // namespace dynalin
