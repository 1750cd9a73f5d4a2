#include "simulation/dae_integrator.h"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "simulation/hidden_crossings.h"
#include "simulation/newton_convergence.h"
#include "simulation/order_trial.h"
#include "simulation/step_factors.h"

namespace dynalin {

namespace {

constexpr int recoverable = 1;
// Of one step: convergence failures and error test failures before it is given up.
constexpr int integrator_failures = 25;
constexpr int standing_limit = 20;
constexpr int short_steps_limit = 12;  // more than an order is kept for while steps grow
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
constexpr double part_of_way = 1e-3;  // a first step is no longer than this

std::span<double> values(N_Vector v) { return {NV_DATA_S(v), static_cast<std::size_t>(NV_LENGTH_S(v))}; }
std::span<const double> constant(N_Vector v) { return values(v); }

void check(int flag) {
  if (flag < 0) throw std::logic_error("the integrator was not set up as it must be");
}
template <class T>
T* check(T* made) {
  if (!made) throw std::bad_alloc();
  return made;
}

}  // namespace

struct DaeIntegrator::Memory {
  DaeProblem& problem;
  StepBounds bounds;
  SUNContext context = nullptr;
  void* ida = nullptr;
  N_Vector y = nullptr, yp = nullptr, work = nullptr, id = nullptr, weight = nullptr;
  // Shells: what IDA asks of a matrix and of what solves with it comes from the factors.
  SUNMatrix matrix = nullptr;
  SUNLinearSolver solver = nullptr;
  StepFactors factors;
  SUNNonlinearSolver newton = nullptr;
  NewtonConvergence convergence;
  OrderTrial orders;
  std::optional<int> next_order;  // the largest from the next step on, if it changes
  std::minstd_rand random{1};
  double t = 0;
  double coefficient = 1;             // of the method where the matrix was made
  bool begun = false, fresh = false;  // fresh: no step has been made since the last start
  std::optional<double> stated_first;
  int standing = 0;     // steps in a row in which time did not go on
  int short_steps = 0;  // shorter than is allowed, in a row, that do not grow
  std::vector<int> crossed;
  // The sides to which functions went where the last event was. Where the integration goes on from there they keep them
  // while they are zero: IDA gives up on one that is zero at two instants in a row.
  std::vector<int> side;
  HiddenCrossings hidden;
  // The end of a step whose beginning is all that has been handed out, as something crossed zero in it.
  struct Rest {
    double end;
    Outcome outcome;
    std::vector<int> crossed;
  };
  std::optional<Rest> rest;
  std::vector<double> switches_now;
  std::string reason;
  std::int64_t at_its_rounding = -1;  // the unknown of which rounding leaves more than may be allowed
  IntegrationStatistics before;       // of what was before the last start
  std::int64_t restarts = 0;

  Memory(DaeProblem& p, const StepBounds& b)
      : problem(p),
        bounds(b),
        convergence(p.size(), std::max(1, b.iterations), [this](auto to) { return rounding(to); }),
        orders(largest_order()) {}
  ~Memory() {
    if (ida) IDAFree(&ida);
    if (newton) SUNNonlinSolFree(newton);
    if (solver) SUNLinSolFreeEmpty(solver);
    if (matrix) SUNMatFreeEmpty(matrix);
    for (const N_Vector v : {y, yp, work, id, weight}) {
      if (v) N_VDestroy(v);
    }
    if (context) SUNContext_Free(&context);
  }

  int largest_order() const { return std::clamp(bounds.largest_order, 1, 5); }
  static Memory& of(void* self) { return *static_cast<Memory*>(self); }

