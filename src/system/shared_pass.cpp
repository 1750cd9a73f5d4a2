#include "system/shared_pass.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"

namespace dynalin {

namespace {

constexpr std::size_t worth_sharing = 8;       // shares; fewer take no longer than waking a thread
constexpr std::size_t shares_of_a_thread = 4;  // before what they add is taken

struct Task {
  const Kernel* kernel;
  Equations::Share share;

  // What does not share its work is evaluated when its turn has come.
  bool is_whole() const { return share.of == 1; }
};

std::vector<Task> tasks_of(std::span<const std::unique_ptr<Kernel>> kernels) {
  std::vector<Task> tasks;
  for (const auto& kernel : kernels) {
    const std::size_t shares = kernel->shares();
    for (std::size_t k = 0; k < shares; ++k) tasks.push_back({kernel.get(), {k, shares}});
  }
  return tasks;
}

}  // namespace

void add_equations(std::span<const std::unique_ptr<Kernel>> kernels, const Motion& motion, Threads threads,
                   Equations& eq) {
  const std::size_t at_work = threads == Threads::all && eq.can_be_shared() ? thread_count() : 1;
  std::vector<Task> tasks;
  if (at_work > 1) tasks = tasks_of(kernels);
  if (tasks.size() < kernels.size() + worth_sharing) {
    for (const auto& kernel : kernels) kernel->equations(motion, eq);
    return;
  }
  // While shares are evaluated those before them are taken.
  const std::size_t at_once = shares_of_a_thread * at_work;
  std::vector<Equations>& desks = eq.desks(2 * at_once);
  const auto desk = [&](std::size_t task) -> Equations& { return desks[task % (2 * at_once)]; };
  const auto evaluate = [&](std::size_t task) {
    if (tasks[task].is_whole()) return;
    desk(task).become_share_of(eq, tasks[task].share);
    tasks[task].kernel->equations(motion, desk(task));
  };
  const auto take = [&](std::size_t first) {
    for (std::size_t t = first; t < std::min(first + at_once, tasks.size()); ++t)
      tasks[t].is_whole() ? tasks[t].kernel->equations(motion, eq) : eq.take(desk(t).contributions());
  };
  for (std::size_t first = 0; first < tasks.size(); first += at_once) {
    const std::size_t count = std::min(at_once, tasks.size() - first);
    in_parallel(count + 1, [&](std::size_t k) {
      if (k > 0) return evaluate(first + k - 1);
      if (first > 0) take(first - at_once);
    });
  }
  take((tasks.size() - 1) / at_once * at_once);
}

}  // namespace dynalin
