#include "base/blas_threads.h"

#include <dlfcn.h>

#include <mutex>

namespace dynalin {

namespace {

// Of the process: the number is kept by the first that asks and given back by the last.
class BlasThreads {
 public:
  void hold() {
    const std::lock_guard lock(mutex_);
    if (holders_++ > 0 || !count_ || !set_) return;
    before_ = count_();
    set_(1);
  }
  void give_back() {
    const std::lock_guard lock(mutex_);
    if (--holders_ == 0 && count_ && set_) set_(before_);
  }

 private:
  using Count = int (*)();
  using Set = void (*)(int);
  const Count count_ = reinterpret_cast<Count>(::dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  const Set set_ = reinterpret_cast<Set>(::dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  std::mutex mutex_;
  int holders_ = 0, before_ = 1;
};

BlasThreads& blas_threads() {
  static BlasThreads all;
  return all;
}

}  // namespace

OneBlasThread::OneBlasThread() { blas_threads().hold(); }
OneBlasThread::~OneBlasThread() { blas_threads().give_back(); }

}  // namespace dynalin