  static int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* self) {
    return of(self).problem.residual(t, constant(y), constant(yp), values(r)) ? 0 : recoverable;
  }
  static int jacobian(double t, double c, N_Vector y, N_Vector yp, N_Vector, SUNMatrix, void* self, N_Vector, N_Vector,
                      N_Vector) {
    Memory& m = of(self);
    m.convergence.begin_matrix();
    m.coefficient = c;
    const ColumnMatrix* matrix = m.problem.jacobian(t, c, constant(y), constant(yp));
    return matrix && m.factors.factor(*matrix) ? 0 : recoverable;
  }
  static int solve(SUNLinearSolver by, SUNMatrix, N_Vector x, N_Vector b, double) {
    std::ranges::copy(constant(b), values(x).begin());
    Memory& m = of(by->content);
    m.factors.solve(values(x));
    m.scale_to_step(values(x));
    return 0;
  }
  static int weights(N_Vector y, N_Vector weight, void* self) {
    double step = 0;
    IDAGetCurrentStep(of(self).ida, &step);
    Memory& m = of(self);
    m.problem.weights(step, constant(y), values(weight));
    m.allow_rounding(values(weight));
    return 0;
  }
  static int converged(SUNNonlinearSolver newton, N_Vector, N_Vector correction, double left, N_Vector weight,
                       void* self) {
    double c = 0;
    IDAGetCurrentCj(of(self).ida, &c);
    return of(self).convergence.test(newton, c, correction, left, weight);
  }

  // Where the matrix is that of another step the corrections of what is integrated are too large or too small, about by
  // the mean of both coefficients. IDA scales all unknowns so; those that equations give at the instant (multipliers,
  // VARIABLEs) would then keep a part of what was predicted for them, and as no error test holds them, rounding would
  // grow from step to step until nothing is left of them.
  void scale_to_step(std::span<double> correction) const {
    double c = 0;
    IDAGetCurrentCj(ida, &c);
    if (c == coefficient) return;
    const double factor = 2 / (1 + c / coefficient);
    for (std::size_t k = 0; k < correction.size(); ++k) {
      if (problem.differential()[k] != 0.0) correction[k] *= factor;
    }
  }

  void allow_rounding(std::span<double> weights) {
    const std::span<const double> rounding = convergence.rounding();
    at_its_rounding = -1;
    double most = 1 + 1e-6;
    for (std::size_t k = 0; k < rounding.size(); ++k) {
      double& w = weights[k];
      w = std::max(w / bounds.loosest, std::min(w, 1 / (error_over_rounding * rounding[k])));
      const double part = w * error_over_rounding * rounding[k];
      if (problem.differential()[k] != 0.0 && part > most) most = part, at_its_rounding = static_cast<std::int64_t>(k);
    }
  }

  Outcome fail(std::string why) {
    reason = at_its_rounding < 0 ? std::move(why) : "rounding alone is more than the error that is allowed";
    return Outcome::failed;
  }

  // Of each unknown, what rounding of the terms of all equations makes of it.
  bool rounding(std::span<double> to) {
    N_Vector at = nullptr, rate = nullptr;
    if (IDAGetCurrentY(ida, &at) < 0 || IDAGetCurrentYp(ida, &rate) < 0) return false;
    const std::span<double> error = values(work);
    problem.terms(constant(at), constant(rate), error);
    std::uniform_real_distribution<double> part(-1, 1);
    constexpr double unit = std::numeric_limits<double>::epsilon();
    for (double& e : error) e *= unit * part(random);
    factors.solve(error);
    for (std::size_t k = 0; k < to.size(); ++k)
      to[k] = std::max(unit * std::abs(constant(at)[k]), rounding_margin * std::abs(error[k]));
    return std::ranges::all_of(to, [](double v) { return std::isfinite(v); });
  }
  static int switches(double t, N_Vector y, N_Vector yp, double* to, void* self) {
    DaeProblem& p = of(self).problem;
    p.switches(t, constant(y), constant(yp), {to, p.switch_count()});
    const std::vector<int>& side = of(self).side;
    for (std::size_t k = 0; k < side.size(); ++k)
      if (to[k] == 0) to[k] = side[k] * std::numeric_limits<double>::min();
    return 0;
  }
  static void ignore(int, const char*, const char*, char*, void*) {}

