#include "distributed/team.h"

#include <mpi.h>
#include <slepcsys.h>

#include <cstdlib>
#include <ctime>

#include "base/parallel.h"
#include "distributed/orders.h"

namespace dynalin {

namespace {

constexpr int first = 0;

struct Joined {
  MPI_Comm orders = MPI_COMM_NULL;
  int rank = first, size = 1;
};
Joined& joined() {
  static Joined of_this_process;
  return of_this_process;
}

// Those who wait for an order sleep, so that the first has the processors to itself while it works alone.
void wait(MPI_Request& request) {
  constexpr int awake = 2000;
  constexpr std::timespec nap{0, 200'000};
  for (int tries = 0;; ++tries) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    if (tries > awake) ::nanosleep(&nap, nullptr);
  }
}

void broadcast(Order& order) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&order, sizeof order, MPI_BYTE, first, joined().orders, &request);
  wait(request);
}

void leave() {
  if (SlepcInitializeCalled) SlepcFinalize();
  MPI_Comm_free(&joined().orders);
  MPI_Finalize();
  joined() = {};
}

}  // namespace

int processes() { return joined().size; }

void give(Order order) {
  if (processes() > 1) broadcast(order);
}

Order serve_until(Order::Kind last) {
  for (;;) {
    Order order;
    broadcast(order);
    if (order.kind == last) return order;
    switch (order.kind) {
      case Order::Kind::real_factors:
      case Order::Kind::complex_factors:
        take_part_in_mumps(order);
        break;
      case Order::Kind::krylov:
        take_part_in_krylov(order);
        break;
      case Order::Kind::applied:
      case Order::Kind::end:
        end_all();  // out of step
    }
  }
}

void end_all() {
  constexpr int analysis_failed = 2;
  MPI_Abort(MPI_COMM_WORLD, analysis_failed);
  std::abort();
}

Team::Team() {
  // Without mpirun there is nobody to ask for other processes.
  if (!std::getenv("OMPI_COMM_WORLD_SIZE")) ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  int threads = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threads);
  MPI_Comm_dup(MPI_COMM_WORLD, &joined().orders);
  MPI_Comm_rank(joined().orders, &joined().rank);
  MPI_Comm_size(joined().orders, &joined().size);
  if (joined().size > 1) set_thread_count(1);  // a process for each core
}

Team::~Team() {
  if (!ended_) end_all();
}

bool Team::leads() const { return joined().rank == first; }

int Team::serve() {
  int status = 0;
  try {
    status = serve_until(Order::Kind::end).status;
  } catch (...) {
    end_all();
  }
  ended_ = true;
  leave();
  return status;
}

int Team::end(int status) {
  Order order;
  order.status = status;
  give(order);
  ended_ = true;
  leave();
  return status;
}

}  // namespace dynalin
