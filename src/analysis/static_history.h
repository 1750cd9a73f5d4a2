// What a search for an equilibrium has seen: enough for a short account of it.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace dynalin {

// Called with every iteration; for a line that shows progress.
using StaticProgress = std::function<void(int iteration, double imbalance)>;

class StaticHistory {
 public:
  explicit StaticHistory(StaticProgress progress) : progress_(std::move(progress)) {}

  // Forces that are out of balance, and the fastest rate of a state: it is at rest where both are nothing.
  void add(double imbalance, double rate);
  int iterations() const { return count_; }
  // The first, the best and the last.
  std::vector<std::string> lines() const;

 private:
  StaticProgress progress_;
  struct Iteration {
    double imbalance = 0, rate = 0;
  };
  int count_ = 0, best_at_ = 0;
  Iteration first_, best_{std::numeric_limits<double>::infinity(), 0}, last_;
};

}  // namespace dynalin