  std::span<const double> switches_at(double at, N_Vector place, N_Vector rate) {
    switches_now.resize(problem.switch_count());
    problem.switches(at, constant(place), constant(rate), switches_now);
    return switches_now;
  }
  void place_at(double at) {
    t = at;
    check(IDAGetDky(ida, t, 0, y));
    check(IDAGetDky(ida, t, 1, yp));
  }

  // The step from one instant to another, or as far as something crosses zero that is not seen at its end.
  Outcome looked_into(double from, Rest to) {
    const HiddenCrossings::Values inside = [&](double at, std::span<double> found) {
      check(IDAGetDky(ida, at, 0, work));
      check(IDAGetDky(ida, at, 1, weight));
      problem.switches(at, constant(work), constant(weight), found);
    };
    if (t != to.end) place_at(to.end);
    std::optional<double> first;
    // IDA compares the ends of its own step: what changes twice in it is not known to it at the end of a part.
    std::span<const int> reported;
    if (to.outcome == Outcome::event) reported = to.crossed;
    if (problem.switch_count() > 0) first = hidden.first(from, to.end, switches_at(t, y, yp), inside, reported);
    if (!first) {
      if (to.outcome == Outcome::event) crossed = std::move(to.crossed);
      return to.outcome;
    }
    place_at(*first);
    crossed.assign(hidden.crossed().begin(), hidden.crossed().end());
    rest = std::move(to);
    return Outcome::event;
  }

  void attach_solver() {
    matrix = check(SUNMatNewEmpty(context));
    matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix->ops->zero = [](SUNMatrix) { return 0; };
    solver = check(SUNLinSolNewEmpty(context));
    solver->content = this;
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver->ops->solve = &solve;
    check(IDASetLinearSolver(ida, solver, matrix));
    check(IDASetJacFn(ida, &jacobian));
    check(IDASetDeltaCjLSetup(ida, stale_coefficient));
    check(IDASetLinearSolutionScaling(ida, SUNFALSE));
  }

  void make() {
    const auto n = static_cast<sunindextype>(problem.size());
    check(SUNContext_Create(nullptr, &context));
    for (N_Vector* v : {&y, &yp, &work, &id, &weight}) *v = check(N_VNew_Serial(n, context));
    ida = check(IDACreate(context));
    check(IDASetErrHandlerFn(ida, &ignore, this));
  }

  void begin(double at, std::optional<double> first_step) {
    t = at;
    if (!begun) {
      check(IDAInit(ida, &residual, t, y, yp));
      check(IDASetUserData(ida, this));
      check(IDAWFtolerances(ida, &weights));
      std::copy(problem.differential().begin(), problem.differential().end(), values(id).begin());
      check(IDASetId(ida, id));
      check(IDASetSuppressAlg(ida, SUNTRUE));
      check(IDASetMaxOrd(ida, largest_order()));
      check(IDASetMaxNumSteps(ida, -1));
      check(IDASetMaxErrTestFails(ida, integrator_failures));
      check(IDASetMaxConvFails(ida, integrator_failures));
      check(IDASetNonlinConvCoef(ida, left_by_iteration));
      newton = check(SUNNonlinSol_Newton(y, context));
      check(IDASetNonlinearSolver(ida, newton));
      check(SUNNonlinSolSetConvTestFn(newton, &converged, this));
      check(IDASetMaxNonlinIters(ida, std::max(1, bounds.iterations)));
      if (bounds.largest) check(IDASetMaxStep(ida, *bounds.largest));
      attach_solver();
      crossed.assign(problem.switch_count(), 0);
      if (!crossed.empty()) check(IDARootInit(ida, static_cast<int>(crossed.size()), &switches));
      check(IDASetNoInactiveRootWarn(ida));
      begun = true;
    } else {
      before = total();
      ++restarts;
      check(IDAReInit(ida, t, y, yp));
    }
    stated_first = first_step ? first_step : bounds.first;
    fresh = true;
    rest.reset();
    side.clear();
    hidden.begin(switches_at(t, y, yp));
  }

