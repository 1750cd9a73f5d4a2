#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/blas_threads.h"
#include "base/signals_held_back.h"

namespace dynalin {

namespace {

// The tasks of one call, taken one by one.
class Tasks {
 public:
  Tasks(std::size_t count, const std::function<void(std::size_t)>& task) : count_(count), task_(&task) {}

  void run(std::size_t k) {
    try {
      (*task_)(k);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (k < failed_) failed_ = k, error_ = std::current_exception();
    }
  }
  // Those that nobody has taken, but for the first.
  void run_rest() {
    for (std::size_t k = next_++; k < count_; k = next_++) run(k);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const std::size_t count_;
  const std::function<void(std::size_t)>* task_;
  std::atomic<std::size_t> next_ = 1;
  std::mutex mutex_;
  std::size_t failed_ = ~std::size_t{0};
  std::exception_ptr error_;
};

class Pool {
 public:
  Pool() { const OneBlasThread first; }  // whose own are there longer than the pool
  ~Pool() { stop(); }

  std::size_t size() const { return wanted_; }
  void resize(std::size_t wanted) {
    const std::lock_guard lock(busy_);
    stop();
    wanted_ = std::max<std::size_t>(1, wanted);
    if (wanted_ > 1) {
      alone_.reset();
    } else if (!alone_) {
      alone_.emplace();
    }
  }

  // False if somebody else has it.
  bool run(Tasks& tasks, std::size_t count) {
    const std::unique_lock owner(busy_, std::try_to_lock);
    if (!owner) return false;
    const std::size_t helpers = call_helpers(std::min<std::size_t>(wanted_, count) - 1);
    if (helpers == 0) return false;
    {
      const std::lock_guard lock(mutex_);
      tasks_ = &tasks, vacant_ = helpers;
    }
    if (helpers == 1) {
      wake_.notify_one();
    } else {
      wake_.notify_all();
    }
    tasks.run(0);
    tasks.run_rest();
    std::unique_lock lock(mutex_);
    tasks_ = nullptr;
    idle_.wait(lock, [&] { return at_work_ == 0; });
    return true;
  }

 private:
  // So many, or as many as the system lets there be.
  std::size_t call_helpers(std::size_t most) {
    const SignalsHeldBack quiet;
    try {
      while (threads_.size() < most) threads_.emplace_back([this](const std::stop_token& stop) { help(stop); });
    } catch (const std::system_error&) {
      wanted_ = threads_.size() + 1;
    }
    return std::min(most, threads_.size());
  }
  void help(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, stop, [&] { return tasks_ && vacant_ > 0; })) {
      Tasks& tasks = *tasks_;
      --vacant_, ++at_work_;
      lock.unlock();
      tasks.run_rest();
      lock.lock();
      if (--at_work_ == 0) idle_.notify_one();
    }
  }
  void stop() {
    for (std::jthread& t : threads_) t.request_stop();
    threads_.clear();
  }

  std::mutex busy_;  // of who gives the work
  std::atomic<std::size_t> wanted_ = std::max(1u, std::thread::hardware_concurrency());
  std::mutex mutex_;  // of what follows
  std::condition_variable_any wake_;
  std::condition_variable idle_;
  Tasks* tasks_ = nullptr;
  std::size_t vacant_ = 0, at_work_ = 0;
  std::vector<std::jthread> threads_;
  std::optional<OneBlasThread> alone_;  // who wants one thread wants none of the BLAS
};

Pool& pool() {
  static Pool all;
  return all;
}

// A task that has tasks of its own does them alone: the lock of the pool is in its hands, or in those of its caller.
thread_local bool in_task = false;

}  // namespace

std::size_t thread_count() { return pool().size(); }

void set_thread_count(std::size_t count) { pool().resize(count); }

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& task) {
  if (count == 0) return;
  const std::function<void(std::size_t)> marked = [&](std::size_t k) {
    const bool before = std::exchange(in_task, true);
    try {
      task(k);
    } catch (...) {
      in_task = before;
      throw;
    }
    in_task = before;
  };
  Tasks tasks(count, marked);
  std::optional<OneBlasThread> each;
  if (count > 1) each.emplace();
  if (in_task || count == 1 || thread_count() == 1 || !pool().run(tasks, count)) {
    for (std::size_t k = 0; k < count; ++k) tasks.run(k);
  }
  tasks.rethrow();
}

}  // namespace dynalin
