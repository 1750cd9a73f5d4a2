// Working space for solutions with KLU. Its factors hold one, and so they serve one thread at a time; whoever else
// comes gets more.
#pragma once

#include <klu.h>

#include <memory>
#include <mutex>
#include <vector>

namespace dynalin {

class KluWork {
 public:
  // After every factorization, of numbers of so many doubles each.
  void follow(klu_numeric* factors, int doubles_each) {
    factors_ = factors, doubles_each_ = doubles_each;
    own_is_free_ = factors != nullptr;
    spare_.clear();
  }

  // solve(factors, common) with working space that nobody else has. Both are the caller's own.
  template <class Solve>
  void with(const klu_common& common, Solve&& solve) {
    klu_numeric factors = *factors_;
    klu_common report = common;
    std::unique_ptr<double[]> more = take(factors);
    solve(&factors, &report);
    give_back(std::move(more));
  }

 private:
  static constexpr std::size_t at_a_time = 4;  // right-hand sides

  // Nothing if it is that of the factors.
  std::unique_ptr<double[]> take(klu_numeric& factors) {
    std::unique_ptr<double[]> more;
    {
      const std::lock_guard lock(mutex_);
      if (own_is_free_) {
        own_is_free_ = false;
        return more;
      }
      if (!spare_.empty()) {
        more = std::move(spare_.back());
        spare_.pop_back();
      }
    }
    if (!more) {
      const auto size = at_a_time * static_cast<std::size_t>(doubles_each_) * static_cast<std::size_t>(factors.n);
      more = std::make_unique_for_overwrite<double[]>(size);
    }
    factors.Xwork = more.get();
    return more;
  }
  void give_back(std::unique_ptr<double[]> more) {
    const std::lock_guard lock(mutex_);
    if (more) {
      spare_.push_back(std::move(more));
    } else {
      own_is_free_ = true;
    }
  }

  klu_numeric* factors_ = nullptr;
  int doubles_each_ = 1;
  std::mutex mutex_;
  bool own_is_free_ = false;
  std::vector<std::unique_ptr<double[]>> spare_;
};

}  // namespace dynalin