  // IDA's own choice takes the errors of the first step to be as large as what it changes: the shorter by far than they
  // need to be, the less is allowed, down to where rounding is all there is. An error like h² of something that changes
  // in a thousandth of the way ahead allows the mean of both.
  double first_step(double latest) {
    problem.weights(0, constant(y), values(weight));
    for (std::size_t k = 0; k < problem.size(); ++k)
      values(work)[k] = problem.differential()[k] != 0.0 ? values(yp)[k] : 0.0;
    const double change = 2 * N_VWrmsNorm(work, weight), longest = part_of_way * (latest - t);
    return change * longest > 1 ? std::sqrt(longest / change) : longest;
  }

  // Where the next step has to end that may go on to an instant.
  double end_of_step(double latest, std::optional<double> first) {
    if (!problem.looks_ahead()) return latest;
    double now = t, h = first.value_or(0);
    if (!first) {
      check(IDAGetCurrentTime(ida, &now));
      check(IDAGetCurrentStep(ida, &h));
    }
    if (now != t) return latest;  // the rest of a step that is made
    const double end = std::min(t + h, latest);
    if (!(end > t)) return latest;
    if (first) {
      N_VLinearSum(1, y, end - t, yp, work);
      N_VScale(1, yp, weight);
    } else {
      check(IDAGetDky(ida, end, 0, work));
      check(IDAGetDky(ida, end, 1, weight));
    }
    const double part = problem.part_to_make({t, constant(y), constant(yp)}, {end, constant(work), constant(weight)});
    // One that hardly goes on would count as none.
    constexpr double least_part = 1e-6, least_roundings = 1000;
    const double least = std::max(least_part * (end - t),
                                  least_roundings * std::numeric_limits<double>::epsilon() * (std::abs(t) + end - t));
    return part < 1 ? std::min(latest, t + std::max(least, part * (end - t))) : latest;
  }

  // IDA counts anew from each start.
  IntegrationStatistics total() const {
    IntegrationStatistics s = before;
    s.restarts = restarts;
    if (!begun) return s;
    long steps = 0, evaluations = 0, setups = 0, errors = 0, iterations = 0, failures = 0, extra = 0;
    int last = 0, now = 0;
    double first = 0, used = 0, next = 0, at = 0;
    IDAGetIntegratorStats(ida, &steps, &evaluations, &setups, &errors, &last, &now, &first, &used, &next, &at);
    IDAGetNonlinSolvStats(ida, &iterations, &failures);
    IDAGetNumLinResEvals(ida, &extra);
    s.steps += steps, s.evaluations += evaluations + extra, s.jacobians += setups;
    s.iterations += iterations, s.failed_error_tests += errors, s.failed_iterations += failures;
    s.step_size = used, s.order = last;
    return s;
  }
};

DaeIntegrator::DaeIntegrator(DaeProblem& problem, const StepBounds& bounds)
    : memory_(std::make_unique<Memory>(problem, bounds)) {
  memory_->make();
}
DaeIntegrator::~DaeIntegrator() = default;

void DaeIntegrator::start(double t, std::span<const double> y, std::span<const double> yp,
                          std::optional<double> first_step) {
  std::copy(y.begin(), y.end(), values(memory_->y).begin());
  std::copy(yp.begin(), yp.end(), values(memory_->yp).begin());
  memory_->begin(t, first_step);
}

void DaeIntegrator::limit_steps(double longest) { check(IDASetMaxStep(memory_->ida, longest)); }

