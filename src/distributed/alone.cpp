// One process is all there is: MUMPS without MPI, Krylov iterations of our own.
#include <mutex>

#include "distributed/krylov_run.h"
#include "distributed/mumps_call.h"
#include "distributed/team.h"

namespace dynalin {

namespace {

std::mutex one_at_a_time;
FactorCost last_cost;

template <class Problem>
void call(Problem& problem, void (*mumps)(Problem*)) {
  constexpr int initialize = -1, use_comm_world = -987654;
  const std::lock_guard lock(one_at_a_time);
  if (problem.job == initialize) problem.comm_fortran = use_comm_world;
  mumps(&problem);
  if (has_factored(problem)) last_cost = cost_of(problem);
}

}  // namespace

void call_mumps(DMUMPS_STRUC_C& problem) { call(problem, dmumps_c); }
void call_mumps(ZMUMPS_STRUC_C& problem) { call(problem, zmumps_c); }
FactorCost last_mumps_factors() {
  const std::lock_guard lock(one_at_a_time);
  return last_cost;
}

std::optional<KrylovRun> krylov_run_of_team(const std::function<void(Eigen::VectorXcd&)>&, const KrylovTask&) {
  return std::nullopt;
}

Team::Team() = default;
Team::~Team() = default;
bool Team::leads() const { return true; }
int Team::serve() { return 0; }
int Team::end(int status) {
  ended_ = true;
  return status;
}

}  // namespace dynalin
