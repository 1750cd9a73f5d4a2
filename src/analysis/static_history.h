// What a search for an equilibrium has seen: enough for a short account of it.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/progress.h"

namespace dynalin {

// Called with every iteration.
using StaticProgress = std::function<void(int iteration, double imbalance)>;

class StaticHistory {
 public:
  explicit StaticHistory(StaticProgress watch, Progress progress = {})
      : watch_(std::move(watch)), progress_(std::move(progress)) {}

  // Which search is on from now: "continuation".
  void begin(std::string_view search);
  // Forces that are out of balance, and the fastest rate of a state: it is at rest where both are nothing.
  void add(double imbalance, double rate);
  int iterations() const { return count_; }
  // The first, the best and the last.
  std::vector<std::string> lines() const;

 private:
  StaticProgress watch_;
  Progress progress_;
  std::string_view search_;
  struct Iteration {
    double imbalance = 0, rate = 0;
  };
  int count_ = 0, best_at_ = 0;
  Iteration first_, best_{std::numeric_limits<double>::infinity(), 0}, last_;
};

}  // namespace dynalin