DaeIntegrator::Outcome DaeIntegrator::step(double latest) {
  Memory& m = *memory_;
  if (m.rest) return m.looked_into(m.t, *std::exchange(m.rest, std::nullopt));
  if (const auto order = std::exchange(m.next_order, std::nullopt)) {
    check(IDASetMaxOrd(m.ida, *order));
    m.begin(m.t, std::nullopt);
  }
  std::optional<double> first;
  if (std::exchange(m.fresh, false)) {
    first = m.stated_first ? *m.stated_first : m.first_step(latest);
    check(IDASetInitStep(m.ida, *first));
  }
  check(IDASetStopTime(m.ida, m.end_of_step(latest, first)));
  const double before = m.t;
  const int flag = IDASolve(m.ida, latest, &m.t, m.y, m.yp, IDA_ONE_STEP);
  switch (flag) {
    case IDA_SUCCESS:
    case IDA_TSTOP_RETURN:
      break;
    case IDA_ROOT_RETURN:
      check(IDAGetRootInfo(m.ida, m.crossed.data()));
      m.side = m.crossed;
      return m.looked_into(before, {m.t, Outcome::event, m.crossed});
    case IDA_ERR_FAIL:
      return m.fail("no step is short enough for the error that is allowed");
    case IDA_REP_RES_ERR:
      m.reason = "the equations have no finite values";
      return Outcome::failed;
    case IDA_LSETUP_FAIL:
    case IDA_LSOLVE_FAIL:
      m.reason = "the equations are singular";
      return Outcome::failed;
    case IDA_ILL_INPUT:
      return m.fail("a function that switches is zero at two instants that are hardly apart");
    default:
      return m.fail("the iteration of a step does not converge however short it is");
  }
  // Steps that differ from none by rounding alone lead nowhere.
  const bool moved = m.t - before > 4 * std::numeric_limits<double>::epsilon() * std::abs(m.t);
  m.standing = moved ? 0 : m.standing + 1;
  if (m.standing > standing_limit) {
    return m.fail("time stands still: no step is short enough");
  }
  if (m.bounds.least && m.t < latest) {
    double used = 0, next = 0;
    check(IDAGetLastStep(m.ida, &used));
    check(IDAGetCurrentStep(m.ida, &next));
    // After a start steps are short, and grow.
    const bool is_short = next < *m.bounds.least;
    m.short_steps = is_short && next <= used ? m.short_steps + 1 : 0;
    if (is_short && (next < used || m.short_steps > short_steps_limit)) {
      m.reason = "the error that is allowed asks for steps shorter than HMIN";
      return Outcome::failed;
    }
  }
  m.next_order = m.orders.after_step(m.t - before, latest - m.t);
  return m.looked_into(before, {m.t, Outcome::step, {}});
}

double DaeIntegrator::time() const { return memory_->t; }
std::span<const double> DaeIntegrator::y() const { return constant(memory_->y); }
std::span<const double> DaeIntegrator::yp() const { return constant(memory_->yp); }

void DaeIntegrator::interpolate(double t, std::span<double> y, std::span<double> yp) const {
  const Memory& m = *memory_;
  const auto take = [&](int derivative, std::span<double> to) {
    check(IDAGetDky(m.ida, t, derivative, m.work));
    std::copy_n(values(m.work).begin(), to.size(), to.begin());
  };
  take(0, y);
  take(1, yp);
}

std::span<const int> DaeIntegrator::crossed() const { return memory_->crossed; }
const std::string& DaeIntegrator::reason() const { return memory_->reason; }

std::int64_t DaeIntegrator::at_its_rounding() const { return memory_->at_its_rounding; }

std::int64_t DaeIntegrator::hardest_unknown() const {
  const Memory& m = *memory_;
  if (m.at_its_rounding >= 0) return m.at_its_rounding;
  if (IDAGetEstLocalErrors(m.ida, m.work) < 0 || IDAGetErrWeights(m.ida, m.weight) < 0) return -1;
  std::int64_t hardest = -1;
  double largest = 0;
  for (std::size_t k = 0; k < m.problem.size(); ++k) {
    const double weight = values(m.weight)[k];
    if (weight < of_no_weight) continue;
    const double e = std::abs(values(m.work)[k] * weight);
    if (e > largest) largest = e, hardest = static_cast<std::int64_t>(k);
  }
  return hardest;
}

IntegrationStatistics DaeIntegrator::statistics() const { return memory_->total(); }

}  // namespace dynalin
