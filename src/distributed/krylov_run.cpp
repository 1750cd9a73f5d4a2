// A Krylov iteration by SLEPc: the vectors of its space lie spread over all processes. The operator is applied by the
// first, with a whole vector; the others take part in what that needs of them, which is MUMPS.
#include "distributed/krylov_run.h"

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "distributed/krylov_progress.h"
#include "distributed/orders.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Operator = std::function<void(Eigen::VectorXcd&)>;
static_assert(std::is_same_v<PetscScalar, Complex>, "PETSc for complex numbers");

// Whether the others have failed as well is not known.
void check(PetscErrorCode code) {
  if (code != 0) end_all();
}

void start_library() {
  if (SlepcInitializeCalled) return;
  PetscOptionsSetValue(nullptr, "-skip_petscrc", "1");
  PetscOptionsSetValue(nullptr, "-no_signal_handler", "1");
  check(SlepcInitialize(nullptr, nullptr, nullptr, nullptr));
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

// What SLEPc says of its values one by one, as KrylovProgress asks for it.
class Watch {
 public:
  explicit Watch(const Order& task) : space_(task.space), progress_(task.wanted, task.least) {}

  double error_of(Complex value, double residual) {
    largest_ = std::max(largest_, std::abs(value));
    seen_.push_back({std::abs(value), residual});
    return KrylovProgress::is_found(seen_.back(), largest_) ? 0 : residual / std::abs(value);
  }
  // After a restart with so many leading values found; the one behind them was looked at last.
  bool ends(PetscInt found) {
    const bool next_seen = !seen_.empty() && found < space_ && found - before_ < count(seen_);
    if (found > before_ && found - before_ <= count(seen_))
      last_ = seen_[static_cast<std::size_t>(found - before_ - 1)].size;
    progress_.look(found, static_cast<Eigen::Index>(space_), last_,
                   next_seen ? std::optional(seen_.back()) : std::nullopt);
    seen_.clear(), before_ = found;
    return reached() || progress_.stands_still();
  }
  bool reached() const { return progress_.has_reached_its_end(); }
  std::vector<Complex> in_sight;

 private:
  static PetscInt count(const std::vector<KrylovProgress::Value>& s) { return static_cast<PetscInt>(s.size()); }

  const std::int64_t space_;
  KrylovProgress progress_;
  std::vector<KrylovProgress::Value> seen_;  // in this restart
  double largest_ = 0, last_ = 0;
  PetscInt before_ = 0;
};

class Iteration {
 public:
  // `op` and `task` are the first process's alone.
  Iteration(const Order& order, const Operator* op, const KrylovTask* task)
      : order_(order), op_(op), task_(task), watch_(order) {
    start_library();
    const auto n = static_cast<PetscInt>(order.size);
    check(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n, &like_));
    check(VecScatterCreateToZero(like_, &to_first_, &whole_));
    PetscInt local = 0;
    check(VecGetLocalSize(like_, &local));
    check(MatCreateShell(PETSC_COMM_WORLD, local, local, n, n, this, &matrix_));
    check(MatShellSetOperation(matrix_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    check(EPSCreate(PETSC_COMM_WORLD, &solver_));
  }
  ~Iteration() {
    EPSDestroy(&solver_), MatDestroy(&matrix_), VecScatterDestroy(&to_first_), VecDestroy(&whole_), VecDestroy(&like_);
  }
  Iteration(const Iteration&) = delete;
  Iteration& operator=(const Iteration&) = delete;

  // Nothing but `converged` for others than the first. Not converged if the operator could not be applied.
  KrylovRun run() {
    check(EPSSetOperators(solver_, matrix_, nullptr));
    check(EPSSetProblemType(solver_, EPS_NHEP));
    check(EPSSetType(solver_, EPSKRYLOVSCHUR));
    check(EPSSetWhichEigenpairs(solver_, EPS_LARGEST_MAGNITUDE));
    const auto space = static_cast<PetscInt>(order_.space);
    check(EPSSetDimensions(solver_, static_cast<PetscInt>(std::max<std::int64_t>(1, order_.wanted)), space, space));
    check(EPSSetTolerances(solver_, KrylovProgress::tolerance, static_cast<PetscInt>(order_.restarts)));
    check(EPSSetConvergenceTestFunction(solver_, test_value, this, nullptr));
    check(EPSSetStoppingTestFunction(solver_, test_end, this, nullptr));
    check(EPSMonitorSet(solver_, watch, this, nullptr));
    BV basis = nullptr;
    check(EPSGetBV(solver_, &basis));
    check(BVSetOrthogonalization(basis, BV_ORTHOG_CGS, BV_ORTHOG_REFINE_ALWAYS, PETSC_DEFAULT, BV_ORTHOG_BLOCK_GS));
    set_start();
    set_locked();
    const PetscErrorCode solved = EPSSolve(solver_);
    KrylovRun found;
    if (not_applied_) return found;
    check(solved);
    found.basis = vectors_found();
    found.converged = watch_.reached();
    found.in_sight = watch_.in_sight;
    return found;
  }

  std::exception_ptr error() const { return error_; }  // of the operator

 private:
  class Vectors {  // like `like`
   public:
    Vectors(Vec like, PetscInt count) : count_(count) {
      if (count > 0) check(VecDuplicateVecs(like, count, &all_));
    }
    ~Vectors() {
      if (all_) VecDestroyVecs(count_, &all_);
    }
    Vectors(const Vectors&) = delete;
    Vectors& operator=(const Vectors&) = delete;
    Vec operator[](PetscInt k) const { return all_[k]; }
    Vec* data() const { return all_; }

   private:
    Vec* all_ = nullptr;
    PetscInt count_;
  };

  // Between a vector that is spread and the whole of it, which the first process has.
  template <class Function>
  void with_whole(Function&& use) {
    PetscScalar* entries = nullptr;
    check(VecGetArray(whole_, &entries));
    use(Eigen::Map<Eigen::VectorXcd>(entries, op_ ? static_cast<Eigen::Index>(order_.size) : 0));
    check(VecRestoreArray(whole_, &entries));
  }
  void collect(Vec spread) {
    check(VecScatterBegin(to_first_, spread, whole_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(to_first_, spread, whole_, INSERT_VALUES, SCATTER_FORWARD));
  }
  void spread(Vec to) {
    check(VecScatterBegin(to_first_, whole_, to, INSERT_VALUES, SCATTER_REVERSE));
    check(VecScatterEnd(to_first_, whole_, to, INSERT_VALUES, SCATTER_REVERSE));
  }

  void set_start() {
    with_whole([&](auto v) {
      if (op_) v = task_->start;
    });
    Vec start = like_;
    spread(start);
    check(EPSSetInitialSpace(solver_, 1, &start));
  }
  void set_locked() {
    const auto count = static_cast<PetscInt>(order_.locked);
    const Vectors locked(like_, count);
    for (PetscInt k = 0; k < count; ++k) {
      with_whole([&](auto v) {
        if (op_) v = task_->locked.col(k);
      });
      spread(locked[k]);
    }
    if (count > 0) check(EPSSetDeflationSpace(solver_, count, locked.data()));
  }
  Eigen::MatrixXcd vectors_found() {
    PetscInt count = 0;
    check(EPSGetConverged(solver_, &count));
    const Vectors found(like_, count);
    if (count > 0) check(EPSGetInvariantSubspace(solver_, found.data()));
    Eigen::MatrixXcd whole(op_ ? static_cast<Eigen::Index>(order_.size) : 0, count);
    for (PetscInt k = 0; k < count; ++k) {
      collect(found[k]);
      with_whole([&](auto v) { whole.col(k) = v; });
    }
    return whole;
  }

  bool apply() {
    if (!op_) return serve_until(Order::Kind::applied).status != 0;
    Order applied;
    applied.kind = Order::Kind::applied;
    try {
      with_whole([&](auto entries) {
        Eigen::VectorXcd v = entries;
        (*op_)(v);
        entries = v;
        applied.status = v.allFinite() ? 1 : 0;
      });
    } catch (...) {
      error_ = std::current_exception();
    }
    give(applied);
    return applied.status != 0;
  }

  static PetscErrorCode multiply(Mat matrix, Vec x, Vec y) {
    Iteration* self = nullptr;
    MatShellGetContext(matrix, &self);
    try {
      self->collect(x);
      if (!self->apply()) {
        self->not_applied_ = true;
        return PETSC_ERR_LIB;
      }
      self->spread(y);
    } catch (...) {
      end_all();
    }
    return 0;
  }
  static PetscErrorCode test_value(EPS, PetscScalar value, PetscScalar, PetscReal residual, PetscReal* error,
                                   void* self) {
    *error = static_cast<Iteration*>(self)->watch_.error_of(value, residual);
    return 0;
  }
  static PetscErrorCode test_end(EPS, PetscInt restarts, PetscInt most, PetscInt found, PetscInt,
                                 EPSConvergedReason* reason, void* self) {
    *reason = static_cast<Iteration*>(self)->watch_.ends(found) ? EPS_CONVERGED_USER
              : restarts >= most                                ? EPS_DIVERGED_ITS
                                                                : EPS_CONVERGED_ITERATING;
    return 0;
  }
  static PetscErrorCode watch(EPS, PetscInt, PetscInt found, PetscScalar* values, PetscScalar*, PetscReal*,
                              PetscInt all, void* self) {
    if (found < all) static_cast<Iteration*>(self)->watch_.in_sight.assign(values + found, values + all);
    return 0;
  }

  const Order& order_;
  const Operator* op_;
  const KrylovTask* task_;
  Watch watch_;
  std::exception_ptr error_;
  bool not_applied_ = false;
  Vec like_ = nullptr, whole_ = nullptr;
  VecScatter to_first_ = nullptr;
  Mat matrix_ = nullptr;
  EPS solver_ = nullptr;
};

}  // namespace

std::optional<KrylovRun> krylov_run_of_team(const Operator& op, const KrylovTask& task) {
  // Small problems are not worth it, and the iteration alone handles spaces as large as the problem.
  constexpr Eigen::Index least_size = 300;
  const Eigen::Index left = task.start.size() - task.locked.cols();
  if (processes() == 1 || left < std::max(least_size, 3 * task.space)) return std::nullopt;
  Order order;
  order.kind = Order::Kind::krylov;
  order.size = task.start.size(), order.locked = task.locked.cols();
  order.wanted = task.wanted, order.space = task.space, order.restarts = task.restarts, order.least = task.least;
  give(order);
  KrylovRun found;
  std::exception_ptr error;
  try {
    Iteration iteration(order, &op, &task);
    found = iteration.run();
    error = iteration.error();
  } catch (...) {
    end_all();
  }
  if (error) std::rethrow_exception(error);
  found.images.resize(found.basis.rows(), found.basis.cols());
  for (Eigen::Index k = 0; k < found.basis.cols(); ++k) {
    Eigen::VectorXcd v = found.basis.col(k);
    op(v);
    found.images.col(k) = v;
  }
  return found;
}

void take_part_in_krylov(const Order& order) { Iteration(order, nullptr, nullptr).run(); }

}  // namespace dynalin
