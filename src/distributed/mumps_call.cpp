// By all processes of a team: each has its part of the factors, the first also the matrix and the right-hand sides.
#include "distributed/mumps_call.h"

#include <mpi.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "distributed/orders.h"

namespace dynalin {

namespace {

constexpr int initialize = -1, terminate = -2;

void mumps(DMUMPS_STRUC_C& problem) { dmumps_c(&problem); }
void mumps(ZMUMPS_STRUC_C& problem) { zmumps_c(&problem); }

std::mutex one_at_a_time;
FactorCost last_cost;

template <class Problem>
void call(Problem& problem, Order::Kind kind) {
  const std::lock_guard lock(one_at_a_time);
  const bool alone = processes() == 1;
  if (problem.job == initialize) problem.comm_fortran = MPI_Comm_c2f(alone ? MPI_COMM_SELF : MPI_COMM_WORLD);
  if (!alone) {
    Order order;
    order.kind = kind;
    order.problem = reinterpret_cast<std::uintptr_t>(&problem);
    order.job = problem.job, order.symmetry = problem.sym;
    std::copy_n(problem.icntl, order.icntl.size(), order.icntl.begin());
    std::copy_n(problem.cntl, order.cntl.size(), order.cntl.begin());
    give(order);
  }
  mumps(problem);
  if (has_factored(problem)) last_cost = cost_of(problem);
}

template <class Problem>
void take_part(const Order& order) {
  static std::map<std::uint64_t, Problem> problems;
  Problem& problem = problems[order.problem];
  problem.job = order.job;
  if (order.job == initialize) {
    problem.par = 1, problem.sym = order.symmetry, problem.comm_fortran = MPI_Comm_c2f(MPI_COMM_WORLD);
  } else {
    std::copy(order.icntl.begin(), order.icntl.end(), problem.icntl);
    std::copy(order.cntl.begin(), order.cntl.end(), problem.cntl);
  }
  mumps(problem);
  if (order.job == terminate) problems.erase(order.problem);
}

}  // namespace

void call_mumps(DMUMPS_STRUC_C& problem) { call(problem, Order::Kind::real_factors); }
void call_mumps(ZMUMPS_STRUC_C& problem) { call(problem, Order::Kind::complex_factors); }
FactorCost last_mumps_factors() {
  const std::lock_guard lock(one_at_a_time);
  return last_cost;
}

void take_part_in_mumps(const Order& order) {
  order.kind == Order::Kind::real_factors ? take_part<DMUMPS_STRUC_C>(order) : take_part<ZMUMPS_STRUC_C>(order);
}

}  // namespace dynalin
